/// @file contact_rules_test.c
/// What contact promises of positions, velocities and forces: nothing passes through anything, what overlaps parts slowly,
/// what rests rests.
#include "detect/obstacle.h"
#include "pass/contact.h"
#include "pass/pass_case.h"

static const char material[] = "material: {law: stable_neo_hookean, density: 1000, young: 1e5, poisson: 0.3}";

/// Largest overlap of a run so far, relative to a size, and largest residual; checked in every step.
static void step_soundly(Run* run, double size, double overlap) {
	run_step(run);
	const double deepest = run_column(run, "penetration"), residual = run_column(run, "qp_residual");
	if (!(deepest <= overlap * size)) fail_msg("step %ld: overlap of %g m", jn_sim_steps(run->sim), deepest);
	if (!(residual <= 1e-6)) fail_msg("step %ld: residual %g", jn_sim_steps(run->sim), residual);
}

static bool is_on_surface(const Run* run, int body, int node) {
	const JnContactPass* pass = (const JnContactPass*)run_pass(run);
	const JnSkin* skin = &pass->skins[pass->skin_of[body]];
	for (int i = 0; i < 3 * skin->triangle_count; ++i)
		if (skin->nodes[skin->triangles[i]] == run->model->bodies[body].first_node + node) return true;
	return false;
}

/// Smallest distance of a body's nodes to an obstacle; of the surface alone, where something sharp may enter a face.
static double clearance(const Run* run, int body, int obstacle) {
	double least = INFINITY, normal[3];
	for (int k = 0; k < body_length(run, body); k += 3) {
		if (!is_on_surface(run, body, k / 3)) continue;
		least = fmin(least, jn_obstacle_distance(&run->model->obstacles[obstacle].shape,
												 run_state(run)->x + body_first(run, body) + k, normal));
	}
	return least;
}

// ---- thin things

// A ball of 4 cm at 20 m/s: 20 cm in a step of 10 ms, through a plate of 1 mm.
static void shoot_at_box(const char* prediction) {
	static const char* const methods[] = {"backward_euler", "sdirk2", "newmark"};
	for (int m = 0; m < 3; ++m)
		for (int side = -1; side <= 1; side += 2) {
			Run run;
			run_open(
				&run, 1,
				"duration: 1 s\ngravity: [0, 0, 0]\nintegrator: {method: %s}\nstep: {dt: 10 ms}\n"
				"bodies:\n"
				"  - {name: ball, shape: {type: ball, center: [0.01, %g, 0.02], radius: 0.02, cells: 2, rings: 1},\n"
				"     material: {law: stable_neo_hookean, density: 1000, young: 1e6, poisson: 0.3},\n"
				"     velocity: [0, %d, 0]}\n"
				"obstacles: [{name: plate, shape: {type: box, size: [1, 0.001, 1]}}]\n"
				"contact: {prediction: %s}\n",
				methods[m], 0.13 * side, -20 * side, prediction);
			double pressed = 0;
			for (int i = 0; i < 20; ++i) {
				step_soundly(&run, 0.04, 1e-6);
				pressed += run_column(&run, "contacts_pressing") > 0;
				const double low =
					side > 0 ? body_low(&run, 0, run_state(&run)->x, 1) : -body_high(&run, 0, run_state(&run)->x, 1);
				if (!(low >= 0.0005 - 1e-6 * 0.04))
					fail_msg("%s, %s, step %d: a node at %g m, inside or behind", methods[m], prediction, i + 1, low);
			}
			assert_true(pressed > 0);
			run_close(&run);
		}
}

static void a_fast_ball_does_not_pass_a_thin_box(void** state) {
	(void)state;
	shoot_at_box("free");
}

static void a_fast_ball_does_not_pass_a_thin_box_with_iterated_forces(void** state) {
	(void)state;
	shoot_at_box("iterated");
}

static void a_fast_ball_does_not_pass_a_thin_box_with_carried_forces(void** state) {
	(void)state;
	shoot_at_box("carried");
}

