// Opening, following and reading a recording; what its bodies are made of is in view_shape.c.
#include "view_run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

#include "base/grow.h"
#include "base/log.h"
#include "recording_file.h"
#include "recording_part.h"
#include "view_field.h"
#include "view_shape.h"

enum { SILENT_SECONDS = 60 }; // a run that has not written for this long is taken for dead

static JnStatus read_outcome(ViewRun* run) {
	Recording* recording = &run->recording;
	recording->outcome = recording_attribute_text(recording, "/", "outcome", "");
	recording->message = recording_attribute_text(recording, "/", "message", "");
	return recording->outcome != NULL && recording->message != NULL ? JN_OK : JN_OUT_OF_MEMORY;
}

static JnStatus read_summary(ViewRun* run) {
	char path[JN_PATH_SIZE];
	struct stat facts;
	JN_TRY(jn_path_join(run->folder, "summary.json", path));
	FILE* file = fopen(path, "rb");
	if (file == NULL) return JN_OK;
	if (fstat(fileno(file), &facts) == 0 && facts.st_size > 0 && facts.st_size < 1 << 20) {
		char* text = jn_arena_take(&run->arena, (size_t)facts.st_size + 1, 1);
		const size_t length = text != NULL ? fread(text, 1, (size_t)facts.st_size, file) : 0;
		if (length == (size_t)facts.st_size) run->summary = text;
	}
	fclose(file);
	return JN_OK;
}

static JnStatus read_times(ViewRun* run) {
	long count = 0;
	JN_TRY(recording_file_attribute(run->recording.file, "/frames", "count", H5T_NATIVE_LONG, &count));
	if (count > recording_file_links(run->recording.file, "/frames")) return JN_IO_FAILED;
	JN_TRY(jn_grow((void**)&run->times, &run->time_room, (size_t)(count > 0 ? count : 1), sizeof *run->times));
	for (; run->frame_count < count; ++run->frame_count) {
		char group[64];
		snprintf(group, sizeof group, "/frames/%08ld", run->frame_count);
		JN_TRY(recording_file_attribute(run->recording.file, group, "time", H5T_NATIVE_DOUBLE,
										&run->times[run->frame_count]));
	}
	return JN_OK;
}

static JnStatus read_all(ViewRun* run) {
	Recording* recording = &run->recording;
	if (!recording_has(recording, "/mesh/nodes") || !recording_has(recording, "/frames")) return JN_IO_FAILED;
	JN_TRY(recording_read_facts(recording));
	JN_TRY(recording_read_bodies(recording));
	JN_TRY(recording_read_obstacles(recording));
	JN_TRY(view_shape_make(run));
	JN_TRY(read_times(run));
	return view_fields_list(run);
}

// A run in progress is opened for each look, since HDF5 would show what it once has read for ever.
JnStatus view_run_enter(ViewRun* run) {
	if (run->recording.file < 0) run->recording.file = recording_file_enter(run->path);
	return run->recording.file < 0 ? JN_IO_FAILED : JN_OK;
}

void view_run_leave(ViewRun* run) {
	if (run->recording.outcome != NULL && strcmp(run->recording.outcome, "running") != 0) return;
	recording_file_close(&run->recording.file);
}

// What is wrong with a file that does not open, in words.
static JnStatus explain(const ViewRun* run) {
	struct stat facts;
	if (stat(run->folder, &facts) == 0 && !S_ISDIR(facts.st_mode))
		return jn_error(JN_IO_FAILED, "%s: is no folder; give the one that holds run.h5", run->folder);
	if (stat(run->path, &facts) != 0)
		return jn_error(JN_IO_FAILED, "%s: there is no such file; `jounce run SCENE -o %s` makes it", run->path,
						run->folder);
	if (H5Fis_hdf5(run->path) <= 0)
		return jn_error(JN_IO_FAILED, "%s: is no HDF5 file; a recording of `jounce run` is needed", run->path);
	return jn_error(JN_IO_FAILED,
					"%s: is cut off, damaged, or no recording of `jounce run`; run the scene again to replace it",
					run->path);
}

