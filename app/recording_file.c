// This process's side of reading: questions for the child, and answers that are looked at before they are believed.
#include "recording_file.h"

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/log.h"
#include "record/h5_driver.h"
#include "record/text_file.h"
#include "recording_reader.h"

enum { MOST_WORDS = 1 << 30 };

static const JnGuardLimits limits = {
	.memory = (size_t)1 << 30, .seconds = 5, .remedy = "it is damaged: run the scene again"};

struct RecordingFile {
	JnGuardChild child;
	bool has_failed;
	char path[JN_PATH_SIZE];
};

// ---- questions ----

static bool lose(RecordingFile* file) {
	kill(file->child.id, SIGKILL); // it may have gone, or have answered nonsense
	jn_guard_end(file->path, &file->child);
	file->has_failed = true;
	return false;
}

static ReaderRequest ask_for(ReaderVerb verb, const char* object) {
	ReaderRequest request;
	memset(&request, 0, sizeof request); // its gaps too: it is sent
	request.verb = verb;
	snprintf(request.object, sizeof request.object, "%s", object);
	return request;
}

/// False when the child says no, or has failed. The payload of *reply, if any, is the next to be received.
static bool ask(RecordingFile* file, const ReaderRequest* request, ReaderReply* reply) {
	if (file->has_failed) return false;
	if (!reader_send(file->child.socket, request, sizeof *request) ||
		!reader_receive(file->child.socket, reply, sizeof *reply))
		return lose(file);
	return reply->is_good;
}

/// The payload with a zero behind it, from the arena; NULL when memory is out or the child has failed.
static char* receive_payload(RecordingFile* file, const ReaderReply* reply, JnArena* arena) {
	char* bytes = reply->payload < MOST_WORDS ? jn_arena_take(arena, reply->payload + 1, 1) : NULL;
	if (bytes == NULL || !reader_receive(file->child.socket, bytes, reply->payload)) {
		lose(file);
		return NULL;
	}
	bytes[reply->payload] = '\0';
	return bytes;
}

bool recording_file_has(RecordingFile* file, const char* object) {
	const ReaderRequest request = ask_for(READER_HAS, object);
	ReaderReply reply;
	return ask(file, &request, &reply);
}

JnStatus recording_file_attribute(RecordingFile* file, const char* object, const char* name, RecordingNumber kind,
								  void* value) {
	ReaderRequest request = ask_for(READER_ATTRIBUTE, object);
	ReaderReply reply;
	request.kind = kind;
	snprintf(request.attribute, sizeof request.attribute, "%s", name);
	if (!ask(file, &request, &reply)) return JN_IO_FAILED;
	memcpy(value, &reply.number, reader_number_size(kind));
	return JN_OK;
}

JnStatus recording_file_text(RecordingFile* file, const char* object, const char* attribute, JnArena* arena,
							 char** text) {
	ReaderRequest request = ask_for(READER_TEXT, object);
	ReaderReply reply;
	if (attribute != NULL) snprintf(request.attribute, sizeof request.attribute, "%s", attribute);
	if (!ask(file, &request, &reply)) return JN_IO_FAILED;
	*text = receive_payload(file, &reply, arena);
	return *text != NULL ? JN_OK : file->has_failed ? JN_IO_FAILED : JN_OUT_OF_MEMORY;
}

JnStatus recording_file_names(RecordingFile* file, const char* group, JnArena* arena, const char* const** names,
							  int* count) {
	const ReaderRequest request = ask_for(READER_NAMES, group);
	ReaderReply reply;
	const char** list;
	int found = 0;
	*names = NULL;
	*count = 0;
	if (!ask(file, &request, &reply)) return JN_IO_FAILED;
	char* text = receive_payload(file, &reply, arena);
	if (text == NULL) return file->has_failed ? JN_IO_FAILED : JN_OUT_OF_MEMORY;
	const char* end = text + reply.payload;
	for (const char* at = text; at < end; at += strlen(at) + 1) ++found;
	JN_NEW(arena, list, found + 1);
	for (const char* at = text; at < end; at += strlen(at) + 1) list[(*count)++] = at;
	*names = list;
	return JN_OK;
}

RecordingSize recording_file_size(RecordingFile* file, const char* name) {
	const ReaderRequest request = ask_for(READER_SIZE, name);
	ReaderReply reply;
	return ask(file, &request, &reply) ? reply.size : (RecordingSize){.entries = -1};
}