static void shoot_at_sheet(const char* prediction) {
	static const char* const methods[] = {"backward_euler", "sdirk2"};
	for (int m = 0; m < 2; ++m) {
		Run run;
		run_open(
			&run, 1,
			"duration: 1 s\ngravity: [0, 0, 0]\nintegrator: {method: %s}\nstep: {dt: 10 ms}\n"
			"bodies:\n"
			"  - {name: ball, shape: {type: ball, center: [0.013, 0.13, 0.021], radius: 0.02, cells: 2, rings: 1},\n"
			"     material: {law: stable_neo_hookean, density: 1000, young: 1e6, poisson: 0.3},\n"
			"     velocity: [0, -20, 0]}\n"
			"  - {name: sheet, shape: {type: box, origin: [-0.2, -0.002, -0.2], size: [0.4, 0.002, 0.4],\n"
			"     cells: [6, 1, 6]}, material: {law: stable_neo_hookean, density: 1000, young: 1e7, poisson: 0.3},\n"
			"     fix: [{where: {face: x-}}, {where: {face: x+}}]}\n"
			"contact: {prediction: %s}\n",
			methods[m], prediction);
		double pressed = 0;
		for (int i = 0; i < 20; ++i) {
			step_soundly(&run, 0.04, 1e-6);
			pressed += run_column(&run, "contacts_pressing") > 0;
			// The sheet hangs below the ball at its lowest place.
			if (!(body_low(&run, 0, run_state(&run)->x, 1) > body_low(&run, 1, run_state(&run)->x, 1)))
				fail_msg("%s, step %d: the ball is behind the sheet", methods[m], i + 1);
		}
		assert_true(pressed > 0);
		run_close(&run);
	}
}

static void a_fast_ball_does_not_pass_a_sheet(void** state) {
	(void)state;
	shoot_at_sheet("free");
}

static void a_fast_ball_does_not_pass_a_sheet_with_iterated_forces(void** state) {
	(void)state;
	shoot_at_sheet("iterated");
}

static void a_fast_ball_does_not_pass_a_sheet_with_carried_forces(void** state) {
	(void)state;
	shoot_at_sheet("carried");
}

// ---- the rule of the paper

// What touches at the start of a step does not approach, to the solver's tolerance of 1e-7 of speeds of some 1 m/s.
static void the_rule_touching_keeps_what_touches_from_approaching(void** state) {
	(void)state;
	Run run;
	run_open(
		&run, 1,
		"duration: 1 s\nintegrator: backward_euler\nstep: {dt: 5 ms}\n"
		"bodies:\n"
		"  - {name: box, shape: {type: box, origin: [0, 0.0205, 0], size: [0.2, 0.2, 0.2], cells: [2, 2, 2]}, %s}\n"
		"obstacles: [{name: floor, shape: plane}]\ncontact: {rule: touching, margin: 1 mm}\n",
		material);
	double slowest = 0, deepest = 0;
	for (int i = 0; i < 100; ++i) {
		double low[9], v[3 * 27];
		int watched = 0;
		memset(low, 0, sizeof low);
		const double* x = run_state(&run)->x;
		bool touches[27];
		for (int n = 0; n < 27; ++n) touches[n] = x[3 * n + 1] <= 1e-3, watched += touches[n];
		run_step(&run);
		memcpy(v, run_state(&run)->v, sizeof v);
		for (int n = 0; n < 27; ++n)
			if (touches[n]) slowest = fmin(slowest, v[3 * n + 1]);
		deepest = fmin(deepest, body_low(&run, 0, run_state(&run)->x, 1));
		if (i == 99) assert_true(watched >= 9);
	}
	print_message("it fell into the floor by %g m\n", -deepest);
	assert_true(deepest < -1e-3); // from 1.4 mm above, at 0.6 m/s over 5 ms: as the paper allows
	expect_at_most(-slowest, 1e-6, "speed of approach of what touches [m/s]");
	expect_at_most(-body_low(&run, 0, run_state(&run)->x, 1), 1e-4 * 0.2, "overlap at the end [m]"); // pushed out
	run_close(&run);
}

// ---- what overlaps

