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
#include "recording_part.h"
#include "view_field.h"
#include "view_shape.h"

enum { SILENT_SECONDS = 60 }; // a run that has not written for this long is taken for dead
enum { MOST_TRIES = 4 };      // a look at a run in progress may meet a commit, which is short

static JnStatus read_outcome(ViewRun* run) {
	Recording* recording = &run->recording;
	const char* outcome = recording_attribute_text(recording, "/", "outcome", "");
	const char* message = recording_attribute_text(recording, "/", "message", "");
	if (outcome == NULL || message == NULL) return JN_OUT_OF_MEMORY;
	if (*outcome == '\0' || recording_file_has_failed(recording->file)) return JN_IO_FAILED;
	recording->outcome = outcome;
	recording->message = message;
	return JN_OK;
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
	JN_TRY(recording_file_attribute(run->recording.file, "/frames", "count", RECORDING_LONG, &count));
	if (count > recording_file_links(run->recording.file, "/frames")) return JN_IO_FAILED;
	JN_TRY(jn_grow((void**)&run->times, &run->time_room, (size_t)(count > 0 ? count : 1), sizeof *run->times));
	if (count <= run->frame_count) return JN_OK;
	JN_TRY(recording_file_times(run->recording.file, run->frame_count, count - run->frame_count,
								run->times + run->frame_count));
	run->frame_count = count;
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

static void say_nothing(void* user, JnLogLevel level, const char* message) {
	(void)user, (void)level, (void)message;
}

// A run in progress is opened for each look, since HDF5 would show what it once has read for ever. If it cannot be read, or HDF5
// crashes on it, it is being written at this moment, which is no damage.
static JnStatus enter(ViewRun* run) {
	run->is_quiet = run->recording.outcome != NULL && strcmp(run->recording.outcome, "running") == 0;
	if (run->is_quiet) run->log = jn_log_swap((JnLog){.sink = say_nothing});
	if (run->recording.file != NULL) return JN_OK;
	const JnStatus status = recording_file_enter(run->path, &run->recording.file);
	return status == JN_BAD_INPUT && run->is_quiet ? JN_IO_FAILED : status;
}

static JnStatus leave(ViewRun* run, JnStatus status) {
	if (status == JN_IO_FAILED && !run->is_quiet && recording_file_has_failed(run->recording.file))
		status = JN_BAD_INPUT;
	if (run->is_quiet) jn_log_swap(run->log);
	run->is_quiet = false;
	if (run->recording.outcome != NULL && strcmp(run->recording.outcome, "running") != 0) return status;
	recording_file_close(&run->recording.file);
	return status;
}

// What is wrong with a file that does not open, in words.
static JnStatus explain(const ViewRun* run) {
	struct stat facts;
	if (stat(run->folder, &facts) == 0 && !S_ISDIR(facts.st_mode))
		return jn_error(JN_IO_FAILED, "%s: is no folder; give the one that holds run.h5", run->folder);
	if (stat(run->path, &facts) != 0)
		return jn_error(JN_IO_FAILED, "%s: there is no such file; `jounce run SCENE -o %s` makes it", run->path,
						run->folder);
	if (!recording_file_is_hdf5(run->path))
		return jn_error(JN_IO_FAILED, "%s: is no HDF5 file; a recording of `jounce run` is needed", run->path);
	return jn_error(JN_IO_FAILED,
					"%s: is cut off, damaged, or no recording of `jounce run`; run the scene again to replace it",
					run->path);
}

JnStatus view_run_open(ViewRun* run, const char* folder) {
	*run = (ViewRun){0};
	JN_TRY(jn_path_join(folder, "run.h5", run->path));
	run->recording.path = jn_arena_text(&run->recording.arena, run->path);
	if (run->recording.path == NULL) return JN_OUT_OF_MEMORY;
	snprintf(run->folder, sizeof run->folder, "%s", folder);
	JnStatus status = enter(run);
	if (status == JN_OK) status = read_all(run);
	if (status == JN_OK && recording_file_has_failed(run->recording.file)) status = JN_IO_FAILED;
	const bool is_written = status == JN_OK && strcmp(run->recording.outcome, "running") == 0;
	if (status == JN_OK && !is_written)
		status = read_summary(run); // while it is written, that of an earlier run may be there
	status = leave(run, status);
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
	*run = (ViewRun){0};
}

bool view_run_is_running(const ViewRun* run) {
	struct stat facts;
	if (strcmp(run->recording.outcome, "running") != 0) return false;
	return stat(run->path, &facts) == 0 && time(NULL) - facts.st_mtime < SILENT_SECONDS;
}

JnStatus view_run_refresh(ViewRun* run) {
	if (strcmp(run->recording.outcome, "running") != 0) return JN_OK;
	JnStatus status = JN_IO_FAILED;
	for (int tries = 0; status == JN_IO_FAILED && tries < MOST_TRIES; ++tries) {
		status = enter(run);
		if (status == JN_OK) status = read_times(run);
		if (status == JN_OK) status = read_outcome(run);
		if (status == JN_OK && strcmp(run->recording.outcome, "running") != 0) status = read_summary(run);
		status = leave(run, status);
	}
	return status;
}

JnStatus view_run_read(ViewRun* run, long frame, const char* name, int rows, int components, double* out) {
	char path[160];
	snprintf(path, sizeof path, "/frames/%08ld/%s", frame, name);
	JnStatus status = JN_IO_FAILED;
	for (int tries = 0; status == JN_IO_FAILED && tries < MOST_TRIES; ++tries) {
		status = enter(run);
		if (status == JN_OK)
			status = recording_file_array(run->recording.file, path, RECORDING_REAL, (int64_t)rows * components, out);
		status = leave(run, status);
	}
	return status;
}

JnStatus view_run_positions(ViewRun* run, long frame, float* out) {
	JN_TRY(view_run_read(run, frame, run->recording.has_embedding ? "surface" : "position", run->recording.point_count,
						 3, run->scratch));
	view_map_apply(&run->points, 3, run->scratch, out);
	return JN_OK;
}

static JnStatus list_columns(ViewRun* run, ViewSeries* series) {
	const char* const* names;
	int count;
	JN_TRY(recording_file_names(run->recording.file, "/series", &series->arena, &names, &count));
	JN_NEW(&series->arena, series->columns, count + 1);
	for (int i = 0; i < count; ++i) {
		const size_t size = strlen(names[i]) + 1;
		if (size <= sizeof series->columns->name) memcpy(series->columns[series->count++].name, names[i], size);
	}
	return JN_OK;
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
		JN_TRY(recording_file_array(run->recording.file, path, RECORDING_REAL, series->rows, column->values));
	}
	return JN_OK;
}

JnStatus view_run_series(ViewRun* run, ViewSeries* series) {
	JnStatus status = JN_IO_FAILED;
	*series = (ViewSeries){0};
	for (int tries = 0; status == JN_IO_FAILED && tries < MOST_TRIES; ++tries) {
		jn_arena_free(&series->arena);
		*series = (ViewSeries){0};
		status = enter(run);
		if (status == JN_OK) status = read_columns(run, series);
		status = leave(run, status);
	}
	return status;
}
