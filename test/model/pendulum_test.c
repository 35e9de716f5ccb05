// The built-in pendulum: its period and its energy.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "jounce/scene.h"

// sets over scenes/pendulum.yaml
static void open_scene(int count, const char* const sets[], JnScene** scene, JnSim** sim) {
	assert_int_equal(jn_scene_load(JN_SOURCE_DIR "/scenes/pendulum.yaml", count, sets, scene), JN_OK);
	assert_int_equal(jn_scene_build(*scene, 1, sim), JN_OK);
}

static double agm(double a, double b) {
	for (int i = 0; i < 8; ++i) {
		const double mean = 0.5 * (a + b);
		b = sqrt(a * b);
		a = mean;
	}
	return a;
}

// T = 2 pi sqrt(l/g) / agm(1, cos(theta_0/2)): after half of it the pendulum is on the other side.
static void half_a_period_brings_it_to_the_other_side(void** state) {
	(void)state;
	static const double angles[] = {0.1, 1.5, 3};
	for (int i = 0; i < 3; ++i) {
		JnScene* scene;
		JnSim* sim;
		char start[80], duration[64];
		const double half = acos(-1.0) * sqrt(0.7 / 9.81) / agm(1, cos(0.5 * angles[i]));
		snprintf(start, sizeof start, "system={type: pendulum, length: 0.7, mass: 3, angle: %g}", angles[i]);
		snprintf(duration, sizeof duration, "duration=%.17g", half);
		const char* const sets[] = {start, duration, "integrator={method: pefrl}", "step={dt: 0.2 ms}"};
		open_scene(4, sets, &scene, &sim);
		while (!jn_sim_is_done(sim)) assert_int_equal(jn_sim_step(sim), JN_OK);
		const JnState* end = jn_sim_state(sim);
		print_message("from %g to %.12g, speed %.2g\n", angles[i], end->x[0], end->v[0]);
		assert_true(fabs(end->x[0] + angles[i]) < 1e-9); // errors of dt^4
		assert_true(fabs(end->v[0]) < 1e-7); // near the top theta'' and the error grow by exp(half sqrt(g/l))
		jn_sim_destroy(sim);
		jn_scene_destroy(scene);
	}
}

static void energy_is_that_of_a_mass_on_a_circle(void** state) {
	(void)state;
	JnScene* scene;
	JnSim* sim;
	open_scene(1, (const char* const[]){"system={type: pendulum, length: 2, mass: 3, angle: 1.2, speed: -0.5}"}, &scene,
			   &sim);
	const JnEnergies e = jn_sim_energies(sim);
	assert_true(fabs(e.kinetic - 0.5 * 3 * pow(2 * -0.5, 2)) < 1e-14);
	assert_true(fabs(e.elastic + e.gravity - 3 * 9.81 * 2 * (1 - cos(1.2))) < 1e-13); // roundings of numbers up to 100
	jn_sim_destroy(sim);
	jn_scene_destroy(scene);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(half_a_period_brings_it_to_the_other_side),
		cmocka_unit_test(energy_is_that_of_a_mass_on_a_circle),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
