// Shapes made of points: how many, where, how much each weighs, and what they refuse.
#include "shape_case.h"

static double total_volume(const JnMesh* mesh) {
	double sum = 0;
	for (int i = 0; i < mesh->node_count; ++i) sum += mesh->volumes[i];
	return sum;
}

static void near_to(double value, double expected, double tolerance, const char* what) {
	print_message("%s: %.9g, expected %.9g within %.3g\n", what, value, expected, tolerance);
	if (!(fabs(value - expected) <= tolerance)) fail_msg("%s: %.17g, expected %.17g", what, value, expected);
}

static void a_box_is_filled_with_points_in_the_middle_of_cells(void** state) {
	(void)state;
	ShapeCase c;
	shape_make(&c, "{type: points_box, origin: [1, 2, 3], size: [0.4, 0.2, 0.3], spacing: 0.1}");
	assert_int_equal(c.mesh.shape, JN_POINT1);
	assert_int_equal(c.mesh.node_count, 4 * 2 * 3);
	near_to(total_volume(&c.mesh), 0.4 * 0.2 * 0.3, 1e-15, "volume"); // rounding
	near_to(c.mesh.nodes[0], 1.05, 1e-14, "x of the first point");
	near_to(c.mesh.nodes[3 * 23 + 2], 3.25, 1e-14, "z of the last point");
	near_to(c.mesh.thickness, 0, 0, "thickness");
	shape_free(&c);
}

static void a_layer_has_the_thickness_of_the_box(void** state) {
	(void)state;
	ShapeCase c;
	shape_make(&c, "{type: points_box, size: [0.1, 0.04, 0.002], spacing: 0.001, layer: true, jitter: 0.3, seed: 5}");
	assert_int_equal(c.mesh.node_count, 100 * 40);
	near_to(c.mesh.thickness, 0.002, 1e-18, "thickness");
	near_to(total_volume(&c.mesh), 0.1 * 0.04 * 0.002, 1e-18, "volume"); // 4000 roundings of 2e-9
	for (int i = 0; i < c.mesh.node_count; ++i) assert_true(c.mesh.nodes[3 * i + 2] == 0.001);
	shape_free(&c);
}

static void jitter_moves_each_point_within_its_share(void** state) {
	(void)state;
	ShapeCase even, one, again, other;
	double most = 0;
	bool differs = false;
	shape_make(&even, "{type: points_box, size: [1, 1, 1], spacing: 0.1}");
	shape_make(&one, "{type: points_box, size: [1, 1, 1], spacing: 0.1, jitter: 0.2}");
	shape_make(&again, "{type: points_box, size: [1, 1, 1], counts: [10, 10, 10], jitter: 0.2}");
	shape_make(&other, "{type: points_box, size: [1, 1, 1], spacing: 0.1, jitter: 0.2, seed: 2}");
	for (int k = 0; k < 3000; ++k) {
		most = fmax(most, fabs(one.mesh.nodes[k] - even.mesh.nodes[k]));
		assert_true(one.mesh.nodes[k] == again.mesh.nodes[k]);
		differs |= one.mesh.nodes[k] != other.mesh.nodes[k];
	}
	assert_true(differs && most > 0.0199 && most <= 0.02 + 1e-12);
	shape_free(&even), shape_free(&one), shape_free(&again), shape_free(&other);
}

static const char cube_text[] = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
								"f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

static void a_closed_surface_is_filled_to_its_volume(void** state) {
	(void)state;
	ShapeCase c;
	char folder[256], text[400];
	assert_int_equal(folder_create(folder), 0);
	file_write(path_join(folder, "cube.obj"), cube_text);
	snprintf(text, sizeof text, "{type: points_file, path: %s, spacing: 0.1, scale: 2, rotate: [0, 0, 90 deg]}",
			 path_join(folder, "cube.obj"));
	shape_make(&c, text);
	assert_int_equal(c.mesh.node_count, 8000);
	near_to(total_volume(&c.mesh), 8, 1e-9, "volume");
	for (int i = 0; i < c.mesh.node_count; ++i) assert_true(c.mesh.nodes[3 * i] < 0 && c.mesh.nodes[3 * i] > -2);
	shape_free(&c);
	snprintf(text, sizeof text, "{type: points_file, path: %s, spacing: 1 mm}", path_join(folder, "cube.obj"));
	shape_expect_refusal(text, "larger than");
	file_write(path_join(folder, "open.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
	snprintf(text, sizeof text, "{type: points_file, path: %s, spacing: 0.1}", path_join(folder, "open.obj"));
	shape_expect_refusal(text, "open.obj");
	folder_remove(folder);
}

static void bad_counts_are_refused(void** state) {
	(void)state;
	shape_expect_refusal("{type: points_box, size: [1, 1, 1], spacing: 0.1, counts: [2, 2, 2]}", "exactly one");
	shape_expect_refusal("{type: points_box, size: [1, 1, 1], counts: [2, 0, 2]}", "at least 1");
	shape_expect_refusal("{type: points_box, size: [1, -1, 1], spacing: 0.1}", "size");
	shape_expect_refusal("{type: points_box, size: [1, 1, 1], spacing: 0.1, jitter: 0.7}", "jitter");
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_box_is_filled_with_points_in_the_middle_of_cells),
		cmocka_unit_test(a_layer_has_the_thickness_of_the_box),
		cmocka_unit_test(jitter_moves_each_point_within_its_share),
		cmocka_unit_test(a_closed_surface_is_filled_to_its_volume),
		cmocka_unit_test(bad_counts_are_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
