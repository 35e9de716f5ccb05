// Small scenes on which other systems are known to fail: what must happen in them follows from mechanics alone.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/key.h"
#include "integrate/integrator.h"
#include "jounce/scene.h"
#include "support/moved.h"
#include "support/support.h"

#define SCENES JN_SOURCE_DIR "/test/reference/scenes/"

typedef struct Run {
	JnScene* scene;
	JnSim* sim;
	JnArena arena;
	Moved moved;
} Run;

// False: the scene cannot be built with these sets.
static bool try_open(Run* run, const char* path, int count, const char* const sets[], const Move* move) {
	*run = (Run){0};
	if (jn_scene_load(path, count, sets, &run->scene) != JN_OK) fail_msg("%s: %s", path, log_text());
	if (move != NULL) move_scene((JnSceneDef*)jn_scene_def(run->scene), move, &run->arena, &run->moved);
	return jn_scene_build(run->scene, 1, &run->sim) == JN_OK;
}

static void open_run(Run* run, const char* path, int count, const char* const sets[], const Move* move) {
	if (!try_open(run, path, count, sets, move)) fail_msg("%s: %s", path, log_text());
}

static void step_run(Run* run, int steps) {
	for (int i = 0; i < steps; ++i)
		if (jn_sim_step(run->sim) != JN_OK) fail_msg("%s: step %d: %s", jn_scene_def(run->scene)->name, i, log_text());
}

static void close_run(Run* run) {
	jn_sim_destroy(run->sim);
	jn_scene_destroy(run->scene);
	jn_arena_free(&run->arena);
	free(run->moved.order);
}

static int node_count(const Run* run) {
	return jn_model_node_count(jn_sim_model(run->sim));
}

// MuJoCo's flex: a soft body whose frame is turned by 10 degrees ended in NAN. Free fall deforms nothing: every node falls by
// t (t + dt)/2 g, which is what backward Euler makes of t^2/2 g.
static void a_turned_block_falls_without_deforming(void** state) {
	(void)state;
	enum { FALL = 40 };
	Run run;
	open_run(&run, SCENES "falling_block.yaml", 0, NULL, NULL);
	step_run(&run, FALL);
	const double t = 0.01 * FALL, fall = 0.5 * 9.81 * t * (t + 0.01);
	const double *x = jn_sim_state(run.sim)->x, *rest = jn_model_rest(jn_sim_model(run.sim));
	for (int k = 0; k < 3 * node_count(&run); ++k) {
		const double expected = rest[k] - (k % 3 == 1 ? fall : 0);
		if (!(fabs(x[k] - expected) <= 1e-12)) // rounding of positions of 1 m, 40 times
			fail_msg("coordinate %d is %.17g, expected %.17g, tolerance 1e-12", k, x[k], expected);
	}
	close_run(&run);
}

// Bullet: a soft body's motion changed with the order of nodes in its tetrahedra.
static void tetrahedra_with_another_first_node_swing_alike(void** state) {
	(void)state;
	static const char* const sets[] = {"bodies[0].shape.element=tet4", "bodies[0].material.law=corotated",
									   "newton.tolerance=1e-12", "solver={method: direct}"};
	static const Move moves[2] = {
		{.name = "as it is", .turn = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, .length = 1, .mass = 1},
		{.name = "renumbered", .turn = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, .length = 1, .mass = 1, .renumbers = true}};
	Run runs[2];
	for (int i = 0; i < 2; ++i) {
		open_run(&runs[i], SCENES "solid.yaml", 4, sets, &moves[i]);
		step_run(&runs[i], 110);
	}
	const double *a = jn_sim_state(runs[0].sim)->x, *b = jn_sim_state(runs[1].sim)->x;
	double moved = 0;
	for (int k = 0; k < 3 * node_count(&runs[0]); ++k) {
		moved = fmax(moved, fabs(a[k] - jn_model_rest(jn_sim_model(runs[0].sim))[k]));
		if (!(fabs(a[k] - b[k]) <= 1e-9 * 0.3)) // of the bar's length; Newton ends at 1e-12
			fail_msg("coordinate %d is %.17g, and %.17g with cells that begin elsewhere", k, a[k], b[k]);
	}
	assert_true(moved > 0.003); // it does swing
	close_run(&runs[0]);
	close_run(&runs[1]);
}

// Absolute tolerances that suit metres fail at millimetres. With the same material a body 1000 times smaller does the same
// 1000 times faster when weight grows as much: x/L is a function of t sqrt(E/rho)/L and g L rho/E alone.
static void a_bar_of_3_mm_does_what_a_bar_of_3_m_does(void** state) {
	(void)state;
	Run small, large;
	open_run(&small, SCENES "small_bar.yaml", 0, NULL, NULL);
	open_run(&large, SCENES "large_bar.yaml", 0, NULL, NULL);
	step_run(&small, 100);
	step_run(&large, 100);
	const double *a = jn_sim_state(small.sim)->x, *b = jn_sim_state(large.sim)->x;
	double sag = 0;
	for (int k = 0; k < 3 * node_count(&small); ++k) {
		sag = fmin(sag, b[k]);
		if (!(fabs(1000 * a[k] - b[k]) <= 1e-9 * 3)) // of the length; Newton ends at 1e-12
			fail_msg("coordinate %d is %.17g mm, expected %.17g", k, 1000 * a[k], b[k]);
	}
	assert_true(sag < -0.3); // it swings far
	close_run(&small);
	close_run(&large);
}

