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
static JnStatus read_array(hid_t file, JnArena* arena, const char* name, double** data, hssize_t* count) {
	*count = recording_file_measure(file, name);
	if (*count < 0) return JN_IO_FAILED;
	JN_NEW(arena, *data, *count + 1);
	return recording_file_array(file, name, H5T_NATIVE_DOUBLE, *count, *data);
}

static JnStatus read_last_frame(hid_t file, CompareRecording* recording) {
	int frames = 0;
	char group[64], position[80], velocity[80];
	hssize_t rest = 0, x = 0, v = 0;
	JN_TRY(recording_file_attribute(file, "/frames", "count", H5T_NATIVE_INT, &frames));
	if (frames < 1) return JN_IO_FAILED;
	snprintf(group, sizeof group, "/frames/%08d", frames - 1);
	snprintf(position, sizeof position, "%s/position", group);
	snprintf(velocity, sizeof velocity, "%s/velocity", group);
	JN_TRY(recording_file_attribute(file, group, "time", H5T_NATIVE_DOUBLE, &recording->t));
	JN_TRY(read_array(file, &recording->arena, "/mesh/nodes", &recording->rest, &rest));
	JN_TRY(read_array(file, &recording->arena, position, &recording->x, &x));
	JN_TRY(read_array(file, &recording->arena, velocity, &recording->v, &v));
	recording->node_count = (int)(rest / 3);
	return x == rest && v == rest ? JN_OK : JN_IO_FAILED;
}

// Probes are the columns probe.<name>.x with their .y and .z; `iterate` meets columns by name.
static herr_t meet_column(hid_t group, const char* name, const H5L_info_t* info, void* user) {
	(void)group;
	(void)info;
	CompareRecording* recording = user;
	const size_t length = strlen(name);
	if (strncmp(name, "probe.", 6) != 0 || length < 9 || strcmp(name + length - 2, ".x") != 0) return 0;
	char* word = jn_arena_text(&recording->arena, name + 6);
	CompareProbe* probes = jn_arena_take(&recording->arena, (size_t)recording->probe_count + 1, sizeof *probes);
	if (word == NULL || probes == NULL) return -1;
	word[strlen(word) - 2] = '\0';
	if (recording->probe_count > 0) memcpy(probes, recording->probes, (size_t)recording->probe_count * sizeof *probes);
	probes[recording->probe_count++] = (CompareProbe){.name = word};
	recording->probes = probes;
	return 0;
}

static JnStatus read_series(hid_t file, CompareRecording* recording) {
	hssize_t rows = 0, count = 0;
	JN_TRY(read_array(file, &recording->arena, "/series/t", &recording->times, &rows));
	recording->row_count = (int)rows;
	const hid_t group = H5Gopen2(file, "/series", H5P_DEFAULT);
	if (group < 0) return JN_IO_FAILED;
	const herr_t outcome = H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, NULL, meet_column, recording);
	H5Gclose(group);
	if (outcome < 0) return JN_IO_FAILED;
	for (int i = 0; i < 3 * recording->probe_count; ++i) {
		char name[256];
		CompareProbe* probe = &recording->probes[i / 3];
		snprintf(name, sizeof name, "/series/probe.%s.%c", probe->name, "xyz"[i % 3]);
		JN_TRY(read_array(file, &recording->arena, name, &probe->at[i % 3], &count));
		if (count != rows) return JN_IO_FAILED;
	}
	return JN_OK;
}

static JnStatus read_file(hid_t file, void* user) {
	JN_TRY(read_last_frame(file, user));
	return read_series(file, user);
}

JnStatus compare_recording_open(const char* folder, CompareRecording* recording) {
	hid_t file = -1;
	*recording = (CompareRecording){0};
	const JnStatus status = recording_file_open(folder, read_file, recording, &file);
	recording_file_close(&file);
	return status;
}

void compare_recording_close(CompareRecording* recording) {
	jn_arena_free(&recording->arena);
}