static void what_overlaps_parts_no_faster_than_push_out(void** state) {
	(void)state;
	static const char* const predictions[] = {"carried", "iterated", "free"};
	for (int p = 0; p < 3; ++p) {
		Run run;
		run_open(
			&run, 1,
			"duration: 1 s\nintegrator: backward_euler\nstep: {dt: 5 ms}\n"
			"bodies:\n"
			"  - {name: low, shape: {type: box, origin: [0, -0.005, 0], size: [0.2, 0.2, 0.2], cells: [2, 2, 2]}, %s,\n"
			"     damping: {beta: 5 ms}}\n"
			"  - {name: high, shape: {type: box, origin: [0.02, 0.19, 0.03], size: [0.1, 0.1, 0.1],\n"
			"     cells: [2, 2, 2]}, %s, damping: {beta: 5 ms}}\n"
			"obstacles: [{name: floor, shape: plane}]\ncontact: {push_out: 10 cm/s, prediction: %s}\n",
			material, material, predictions[p]);
		double fastest = 0;
		for (int i = 0; i < 100; ++i) {
			const double before = body_low(&run, 0, run_state(&run)->x, 1);
			run_step(&run);
			if (!(run_column(&run, "qp_residual") <= 1e-6)) fail_msg("residual %g", run_column(&run, "qp_residual"));
			const double after = body_low(&run, 0, run_state(&run)->x, 1);
			if (before < -1e-6) fastest = fmax(fastest, (after - before) / 5e-3);
			// The lowest vertex is pushed by exactly that, and the others of the face by no more.
		}
		expect_at_most(fastest, 0.1 * (1 + 1e-5), "%s: speed out of the floor [m/s]", predictions[p]);
		expect_at_most(0.09, fastest, "%s: and it is used", predictions[p]);
		expect_at_most(run_column(&run, "penetration"), 1e-4 * 0.1, "%s: overlap at the end [m]", predictions[p]);
		expect_at_most(-clearance(&run, 0, 0), 1e-4 * 0.1, "%s: overlap with the floor [m]", predictions[p]);
		expect_at_most(body_high(&run, 0, run_state(&run)->x, 1) - body_low(&run, 1, run_state(&run)->x, 1), 5e-3,
					   "%s: sag of the boxes into each other's height [m]", predictions[p]);
		run_close(&run);
	}
}

// ---- rest

static void a_box_comes_to_rest_and_the_floor_carries_its_weight(void** state) {
	(void)state;
	// The corrector of `free` must know the damping that acts in the prediction; it takes 1 % of the weight else.
	static const struct {
		const char *method, *prediction, *damping;
	} ways[] = {{"sdirk2", "carried", "no"},
				{"sdirk2", "iterated", "no"},
				{"backward_euler", "carried", "no"},
				{"backward_euler", "free", "yes"}};
	for (size_t i = 0; i < sizeof ways / sizeof *ways; ++i) {
		Run run;
		run_open(
			&run, 1,
			"duration: 10 s\nintegrator: {method: %s}\nnewton: {tolerance: 1e-11}\nstep: {dt: 5 ms}\n"
			"bodies:\n"
			"  - {name: box, shape: {type: box, origin: [0, 0.01, 0], size: [0.2, 0.2, 0.2], cells: [2, 2, 2]}, %s,\n"
			"     damping: {alpha: 2 1/s, beta: 5 ms}}\n"
			"obstacles: [{name: floor, shape: plane}]\n"
			"contact: {friction: 0.5, prediction: %s, damping: %s, solver: {method: auto, tolerance: 1e-9}}\n",
			ways[i].method, material, ways[i].prediction, ways[i].damping);
		while (run_state(&run)->t < 3) step_soundly(&run, 0.2, 1e-4);
		const double* f = run_field(&run, "contact_force");
		double sum[3] = {0};
		for (int k = 0; k < run.length; ++k) sum[k % 3] += f[k];
		const double weight = jn_model_mass(run.model) * 9.81;
		print_message("%s, %s:\n", ways[i].method, ways[i].prediction);
		expect_at_most(body_largest(&run, 0, run_state(&run)->v), 1e-6, "  largest velocity [m/s]");
		expect_near(sum[1], weight, 1e-6 * weight, "  force of the floor [N]");
		expect_near(hypot(sum[0], sum[2]), 0, 1e-6 * weight, "  force along the floor [N]");
		expect_at_most(-clearance(&run, 0, 0), 1e-4 * 0.2, "  overlap [m]");
		const double* gap = run_field(&run, "gap");
		for (int n = 0; n < run.length / 3; ++n)
			if (run_state(&run)->x[3 * n + 1] < 0.05 && !(fabs(gap[n]) < 1e-8))
				fail_msg("node %d: gap of %g m", n, gap[n]);
		run_close(&run);
	}
}

