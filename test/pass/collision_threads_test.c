/// @file collision_threads_test.c
/// Threads against threads and against soft bodies: momentum, self-collision, fast impacts, and what steps may not leave behind.
#include "control/controller.h"
#include "pass/collision_case.h"

// ---- two threads in free flight

static void open_crossing(Run* run, double friction, double dt, int links, double speed) {
	run_open(run, 1,
			 "duration: 1 s\ngravity: [0, 0, 0]\nintegrator: {method: symplectic_euler}\nstep: {dt: %.17g s}\n"
			 "bodies:\n"
			 "  - {name: a, shape: {type: thread, radius: 2 mm, links: %d, points: [{at: [-0.05, 0.005, 0.002]}, "
			 "{at: [0.05, 0.006, 0]}]}, " SOFT_ROD ", velocity: [0.3, %.17g, 0.2]}\n"
			 "  - {name: b, shape: {type: thread, radius: 3 mm, links: %d, points: [{at: [0.01, 0, -0.06]}, "
			 "{at: [0.012, -0.001, 0.05]}]}, " SOFT_ROD "}\n"
			 "collision: {friction: %g}\n",
			 dt, links, -speed, links, friction);
}

/// Change of momenta over a collision, relative to what one thread gives the other.
typedef struct Change {
	double linear, angular;
} Change;

static double change_of(const double before[3], const double after[3]) {
	double sum = 0;
	for (int a = 0; a < 3; ++a) sum += (after[a] - before[a]) * (after[a] - before[a]);
	return sqrt(sum);
}

static Change collide(double friction, double dt) {
	Run run;
	open_crossing(&run, friction, dt, 20, 1);
	const JnEnergies before = run_energies(&run);
	run_until(&run, 0.03);
	const JnEnergies after = run_energies(&run);
	const double given[3] = {body_momentum(&run, 1, 0), body_momentum(&run, 1, 1), body_momentum(&run, 1, 2)};
	const double size = vec3_length(given);
	run_close(&run);
	assert_true(size > 1e-4); // it was hit: it weighs 3 g
	return (Change){change_of(before.momentum, after.momentum) / size,
					change_of(before.angular, after.angular) / (size * 0.05)};
}

// Rounding of 3000 steps.
static void threads_that_collide_keep_their_momentum(void** state) {
	(void)state;
	expect_at_most(collide(0, 1e-5).linear, 1e-11, "change of momentum without friction");
	expect_at_most(collide(0.5, 1e-5).linear, 1e-11, "change of momentum with friction");
}

// Forces of both act at one point, so that only what is moved apart counts: overlap times momentum across it, of order dt.
static void threads_that_collide_keep_their_angular_momentum(void** state) {
	(void)state;
	for (int rough = 0; rough < 2; ++rough) {
		const double friction = 0.5 * rough, coarse = collide(friction, 2e-5).angular,
					 fine = collide(friction, 5e-6).angular;
		expect_at_most(coarse, 4e-4, "mu = %g: change, steps of 20 us", friction); // 1 m/s * 20 us over 0.05 m
		expect_at_most(fine, 1e-4, "mu = %g: change, steps of 5 us", friction);
	}
}

/// How far the first thread is above the second where they cross, seen from above.
static double height_above(const Run* run) {
	const double* x = run_state(run)->x;
	double above = NAN;
	for (int i = 0; i + 1 < frames_of(run, 0); ++i)
		for (int k = 0; k + 1 < frames_of(run, 1); ++k) {
			double a[3], b[3], c[3], d[3];
			axis_of(run, 0, i, x, a);
			axis_of(run, 0, i + 1, x, b);
			axis_of(run, 1, k, x, c);
			axis_of(run, 1, k + 1, x, d);
			const double u[2] = {b[0] - a[0], b[2] - a[2]}, v[2] = {d[0] - c[0], d[2] - c[2]};
			const double w[2] = {c[0] - a[0], c[2] - a[2]}, area = u[0] * v[1] - u[1] * v[0];
			const double s = (w[0] * v[1] - w[1] * v[0]) / area, t = (w[0] * u[1] - w[1] * u[0]) / area;
			if (s >= 0 && s <= 1 && t >= 0 && t <= 1) above = a[1] + s * (b[1] - a[1]) - (c[1] + t * (d[1] - c[1]));
		}
	return above;
}

