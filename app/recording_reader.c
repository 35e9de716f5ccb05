// The only place of the command that reads HDF5 files. What goes wrong here ends this process alone.
#include "recording_reader.h"

#include <errno.h>
#include <hdf5.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

enum { BYTES_A_SECOND = 20 << 20 }; // of slow disks and slow filters

typedef struct Reader {
	const JnGuardChild* own;
	hid_t file;
	char* payload; // of the reply; owned
	size_t room;   // of the payload
} Reader;

size_t reader_number_size(RecordingNumber kind) {
	static const size_t sizes[] = {
		[RECORDING_REAL] = sizeof(double), [RECORDING_INTEGER] = sizeof(int), [RECORDING_LONG] = sizeof(long)};
	return sizes[kind];
}

static hid_t type_of(RecordingNumber kind) {
	const hid_t types[] = {
		[RECORDING_REAL] = H5T_NATIVE_DOUBLE, [RECORDING_INTEGER] = H5T_NATIVE_INT, [RECORDING_LONG] = H5T_NATIVE_LONG};
	return types[kind];
}

bool reader_send(int socket, const void* data, size_t size) {
	for (const char* at = data; size > 0;) {
		const ssize_t count = send(socket, at, size, MSG_NOSIGNAL);
		if (count < 0 && errno == EINTR) continue;
		if (count <= 0) return false;
		at += count;
		size -= (size_t)count;
	}
	return true;
}

bool reader_receive(int socket, void* data, size_t size) {
	for (char* at = data; size > 0;) {
		const ssize_t count = recv(socket, at, size, 0);
		if (count < 0 && errno == EINTR) continue;
		if (count <= 0) return false;
		at += count;
		size -= (size_t)count;
	}
	return true;
}

// ---- what it is asked ----

static bool is_opened(Reader* reader, const ReaderRequest* request, ReaderReply* reply) {
	(void)request, (void)reply;
	return reader->file >= 0;
}

static bool has(Reader* reader, const ReaderRequest* request, ReaderReply* reply) {
	(void)reply;
	return H5Lexists(reader->file, request->object, H5P_DEFAULT) > 0;
}

/// Bytes that the numbers of a dataset can come from. No filter of HDF5's own makes more of a byte than zlib, 1032 of one.
static hsize_t bytes_behind(hid_t dataset) {
	enum { MOST_OF_A_BYTE = 1032 };
	const hid_t layout = H5Dget_create_plist(dataset);
	const bool is_filtered = H5Pget_nfilters(layout) > 0;
	H5Pclose(layout);
	return H5Dget_storage_size(dataset) * (is_filtered ? MOST_OF_A_BYTE : 1);
}

static bool measure(Reader* reader, const ReaderRequest* request, ReaderReply* reply) {
	hsize_t lengths[H5S_MAX_RANK] = {0};
	const hid_t dataset = H5Dopen2(reader->file, request->object, H5P_DEFAULT);
	if (dataset < 0) return false;
	const hid_t space = H5Dget_space(dataset), type = H5Dget_type(dataset);
	const size_t width = H5Tget_size(type);
	RecordingSize* size = &reply->size;
	size->entries = H5Sget_simple_extent_npoints(space);
	size->most = width > 0 ? (int64_t)(bytes_behind(dataset) / width) : 0;
	size->rank = H5Sget_simple_extent_dims(space, lengths, NULL);
	for (int i = 0; i < 2; ++i) size->lengths[i] = lengths[i] < INT64_MAX ? (int64_t)lengths[i] : INT64_MAX;
	H5Tclose(type);
	H5Sclose(space);
	H5Dclose(dataset);
	return true;
}

static bool count_links(Reader* reader, const ReaderRequest* request, ReaderReply* reply) {
	H5G_info_t facts;
	if (H5Gget_info_by_name(reader->file, request->object, &facts, H5P_DEFAULT) < 0) return false;
	reply->number.whole = (long)facts.nlinks;
	return true;
}

/// Is there one value, and not an array of them? Closes the space.
static bool is_single(hid_t space) {
	const bool is = H5Sget_simple_extent_npoints(space) == 1;
	H5Sclose(space);
	return is;
}

static bool read_attribute(Reader* reader, const ReaderRequest* request, ReaderReply* reply) {
	const hid_t attribute =
		H5Aopen_by_name(reader->file, request->object, request->attribute, H5P_DEFAULT, H5P_DEFAULT);
	if (attribute < 0) return false;
	const bool is_read =
		is_single(H5Aget_space(attribute)) && H5Aread(attribute, type_of(request->kind), &reply->number) >= 0;
	H5Aclose(attribute);
	return is_read;
}

/// A place for `size` bytes more in the payload; NULL when memory is out.
static char* extend(Reader* reader, ReaderReply* reply, size_t size) {
	if (size > SIZE_MAX / 4) return NULL;
	const size_t needed = reply->payload + size;
	if (needed > reader->room) {
		const size_t room = reply->payload > 0 ? 2 * needed : needed; // what grows once will do so again
		char* moved = realloc(reader->payload, room);
		if (moved == NULL) return NULL;
		reader->payload = moved;
		reader->room = room;
	}
	reply->payload = needed;
	return reader->payload + needed - size;
}

