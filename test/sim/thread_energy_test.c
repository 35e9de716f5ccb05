/// @file thread_energy_test.c
/// An undamped thread over a million steps: a symplectic method gains and loses energy, and neither for long.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "jounce/scene.h"

enum { STEPS = 1000000, STRIDE = 100, PARTS = 10 };

static const double dt = 1.5e-4; // [s]; 0.4 of the largest stable step

/// Energy above that of the start over a run, in ten parts: mean and largest size [J].
typedef struct Course {
	double mean[PARTS], largest[PARTS], motion;
} Course;

static double energy_of(JnSim* sim, double* kinetic) {
	const JnEnergies e = jn_sim_energies(sim);
	*kinetic = fmax(*kinetic, e.kinetic);
	return e.kinetic + e.elastic + e.gravity;
}

static void follow(const char* method, int steps, Course* course) {
	const char* const sets[] = {"bodies[0].shape.links=10",
								"bodies[0].material.damping=0",
								"bodies[0].material.volume=50kPa",
								"bodies[0].material.torsion=1e-6",
								"duration=1000 s",
								"step.dt=150 us",
								"gravity=[0, -1, 0]",
								method};
	JnScene* scene = NULL;
	JnSim* sim = NULL;
	*course = (Course){0};
	assert_int_equal(jn_scene_load(JN_SOURCE_DIR "/scenes/thread.yaml", sizeof sets / sizeof *sets, sets, &scene),
					 JN_OK);
	assert_int_equal(jn_scene_build(scene, 1, &sim), JN_OK);
	const double start = energy_of(sim, &course->motion);
	for (int i = 1; i <= steps; ++i) {
		assert_int_equal(jn_sim_step(sim), JN_OK);
		if (i % STRIDE != 0) continue;
		const int part = (int)((long)(i - 1) * PARTS / steps);
		const double gain = energy_of(sim, &course->motion) - start;
		course->mean[part] += gain / (steps / PARTS / STRIDE);
		course->largest[part] = fmax(course->largest[part], fabs(gain));
	}
	assert_true(fabs(jn_sim_state(sim)->t - steps * dt) < 1e-6);
	jn_sim_destroy(sim);
	jn_scene_destroy(scene);
}

static void verlet_keeps_the_energy_of_an_undamped_thread_over_a_million_steps(void** state) {
	(void)state;
	Course course;
	follow("integrator.method=verlet", STEPS, &course);
	for (int k = 0; k < PARTS; ++k)
		print_message("part %d: mean %+.2e, largest %.2e of the energy in motion\n", k, course.mean[k] / course.motion,
					  course.largest[k] / course.motion);
	for (int k = 0; k < PARTS; ++k) {
		// The energy that the method keeps differs from E by (omega dt)^2/8 of what the fastest oscillations have: at most 8 %
		// at this step, of a small part of the whole.
		assert_true(course.largest[k] < 0.01 * course.motion);
		// No trend: once all oscillations have their share, averages differ by less than the energy swings by.
		assert_true(fabs(course.mean[k] - course.mean[PARTS - 1]) < course.largest[0]);
	}
}

// The bounds above are ones that a method can break: this one damps what Verlet keeps, in a tenth of the steps.
static void rk4_loses_energy_where_verlet_does_not(void** state) {
	(void)state;
	Course verlet, rk4;
	follow("integrator.method=verlet", STEPS / 10, &verlet);
	follow("integrator.method=rk4", STEPS / 10, &rk4);
	const double kept = verlet.mean[PARTS - 1] / verlet.motion, lost = rk4.mean[PARTS - 1] / rk4.motion;
	print_message("mean of the last part: verlet %+.2e, rk4 %+.2e of the energy in motion\n", kept, lost);
	assert_true(fabs(kept) < 0.01);
	assert_true(lost < -0.01);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(verlet_keeps_the_energy_of_an_undamped_thread_over_a_million_steps),
		cmocka_unit_test(rk4_loses_energy_where_verlet_does_not),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
