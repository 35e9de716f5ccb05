/// @file scene_watch_test.c
/// The watch over energy is silent on every scene of scenes/, stepped as the scene says: with its method, controller, wind,
/// driven nodes, contact and cracks. Shapes are coarse, so that many steps take little time.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "base/timer.h"
#include "support/coarse_scene.h"
#include "support/support.h"

enum { MOST_STEPS = 300 };

static const double most_seconds = 1; // a scene

static void step_and_watch(JnSim* sim, const char* path) {
	JnEnergies energies = jn_sim_energies(sim);
	const double began = jn_seconds();
	assert_int_equal(jn_sim_watch(sim, &energies), JN_OK);
	while (!jn_sim_is_done(sim) && jn_sim_steps(sim) < MOST_STEPS && jn_seconds() < began + most_seconds) {
		if (jn_sim_step(sim) != JN_OK) fail_msg("%s: %s", path, log_text());
		energies = jn_sim_energies(sim);
		if (jn_sim_watch(sim, &energies) != JN_OK || log_text()[0] != '\0') fail_msg("%s: %s", path, log_text());
	}
	print_message("%s: %ld steps\n", strrchr(path, '/') + 1, jn_sim_steps(sim));
}

static void watch_scene(const char* path) {
	Plan plan;
	Sets sets;
	JnScene* scene = NULL;
	JnSim* sim = NULL;
	make_plan(path, &plan);
	copy_sets(&plan.coarse, &sets);
	log_capture();
	if (jn_scene_load(path, sets.count, sets.list, &scene) != JN_OK) fail_msg("%s: %s", path, log_text());
	drop_bodies(scene);
	if (jn_scene_build(scene, 1, &sim) != JN_OK) fail_msg("%s: %s", path, log_text());
	step_and_watch(sim, path);
	log_release();
	jn_sim_destroy(sim);
	jn_scene_destroy(scene);
}

static void no_scene_gains_energy_from_nowhere(void** state) {
	(void)state;
	visit_scenes(watch_scene);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(no_scene_gains_energy_from_nowhere),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