// 200 m/s: 2 cm in a step, five times the distance at which they touch.
static void a_fast_thread_does_not_pass_through_another(void** state) {
	(void)state;
	for (int friction = 0; friction < 2; ++friction) {
		Run run;
		open_crossing(&run, friction, 1e-4, 8, 200);
		for (int i = 0; i < 2; ++i) {
			run_step(&run);
			const double apart = links_apart(&run, 0, 1, 0), above = height_above(&run);
			// sweeps stop at a thousandth of the centimetre by which impulses move them
			expect_at_most(5e-3 - apart, 1e-4, "step %d: overlap [m]", i);
			expect_at_most(5e-3 - 1e-4, above, "step %d: radii, and how far the first is above the second [m]", i);
		}
		run_close(&run);
	}
}

// ---- one thread

static void a_straight_thread_does_not_meet_itself(void** state) {
	(void)state;
	static const int links[] = {5, 20, 100};
	for (int i = 0; i < 3; ++i) { // links of 20 mm, 5 mm and 1 mm: shorter than the radius
		Run run;
		run_open(&run, 1,
				 "duration: 1 s\ngravity: [0, 0, 0]\nintegrator: {method: symplectic_euler}\nstep: {dt: 10 us}\n"
				 "bodies:\n"
				 "  - {name: a, shape: {type: thread, radius: 2 mm, links: %d, points: [{at: [0, 0, 0]}, "
				 "{at: [0.1, 0, 0]}]}, " SOFT_ROD "}\ncollision: {}\n",
				 links[i]);
		run_step(&run);
		expect_near(run_collision(&run)->kept.count, 0, 0, "%d links: blocks", links[i]);
		run_close(&run);
	}
}

// A hairpin whose legs are pressed together by a load on both ends.
static void a_thread_meets_itself_farther_along(void** state) {
	(void)state;
	Run run;
	run_open(&run, 1,
			 "duration: 1 s\ngravity: [0, 0, 0]\nintegrator: {method: symplectic_euler}\nstep: {dt: 20 us}\n"
			 "bodies:\n"
			 "  - {name: a, shape: {type: thread, radius: 2 mm, links: 40, points: [{at: [0, 0.01, 0]}, {at: [0.05, "
			 "0.01, 0]},"
			 " {at: [0.06, 0, 0]}, {at: [0.05, -0.01, 0]}, {at: [0, -0.01, 0]}]}, " SOFT_ROD ", damping: {alpha: 10},\n"
			 "     loads: [{where: {sphere: {center: [0, 0.01, 0], radius: 3 mm}}, force: [0, -0.005, 0]}, {where: "
			 "{sphere: {center: [0, -0.01, 0], radius: 3 mm}}, "
			 "force: [0, 0.005, 0]}]}\ncollision: {}\n");
	double least = INFINITY, pressing = 0;
	for (int i = 0; i < 100; ++i) {
		run_steps(&run, 100);
		least = fmin(least, links_apart(&run, 0, 0, run_collision(&run)->strands[0].apart));
		pressing = fmax(pressing, run_column(&run, "collisions"));
	}
	run_close(&run);
	assert_true(pressing > 0);
	expect_at_most(4e-3 - least, 4e-5, "overlap [m]"); // sweeps stop at a thousandth
}

// ---- soft bodies

static void open_on_block(Run* run, const char* fix, double speed, double friction) {
	run_open(run, 1,
			 "duration: 1 s\ngravity: [0, 0, 0]\nintegrator: {method: symplectic_euler}\nstep: {dt: 20 us}\n"
			 "bodies:\n"
			 "  - {name: thread, shape: {type: thread, radius: 2 mm, links: 12, points: [{at: [-0.03, 0.012, 0.003]}, "
			 "{at: [0.03, 0.01, 0.0]}]}, " SOFT_ROD ", velocity: [0, %.17g, 0.1]}\n"
			 "  - {name: block, shape: {type: box, origin: [-0.02, -0.02, -0.02], size: [0.04, 0.02, 0.04], cells: [4, "
			 "2, 4], "
			 "element: tet4}, material: {law: stable_neo_hookean, density: 1000, young: 2e4, poisson: 0.3}, mass: "
			 "lumped%s}\n"
			 "collision: {friction: %g}\n",
			 -speed, fix, friction);
}

