/// @file refused_call_test.c
/// A scene is run with checkpoints, stopped and resumed while one call of the system fails: each in turn. Either that is told
/// with the folder of the run, or the run comes to the same end all the same.
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "jounce/scene.h"
#include "support/refused_calls.h"
#include "support/support.h"

static const char scene_text[] =
	"name: spring\nduration: 20 ms\nsystem: {type: spring_1d, mass: 2 kg}\nintegrator: verlet\n"
	"step: {dt: 10 ms}\nrecord: {plots: no, interval: 0.1 s}\ncheckpoint: {every: 10 ms, keep: 1}\n";

static char folder[256];
static long call_count;
static const char* call_name;

static bool stop_halfway(void* user, const JnProgress* progress) {
	(void)user;
	return progress->steps < 1;
}

static JnStatus tell_story(const char* output, JnScene* scene, JnRunResult* result) {
	const JnRunOptions options = {.directory = output, .threads = 1, .progress = stop_halfway};
	JN_TRY(jn_scene_run(scene, &options, result));
	const JnResumeOptions resumed = {.run = {.directory = output, .threads = 1}};
	return jn_scene_resume(&resumed, result);
}

// The story, of which the call of that number fails, or none.
static JnStatus tell(const char* output, long number, JnRunResult* result) {
	JnScene* scene = NULL;
	assert_int_equal(jn_scene_load(path_join(folder, "scene.yaml"), 0, NULL, &scene), JN_OK);
	refused_call_set(CALL_SYSTEM, number);
	const JnStatus status = tell_story(output, scene, result);
	call_name = refused_call_name();
	call_count = refused_call_count();
	refused_call_set(0, 0);
	jn_scene_destroy(scene);
	return status;
}

static const char* fault_of(JnStatus status, const JnRunResult* result, const JnRunResult* expected) {
	if (status == JN_OK)
		return result->t == expected->t && result->steps == expected->steps ? NULL : "the end is another one";
	if (status != JN_IO_FAILED) return jn_status_name(status);
	const bool is_above = strstr(log_text(), "cannot make this folder") != NULL; // a folder on the way, such as /tmp
	return is_above || strstr(log_text(), folder) != NULL ? NULL : "the message names no file";
}

static void a_call_that_fails_is_told_or_done_without(void** state) {
	JnRunResult expected, result;
	int bad = 0;
	(void)state;
	file_write(path_join(folder, "scene.yaml"), scene_text);
	assert_int_equal(tell(path_join(folder, "expected"), 0, &expected), JN_OK);
	const long count = call_count;
	for (long number = 1; number <= count; ++number) {
		const char* output = path_join(folder, "output");
		log_capture();
		const JnStatus status = tell(output, number, &result);
		const char* fault = fault_of(status, &result, &expected);
		if (fault != NULL) print_message("call %ld, %s: %s; \"%s\"\n", number, call_name, fault, log_text());
		bad += fault != NULL;
		folder_remove(output);
	}
	print_message("%ld calls\n", count);
	assert_int_equal(bad, 0);
}

static int set_up(void** state) {
	log_set_up(state);
	return folder_create(folder);
}

static int tear_down(void** state) {
	folder_remove(folder);
	return log_tear_down(state);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(a_call_that_fails_is_told_or_done_without, set_up, tear_down),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