/// A text as it lies in memory: of variable length HDF5 makes room for it.
static bool take_text(Reader* reader, hid_t object, bool is_attribute, hid_t type, ReaderReply* reply) {
	const bool is_variable = H5Tis_variable_str(type) > 0;
	char *made = NULL, *text = is_variable ? NULL : extend(reader, reply, H5Tget_size(type));
	void* to = is_variable ? (void*)&made : text;
	if (to == NULL) return false;
	const herr_t outcome =
		is_attribute ? H5Aread(object, type, to) : H5Dread(object, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, to);
	if (outcome < 0 || (is_variable && made == NULL)) return false;
	if (is_variable) {
		const size_t length = strlen(made);
		text = extend(reader, reply, length);
		// NOLINTNEXTLINE(bugprone-not-null-terminated-result): the reply says how long it is
		if (text != NULL) memcpy(text, made, length);
		H5free_memory(made);
	} else {
		reply->payload = strnlen(text, reply->payload);
	}
	return text != NULL;
}

static bool read_text(Reader* reader, const ReaderRequest* request, ReaderReply* reply) {
	const bool is_attribute = request->attribute[0] != '\0';
	const hid_t object =
		is_attribute ? H5Aopen_by_name(reader->file, request->object, request->attribute, H5P_DEFAULT, H5P_DEFAULT)
					 : H5Dopen2(reader->file, request->object, H5P_DEFAULT);
	if (object < 0) return false;
	const hid_t type = is_attribute ? H5Aget_type(object) : H5Dget_type(object);
	const bool is_text =
		H5Tget_class(type) == H5T_STRING && is_single(is_attribute ? H5Aget_space(object) : H5Dget_space(object));
	const bool is_read = is_text && take_text(reader, object, is_attribute, type, reply);
	H5Tclose(type);
	is_attribute ? H5Aclose(object) : H5Dclose(object);
	return is_read;
}

typedef struct Names {
	Reader* reader;
	ReaderReply* reply;
} Names;

static herr_t meet(hid_t group, const char* name, const H5L_info_t* info, void* user) {
	const Names* names = user;
	const size_t size = strlen(name) + 1;
	char* to = extend(names->reader, names->reply, size);
	(void)group, (void)info;
	if (to == NULL) return -1;
	memcpy(to, name, size);
	return 0;
}

static bool read_names(Reader* reader, const ReaderRequest* request, ReaderReply* reply) {
	Names names = {reader, reply};
	const hid_t group = H5Gopen2(reader->file, request->object, H5P_DEFAULT);
	if (group < 0) return false;
	const herr_t outcome = H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, NULL, meet, &names);
	H5Gclose(group);
	return outcome >= 0;
}

// ---- numbers ----

static bool gather_times(Reader* reader, const ReaderRequest* request, ReaderReply* reply) {
	ReaderRequest frame = {.kind = RECORDING_REAL, .attribute = "time"};
	for (int64_t i = 0; i < request->count; ++i) {
		ReaderReply time;
		snprintf(frame.object, sizeof frame.object, "/frames/%08" PRId64, request->first + i);
		jn_guard_wind(reader->own, 0);
		char* to = read_attribute(reader, &frame, &time) ? extend(reader, reply, sizeof time.number.real) : NULL;
		if (to == NULL) return false;
		memcpy(to, &time.number.real, sizeof time.number.real);
	}
	return true;
}

static bool read_array(Reader* reader, const ReaderRequest* request, ReaderReply* reply) {
	const size_t width = reader_number_size(request->kind);
	const size_t bytes = (size_t)request->count * width;
	const hid_t dataset = H5Dopen2(reader->file, request->object, H5P_DEFAULT);
	if (dataset < 0) return false;
	const hid_t space = H5Dget_space(dataset);
	const bool fits = H5Sget_simple_extent_npoints(space) == request->count;
	jn_guard_wind(reader->own, (int)(bytes / BYTES_A_SECOND));
	jn_guard_allow(reader->own, reader->room + bytes); // of a larger one before, and of this one
	void* numbers = fits ? extend(reader, reply, bytes) : NULL;
	const bool is_read =
		numbers != NULL && H5Dread(dataset, type_of(request->kind), H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers) >= 0;
	H5Sclose(space);
	H5Dclose(dataset);
	return is_read;
}

// ---- answering ----

typedef bool Answer(Reader* reader, const ReaderRequest* request, ReaderReply* reply);

static Answer* const answers[READER_VERBS] = {
	[READER_OPENED] = is_opened,  [READER_HAS] = has,          [READER_SIZE] = measure,
	[READER_LINKS] = count_links, [READER_TEXT] = read_text,   [READER_ATTRIBUTE] = read_attribute,
	[READER_NAMES] = read_names,  [READER_ARRAY] = read_array, [READER_TIMES] = gather_times,
};

static bool answer(Reader* reader, const ReaderRequest* request) {
	ReaderReply reply;
	memset(&reply, 0, sizeof reply); // its gaps too: it is sent
	jn_guard_wind(reader->own, 0);
	reply.is_good = answers[request->verb](reader, request, &reply);
	if (!reply.is_good) reply.payload = 0;
	return reader_send(reader->own->socket, &reply, sizeof reply) &&
		   reader_send(reader->own->socket, reader->payload, reply.payload);
}

void reader_serve(const JnGuardChild* own, void* path) {
	Reader reader = {.own = own};
	ReaderRequest request;
	H5Eset_auto2(H5E_DEFAULT, NULL, NULL); // the words are ours
	reader.file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
	while (reader_receive(own->socket, &request, sizeof request) && answer(&reader, &request)) continue;
	if (reader.file >= 0) H5Fclose(reader.file);
	free(reader.payload);
}
