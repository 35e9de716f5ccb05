// Ropes: the curve through their points, frames that do not twist, ends.
#include "mesh/shape/curve.h"
#include "mesh/shape_case.h"

static double dot(const double a[3], const double b[3]) {
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double distance(const double a[3], const double b[3]) {
	return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

static void a_straight_rope_is_a_prism_between_its_ends(void** state) {
	(void)state;
	ShapeCase c;
	shape_make(&c, "{type: rope, points: [{at: [1, 2, 3]}, {at: [3, 3, 5]}], radius: 0.1, cells: [12, 2, 10]}");
	const double direction[3] = {2.0 / 3, 1.0 / 3, 2.0 / 3}, from[3] = {1, 2, 3};
	const double volume = 3 * 12 / 2.0 * 0.01 * sin(3.14159265358979323846 / 6); // length 3 on a polygon of 12 corners
	assert_true(fabs(mesh_volume(&c.mesh) - volume) < 1e-12 * volume);
	for (int end = 0; end < 2; ++end) {
		const JnNodeSet* set = mesh_set(&c.mesh, end == 0 ? "start" : "end");
		for (int i = 0; i < c.mesh.node_count; ++i) {
			const double* X = c.mesh.nodes + 3 * i;
			const double along = dot((double[3]){X[0] - from[0], X[1] - from[1], X[2] - from[2]}, direction);
			assert_true((fabs(along - 3 * end) < 1e-12) == set_has(set, i)); // rounding near 5
		}
	}
	shape_free(&c);
}

enum { POINTS = 25, STATIONS = 97 };

static void helix(double turns, double rise, double points[3 * POINTS]) {
	for (int i = 0; i < POINTS; ++i) {
		const double angle = 2 * 3.14159265358979323846 * turns * i / (POINTS - 1);
		points[3 * i] = cos(angle);
		points[3 * i + 1] = sin(angle);
		points[3 * i + 2] = rise * angle;
	}
}

static void stations_stand_at_equal_distances_on_the_curve(void** state) {
	(void)state;
	JnArena scratch = {0};
	double points[3 * POINTS];
	JnStation s[STATIONS];
	helix(1, 0.3, points);
	assert_int_equal(jn_curve_stations(POINTS, points, STATIONS, s, &scratch), JN_OK);
	const double length = 2 * 3.14159265358979323846 * hypot(1, 0.3);
	for (int i = 1; i < STATIONS; ++i) {
		const double step = distance(s[i].X, s[i - 1].X);
		assert_true(fabs(step - length / (STATIONS - 1)) <
					0.01 * step); // the spline bends unevenly by (2 pi / 24)^2 / 6
	}
	for (int i = 0; i < POINTS; ++i) {
		double nearest = INFINITY;
		for (int k = 0; k < STATIONS; ++k) nearest = fmin(nearest, distance(points + 3 * i, s[k].X));
		assert_true(nearest < 0.5 * length / (STATIONS - 1)); // the curve goes through each point, between two stations
	}
	assert_true(distance(points, s[0].X) < 1e-15);
	assert_true(distance(points + 3 * (POINTS - 1), s[STATIONS - 1].X) < 1e-14);
	jn_arena_free(&scratch);
}

static void frames_are_right_handed_and_orthonormal(void** state) {
	(void)state;
	JnArena scratch = {0};
	double points[3 * POINTS];
	JnStation s[STATIONS];
	helix(3, 0.2, points);
	assert_int_equal(jn_curve_stations(POINTS, points, STATIONS, s, &scratch), JN_OK);
	for (int i = 0; i < STATIONS; ++i) {
		const double *a = s[i].across[0], *b = s[i].across[1], *t = s[i].along;
		const double cross[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
		assert_true(fabs(dot(a, a) - 1) < 1e-13 && fabs(dot(a, t)) < 1e-13); // a hundred reflections round a little
		assert_true(distance(cross, t) < 1e-13);
	}
	jn_arena_free(&scratch);
}

// The normal of a plane curve's plane keeps its place in a frame that does not twist. A frame that turned once in all
// would be 2 pi away.
static void frames_do_not_twist_along_a_plane_curve(void** state) {
	(void)state;
	JnArena scratch = {0};
	double points[3 * POINTS];
	JnStation s[STATIONS];
	helix(0.9, 0, points);
	assert_int_equal(jn_curve_stations(POINTS, points, STATIONS, s, &scratch), JN_OK);
	for (int i = 0; i < STATIONS; ++i)
		for (int k = 0; k < 2; ++k) assert_true(fabs(s[i].across[k][2] - s[0].across[k][2]) < 1e-13);
	jn_arena_free(&scratch);
}

static void numbers_that_make_no_rope_are_refused(void** state) {
	(void)state;
	shape_expect_refusal("{type: rope, radius: 0.1, points: [{at: [0, 0, 0]}]}", "two or more");
	shape_expect_refusal("{type: rope, radius: 0.1, points: [{at: [0, 0, 0]}, {at: [0, 0, 0]}]}", "points[1]");
	shape_expect_refusal("{type: rope, radius: 0.5, points: [{at: [0, 0, 0]}, {at: [1, 0, 0]}, {at: [1, 1, 0]}]}",
						 "too sharply");
	shape_expect_refusal("{type: rope, radius: 0.1, cells: [6, 1, 4], points: [{at: [0, 0, 0]}, {at: [1, 0, 0]}]}",
						 "use 4 or 8");
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_straight_rope_is_a_prism_between_its_ends),
		cmocka_unit_test(stations_stand_at_equal_distances_on_the_curve),
		cmocka_unit_test(frames_are_right_handed_and_orthonormal),
		cmocka_unit_test(frames_do_not_twist_along_a_plane_curve),
		cmocka_unit_test(numbers_that_make_no_rope_are_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