// ---- a body with itself

// A C of cells of 5 cm, 1 deep: its lower arm is held, and its upper one hangs over 10 cm of air. 8 along, 4 up. The lower
// arm is wider by 2 cm on both sides: edges right above edges may slip past each other.
static void write_c(void) {
	char text[8192];
	int number[9][5][2], nodes = 0, cells = 0, length;
	for (int k = 0; k < 2; ++k)
		for (int j = 0; j < 5; ++j)
			for (int i = 0; i < 9; ++i) number[i][j][k] = j < 2 || j > 2 || i < 2 ? nodes++ : -1;
	for (int j = 0; j < 4; ++j)
		for (int i = 0; i < 8; ++i) cells += j == 0 || j == 3 || i == 0;
	length = snprintf(text, sizeof text,
					  "# vtk DataFile Version 3.0\nc\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS %d double\n", nodes);
	for (int k = 0; k < 2; ++k)
		for (int j = 0; j < 5; ++j)
			for (int i = 0; i < 9; ++i)
				if (number[i][j][k] >= 0)
					length += snprintf(text + length, sizeof text - (size_t)length, "%g %g %g\n", 0.05 * i, 0.05 * j,
									   j < 2 ? 0.09 * k - 0.02 : 0.05 * k);
	length += snprintf(text + length, sizeof text - (size_t)length, "CELLS %d %d\n", cells, 9 * cells);
	for (int j = 0; j < 4; ++j)
		for (int i = 0; i < 8; ++i) {
			if (j != 0 && j != 3 && i != 0) continue;
			length += snprintf(text + length, sizeof text - (size_t)length, "8 %d %d %d %d %d %d %d %d\n",
							   number[i][j][0], number[i + 1][j][0], number[i + 1][j + 1][0], number[i][j + 1][0],
							   number[i][j][1], number[i + 1][j][1], number[i + 1][j + 1][1], number[i][j + 1][1]);
		}
	length += snprintf(text + length, sizeof text - (size_t)length, "CELL_TYPES %d\n", cells);
	for (int i = 0; i < cells; ++i) length += snprintf(text + length, sizeof text - (size_t)length, "12\n");
	file_write(path_join(case_folder, "c.vtk"), text);
}

// How far the underside of the upper arm is above where the lower one was, when it has come to rest: the mean of two nodes
// behind its tip, which may hang over.
static double hang(bool self) {
	Run run;
	write_c();
	run_open(
		&run, 1,
		"duration: 2 s\nintegrator: sdirk2\nstep: {dt: 10 ms}\n"
		"bodies:\n"
		"  - {name: c, shape: {type: file, path: c.vtk}, damping: {alpha: 2 1/s, beta: 5 ms}, contact: {self: %s},\n"
		"     material: {law: stable_neo_hookean, density: 1000, young: 5e4, poisson: 0.3}, fix: [{where: {face: "
		"y-}}]}\n"
		"contact: {friction: 0.3}\n",
		self ? "yes" : "no");
	while (run_state(&run)->t < 1.5) step_soundly(&run, 0.4, 1e-5);
	double height = 0;
	for (int n = 0; n < run.length / 3; ++n) {
		const double* rest = jn_model_rest(run.model) + 3 * n;
		if (fabs(rest[0] - 0.3) < 1e-6 && fabs(rest[1] - 0.15) < 1e-6)
			height += 0.5 * (run_state(&run)->x[3 * n + 1] - 0.05);
	}
	run_close(&run);
	return height;
}