int64_t recording_file_measure(RecordingFile* file, const char* name) {
	const RecordingSize size = recording_file_size(file, name);
	return size.entries <= size.most ? size.entries : -1;
}

int64_t recording_file_links(RecordingFile* file, const char* group) {
	const ReaderRequest request = ask_for(READER_LINKS, group);
	ReaderReply reply;
	return ask(file, &request, &reply) ? reply.number.whole : -1;
}

static JnStatus receive_numbers(RecordingFile* file, const ReaderRequest* request, void* data) {
	ReaderReply reply;
	const size_t size = (size_t)request->count * reader_number_size(request->kind);
	if (!ask(file, request, &reply)) return JN_IO_FAILED;
	if (reply.payload == size && reader_receive(file->child.socket, data, size)) return JN_OK;
	lose(file);
	return JN_IO_FAILED;
}

JnStatus recording_file_array(RecordingFile* file, const char* name, RecordingNumber kind, int64_t count, void* data) {
	ReaderRequest request = ask_for(READER_ARRAY, name);
	request.kind = kind;
	request.count = count;
	return receive_numbers(file, &request, data);
}

JnStatus recording_file_times(RecordingFile* file, int64_t first, int64_t count, double* times) {
	ReaderRequest request = ask_for(READER_TIMES, "/frames");
	request.kind = RECORDING_REAL;
	request.first = first;
	request.count = count;
	return receive_numbers(file, &request, times);
}

// ---- opening ----

static JnStatus begin(RecordingFile* file, const char* path) {
	const ReaderRequest request = ask_for(READER_OPENED, "/");
	ReaderReply reply;
	struct stat facts;
	snprintf(file->path, sizeof file->path, "%s", path);
	if (stat(path, &facts) != 0 || !S_ISREG(facts.st_mode)) return JN_IO_FAILED; // others may never begin
	JN_TRY(jn_h5_recover(path));
	JN_TRY(jn_guard_start(path, limits, reader_serve, file->path, &file->child));
	if (ask(file, &request, &reply)) return JN_OK;
	if (file->has_failed) return JN_BAD_INPUT;
	jn_guard_end(path, &file->child);
	return JN_IO_FAILED;
}

JnStatus recording_file_enter(const char* path, RecordingFile** file) {
	*file = calloc(1, sizeof **file);
	if (*file == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: no room to open %s", path);
	const JnStatus status = begin(*file, path);
	if (status == JN_OK) return JN_OK;
	free(*file);
	*file = NULL;
	return status;
}

JnStatus recording_file_open(const char* folder, RecordingRead* read, void* user, RecordingFile** file) {
	char path[JN_PATH_SIZE];
	*file = NULL;
	JN_TRY(jn_path_join(folder, "run.h5", path));
	JnStatus status = recording_file_enter(path, file);
	if (status == JN_OK) status = read(*file, user);
	if (status != JN_IO_FAILED && status != JN_BAD_INPUT) return status;
	return jn_error(JN_IO_FAILED, "%s: is no whole recording of a run; remove its folder to run it again", path);
}

void recording_file_close(RecordingFile** file) {
	if (*file != NULL && !(*file)->has_failed) jn_guard_end((*file)->path, &(*file)->child);
	free(*file);
	*file = NULL;
}

bool recording_file_has_failed(const RecordingFile* file) {
	return file != NULL && file->has_failed;
}

// ---- names ----

// At the beginning of the file, or behind 512, 1024, 2048 ... bytes of something else.
bool recording_file_is_hdf5(const char* path) {
	static const char signature[8] = "\211HDF\r\n\032\n";
	const int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
	char found[sizeof signature];
	bool is = false;
	for (off_t at = 0; file >= 0 && !is; at = at == 0 ? 512 : 2 * at) {
		if (pread(file, found, sizeof found, at) != sizeof found) break;
		is = memcmp(found, signature, sizeof signature) == 0;
	}
	if (file >= 0) close(file);
	return is;
}

void recording_file_fold(char** name) {
	static char here[] = ".";
	struct stat facts;
	char* slash = strrchr(*name, '/');
	if (strcmp(slash != NULL ? slash + 1 : *name, "run.h5") != 0) return;
	if (stat(*name, &facts) == 0 && S_ISDIR(facts.st_mode)) return;
	if (slash == NULL)
		*name = here;
	else
		slash[slash == *name ? 1 : 0] = '\0';
}
