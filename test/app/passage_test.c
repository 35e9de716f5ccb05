// Who passes through a sheet: bodies that fall through it, and neither those that it stops nor those that go around it.
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "recording_file.c" // the command's own parts are in no library
#include "recording_reader.c"
#include "reproduce/frames.c"
#include "reproduce/passage.c"
#include "support/support.h"

// A sheet of 1 m, held at its edges and at a slope, and a box that falls from 30 cm above it.
static const char scene_text[] =
	"name: fall\n"
	"duration: 0.5 s\n"
	"gravity: [0, -9.81, 0]\n"
	"bodies:\n"
	"  - name: sheet\n"
	"    shape: {type: sheet, plane: xz, size: [1, 1], thickness: 1 cm, cells: [8, 8], rotate: [0, 0, 10 deg]}\n"
	"    material: {law: linear, density: 1000, young: 1e6, poisson: 0.4}\n"
	"    fix: [{where: {face: all}}]\n"
	"  - name: box\n"
	"    shape: {type: box, origin: [0.5, 0.3, 0.5], size: [0.1, 0.1, 0.1], cells: [1, 1, 1]}\n"
	"    material: {law: stable_neo_hookean, density: 200, young: 1e5, poisson: 0.3}\n"
	"integrator: {method: backward_euler}\n"
	"step: {dt: 5 ms}\n"
	"record: {interval: 20 ms, plots: no}\n";

static char folder[256];

static int set_up(void** state) {
	(void)state;
	return folder_create(folder) == 0 ? 0 : -1;
}

static int tear_down(void** state) {
	(void)state;
	folder_remove(folder);
	return 0;
}

static int passages_with(const char* set) {
	Frames frames;
	int passages = -1;
	file_write(path_join(folder, "fall.yaml"), scene_text);
	Outcome outcome =
		command_run(folder, (const char* const[]){"run", "fall.yaml", "-q", "-o", "out", "--set", set, NULL});
	if (outcome.status != 0) fail_msg("%s: %s", set, outcome.err);
	outcome_free(&outcome);
	assert_int_equal(frames_open(path_join(folder, "out"), &frames), JN_OK);
	assert_int_equal(passages_count(&frames, 1, &passages), JN_OK);
	frames_close(&frames);
	print_message("%s: %d\n", set, passages);
	return passages;
}

static void who_falls_through_is_counted_once(void** state) {
	(void)state;
	assert_int_equal(passages_with("gravity=[0, -9.81, 0]"), 1);
}

static void who_is_stopped_is_not_counted(void** state) {
	(void)state;
	assert_int_equal(passages_with("contact={}"), 0);
}

static void who_falls_past_the_rim_is_not_counted(void** state) {
	(void)state;
	assert_int_equal(passages_with("bodies[1].shape.origin=[1.1, 0.3, 0.5]"), 0);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(who_falls_through_is_counted_once, set_up, tear_down),
		cmocka_unit_test_setup_teardown(who_is_stopped_is_not_counted, set_up, tear_down),
		cmocka_unit_test_setup_teardown(who_falls_past_the_rim_is_not_counted, set_up, tear_down),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
