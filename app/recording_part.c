#include "recording_part.h"

#include <limits.h>

#include "base/log.h"

JnStatus recording_damaged(const Recording* recording, const char* object) {
	if (recording_file_has_failed(recording->file)) return JN_BAD_INPUT;
	return jn_error(JN_BAD_INPUT,
					"%s: %s is missing or not as it should be: the recording is damaged; run the scene again",
					recording->path, object);
}

/// Rows of an array of `columns` numbers each that is one- or two-dimensional; -1 when it is anything else.
static int rows_of(const RecordingSize* size, int columns) {
	const bool fits = (size->rank == 1 && columns == 1) || (size->rank == 2 && size->lengths[1] == columns);
	return fits && size->lengths[0] <= INT_MAX / columns ? (int)size->lengths[0] : -1;
}

/// JN_BAD_INPUT, after a message, also when a dataset declares more numbers than the file has.
static JnStatus measure(const Recording* recording, const char* object, int columns, int* rows) {
	const RecordingSize size = recording_file_size(recording->file, object);
	if (size.entries < 0) return recording_damaged(recording, object);
	if (size.entries > size.most)
		return jn_error(
			JN_BAD_INPUT,
			"%s: %s declares %lld numbers, but the file has bytes for %lld at most: the recording is damaged; run "
			"the scene again",
			recording->path, object, (long long)size.entries, (long long)size.most);
	*rows = rows_of(&size, columns);
	return *rows >= 0 ? JN_OK : recording_damaged(recording, object);
}

static JnStatus read(Recording* recording, const char* object, int columns, RecordingNumber kind, void* numbers,
					 int rows) {
	const int64_t count = (int64_t)rows * columns;
	if (count == 0 || recording_file_array(recording->file, object, kind, count, numbers) == JN_OK) return JN_OK;
	return recording_damaged(recording, object);
}

JnStatus recording_numbers(Recording* recording, const char* object, int columns, int** numbers, int* rows) {
	JN_TRY(measure(recording, object, columns, rows));
	JN_NEW(&recording->arena, *numbers, (size_t)*rows * (size_t)columns + 1);
	return read(recording, object, columns, RECORDING_INTEGER, *numbers, *rows);
}

JnStatus recording_reals(Recording* recording, const char* object, int columns, double** reals, int* rows) {
	JN_TRY(measure(recording, object, columns, rows));
	JN_NEW(&recording->arena, *reals, (size_t)*rows * (size_t)columns + 1);
	return read(recording, object, columns, RECORDING_REAL, *reals, *rows);
}

bool recording_are_within(const int* numbers, size_t count, long low, long end) {
	bool are = true;
	for (size_t i = 0; i < count; ++i) are &= numbers[i] >= low && numbers[i] < end;
	return are;
}

const char* recording_attribute_text(Recording* recording, const char* object, const char* name,
									 const char* otherwise) {
	char* text = NULL;
	const JnStatus status = recording_file_text(recording->file, object, name, &recording->arena, &text);
	return status == JN_IO_FAILED ? jn_arena_text(&recording->arena, otherwise) : text;
}

JnStatus recording_attribute_count(const Recording* recording, const char* object, const char* name, int* count) {
	if (recording_file_attribute(recording->file, object, name, RECORDING_INTEGER, count) == JN_OK) return JN_OK;
	return recording_damaged(recording, object);
}

bool recording_has(const Recording* recording, const char* object) {
	return recording_file_has(recording->file, object);
}

JnStatus recording_names(Recording* recording, const char* group, const char* const** names, int* count) {
	*names = NULL;
	*count = 0;
	if (!recording_has(recording, group)) return JN_OK;
	const JnStatus status = recording_file_names(recording->file, group, &recording->arena, names, count);
	return status == JN_IO_FAILED ? recording_damaged(recording, group) : status;
}
