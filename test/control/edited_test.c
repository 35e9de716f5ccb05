/// @file edited_test.c
/// Step doubling where contact edits the ends: two halves are the integrator's alone, so that the edited end of the whole step is
/// kept, whichever end is asked for.
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "jounce/scene.h"
#include "jounce/sim.h"
#include "support/support.h"

// A soft block that lies on the floor from the start: every step is edited.
static const char scene_text[] = "duration: 40 ms\ngravity: [0, -9.81, 0]\nintegrator: sdirk2\ncontact: {}\n"
								 "step: {controller: step_doubling, dt: 10 ms, tolerance: 1 m}\n"
								 "obstacles: [{name: floor, shape: plane}]\n"
								 "bodies:\n"
								 "  - name: block\n    contact: {}\n"
								 "    shape: {type: box, size: [0.2, 0.2, 0.2], cells: [1, 1, 1]}\n"
								 "    material: {law: linear, density: 1000, young: 1e5, poisson: 0.3}\n";

enum { NODES = 8, STEPS = 4 };

static char folder[256];

static void run(const char* keep, double x[3 * NODES], double* lowest) {
	char set[64];
	snprintf(set, sizeof set, "step.keep=%s", keep);
	JnScene* scene = NULL;
	JnSim* sim = NULL;
	assert_int_equal(jn_scene_load(path_join(folder, "scene.yaml"), 1, (const char* const[]){set}, &scene), JN_OK);
	assert_int_equal(jn_scene_build(scene, 1, &sim), JN_OK);
	while (!jn_sim_is_done(sim)) assert_int_equal(jn_sim_step(sim), JN_OK);
	assert_int_equal(jn_sim_steps(sim), STEPS);
	memcpy(x, jn_sim_state(sim)->x, 3 * NODES * sizeof *x);
	*lowest = x[1];
	for (int i = 1; i < NODES; ++i)
		if (x[3 * i + 1] < *lowest) *lowest = x[3 * i + 1];
	jn_sim_destroy(sim);
	jn_scene_destroy(scene);
}

static void an_end_that_contact_has_edited_is_kept(void** state) {
	(void)state;
	double whole[3 * NODES], halves[3 * NODES], lowest;
	file_write(path_join(folder, "scene.yaml"), scene_text);
	run("whole", whole, &lowest);
	run("halves", halves, &lowest);
	print_message("lowest node at %g m\n", lowest);
	assert_true(lowest > -1e-6); // free fall in 40 ms: 8 mm below the floor
	assert_memory_equal(whole, halves, sizeof whole);
}

static int set_up(void** state) {
	(void)state;
	return folder_create(folder);
}

static int tear_down(void** state) {
	(void)state;
	folder_remove(folder);
	return 0;
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(an_end_that_contact_has_edited_is_kept, set_up, tear_down),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
