/// @file collision_rest_test.c
/// Threads on obstacles: they rest at their radius, stick and slide as Coulomb says, and roll; nothing passes through.
#include "pass/collision_case.h"

static const double radius = 2e-3, g = 9.81;

static void open_on_floor(Run* run, const char* method, double height, const char* gravity, const char* collision) {
	run_open(run, 1,
			 "duration: 10 s\ngravity: %s\nintegrator: {method: %s}\nstep: {dt: 0.1 ms}\n"
			 "bodies:\n"
			 "  - {name: thread, shape: {type: thread, radius: 2 mm, links: 10, points: [{at: [0, %.17g, 0]}, "
			 "{at: [0.06, %.17g, 0]}]}, " SOFT_ROD "}\n"
			 "obstacles: [{name: floor, shape: plane}]\ncollision: {%s}\n",
			 gravity, method, height, height, collision);
}

// Its impulses carry the weight; what a step leaves of its fall is g dt^2 and is taken off within the step.
static void a_thread_rests_on_a_floor_at_its_radius(void** state) {
	(void)state;
	static const char* const methods[] = {"symplectic_euler", "verlet", "rk4", "backward_euler", "sdirk2"};
	for (int m = 0; m < 5; ++m) {
		Run run;
		open_on_floor(&run, methods[m], 1.5 * radius, "[0, -9.81, 0]", "");
		run_until(&run, 0.1);
		double impulse = 0;
		for (int i = 0; i < 100; ++i) {
			run_step(&run);
			impulse += run_column(&run, "collision_impulse") / 100;
		}
		const double weight = g * body_mass(&run, 0);
		print_message("%s\n", methods[m]);
		// a step's fall is 1e-7 m; 1e-6 m is a two-thousandth of the radius
		expect_near(axis_low(&run, 0, run_state(&run)->x, 1), radius, 1e-6, "lowest point");
		expect_near(axis_high(&run, 0, run_state(&run)->x, 1), radius, 1e-6, "highest point");
		// sections swing a little within; over a hundred steps that leaves parts in a thousand
		expect_near(impulse / (1e-4 * weight), 1, 0.01, "force over weight");
		run_close(&run);
	}
}

// Gravity in place of a slope: tan 30 deg = 0.577.
static const char slope[] = "[4.905, -8.4957, 0]";

static double speed_after(const char* method, double friction, double t, double* moved) {
	Run run;
	char collision[64];
	snprintf(collision, sizeof collision, "friction: %g", friction);
	open_on_floor(&run, method, radius, slope, collision);
	const double from = axis_low(&run, 0, run_state(&run)->x, 0);
	run_until(&run, t);
	const double speed = body_momentum(&run, 0, 0) / body_mass(&run, 0);
	*moved = axis_low(&run, 0, run_state(&run)->x, 0) - from;
	run_close(&run);
	return speed;
}

static void a_thread_on_a_slope_sticks_where_friction_is_larger_than_its_slope(void** state) {
	(void)state;
	static const char* const methods[] = {"symplectic_euler", "verlet", "backward_euler"};
	for (int m = 0; m < 3; ++m) {
		double moved;
		speed_after(methods[m], 0.62, 0.2, &moved);
		// free, it would slide 98 mm; the thread is compressed by its own weight, by rho g L^2/(2 E) = 0.04 mm
		expect_near(moved, 0, 1e-4, "%s: moved [m]", methods[m]);
	}
}

static void a_thread_on_a_slope_slides_where_friction_is_smaller(void** state) {
	(void)state;
	static const char* const methods[] = {"symplectic_euler", "verlet", "backward_euler"};
	for (int m = 0; m < 3; ++m) {
		double moved;
		const double speed = speed_after(methods[m], 0.4, 0.2, &moved), expected = (4.905 - 0.4 * 8.4957) * 0.2;
		// friction at the surface bends it a little at first: some steps of 0.1 ms in 2000
		expect_near(speed, expected, 0.005 * expected, "%s: speed [m/s]", methods[m]);
		expect_near(moved, 0.5 * expected * 0.2, 0.01 * 0.5 * expected * 0.2, "%s: moved [m]", methods[m]);
	}
}