JnStatus view_run_open(ViewRun* run, const char* folder) {
	*run = (ViewRun){.recording = {.file = H5I_INVALID_HID}};
	JN_TRY(jn_path_join(folder, "run.h5", run->path));
	run->recording.path = jn_arena_text(&run->recording.arena, run->path);
	if (run->recording.path == NULL) return JN_OUT_OF_MEMORY;
	snprintf(run->folder, sizeof run->folder, "%s", folder);
	JnStatus status = view_run_enter(run);
	if (status == JN_OK) status = read_all(run);
	const bool is_written = status == JN_OK && strcmp(run->recording.outcome, "running") == 0;
	if (status == JN_OK && !is_written)
		status = read_summary(run); // while it is written, that of an earlier run may be there
	view_run_leave(run);
	return status == JN_IO_FAILED ? explain(run) : status;
}

void view_run_close(ViewRun* run) {
	recording_file_close(&run->recording.file);
	view_elastic_close(&run->elastic);
	view_map_free(&run->points);
	view_map_free(&run->nodes);
	free(run->times);
	jn_arena_free(&run->recording.arena);
	jn_arena_free(&run->arena);
	*run = (ViewRun){.recording.file = H5I_INVALID_HID};
}

bool view_run_is_running(const ViewRun* run) {
	struct stat facts;
	if (strcmp(run->recording.outcome, "running") != 0) return false;
	return stat(run->path, &facts) == 0 && time(NULL) - facts.st_mtime < SILENT_SECONDS;
}

JnStatus view_run_refresh(ViewRun* run) {
	if (strcmp(run->recording.outcome, "running") != 0) return JN_OK;
	JnStatus status = view_run_enter(run);
	if (status == JN_OK) status = read_times(run);
	if (status == JN_OK) status = read_outcome(run);
	if (status == JN_OK && strcmp(run->recording.outcome, "running") != 0) status = read_summary(run);
	view_run_leave(run);
	return status;
}

JnStatus view_run_read(ViewRun* run, long frame, const char* name, int rows, int components, double* out) {
	char path[160];
	snprintf(path, sizeof path, "/frames/%08ld/%s", frame, name);
	JnStatus status = view_run_enter(run);
	if (status == JN_OK)
		status = recording_file_array(run->recording.file, path, H5T_NATIVE_DOUBLE, (hssize_t)rows * components, out);
	view_run_leave(run);
	return status;
}

JnStatus view_run_positions(ViewRun* run, long frame, float* out) {
	JN_TRY(view_run_read(run, frame, run->recording.has_embedding ? "surface" : "position", run->recording.point_count,
						 3, run->scratch));
	view_map_apply(&run->points, 3, run->scratch, out);
	return JN_OK;
}

static herr_t meet_column(hid_t group, const char* name, const H5L_info_t* info, void* user) {
	ViewSeries* series = user;
	(void)group, (void)info;
	const size_t size = strlen(name) + 1;
	if (size > sizeof series->columns->name) return 0;
	if (series->columns != NULL) memcpy(series->columns[series->count].name, name, size);
	series->count++;
	return 0;
}

static JnStatus list_columns(ViewRun* run, ViewSeries* series) {
	JN_TRY(recording_file_visit(run->recording.file, "/series", meet_column, series));
	JN_NEW(&series->arena, series->columns, series->count + 1);
	series->count = 0;
	return recording_file_visit(run->recording.file, "/series", meet_column, series);
}

static JnStatus read_columns(ViewRun* run, ViewSeries* series) {
	JN_TRY(list_columns(run, series));
	series->rows = (long)recording_file_measure(run->recording.file, "/series/t");
	if (series->rows < 0) return JN_IO_FAILED;
	for (int i = 0; i < series->count; ++i) {
		char path[160], *unit = "";
		ViewColumn* column = &series->columns[i];
		snprintf(path, sizeof path, "/series/%s", column->name);
		JN_NEW(&series->arena, column->values, series->rows + 1);
		JN_TRY(recording_file_text(run->recording.file, path, "unit", &series->arena, &unit));
		snprintf(column->unit, sizeof column->unit, "%s", unit);
		JN_TRY(recording_file_array(run->recording.file, path, H5T_NATIVE_DOUBLE, series->rows, column->values));
	}
	return JN_OK;
}

JnStatus view_run_series(ViewRun* run, ViewSeries* series) {
	*series = (ViewSeries){0};
	JnStatus status = view_run_enter(run);
	if (status == JN_OK) status = read_columns(run, series);
	view_run_leave(run);
	return status;
}