static void a_body_touches_itself_where_it_says_so(void** state) {
	(void)state;
	expect_at_most(hang(false), -0.02, "height of the arm where it touches nothing [m]");
	// The lower arm yields to the weight of the upper one: 500 Pa and more at its end, of 50 kPa, over 5 cm.
	expect_at_most(-hang(true), 0.003, "depth of the arm below where the other was [m]");
}

// ---- what is moved or held

static void a_ball_is_squeezed_between_driven_plates(void** state) {
	(void)state;
	Run run;
	run_open(&run, 1,
			 "duration: 2 s\nintegrator: sdirk2\nstep: {dt: 10 ms}\n"
			 "bodies:\n"
			 "  - {name: ball, shape: {type: ball, center: [0, 0, 0], radius: 20 cm, cells: 3, rings: 2}, damping: "
			 "{beta: 5 ms},\n"
			 "     material: {law: stable_neo_hookean, density: 1000, young: 1e5, poisson: 0.4}}\n"
			 "  - {name: lower, shape: {type: box, origin: [-0.4, -0.25, -0.4], size: [0.8, 0.05, 0.8], cells: [4, 1, "
			 "4]}, %s,\n"
			 "     fix: [{where: {face: all}}]}\n"
			 "  - {name: upper, shape: {type: box, origin: [-0.4, 0.2, -0.4], size: [0.8, 0.05, 0.8], cells: [4, 1, "
			 "4]}, %s,\n"
			 "     drive: [{where: {face: all}, y: {type: keyframes, points: [[0.0, 0.0], [0.8, -0.2], [1, -0.2]]}}]}\n"
			 "contact: {friction: 0.4}\n",
			 material, material);
	while (run_state(&run)->t < 1) {
		step_soundly(&run, 0.4, 1e-5);
		const double top = body_low(&run, 2, run_state(&run)->x, 1);
		if (body_high(&run, 0, run_state(&run)->x, 1) > top + 1e-5 ||
			body_low(&run, 0, run_state(&run)->x, 1) < -0.2 - 1e-5)
			fail_msg("the ball is in a plate at t = %g s", run_state(&run)->t);
	}
	expect_near(body_low(&run, 2, run_state(&run)->x, 1), 0, 1e-9, "the upper plate [m]");
	const double* f = run_field(&run, "contact_force");
	double on[3] = {0};
	for (int b = 0; b < 3; ++b)
		for (int k = 1; k < body_length(&run, b); k += 3) on[b] += f[body_first(&run, b) + k];
	print_message("forces on ball, lower, upper: %g %g %g N\n", on[0], on[1], on[2]);
	expect_near(on[0] + on[1] + on[2], 0, 1e-6 * on[2], "sum of contact forces [N]"); // equal and opposite, rounding
	assert_true(on[2] > 500 && on[1] < -500);
	run_close(&run);
}

static void a_held_body_carries_another(void** state) {
	(void)state;
	Run run;
	run_open(
		&run, 1,
		"duration: 10 s\nintegrator: sdirk2\nstep: {dt: 5 ms}\n"
		"bodies:\n"
		"  - {name: table, shape: {type: box, size: [0.4, 0.1, 0.4], cells: [3, 1, 3]}, %s, fix: [{where: {face: "
		"all}}]}\n"
		"  - {name: box, shape: {type: box, origin: [0.11, 0.11, 0.12], size: [0.2, 0.2, 0.2], cells: [2, 2, 2]}, %s,\n"
		"     damping: {alpha: 2 1/s, beta: 5 ms}}\n"
		"contact: {friction: 0.5}\n",
		material, material);
	const size_t bytes = (size_t)body_length(&run, 0) * sizeof(double);
	while (run_state(&run)->t < 2) step_soundly(&run, 0.2, 1e-4);
	assert_memory_equal(run_state(&run)->x, jn_model_rest(run.model), bytes);
	expect_at_most(body_largest(&run, 1, run_state(&run)->v), 1e-5, "largest velocity [m/s]");
	expect_near(body_low(&run, 1, run_state(&run)->x, 1), 0.1, 1e-4 * 0.2, "underside [m]");
	run_close(&run);
}

// ---- obstacles