// A step of 2e-13 s between others of 1e-4 s, in a heap that still settles: what begins the next one is no billion times what
// presses in it.
static void a_step_cut_short_throws_nothing(void** state) {
	(void)state;
	static const char* const methods[] = {"symplectic_euler", "verlet", "backward_euler"};
	for (int m = 0; m < 3; ++m) {
		Run run;
		double before = 0, after = 0;
		run_open(
			&run, 1,
			"duration: 10 s\ngravity: [0, -9.81, 0]\nintegrator: {method: %s}\nstep: {dt: 0.1 ms}\nbodies:\n"
			"  - {name: low, shape: {type: thread, radius: 2 mm, links: 10, points: [{at: [-0.03, 0.002, 0]}, {at: "
			"[0.03, 0.002, 0]}]}, " SOFT_ROD "}\n"
			"  - {name: high, shape: {type: thread, radius: 2 mm, links: 10, points: [{at: [0, 0.006, -0.03]}, {at: "
			"[0, 0.006, 0.03]}]}, " SOFT_ROD "}\n"
			"obstacles: [{name: floor, shape: plane}]\ncollision: {friction: 0.3}\n",
			methods[m]);
		run_until(&run, 0.05);
		for (int k = 0; k < run.length; ++k) before = fmax(before, fabs(run_state(&run)->v[k]));
		jn_sim_stop_at(run.sim, run_state(&run)->t + 2e-13);
		run_step(&run);
		jn_sim_stop_at(run.sim, INFINITY);
		for (int i = 0; i < 5; ++i) {
			run_step(&run);
			for (int k = 0; k < run.length; ++k) after = fmax(after, fabs(run_state(&run)->v[k]));
		}
		// five steps of gravity are 5 mm/s
		expect_at_most(after, before + 5e-3, "%s: fastest node [m/s]", methods[m]);
		run_close(&run);
	}
}

// Three lines at r / sqrt 2 have the moment of inertia m r^2/2, so that a = g sin / (1 + 1/2).
static void friction_is_that_of_the_pair_of_surfaces(void** state) {
	(void)state;
	Run run;
	run_open(&run, 1,
			 "duration: 10 s\ngravity: %s\nintegrator: {method: symplectic_euler}\nstep: {dt: 0.1 ms}\n"
			 "bodies:\n"
			 "  - {name: a, shape: {type: thread, radius: 2 mm, links: 10, points: [{at: [0, 0.002, 0]}, "
			 "{at: [0.06, 0.002, 0]}]}, " SOFT_ROD ", contact: {surface: silk}}\n"
			 "  - {name: b, shape: {type: thread, radius: 2 mm, links: 10, points: [{at: [0, 0.002, 0.1]}, "
			 "{at: [0.06, 0.002, 0.1]}]}, " SOFT_ROD ", contact: {surface: hemp}}\n"
			 "obstacles: [{name: floor, shape: plane, surface: wood}]\n"
			 "collision: {friction: 0.1, pairs: [{first: silk, second: wood, friction: 0.4}, "
			 "{first: wood, second: hemp, friction: 0.62}]}\n",
			 slope);
	run_until(&run, 0.1);
	const double silk = body_momentum(&run, 0, 0) / body_mass(&run, 0),
				 hemp = body_momentum(&run, 1, 0) / body_mass(&run, 1);
	run_close(&run);
	const double expected = (4.905 - 0.4 * 8.4957) * 0.1;
	expect_near(silk, expected, 0.02 * expected,
				"speed of silk [m/s]"); // it swings along itself, with 0.1 ms steps of 1000
	expect_near(hemp, 0, 0.02 * expected, "speed of hemp [m/s]");
}

static void a_thread_across_a_slope_rolls(void** state) {
	(void)state;
	Run run;
	open_on_floor(&run, "symplectic_euler", radius, "[0, -8.4957, 4.905]", "friction: 0.5");
	run_until(&run, 0.1);
	const double speed = body_momentum(&run, 0, 2) / body_mass(&run, 0), expected = 2.0 / 3 * 4.905 * 0.1;
	run_close(&run);
	expect_near(speed, expected, 0.01 * expected,
				"speed [m/s]"); // sections give under its weight by parts in a thousand
}

static void restitution_gives_back_its_share_of_the_speed(void** state) {
	(void)state;
	Run run;
	open_on_floor(&run, "symplectic_euler", radius + 0.01, "[0, -9.81, 0]", "restitution: 0.5");
	double fastest = 0, after = 0;
	for (int i = 0; i < 600; ++i) { // the fall takes 45 ms
		run_step(&run);
		double v[3];
		axis_of(&run, 0, 5, run_state(&run)->v, v); // the middle: at its ends the lumped masses lie beside the axis
		fastest = fmin(fastest, v[1]);
		after = fmax(after, v[1]);
	}
	run_close(&run);
	expect_near(after, -0.5 * fastest, 0.01 * fabs(fastest), "speed of the rebound [m/s]"); // a step of gravity: 1 mm/s
}

// The residue is the load that acts in the next step: the weight, or that share of it.
static void the_residue_is_the_share_of_the_weight_that_acts_on(void** state) {
	(void)state;
	static const double shares[] = {0, 0.5, 1};
	for (int s = 0; s < 3; ++s) {
		Run run;
		char collision[64];
		double carried = 0, lowest;
		snprintf(collision, sizeof collision, "residue: %g", shares[s]);
		open_on_floor(&run, "symplectic_euler", radius, "[0, -9.81, 0]", collision);
		run_until(&run, 0.05);
		const JnCollision* pass = run_collision(&run);
		for (int k = 1; pass->is_loaded && k < run.length; k += 3) carried += pass->load[k];
		lowest = axis_low(&run, 0, run_state(&run)->x, 1);
		const double weight = g * body_mass(&run, 0);
		run_close(&run);
		expect_near(carried / weight, shares[s], 0.02, "carried over weight"); // sections swing a little
		expect_near(lowest, radius, 1e-6, "lowest point");
	}
}

