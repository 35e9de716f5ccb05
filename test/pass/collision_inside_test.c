/// @file collision_inside_test.c
/// A thread that lies within a body at the start is pushed out by the nearest way, no faster than `push_out`.
#include "pass/collision_case.h"

static const double radius = 2e-3, depth = 1.5e-3, push_out = 0.5, dt = 50e-6;

// A slab of 20 mm whose top is at y = 0; the axis of the thread lies below that, or above its bottom.
static void open_slab(Run* run, double y) {
	run_open(
		run, 1,
		"duration: 1 s\ngravity: [0, 0, 0]\nintegrator: {method: symplectic_euler}\nstep: {dt: 50 us}\n"
		"bodies:\n"
		"  - {name: thread, shape: {type: thread, radius: 2 mm, links: 5, points: [{at: [-0.01, %.17g, 0.001]}, "
		"{at: [0.01, %.17g, 0.001]}]}, " SOFT_ROD "}\n"
		"  - {name: slab, shape: {type: box, origin: [-0.04, -0.02, -0.04], size: [0.08, 0.02, 0.08], cells: [4, 1, "
		"4], element: tet4}, material: {law: stable_neo_hookean, density: 1000, young: 1e5, poisson: 0.3}, mass: "
		"lumped, fix: [{where: {face: all}}]}\n"
		"collision: {push_out: 0.5 m/s}\n",
		y, y);
}

static double low(const Run* run) {
	return axis_low(run, 0, run_state(run)->x, 1);
}

static double high(const Run* run) {
	return axis_high(run, 0, run_state(run)->x, 1);
}

// Its depth and its radius at 0.5 m/s: 7 ms, in which no frame may move faster than that.
static void expect_way_out(double y, double surface, double side) {
	Run run;
	double before = y;
	open_slab(&run, y);
	while (run_state(&run)->t < 1.2 * (depth + radius) / push_out) {
		run_step(&run);
		const double now = side > 0 ? low(&run) : high(&run);
		// the first order of the push; a frame is held back by its neighbours, never thrown ahead of them
		assert_true(side * (now - before) <= push_out * dt * 1.01 && side * (now - before) >= -1e-6);
		before = now;
	}
	// from then on it touches: what sweeps leave is below a thousandth of the radius
	const double gap = side > 0 ? low(&run) - surface : surface - high(&run);
	print_message("gap of the axis %.4g m, radius %g m\n", gap, radius);
	assert_true(gap >= radius * (1 - 1e-3));
	run_close(&run);
}

static void a_thread_below_the_top_leaves_through_the_top(void** state) {
	(void)state;
	expect_way_out(-depth, 0, 1);
}

static void a_thread_above_the_bottom_leaves_through_the_bottom(void** state) {
	(void)state;
	expect_way_out(-0.02 + depth, -0.02, -1);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_thread_below_the_top_leaves_through_the_top),
		cmocka_unit_test(a_thread_above_the_bottom_leaves_through_the_bottom),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
