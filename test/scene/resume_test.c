/// @file resume_test.c
/// Where a run is gone on from: the newest state, the newest of all, one that is named in any of three ways; and what is said
/// where there is none, or a damaged one.
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "jounce/scene.h"
#include "support/support.h"

// No line break at its end: what follows in the recording must not run into it.
static const char scene_text[] = "duration: 60 ms\nsystem: {type: spring_1d, mass: 2 kg}\nintegrator: verlet\n"
								 "step: {dt: 10 ms}\nrecord: {plots: no}\ncheckpoint: {every: 20 ms, keep: 9}";

enum { STOP = 5 }; // steps; states are saved after 0, 2 and 4 of them, and at the end after 5

static char folder[256];

static bool stop(void* user, const JnProgress* progress) {
	(void)user;
	return progress->steps < STOP;
}

// A run that is stopped.
static int set_up(void** state) {
	static const char* const sets[] = {"name=spring"};
	JnScene* scene = NULL;
	JnRunResult result;
	log_set_up(state);
	if (folder_create(folder) != 0) return -1;
	file_write(path_join(folder, "scene.yaml"), scene_text);
	assert_int_equal(jn_scene_load(path_join(folder, "scene.yaml"), 1, sets, &scene), JN_OK);
	const JnRunOptions options = {.directory = folder, .threads = 1, .progress = stop};
	assert_int_equal(jn_scene_run(scene, &options, &result), JN_OK);
	assert_true(result.was_stopped && result.steps == STOP);
	jn_scene_destroy(scene);
	return 0;
}

static int tear_down(void** state) {
	folder_remove(folder);
	return log_tear_down(state);
}

static long first_step; // of what was resumed

static bool note_first(void* user, const JnProgress* progress) {
	(void)user;
	if (first_step == 0) first_step = progress->steps;
	return true;
}

static JnStatus resume(const char* from, bool takes_latest) {
	JnRunResult result;
	const JnResumeOptions options = {
		.run = {.directory = folder, .threads = 1, .progress = note_first}, .from = from, .takes_latest = takes_latest};
	first_step = 0;
	log_capture();
	const JnStatus status = jn_scene_resume(&options, &result);
	if (status == JN_OK) assert_true(result.steps == 6 && result.t > 0.0599);
	return status;
}

static void the_newest_state_of_the_run_itself_is_taken(void** state) {
	(void)state;
	assert_int_equal(resume(NULL, false), JN_OK);
	assert_int_equal(first_step, 5); // after step 4
}

static void the_newest_of_all_is_where_the_run_ended(void** state) {
	(void)state;
	assert_int_equal(resume(NULL, true), JN_OK);
	assert_int_equal(first_step, 6);
}

static void a_state_is_named_by_its_file_or_a_path(void** state) {
	(void)state;
	char home[1024], relative[2048], beside[512];
	assert_int_equal(resume("step-0000000002.jnc", false), JN_OK);
	assert_int_equal(first_step, 3);
	assert_int_equal(resume(path_join(folder, "checkpoints/step-0000000002.jnc"), false), JN_OK);
	assert_int_equal(first_step, 3);
	assert_non_null(getcwd(home, sizeof home));
	snprintf(beside, sizeof beside, "%s", folder);
	assert_int_equal(chdir(beside), 0);
	snprintf(relative, sizeof relative, "checkpoints/step-0000000002.jnc");
	const JnStatus status = resume(relative, false);
	assert_int_equal(chdir(home), 0);
	assert_int_equal(status, JN_OK);
	assert_int_equal(first_step, 3);
}

static void a_name_that_is_not_there_is_told_with_another_one(void** state) {
	(void)state;
	assert_int_equal(resume("step-0000000003.jnc", false), JN_IO_FAILED);
	log_expect("step-0000000003.jnc: cannot read the checkpoint: No such file or directory");
	log_expect("the newest other checkpoint is of step 4; to go on from there: jounce resume ");
	log_expect(" --from step-0000000004.jnc");
}

static void of_a_damaged_state_the_one_before_is_offered(void** state) {
	(void)state;
	file_write(path_join(folder, "checkpoints/step-0000000004.jnc"), "nothing");
	assert_int_equal(resume(NULL, false), JN_BAD_INPUT);
	log_expect("step-0000000004.jnc: is no checkpoint of jounce");
	log_expect("the newest other checkpoint is of step 2;");
}

static void where_there_is_no_other_state_the_scene_is_to_be_run_again(void** state) {
	(void)state;
	unlink(path_join(folder, "checkpoints/step-0000000000.jnc"));
	unlink(path_join(folder, "checkpoints/step-0000000002.jnc"));
	file_write(path_join(folder, "checkpoints/step-0000000004.jnc"), "nothing");
	assert_int_equal(resume(NULL, false), JN_BAD_INPUT);
	log_expect("there is no other checkpoint; run the scene again");
}

static void a_folder_without_states_is_told_as_such(void** state) {
	(void)state;
	unlink(path_join(folder, "checkpoints/step-0000000000.jnc"));
	unlink(path_join(folder, "checkpoints/step-0000000002.jnc"));
	unlink(path_join(folder, "checkpoints/step-0000000004.jnc"));
	assert_int_equal(resume(NULL, false), JN_BAD_INPUT);
	log_expect("there are no checkpoints to resume from");
	assert_int_equal(resume(NULL, true), JN_OK); // but for that at its end
	assert_int_equal(first_step, 6);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

int main(void) {
	const struct CMUnitTest tests[] = {
		TEST(the_newest_state_of_the_run_itself_is_taken),
		TEST(the_newest_of_all_is_where_the_run_ended),
		TEST(a_state_is_named_by_its_file_or_a_path),
		TEST(a_name_that_is_not_there_is_told_with_another_one),
		TEST(of_a_damaged_state_the_one_before_is_offered),
		TEST(where_there_is_no_other_state_the_scene_is_to_be_run_again),
		TEST(a_folder_without_states_is_told_as_such),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
