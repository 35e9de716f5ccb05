/// @file frames_test.c
/// When frames are written: at the multiples of the interval, whatever the steps are, and as steps are where they coincide.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <hdf5.h>
#include <cmocka.h>

#include "jounce/scene.h"
#include "support/support.h"

enum { MOST = 400 };

static char folder[256];

static int set_up(void** state) {
	(void)state;
	log_capture();
	return folder_create(folder);
}

static int tear_down(void** state) {
	(void)state;
	log_release();
	folder_remove(folder);
	return 0;
}

typedef struct Frames {
	int count;
	double t[MOST], x[MOST];
	long step[MOST];
} Frames;

static void read_attribute(hid_t group, const char* name, hid_t type, void* value) {
	const hid_t attribute = H5Aopen(group, name, H5P_DEFAULT);
	assert_true(attribute >= 0 && H5Aread(attribute, type, value) >= 0);
	H5Aclose(attribute);
}

static void read_frames(Frames* frames) {
	const hid_t file = H5Fopen(path_join(folder, "out/run.h5"), H5F_ACC_RDONLY, H5P_DEFAULT);
	assert_true(file >= 0);
	for (frames->count = 0; frames->count < MOST; ++frames->count) {
		char name[64];
		double position[3];
		snprintf(name, sizeof name, "/frames/%08d", frames->count);
		if (H5Lexists(file, name, H5P_DEFAULT) <= 0) break;
		const hid_t group = H5Gopen2(file, name, H5P_DEFAULT), data = H5Dopen2(group, "position", H5P_DEFAULT);
		read_attribute(group, "time", H5T_NATIVE_DOUBLE, &frames->t[frames->count]);
		read_attribute(group, "step", H5T_NATIVE_LONG, &frames->step[frames->count]);
		assert_true(H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, position) >= 0);
		frames->x[frames->count] = position[0];
		H5Dclose(data);
		H5Gclose(group);
	}
	H5Fclose(file);
}

// The spring with these steps and records, over 1 s.
static JnRunResult run(const char* step, const char* record, Frames* frames) {
	char text[512];
	JnScene* scene = NULL;
	JnRunResult result;
	snprintf(text, sizeof text,
			 "system: spring_1d\nduration: 1 s\nintegrator: linearized_newmark\nstep: %s\nrecord: {plots: no, %s}\n",
			 step, record);
	file_write(path_join(folder, "scene.yaml"), text);
	if (jn_scene_load(path_join(folder, "scene.yaml"), 0, NULL, &scene) != JN_OK) fail_msg("%s", log_text());
	const JnRunOptions options = {.directory = path_join(folder, "out"), .threads = 1};
	if (jn_scene_run(scene, &options, &result) != JN_OK) fail_msg("%s", log_text());
	jn_scene_destroy(scene);
	read_frames(frames);
	assert_int_equal(result.frames, frames->count);
	return result;
}

static void expect_times(const Frames* frames, double interval, int count) {
	assert_int_equal(frames->count, count);
	for (int i = 0; i < count; ++i)
		if (!(fabs(frames->t[i] - interval * i) <= 1e-14)) // rounding of sums of steps
			fail_msg("frame %d at %.17g s, expected %.17g", i, frames->t[i], interval * i);
}

static void frames_stand_at_their_times_whatever_the_steps_are(void** state) {
	(void)state;
	static const char* const steps[] = {"{dt: 3 ms}", "{dt: 0.2 s}", "{controller: force_error, tolerance: 1e-4 m}"};
	for (int i = 0; i < 3; ++i) {
		Frames frames;
		const JnRunResult sparse = run(steps[i], "interval: 1e3 s", &frames);
		assert_int_equal(frames.count, 2); // start and end
		const JnRunResult dense = run(steps[i], "interval: 20 ms", &frames);
		expect_times(&frames, 0.02, 51);
		assert_int_equal(dense.steps, sparse.steps);
	}
}

// Near the fine steps of the same method, as far as its own steps are.
static void frames_between_steps_lie_on_the_motion(void** state) {
	(void)state;
	static Frames coarse, fine;
	double error = 0, error_of_steps = 0;
	run("{dt: 8 ms}", "interval: 5 ms", &coarse);
	run("{dt: 5 ms}", "interval: 5 ms", &fine);
	expect_times(&coarse, 0.005, 201);
	for (int i = 0; i < coarse.count; ++i) {
		const double difference = fabs(coarse.x[i] - fine.x[i]);
		if (i % 8 == 0) error_of_steps = fmax(error_of_steps, difference); // every fifth step ends on an eighth frame
		error = fmax(error, difference);
	}
	print_message("difference at steps %.2e m, between them %.2e m\n", error_of_steps, error);
	assert_true(error <= 2 * error_of_steps); // the cubic adds little
}

static void a_frame_that_ends_a_step_is_that_step(void** state) {
	(void)state;
	static Frames frames, every;
	run("{dt: 4 ms}", "interval: 20 ms", &frames);
	run("{dt: 4 ms}", "interval: 0", &every);
	assert_int_equal(every.count, 251);
	for (int i = 0; i < frames.count; ++i) {
		assert_int_equal(frames.step[i], 5 * i);
		assert_true(frames.x[i] == every.x[5 * i] && frames.t[i] == every.t[5 * i]);
	}
}

static void exact_times_are_ends_of_steps(void** state) {
	(void)state;
	static Frames frames, every;
	const char* step = "{controller: force_error, tolerance: 1e-4 m}";
	const JnRunResult result = run(step, "interval: 50 ms, exact_times: yes", &frames);
	expect_times(&frames, 0.05, 21);
	for (int i = 1; i < frames.count; ++i) assert_true(frames.step[i] > frames.step[i - 1]);
	const JnRunResult free_run = run(step, "interval: 50 ms", &every);
	print_message("%ld steps, %ld without exact times\n", result.steps, free_run.steps);
	assert_true(result.steps > free_run.steps);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(frames_stand_at_their_times_whatever_the_steps_are),
		cmocka_unit_test(frames_between_steps_lie_on_the_motion),
		cmocka_unit_test(a_frame_that_ends_a_step_is_that_step),
		cmocka_unit_test(exact_times_are_ends_of_steps),
	};
	return cmocka_run_group_tests(tests, set_up, tear_down);
}