// A thread of polypropylene, whose axial waves take 0.13 us a link: with steps of 1 ms it must neither stretch nor gain
// energy. Its weight m g = 1.6 mN stretches it by m g L/(E A) at most a few times: 1e-4 of the length with the swing.
static void a_stiff_suture_keeps_its_length_and_its_energy(void** state) {
	(void)state;
	Run run;
	open_run(&run, JN_SOURCE_DIR "/scenes/suture_thread.yaml", 0, NULL, NULL);
	const JnEnergies start = jn_sim_energies(run.sim);
	const double before = start.kinetic + start.elastic + start.gravity, weight = jn_sim_mass(run.sim) * 9.81;
	step_run(&run, 300);
	const JnEnergies end = jn_sim_energies(run.sim);
	const double *x = jn_sim_state(run.sim)->x, *rest = jn_model_rest(jn_sim_model(run.sim));
	double length = 0, at_rest = 0;
	for (int frame = 0; frame + 1 < node_count(&run) / 3; ++frame) {
		const double *p = x + 9 * frame, *q = rest + 9 * frame;
		length += hypot(hypot(p[9] - p[0], p[10] - p[1]), p[11] - p[2]);
		at_rest += hypot(hypot(q[9] - q[0], q[10] - q[1]), q[11] - q[2]);
	}
	if (!(fabs(length / at_rest - 1) <=
		  2e-3)) // a corner of the section, which bending moves by its radius over that of the bow
		fail_msg("the length is %.17g m, %.17g m at rest, tolerance 0.2 %%", length, at_rest);
	const double gained = (end.kinetic + end.elastic + end.gravity - before) / (weight * 0.1);
	if (!(gained <= 1e-3 && gained >= -0.2)) // the method damps what the steps do not resolve, and adds nothing
		fail_msg("the energy changed by %.3g of the weight times the length", gained);
	close_run(&run);
}

// Without any force, what rests stays where it is, and what flies keeps its momentum. At rest a force of 1e-16 E A = 1e-13 N
// is left of rounding, which moves a node of 0.1 kg by 1e-16 m in 20 ms.
static void a_free_body_at_rest_stays_and_a_flying_one_goes_on(void** state) {
	(void)state;
	int tried = 0;
	for (int i = 0; i < jn_integrator_list.count; ++i) {
		char method[96];
		const char* const still[] = {method, "gravity=[0, 0, 0]", "bodies[0].mass=lumped", "step.dt=1 ms"};
		const char* const flying[] = {method, "gravity=[0, 0, 0]", "bodies[0].mass=lumped", "step.dt=1 ms",
									  "bodies[0].velocity=[0.5, -0.25, 1]"};
		Run run;
		snprintf(method, sizeof method, "integrator={method: %s}", jn_integrator_list.rows[i]->name);
		if (!try_open(&run, SCENES "falling_block.yaml", 4, still, NULL)) {
			close_run(&run);
			continue;
		}
		step_run(&run, 20);
		const double* rest = jn_model_rest(jn_sim_model(run.sim));
		for (int k = 0; k < 3 * node_count(&run); ++k)
			if (!(fabs(jn_sim_state(run.sim)->x[k] - rest[k]) <= 1e-15))
				fail_msg("%s: the body at rest has moved by %.3g m", method, jn_sim_state(run.sim)->x[k] - rest[k]);
		close_run(&run);

		open_run(&run, SCENES "falling_block.yaml", 5, flying, NULL);
		step_run(&run, 20);
		const JnEnergies end = jn_sim_energies(run.sim);
		const double mass = jn_sim_mass(run.sim), expected[3] = {0.5 * mass, -0.25 * mass, mass};
		for (int a = 0; a < 3; ++a)
			if (!(fabs(end.momentum[a] - expected[a]) <= 1e-13 * mass)) // rounding of 27 nodes in 20 steps
				fail_msg("%s: momentum %d is %.17g, expected %.17g", method, a, end.momentum[a], expected[a]);
		close_run(&run);
		++tried;
	}
	assert_true(tried > 10);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_turned_block_falls_without_deforming),
		cmocka_unit_test(tetrahedra_with_another_first_node_swing_alike),
		cmocka_unit_test(a_bar_of_3_mm_does_what_a_bar_of_3_m_does),
		cmocka_unit_test(a_stiff_suture_keeps_its_length_and_its_energy),
		cmocka_unit_test(a_free_body_at_rest_stays_and_a_flying_one_goes_on),
	};
	return cmocka_run_group_tests(tests, log_set_up, log_tear_down);
}