static void a_soft_body_stops_a_thread_and_feels_it(void** state) {
	(void)state;
	for (int rough = 0; rough < 2; ++rough) {
		Run run;
		open_on_block(&run, "", 0.5, 0.5 * rough);
		const JnEnergies before = run_energies(&run);
		const double first = body_momentum(&run, 0, 1);
		run_until(&run, 0.06);
		const JnEnergies after = run_energies(&run);
		const double given = body_momentum(&run, 1, 1);
		print_message("the block has %g of the thread's %g N s\n", given, first);
		assert_true(given < 0.5 * first); // downwards, both
		assert_true(axis_low(&run, 0, run_state(&run)->x, 1) > body_low(&run, 1, run_state(&run)->x, 1));
		for (int a = 0; a < 3; ++a) // rounding of 3000 steps
			expect_near(after.momentum[a], before.momentum[a], 1e-12 * fabs(first) * 100, "mu = %g: momentum",
						0.5 * rough);
		run_close(&run);
	}
}

// 1 mm, 2 cm and 10 cm in a step: the block is 2 cm thick.
static void a_fast_thread_does_not_enter_a_soft_body(void** state) {
	(void)state;
	static const double speeds[] = {50, 1000, 5000};
	for (int i = 0; i < 3; ++i) {
		Run run;
		open_on_block(&run, ", fix: [{where: {face: all}}]", speeds[i], 0);
		double lowest = INFINITY;
		for (int k = 0; k < 2 + 0.012 / (2e-5 * speeds[i]); ++k) {
			run_step(&run);
			double at[3];
			for (int f = 3; f < 10; ++f) { // above the block, whose top is y = 0
				axis_of(&run, 0, f, run_state(&run)->x, at);
				if (fabs(at[0]) < 0.018 && fabs(at[2]) < 0.018) lowest = fmin(lowest, at[1]);
			}
		}
		run_close(&run);
		expect_at_most(2e-3 - lowest, 2e-6, "%g m/s: overlap [m]", speeds[i]); // sweeps stop at a thousandth
	}
}

// Its frames stand beside the block, 2.5 cm from the middle: only the edges of the block, 1 cm from it, carry the link.
static void a_link_rests_on_edges_between_its_frames(void** state) {
	(void)state;
	Run run;
	run_open(
		&run, 1,
		"duration: 1 s\ngravity: [0, -9.81, 0]\nintegrator: {method: symplectic_euler}\nstep: {dt: 0.1 ms}\n"
		"bodies:\n"
		"  - {name: thread, shape: {type: thread, radius: 2 mm, links: 3, points: [{at: [-0.075, 0.003, 0.001]}, "
		"{at: [0.075, 0.003, 0.001]}]}, material: {law: rod, density: 1000, young: 1e6, damping: 1 ms}, mass: lumped, "
		"damping: {alpha: 20}}\n"
		"  - {name: block, shape: {type: box, origin: [-0.01, -0.02, -0.02], size: [0.02, 0.02, 0.04], cells: [2, 2, "
		"2], "
		"element: tet4}, material: {law: stable_neo_hookean, density: 1000, young: 2e4, poisson: 0.3}, mass: lumped, "
		"fix: [{where: {face: all}}]}\n"
		"collision: {}\n");
	run_until(&run, 0.3);
	const double* x = run_state(&run)->x;
	double a[3], b[3];
	axis_of(&run, 0, 1, x, a);
	axis_of(&run, 0, 2, x, b);
	const double at_edge = a[1] + (b[1] - a[1]) * (0.01 - a[0]) / (b[0] - a[0]);
	run_close(&run);
	expect_near(at_edge, 2e-3, 2e-5,
				"height of the axis over the edge [m]"); // a link that leans by 0.1 stands 1e-5 m higher
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(threads_that_collide_keep_their_momentum),
		cmocka_unit_test(threads_that_collide_keep_their_angular_momentum),
		cmocka_unit_test(a_fast_thread_does_not_pass_through_another),
		cmocka_unit_test(a_straight_thread_does_not_meet_itself),
		cmocka_unit_test(a_thread_meets_itself_farther_along),
		cmocka_unit_test(a_soft_body_stops_a_thread_and_feels_it),
		cmocka_unit_test(a_fast_thread_does_not_enter_a_soft_body),
		cmocka_unit_test(a_link_rests_on_edges_between_its_frames),
	};
	return cmocka_run_group_tests(tests, case_set_up, case_tear_down);
}
