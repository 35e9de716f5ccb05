#include "recording_part.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "base/log.h"
#include "recording_file.h"

JnStatus recording_damaged(const Recording* recording, const char* object) {
	return jn_error(JN_BAD_INPUT,
					"%s: %s is missing or not as it should be: the recording is damaged; run the scene again",
					recording->path, object);
}

/// JN_BAD_INPUT, after a message, when a dataset declares more numbers than the file has.
static JnStatus check_size(const Recording* recording, const char* object) {
	const RecordingSize size = recording_file_size(recording->file, object);
	if (size.entries < 0) return recording_damaged(recording, object);
	if (size.entries <= size.most) return JN_OK;
	return jn_error(
		JN_BAD_INPUT,
		"%s: %s declares %lld numbers, but the file has bytes for %lld at most: the recording is damaged; run "
		"the scene again",
		recording->path, object, (long long)size.entries, (long long)size.most);
}

/// Rows of an array of `columns` numbers each that is one- or two-dimensional; -1 when it is anything else.
static int measure(const Recording* recording, const char* object, int columns) {
	const hid_t dataset = H5Dopen2(recording->file, object, H5P_DEFAULT);
	if (dataset < 0) return -1;
	hsize_t dims[H5S_MAX_RANK] = {0};
	const hid_t space = H5Dget_space(dataset);
	const int rank = H5Sget_simple_extent_dims(space, dims, NULL);
	H5Sclose(space);
	H5Dclose(dataset);
	const bool fits = (rank == 1 && columns == 1) || (rank == 2 && dims[1] == (hsize_t)columns);
	return fits && dims[0] <= INT_MAX / (hsize_t)columns ? (int)dims[0] : -1;
}

static JnStatus read(Recording* recording, const char* object, int columns, hid_t type, void* numbers, int rows) {
	const hssize_t count = (hssize_t)rows * columns;
	if (count == 0 || recording_file_array(recording->file, object, type, count, numbers) == JN_OK) return JN_OK;
	return recording_damaged(recording, object);
}

JnStatus recording_numbers(Recording* recording, const char* object, int columns, int** numbers, int* rows) {
	JN_TRY(check_size(recording, object));
	*rows = measure(recording, object, columns);
	if (*rows < 0) return recording_damaged(recording, object);
	JN_NEW(&recording->arena, *numbers, (size_t)*rows * (size_t)columns + 1);
	return read(recording, object, columns, H5T_NATIVE_INT, *numbers, *rows);
}

JnStatus recording_reals(Recording* recording, const char* object, int columns, double** reals, int* rows) {
	JN_TRY(check_size(recording, object));
	*rows = measure(recording, object, columns);
	if (*rows < 0) return recording_damaged(recording, object);
	JN_NEW(&recording->arena, *reals, (size_t)*rows * (size_t)columns + 1);
	return read(recording, object, columns, H5T_NATIVE_DOUBLE, *reals, *rows);
}

bool recording_are_within(const int* numbers, size_t count, long low, long end) {
	bool are = true;
	for (size_t i = 0; i < count; ++i) are &= numbers[i] >= low && numbers[i] < end;
	return are;
}

const char* recording_attribute_text(Recording* recording, const char* object, const char* name,
									 const char* otherwise) {
	const hid_t type = H5Tcopy(H5T_C_S1);
	char* text = NULL;
	H5Tset_size(type, H5T_VARIABLE);
	H5Tset_cset(type, H5T_CSET_UTF8);
	const JnStatus status = recording_file_attribute(recording->file, object, name, type, &text);
	const char* copy = jn_arena_text(&recording->arena, status == JN_OK && text != NULL ? text : otherwise);
	if (text != NULL) H5free_memory(text);
	H5Tclose(type);
	return copy;
}

JnStatus recording_attribute_count(const Recording* recording, const char* object, const char* name, int* count) {
	if (recording_file_attribute(recording->file, object, name, H5T_NATIVE_INT, count) == JN_OK) return JN_OK;
	return recording_damaged(recording, object);
}

bool recording_has(const Recording* recording, const char* object) {
	return H5Lexists(recording->file, object, H5P_DEFAULT) > 0;
}

typedef struct Names {
	JnArena* arena;
	const char** list;
	int count, capacity;
} Names;

static herr_t meet(hid_t group, const char* name, const H5L_info_t* info, void* user) {
	Names* names = user;
	(void)group, (void)info;
	if (names->count == names->capacity) return -1;
	names->list[names->count] = jn_arena_text(names->arena, name);
	return names->list[names->count++] != NULL ? 0 : -1;
}

JnStatus recording_names(Recording* recording, const char* group, const char* const** names, int* count) {
	H5G_info_t facts;
	Names meeting = {.arena = &recording->arena};
	*names = NULL;
	*count = 0;
	if (!recording_has(recording, group)) return JN_OK;
	const hid_t opened = H5Gopen2(recording->file, group, H5P_DEFAULT);
	if (opened < 0 || H5Gget_info(opened, &facts) < 0) return recording_damaged(recording, group);
	meeting.capacity = (int)facts.nlinks;
	meeting.list = jn_arena_take(&recording->arena, (size_t)meeting.capacity + 1, sizeof *meeting.list);
	const bool is_read =
		meeting.list != NULL && H5Literate(opened, H5_INDEX_NAME, H5_ITER_INC, NULL, meet, &meeting) >= 0;
	H5Gclose(opened);
	*names = meeting.list;
	*count = meeting.count;
	return is_read ? JN_OK : recording_damaged(recording, group);
}