static const struct {
	const char *name, *shape, *at; // and where the ball starts
	double tolerance;              // [m]
} obstacles[] = {
	// A tangent plane stands for a curved surface within a step: what slides by s is then s^2 / 2R too deep in a bowl;
	// 2 m/s over 2 ms and R = 0.3 m.
	{"plane", "plane", "[0, 0.12, 0]", 1e-9},
	{"sphere", "{type: sphere, center: [0, -0.3, 0], radius: 0.3}", "[0.02, 0.12, 0.01]", 1e-9},
	{"bowl", "{type: sphere, center: [0, 0.2, 0], radius: 0.3, inside: yes}", "[0.1, 0.1, 0]", 3e-5},
	{"box", "{type: box, center: [0, -0.1, 0], size: [0.15, 0.2, 0.15], rotate: [10 deg, 20 deg, 0]}",
	 "[0.02, 0.13, 0.01]", 1e-4},
	{"capsule", "{type: capsule, from: [-1, -0.1, 0], to: [1, -0.1, 0], radius: 0.1}", "[0, 0.12, 0.01]", 1e-9},
	{"mesh", "{type: mesh, path: rock.off}", "[0.02, 0.16, 0.01]", 1e-4},
};

static const char rock_off[] = "OFF\n6 8 0\n0.3 0 0\n-0.3 0 0\n0 0.05 0\n0 -0.3 0\n0 0 0.3\n0 0 -0.3\n"
							   "3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n";

static void a_ball_stays_outside_of_every_kind_of_obstacle(void** state) {
	(void)state;
	file_write(path_join(case_folder, "rock.off"), rock_off);
	for (size_t i = 0; i < sizeof obstacles / sizeof *obstacles; ++i) {
		Run run;
		double least = INFINITY, pressed = 0;
		run_open(&run, 1,
				 "duration: 10 s\nintegrator: sdirk2\nstep: {dt: 2 ms}\n"
				 "bodies:\n"
				 "  - {name: ball, shape: {type: ball, center: %s, radius: 0.1, cells: 2, rings: 2}, %s, velocity: "
				 "[0.2, -1, 0]}\n"
				 "obstacles: [{name: it, shape: %s}]\ncontact: {friction: 0.3}\n",
				 obstacles[i].at, material, obstacles[i].shape);
		while (run_state(&run)->t < 0.4) {
			run_step(&run);
			if (!(run_column(&run, "qp_residual") <= 1e-6)) fail_msg("%s: residual", obstacles[i].name);
			least = fmin(least, clearance(&run, 0, 0));
			pressed += run_column(&run, "contacts_pressing") > 0;
		}
		print_message("%s: %g steps in contact\n", obstacles[i].name, pressed);
		expect_at_most(-least, obstacles[i].tolerance, "%s: overlap [m]", obstacles[i].name);
		assert_true(pressed > 10);
		run_close(&run);
	}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_fast_ball_does_not_pass_a_thin_box),
		cmocka_unit_test(a_fast_ball_does_not_pass_a_thin_box_with_iterated_forces),
		cmocka_unit_test(a_fast_ball_does_not_pass_a_thin_box_with_carried_forces),
		cmocka_unit_test(a_fast_ball_does_not_pass_a_sheet),
		cmocka_unit_test(a_fast_ball_does_not_pass_a_sheet_with_iterated_forces),
		cmocka_unit_test(a_fast_ball_does_not_pass_a_sheet_with_carried_forces),
		cmocka_unit_test(the_rule_touching_keeps_what_touches_from_approaching),
		cmocka_unit_test(what_overlaps_parts_no_faster_than_push_out),
		cmocka_unit_test(a_box_comes_to_rest_and_the_floor_carries_its_weight),
		cmocka_unit_test(a_body_touches_itself_where_it_says_so),
		cmocka_unit_test(a_ball_is_squeezed_between_driven_plates),
		cmocka_unit_test(a_held_body_carries_another),
		cmocka_unit_test(a_ball_stays_outside_of_every_kind_of_obstacle),
	};
	return cmocka_run_group_tests(tests, case_set_up, case_tear_down);
}