// A thread lies across another, which a hand holds: the hand carries both, whichever share of it acts as a load.
static void a_hand_feels_what_collides_with_what_it_holds(void** state) {
	(void)state;
	static const double shares[] = {0, 1};
	for (int s = 0; s < 2; ++s) {
		Run run;
		double force[3], carried = 0;
		run_open(
			&run, 1,
			"duration: 10 s\ngravity: [0, -9.81, 0]\nintegrator: {method: symplectic_euler}\nstep: {dt: 0.1 ms}\n"
			"bodies:\n"
			"  - {name: held, shape: {type: thread, radius: 2 mm, links: 4, points: [{at: [-0.01, 0, 0]}, {at: [0.01, "
			"0, 0]}]}, " SOFT_ROD ", drive: [{where: {face: all}, input: hand}]}\n"
			"  - {name: other, shape: {type: thread, radius: 2 mm, links: 4, points: [{at: [0, 0.004, -0.01]}, {at: "
			"[0, 0.004, 0.01]}]}, " SOFT_ROD "}\ncollision: {friction: 0.5, residue: %g}\n",
			shares[s]);
		const double weight = g * (body_mass(&run, 0) + body_mass(&run, 1));
		run_until(&run, 0.1);
		for (int i = 0; i < 500; ++i) {
			run_step(&run);
			assert_int_equal(jn_sim_input_force(run.sim, jn_sim_input(run.sim, "hand"), force), JN_OK);
			carried -= force[1] / 500;
		}
		run_close(&run);
		expect_near(carried / weight, 1, 0.01, "carried over weight"); // its ends swing a little, over 50 ms
	}
}

// 5 cm in a step, through a plate of 1 mm, on a plane, a bar and a ball: of springs alone, which such a blow may flatten.
static void a_fast_thread_does_not_pass_through_obstacles(void** state) {
	(void)state;
	static const char* const obstacles[] = {"{type: box, size: [1, 0.001, 1]}", "{type: plane}",
											"{type: capsule, from: [-1, -0.003, 0], to: [1, -0.003, 0], radius: 3 mm}",
											"{type: sphere, center: [0, -0.02, 0], radius: 2 cm}"};
	for (int i = 0; i < 4; ++i) {
		Run run;
		run_open(&run, 1,
				 "duration: 1 s\ngravity: [0, 0, 0]\nintegrator: {method: symplectic_euler}\nstep: {dt: 0.1 ms}\n"
				 "bodies:\n"
				 "  - {name: thread, shape: {type: thread, radius: 2 mm, links: 8, points: [{at: [-0.02, 0.11, 0]}, "
				 "{at: [0.02, 0.113, 0]}]}, velocity: [0, -500, 0], material: {law: constraints, density: 1000, "
				 "stiffness: 5 kPa}, mass: lumped}\n"
				 "obstacles: [{name: wall, shape: %s}]\ncollision: {}\n",
				 obstacles[i]);
		double lowest = INFINITY, middle = INFINITY;
		for (int k = 0; k < 5; ++k) {
			run_step(&run);
			double normal[3], at[3];
			axis_of(&run, 0, 4, run_state(&run)->x, at);
			middle = fmin(middle, at[1]);
			for (int f = 0; f < frames_of(&run, 0); ++f) {
				axis_of(&run, 0, f, run_state(&run)->x, at);
				lowest = fmin(lowest, jn_obstacle_distance(&run.model->obstacles[0].shape, at, normal));
			}
		}
		run_close(&run);
		// along a curved surface a frame leaves the tangent plane in which it was stopped
		expect_at_most(radius - lowest, 0.5 * radius, "%s: overlap [m]", obstacles[i]);
		expect_at_most(-middle, 0, "%s: how far below its top [m]", obstacles[i]); // beyond it the overlap is none, too
	}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_thread_rests_on_a_floor_at_its_radius),
		cmocka_unit_test(a_thread_on_a_slope_sticks_where_friction_is_larger_than_its_slope),
		cmocka_unit_test(a_thread_on_a_slope_slides_where_friction_is_smaller),
		cmocka_unit_test(a_step_cut_short_throws_nothing),
		cmocka_unit_test(friction_is_that_of_the_pair_of_surfaces),
		cmocka_unit_test(a_thread_across_a_slope_rolls),
		cmocka_unit_test(restitution_gives_back_its_share_of_the_speed),
		cmocka_unit_test(the_residue_is_the_share_of_the_weight_that_acts_on),
		cmocka_unit_test(a_hand_feels_what_collides_with_what_it_holds),
		cmocka_unit_test(a_fast_thread_does_not_pass_through_obstacles),
	};
	return cmocka_run_group_tests(tests, case_set_up, case_tear_down);
}
