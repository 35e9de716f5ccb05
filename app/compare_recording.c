// Reads only what a comparison needs: ends, times and probes.
#include "compare_recording.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "recording_file.h"

// A newline inside a text is escaped, so that an entry is found at the start of its line and nowhere else.
static const char* find_entry(const char* summary, const char* name) {
	char start[80];
	const int length = snprintf(start, sizeof start, "\n\t\"%s\": ", name);
	const char* at = summary != NULL ? strstr(summary, start) : NULL;
	return at != NULL ? at + length : NULL;
}

double compare_summary_number(const char* summary, const char* name) {
	const char* at = find_entry(summary, name);
	char* end = NULL;
	const double value = at != NULL ? strtod(at, &end) : NAN;
	return end != at ? value : NAN;
}

bool compare_summary_is_done(const char* summary) {
	const char* at = find_entry(summary, "outcome");
	return at != NULL && strncmp(at, "\"done\"", 6) == 0;
}

// A dataset of doubles; `*count` is the number of its entries.
static JnStatus read_array(RecordingFile* file, JnArena* arena, const char* name, double** data, int64_t* count) {
	*count = recording_file_measure(file, name);
	if (*count < 0) return JN_IO_FAILED;
	JN_NEW(arena, *data, *count + 1);
	return recording_file_array(file, name, RECORDING_REAL, *count, *data);
}

static JnStatus read_last_frame(RecordingFile* file, CompareRecording* recording) {
	int frames = 0;
	char group[64], position[80], velocity[80];
	int64_t rest = 0, x = 0, v = 0;
	JN_TRY(recording_file_attribute(file, "/frames", "count", RECORDING_INTEGER, &frames));
	if (frames < 1) return JN_IO_FAILED;
	snprintf(group, sizeof group, "/frames/%08d", frames - 1);
	snprintf(position, sizeof position, "%s/position", group);
	snprintf(velocity, sizeof velocity, "%s/velocity", group);
	JN_TRY(recording_file_attribute(file, group, "time", RECORDING_REAL, &recording->t));
	JN_TRY(read_array(file, &recording->arena, "/mesh/nodes", &recording->rest, &rest));
	JN_TRY(read_array(file, &recording->arena, position, &recording->x, &x));
	JN_TRY(read_array(file, &recording->arena, velocity, &recording->v, &v));
	recording->node_count = (int)(rest / 3);
	return x == rest && v == rest ? JN_OK : JN_IO_FAILED;
}

// Probes are the columns probe.<name>.x with their .y and .z.
static JnStatus find_probes(RecordingFile* file, CompareRecording* recording) {
	const char* const* names;
	int count;
	JN_TRY(recording_file_names(file, "/series", &recording->arena, &names, &count));
	JN_NEW(&recording->arena, recording->probes, count + 1);
	for (int i = 0; i < count; ++i) {
		const size_t length = strlen(names[i]);
		if (strncmp(names[i], "probe.", 6) != 0 || length < 9 || strcmp(names[i] + length - 2, ".x") != 0) continue;
		char* word = jn_arena_text(&recording->arena, names[i] + 6);
		if (word == NULL) return JN_OUT_OF_MEMORY;
		word[strlen(word) - 2] = '\0';
		recording->probes[recording->probe_count++] = (CompareProbe){.name = word};
	}
	return JN_OK;
}

static JnStatus read_series(RecordingFile* file, CompareRecording* recording) {
	int64_t rows = 0, count = 0;
	JN_TRY(read_array(file, &recording->arena, "/series/t", &recording->times, &rows));
	recording->row_count = (int)rows;
	JN_TRY(find_probes(file, recording));
	for (int i = 0; i < 3 * recording->probe_count; ++i) {
		char name[256];
		CompareProbe* probe = &recording->probes[i / 3];
		snprintf(name, sizeof name, "/series/probe.%s.%c", probe->name, "xyz"[i % 3]);
		JN_TRY(read_array(file, &recording->arena, name, &probe->at[i % 3], &count));
		if (count != rows) return JN_IO_FAILED;
	}
	return JN_OK;
}

static JnStatus read_file(RecordingFile* file, void* user) {
	JN_TRY(read_last_frame(file, user));
	return read_series(file, user);
}

JnStatus compare_recording_open(const char* folder, CompareRecording* recording) {
	RecordingFile* file;
	*recording = (CompareRecording){0};
	const JnStatus status = recording_file_open(folder, read_file, recording, &file);
	recording_file_close(&file);
	return status;
}

void compare_recording_close(CompareRecording* recording) {
	jn_arena_free(&recording->arena);
}
