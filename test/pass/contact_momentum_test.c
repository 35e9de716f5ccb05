/// @file contact_momentum_test.c
/// Collisions in free flight: what contact must keep, and how motion follows the symmetries of a scene.
#include "pass/pass_case.h"

static const char material[] = "material: {law: stable_neo_hookean, density: 1000, young: 1e5, poisson: 0.3}";

// An octahedron without any symmetry: surface of what voxels carry.
static const char rock_off[] = "OFF\n6 8 0\n0.11 0.01 0\n-0.1 0 0.01\n0 0.12 0\n0.01 -0.1 0\n0 0 0.1\n0 0.01 -0.09\n"
							   "3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n";

static const struct {
	const char *name, *first, *second;
} pairs[] = {
	{"hexahedra", "{type: ball, center: [-0.15, 0.03, 0.02], radius: 0.1, cells: 2, rings: 2}",
	 "{type: box, origin: [0, -0.1, -0.1], size: [0.2, 0.2, 0.2], cells: [2, 2, 2]}"},
	{"tetrahedra", "{type: ball, center: [-0.15, 0.03, 0.02], radius: 0.1, cells: 2, rings: 2, element: tet4}",
	 "{type: box, origin: [0, -0.1, -0.1], size: [0.2, 0.2, 0.2], cells: [2, 2, 2], element: tet4}"},
	{"voxels", "{type: file, path: rock.off, translate: [-0.15, 0.02, 0.01], voxels: {size: 0.1}}",
	 "{type: box, origin: [0, -0.1, -0.1], size: [0.2, 0.2, 0.2], cells: [2, 2, 2]}"},
};
enum { PAIRS = sizeof pairs / sizeof *pairs };

static void open_pair(Run* run, int pair, const char* method, const char* prediction, double friction, double dt) {
	file_write(path_join(case_folder, "rock.off"), rock_off);
	run_open(run, 1,
			 "duration: 2 s\ngravity: [0, 0, 0]\nintegrator: {method: %s}\n"
			 "newton: {tolerance: 1e-12}\nstep: {dt: %.17g s}\n"
			 "bodies:\n"
			 "  - {name: a, shape: %s, %s, velocity: [1, 0.1, 0]}\n"
			 "  - {name: b, shape: %s, %s, velocity: [-0.5, 0, 0]}\n"
			 "contact: {friction: %g, prediction: %s, solver: {method: auto, tolerance: 1e-9}}\n",
			 method, dt, pairs[pair].first, material, pairs[pair].second, material, friction, prediction);
}

// Change of a momentum over the collision, and whether there was one.
typedef struct Change {
	double linear;  // largest over the steps, relative to the momentum of one body
	double angular; // at the end, relative to that momentum times the size
	double turned;  // change of the second body's own velocity [m/s]
} Change;

static Change collide(int pair, const char* method, const char* prediction, double friction, double dt) {
	Run run;
	open_pair(&run, pair, method, prediction, friction, dt);
	const JnEnergies before = run_energies(&run);
	const double unit = 8.0 * 0.5; // of the box: 8 kg at 0.5 m/s
	Change change = {0};
	while (run_state(&run)->t < 0.2) {
		run_step(&run);
		const JnEnergies now = run_energies(&run);
		for (int a = 0; a < 3; ++a)
			change.linear = fmax(change.linear, fabs(now.momentum[a] - before.momentum[a]) / unit);
	}
	const JnEnergies after = run_energies(&run);
	for (int a = 0; a < 3; ++a)
		change.angular = fmax(change.angular, fabs(after.angular[a] - before.angular[a]) / (unit * 0.2));
	change.turned = body_mean(&run, 1, run_state(&run)->v, 0) + 0.5;
	assert_true(run_column(&run, "contacts_pressing") == 0); // they have parted
	run_close(&run);
	return change;
}

// Impulses act on both bodies alike, weights of a triangle sum to one, and C and M agree on rigid translations. 1e-10 is
// the tolerance of the integrator's own equations, 1e-12 of some N, over a hundred steps.
static void collisions_conserve_linear_momentum(void** state) {
	(void)state;
	static const char* const predictions[] = {"carried", "iterated", "free"};
	for (int pair = 0; pair < PAIRS; ++pair)
		for (int p = 0; p < 3; ++p)
			for (int rough = 0; rough < 2; ++rough) {
				const Change c = collide(pair, "sdirk2", predictions[p], 0.4 * rough, 2e-3);
				expect_at_most(c.linear, 1e-10, "%s, %s, mu %.1f: relative change of momentum", pairs[pair].name,
							   predictions[p], 0.4 * rough);
				assert_true(c.turned > 0.1); // the box was hit
			}
}

// Impulses act along the line between the points that touch, up to the gap between them, which is of the order of dt; and
// C turns with the body only to the order of dt.
static void angular_momentum_changes_less_with_smaller_steps(void** state) {
	(void)state;
	for (int pair = 0; pair < PAIRS; ++pair) {
		const double coarse = collide(pair, "sdirk2", "carried", 0, 4e-3).angular;
		const double middle = collide(pair, "sdirk2", "carried", 0, 2e-3).angular;
		const double fine = collide(pair, "sdirk2", "carried", 0, 0.5e-3).angular;
		print_message("%s: relative change %g, %g, %g\n", pairs[pair].name, coarse, middle, fine);
		expect_at_most(fine, 0.01, "%s: relative change", pairs[pair].name);
		expect_at_most(fine, coarse / 4, "%s: an eighth of the step", pairs[pair].name);
	}
}

