/// @file contact_graze_test.c
/// What grazes by no more than rounding does not fail a step: neither a corner beside a face of its own height, nor an
/// impulse that is as small as the rounding of the velocities.
#include "detect/obstacle.h"
#include "pass/pass_case.h"

static const char material[] = "material: {law: stable_neo_hookean, density: 1000, young: 1e5, poisson: 0.3}";

// Two boxes of the same height, 1 mm beside each other. Their corners are in line with the top faces of each other, 1 mm
// away: there is no contact along y.
static void boxes_of_one_height_do_not_hold_each_other_by_their_edges(void** state) {
	(void)state;
	Run run;
	run_open(&run, 1,
			 "duration: 1 s\ngravity: [0, 0, 0]\nintegrator: {method: backward_euler}\nstep: {dt: 1 ms, cuts: 0}\n"
			 "bodies:\n"
			 "  - {name: a, shape: {type: box, size: [0.2, 0.2, 0.2], cells: [2, 2, 2]}, %s, spin: [0.2, 0, 0]}\n"
			 "  - {name: b, shape: {type: box, origin: [0.201, 0, 0], size: [0.2, 0.2, 0.2], cells: [2, 2, 2]}, %s,\n"
			 "     velocity: [0.1, 0, 0], spin: [0.2, 0, 0]}\n"
			 "contact: {}\n",
			 material, material);
	for (int i = 0; i < 10; ++i) {
		run_step(&run);
		// All contacts are from one box to the other, along x, and they grow.
		expect_at_most(fabs(run_column(&run, "penetration")), 0, "penetration in step %d", i + 1);
		assert_true(run_column(&run, "contacts_pressing") == 0);
		const double* gap = run_field(&run, "gap");
		for (int node = 0; node < run.length / 3; ++node)
			if (gap[node] < 1e-3) fail_msg("node %d has a gap of %g m", node, gap[node]);
	}
	run_close(&run);
}

// A box that lies on the floor without weight and is lifted by 1e-13 m/s, or pressed: neither matters, and the step ends.
static void impulses_of_rounding_size_do_not_fail_a_step(void** state) {
	(void)state;
	const double speeds[] = {-1e-9, -1e-11, -1e-12, -1e-13, -1e-14, -1e-15, -1e-16, 1e-13};
	for (size_t i = 0; i < sizeof speeds / sizeof *speeds; ++i) {
		Run run;
		run_open(
			&run, 1,
			"duration: 1 s\ngravity: [0, 0, 0]\nintegrator: {method: backward_euler}\nstep: {dt: 1 ms, cuts: 0}\n"
			"bodies:\n"
			"  - {name: a, shape: {type: box, size: [0.2, 0.2, 0.2], cells: [2, 2, 2]}, %s, velocity: [1, %g, 0]}\n"
			"obstacles: [{name: floor, shape: plane}]\n"
			"contact: {}\n",
			material, speeds[i]);
		print_message("pressed at %g m/s\n", -speeds[i]);
		run_steps(&run, 5);
		run_close(&run);
	}
}

// Two boxes of one height that collide off their middles: corners meet edges, along them and across. Some 10 iterations are
// usual.
static void expect_solved(const char* method, const char* mass, const char* contact) {
	Run run;
	run_open(
		&run, 1,
		"duration: 1 s\ngravity: [0, -9.81, 0]\nintegrator: {method: %s}\nstep: {dt: 1 ms, cuts: 0}\n"
		"bodies:\n"
		"  - {name: a, shape: {type: box, origin: [0, 1, 0], size: [0.2, 0.2, 0.2], cells: [2, 2, 2]}, %s,\n"
		"     mass: %s, velocity: [1, 0, 0]}\n"
		"  - {name: b, shape: {type: box, origin: [0.201, 1, 0.05], size: [0.2, 0.2, 0.2], cells: [2, 2, 2]}, %s,\n"
		"     mass: %s, velocity: [-1, 0, 0]}\n"
		"contact: {%s}\n",
		method, material, mass, material, mass, contact);
	double most = 0;
	for (int i = 0; i < 20; ++i) {
		run_step(&run);
		most = fmax(most, run_column(&run, "qp_iterations"));
	}
	expect_at_most(most, 1000, "%s, %s: iterations in a step", method, contact);
	run_close(&run);
}

static void frictional_impact_of_two_boxes_is_solved(void** state) {
	(void)state;
	expect_solved("verlet", "lumped", "prediction: iterated, friction: 0.5");
	expect_solved("sdirk2", "consistent", "friction: 0.5");
}

// After some rounds, corners are a little inside of each other's edges, where rows must not contradict each other.
static void impact_of_two_boxes_of_one_height_is_solved(void** state) {
	(void)state;
	expect_solved("ros34pw3", "consistent", "prediction: iterated");
}

// Points on a face of a tetrahedron, and beside it by roundings: what rests there must not be pushed along the face, though
// the direction of an offset of 1e-17 m is that of its rounding.
static void a_point_on_a_mesh_obstacle_has_the_normal_of_its_face(void** state) {
	(void)state;
	Run run;
	file_write(path_join(case_folder, "corner.off"),
			   "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
	run_open(&run, 1,
			 "duration: 1 s\nintegrator: sdirk2\nbodies:\n"
			 "  - {name: a, shape: {type: box, origin: [0, 5, 0], size: [1, 1, 1], cells: [1, 1, 1]}, %s}\n"
			 "obstacles: [{name: it, shape: {type: mesh, path: corner.off}}]\ncontact: {}\n",
			 material);
	double worst = 1;
	for (int i = 1; i < 20; ++i)
		for (int k = 1; k < 20 - i; ++k) {
			const double point[3] = {0.05 * i, 0.05 * k, 1 - 0.05 * i - 0.05 * k}; // on x + y + z = 1, up to rounding
			double normal[3];
			jn_obstacle_distance(&run.model->obstacles[0].shape, point, normal);
			worst = fmin(worst, (normal[0] + normal[1] + normal[2]) / sqrt(3));
		}
	run_close(&run);
	expect_near(worst, 1, 1e-6, "cosine between the normal and that of the face, at worst");
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(boxes_of_one_height_do_not_hold_each_other_by_their_edges),
		cmocka_unit_test(impulses_of_rounding_size_do_not_fail_a_step),
		cmocka_unit_test(frictional_impact_of_two_boxes_is_solved),
		cmocka_unit_test(impact_of_two_boxes_of_one_height_is_solved),
		cmocka_unit_test(a_point_on_a_mesh_obstacle_has_the_normal_of_its_face),
	};
	return cmocka_run_group_tests(tests, case_set_up, case_tear_down);
}
