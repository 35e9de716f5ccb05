// Threads: frames along a curve, cells, sets, and what is refused.
#include "math/vec3.h"
#include "mesh/shape_case.h"
#include "mesh/thread.h"
#include "support/knot.h"

static void expect(double value, double expected, double tolerance, const char* what) {
	if (!(fabs(value - expected) <= tolerance))
		fail_msg("%s: %.17g, expected %.17g, tolerance %.3g", what, value, expected, tolerance);
}

static const char* const all[] = {
	"{type: thread, radius: 4 mm, links: 200, curve: {type: helix, radius: 5 cm, pitch: 3 cm, turns: 2}}",
	"{type: thread, radius: 4 mm, links: 200, twist: 2, curve: {type: torus_knot, ring: 10 cm, tube: 4 cm}}",
	"{type: thread, radius: 2 mm, links: 200, curve: {type: overhand, size: 8 cm, tail: 10 cm}}",
	"{type: thread, radius: 4 mm, links: 200, section: corner, curve: {type: circle, radius: 10 cm}}",
	"{type: thread, radius: 4 mm, links: 200, points: [{at: [0, 0, 0]}, {at: [0.1, 0, 0]}, {at: [0.1, 0.1, 0.1]}]}",
	"{type: thread, radius: 4 mm, links: 200, section: corner, curve: {type: circle, radius: 10 cm, angle: 90 deg}}",
};
enum { THREADS = sizeof all / sizeof *all };

static void axis_point(const JnMesh* mesh, int frame, double X[3]) {
	const double* nodes = mesh->nodes + 9 * (ptrdiff_t)frame;
	for (int a = 0; a < 3; ++a) {
		X[a] = 0;
		for (int i = 0; i < 3; ++i) X[a] += mesh->thread->axis[i] * nodes[3 * i + a];
	}
}

static void every_cell_is_positive(void** state) {
	(void)state;
	for (int i = 0; i < THREADS; ++i) {
		ShapeCase c;
		shape_make(&c, all[i]);
		assert_int_equal(c.mesh.cell_count, 3 * jn_thread_links(c.mesh.thread));
		assert_int_equal(c.mesh.node_count, 3 * c.mesh.thread->frame_count);
		const double mean = mesh_volume(&c.mesh) / c.mesh.cell_count;
		for (int cell = 0; cell < c.mesh.cell_count; ++cell)
			if (!(jn_mesh_cell_volume(&c.mesh, cell) > 0.3 * mean)) // three of one size in a straight link
				fail_msg("%s: cell %d has %g of the mean volume", all[i], cell,
						 jn_mesh_cell_volume(&c.mesh, cell) / mean);
		shape_free(&c);
	}
}

static void a_straight_thread_is_a_prism(void** state) {
	(void)state;
	ShapeCase c;
	shape_make(&c, "{type: thread, radius: 1 cm, links: 20, points: [{at: [1, 0, 0]}, {at: [1, 2, 0]}]}");
	const double side = 0.01 * sqrt(1.5); // three nodes at r / sqrt 2 about the axis
	expect(mesh_volume(&c.mesh), 2 * side * side * sqrt(3) / 4, 1e-15, "volume");
	expect(c.mesh.thread->link_length, 0.1, 1e-12, "link");
	shape_free(&c);
}

static void the_axis_runs_along_the_curve_in_equal_links(void** state) {
	(void)state;
	ShapeCase c;
	shape_make(&c, all[0]);
	const double chord = 2 * 0.05 * sin(3.14159265358979323846 * 2 / 200), rise = 0.06 / 200;
	for (int k = 0; k <= 200; ++k) {
		double X[3], next[3];
		axis_point(&c.mesh, k, X);
		expect(hypot(X[0], X[2]), 0.05, 1e-15, "distance from the axis");
		if (k == 200) break;
		axis_point(&c.mesh, k + 1, next);
		expect(vec3_distance(X, next), hypot(chord, rise), 1e-10, "link"); // error of the arc length
	}
	shape_free(&c);
}

static void threads_are_knotted_where_their_curves_are(void** state) {
	(void)state;
	static const int determinants[THREADS] = {1, 3, 3, 1, 1, 1};
	for (int i = 0; i < THREADS; ++i) {
		ShapeCase c;
		double points[3 * 201];
		shape_make(&c, all[i]);
		for (int k = 0; k < c.mesh.thread->frame_count; ++k) axis_point(&c.mesh, k, points + 3 * k);
		assert_int_equal(knot_determinant(c.mesh.thread->frame_count, points, c.mesh.thread->is_closed),
						 determinants[i]);
		shape_free(&c);
	}
}

static void expect_frames(const JnMesh* mesh, const char* name, int first, int last) {
	const JnNodeSet* set = mesh_set(mesh, name);
	assert_int_equal(set->count, 3 * (last - first + 1));
	for (int i = 0; i < set->count; ++i) assert_int_equal(set->nodes[i], 3 * first + i);
}

static void sets_name_the_ends_and_the_needle(void** state) {
	(void)state;
	ShapeCase c;
	shape_make(
		&c, "{type: thread, radius: 1 cm, links: 20, needle: 4, section: corner, points: [{at: [1, 0, 0]}, {at: [1, 2, "
			"0]}]}");
	expect_frames(&c.mesh, "start", 0, 0);
	expect_frames(&c.mesh, "end", 20, 20);
	expect_frames(&c.mesh, "needle", 0, 4);
	const JnNodeSet* axis = mesh_set(&c.mesh, "axis");
	assert_int_equal(axis->count, 21);
	for (int k = 0; k <= 20; ++k) assert_int_equal(axis->nodes[k], 3 * k);
	shape_free(&c);
	shape_make(&c, all[1]); // a loop
	assert_int_equal(c.mesh.set_count, 1);
	expect_frames(&c.mesh, "start", 0, 0);
	assert_true(c.mesh.thread->is_closed);
	shape_free(&c);
}

static void what_makes_no_thread_is_refused(void** state) {
	(void)state;
	shape_expect_refusal("{type: thread, radius: 1 cm}", "shape.curve: nothing says where the thread goes");
	shape_expect_refusal("{type: thread, radius: 1 cm, curve: {type: circle, radius: 1}, points: [{at: [0, 0, 0]}]}",
						 "shape.curve: there are points, too");
	shape_expect_refusal("{type: thread, radius: 1 cm, points: [{at: [0, 0, 0]}]}",
						 "shape.points: 1 points make no curve");
	shape_expect_refusal("{type: thread, radius: 6 cm, curve: {type: circle, radius: 5 cm}}",
						 "bends with a radius of 0.0");
	shape_expect_refusal("{type: thread, radius: 1 cm, links: 2, curve: {type: circle, radius: 1}}",
						 "shape.links: 2 make no");
	shape_expect_refusal("{type: thread, radius: 1 cm, twist: 0.5, curve: {type: circle, radius: 1}}", "do not close");
	shape_expect_refusal(
		"{type: thread, radius: 1 cm, links: 5, needle: 6, points: [{at: [0, 0, 0]}, {at: [1, 0, 0]}]}",
		"shape.needle: 6 links");
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(every_cell_is_positive),
		cmocka_unit_test(a_straight_thread_is_a_prism),
		cmocka_unit_test(the_axis_runs_along_the_curve_in_equal_links),
		cmocka_unit_test(threads_are_knotted_where_their_curves_are),
		cmocka_unit_test(sets_name_the_ends_and_the_needle),
		cmocka_unit_test(what_makes_no_thread_is_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