// ---- symmetries

// Surfaces of triangles, filled with tetrahedra about a point inside: meshes that can be mirrored exactly.
typedef struct Star {
	int points, triangles;
	double point[9][3]; // the last is the one inside
	int triangle[12][3];
} Star;

static const Star rock = {
	7,
	8,
	{{0.11, 0.01, 0}, {-0.1, 0, 0.01}, {0, 0.12, 0}, {0.01, -0.1, 0}, {0, 0, 0.1}, {0, 0.01, -0.09}, {0}},
	{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};

// A mesh file of a star, moved along x and then mirrored in x where `side` is -1.
static void write_star(const char* name, const Star* star, double shift, int side) {
	char text[4096];
	int length = snprintf(text, sizeof text,
						  "# vtk DataFile Version 3.0\nstar\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS %d double\n",
						  star->points);
	for (int i = 0; i < star->points; ++i)
		length += snprintf(text + length, sizeof text - (size_t)length, "%.17g %.17g %.17g\n",
						   side * (star->point[i][0] + shift), star->point[i][1], star->point[i][2]);
	length +=
		snprintf(text + length, sizeof text - (size_t)length, "CELLS %d %d\n", star->triangles, 5 * star->triangles);
	for (int i = 0; i < star->triangles; ++i) {
		const int* t = star->triangle[i];
		length += snprintf(text + length, sizeof text - (size_t)length, "4 %d %d %d %d\n", t[0], t[side > 0 ? 2 : 1],
						   t[side > 0 ? 1 : 2], star->points - 1);
	}
	length += snprintf(text + length, sizeof text - (size_t)length, "CELL_TYPES %d\n", star->triangles);
	for (int i = 0; i < star->triangles; ++i) length += snprintf(text + length, sizeof text - (size_t)length, "10\n");
	file_write(path_join(case_folder, name), text);
}

/// Two rocks that meet; exchanged in the list, or mirrored.
static void open_rocks(Run* run, bool exchanged, int side, double friction) {
	char bodies[2][512];
	write_star("left.vtk", &rock, -0.12, side);
	write_star("right.vtk", &rock, 0.12, side);
	snprintf(bodies[0], sizeof bodies[0],
			 "  - {name: left, shape: {type: file, path: left.vtk}, %s, velocity: [%d, 0.1, 0]}\n", material, side);
	snprintf(bodies[1], sizeof bodies[1],
			 "  - {name: right, shape: {type: file, path: right.vtk, translate: [0, 0.02, 0.01]}, %s, velocity: [%g, "
			 "0, 0]}\n",
			 material, -0.5 * side);
	run_open(run, 1,
			 "duration: 2 s\ngravity: [0, 0, 0]\nintegrator: {method: sdirk2}\nnewton: {tolerance: 1e-12}\n"
			 "step: {dt: 2 ms}\nbodies:\n%s%scontact: {friction: %g, solver: {method: auto, tolerance: 1e-12}}\n",
			 bodies[exchanged], bodies[!exchanged], friction);
}

static void expect_same_motion(bool exchanged, int side, double friction, double tolerance) {
	Run plain, other;
	double most = 0, pressed = 0;
	open_rocks(&plain, false, 1, friction);
	open_rocks(&other, exchanged, side, friction);
	while (run_state(&plain)->t < 0.15) {
		run_step(&plain);
		run_step(&other);
		pressed += run_column(&plain, "contacts_pressing") > 0;
		for (int b = 0; b < 2; ++b)
			for (int k = 0; k < body_length(&plain, b); ++k) {
				const double sign = k % 3 == 0 ? side : 1;
				most = fmax(most, fabs(run_state(&plain)->x[body_first(&plain, b) + k] -
									   sign * run_state(&other)->x[body_first(&other, exchanged ? 1 - b : b) + k]));
			}
	}
	print_message("%g steps in contact\n", pressed);
	assert_true(pressed >= 5);
	expect_at_most(most, tolerance, "difference of positions [m]");
	run_close(&plain);
	run_close(&other);
}

// Sums run in another order; a collision amplifies their rounding, and what the solver leaves, by less than 1e4.
static void exchanging_two_bodies_in_the_scene_changes_nothing(void** state) {
	(void)state;
	expect_same_motion(true, 1, 0, 1e-9);
	expect_same_motion(true, 1, 0.4, 1e-9);
}

static void a_mirrored_collision_is_mirrored(void** state) {
	(void)state;
	expect_same_motion(false, -1, 0, 1e-9);
	expect_same_motion(false, -1, 0.4, 1e-9);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(collisions_conserve_linear_momentum),
		cmocka_unit_test(angular_momentum_changes_less_with_smaller_steps),
		cmocka_unit_test(exchanging_two_bodies_in_the_scene_changes_nothing),
		cmocka_unit_test(a_mirrored_collision_is_mirrored),
	};
	return cmocka_run_group_tests(tests, case_set_up, case_tear_down);
}
