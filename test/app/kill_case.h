/// @file kill_case.h
/// Runs that are killed at any moment: what they have recorded can be read, and resumed they become the run without a break.
#ifndef JN_TEST_APP_KILL_CASE_H
#define JN_TEST_APP_KILL_CASE_H

#include <math.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <hdf5.h>
#include <cmocka.h>

#include "base/random.h"
#include "base/timer.h"
#include "record/h5_driver.h"
#include "support/support.h"

/// A frame at every step keeps the recording busy; saved states come often.
static const char* const kill_run[] = {"run",       JN_SOURCE_DIR "/scenes/beam.yaml",
									   "--set",     "bodies[0].shape.cells=[1, 1, 8]",
									   "--set",     "duration=2 s",
									   "--set",     "record={interval: 0, plots: no}",
									   "--set",     "checkpoint.every=0.1 s",
									   "--threads", "1",
									   "-q",        "-o",
									   "run",       NULL};

/// All frames of a recording, one behind the other. Free `x`.
typedef struct KillFrames {
	long count, length; ///< numbers of a frame
	double* x;
} KillFrames;

static inline KillFrames kill_read_frames(const char* path) {
	KillFrames frames = {0};
	int64_t count = 0;
	assert_int_equal(jn_h5_recover(path), JN_OK);
	const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
	if (file < 0) fail_msg("%s cannot be opened", path);
	const hid_t attribute = H5Aopen_by_name(file, "/frames", "count", H5P_DEFAULT, H5P_DEFAULT);
	assert_true(attribute >= 0 && H5Aread(attribute, H5T_NATIVE_INT64, &count) >= 0);
	H5Aclose(attribute);
	for (; frames.count < count; ++frames.count) {
		char name[64];
		snprintf(name, sizeof name, "/frames/%08ld/position", frames.count);
		const hid_t set = H5Dopen2(file, name, H5P_DEFAULT), space = set >= 0 ? H5Dget_space(set) : -1;
		if (set < 0) fail_msg("%s: frame %ld of %ld is missing", path, frames.count, (long)count);
		if (frames.x == NULL) {
			frames.length = (long)H5Sget_simple_extent_npoints(space);
			frames.x = calloc((size_t)(count * frames.length), sizeof *frames.x);
			assert_non_null(frames.x);
		}
		double* to = frames.x + frames.count * frames.length;
		assert_true(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, to) >= 0);
		H5Sclose(space);
		H5Dclose(set);
	}
	H5Fclose(file);
	return frames;
}

/// The first frames of `whole` are those of `part`, bit for bit.
static inline void kill_expect_part(const KillFrames* part, const KillFrames* whole, double moment) {
	if (part->count > whole->count) fail_msg("killed after %g s: %ld frames of %ld", moment, part->count, whole->count);
	if (part->count == 0) return;
	assert_int_equal(part->length, whole->length);
	if (memcmp(part->x, whole->x, (size_t)(part->count * part->length) * sizeof *part->x) != 0)
		fail_msg("killed after %g s: the frames are others", moment);
}

static inline void kill_expect_same_series(const char* folder, const char* whole, double moment) {
	char* series = file_read(path_join(folder, "run/series.csv"));
	if (strcmp(series, whole) != 0) fail_msg("killed after %g s: the series is another one", moment);
	free(series);
}

// Before the first commit nothing has been reported as written, and before the first file nothing can be resumed.
static inline bool kill_has_started(const char* folder) {
	return path_exists(path_join(folder, "run/checkpoints"));
}

/// Kill a run after `moment` seconds of the clock and resume it. False: it had not saved anything yet.
static inline bool kill_and_resume(const char* folder, double moment, const KillFrames* whole, const char* series) {
	const struct timespec pause = {.tv_sec = (time_t)moment, .tv_nsec = (long)(1e9 * fmod(moment, 1))};
	folder_remove(path_join(folder, "run"));
	Process process = command_start(folder, kill_run);
	nanosleep(&pause, NULL);
	kill(process.id, SIGKILL);
	Outcome outcome = command_wait(process);
	outcome_free(&outcome);
	if (!kill_has_started(folder)) return false;
	KillFrames part = kill_read_frames(path_join(folder, "run/run.h5"));
	kill_expect_part(&part, whole, moment);
	free(part.x);
	outcome = command_run(folder, (const char* const[]){"resume", "run", "-q", NULL});
	const bool has_none = strstr(outcome.err, "no checkpoints") != NULL; // the folder was there, and no file yet
	if (outcome.status != 0 && !has_none) fail_msg("killed after %g s: %s", moment, outcome.err);
	outcome_free(&outcome);
	if (has_none) return false;
	part = kill_read_frames(path_join(folder, "run/run.h5"));
	assert_int_equal(part.count, whole->count);
	kill_expect_part(&part, whole, moment);
	kill_expect_same_series(folder, series, moment);
	free(part.x);
	return true;
}

/// `count` kills, at moments of its whole length and a little more.
static inline void kill_often(int count) {
	char folder[256];
	JnRandom random = {7};
	int resumed = 0;
	assert_int_equal(folder_create(folder), 0);
	const double began = jn_seconds();
	Outcome outcome = command_run(folder, kill_run);
	const double length = jn_seconds() - began;
	if (outcome.status != 0) fail_msg("%s", outcome.err);
	outcome_free(&outcome);
	KillFrames whole = kill_read_frames(path_join(folder, "run/run.h5"));
	char* series = file_read(path_join(folder, "run/series.csv"));
	for (int i = 0; i < count; ++i)
		resumed += kill_and_resume(folder, 1.1 * length * jn_random_uniform(&random), &whole, series);
	print_message("%d kills within %.2f s: %d resumed, the others had saved nothing yet\n", count, length, resumed);
	assert_true(resumed > count / 3);
	free(series);
	free(whole.x);
	folder_remove(folder);
}

#endif
