// The jello and its plate: what is which, and their sizes.
#include "mesh/shape_case.h"

static const char* const fluted = "{type: jello, origin: [1, 2, 3], height: 0.5, radius: 0.4, plate_radius: 0.6, "
								  "plate_thickness: 0.05, flutes: 10, cells: [40, 2, 5]}";

static void the_plate_is_all_that_lies_at_or_below_the_foot(void** state) {
	(void)state;
	ShapeCase c;
	shape_make(&c, fluted);
	const JnNodeSet *plate = mesh_set(&c.mesh, "plate"), *bottom = mesh_set(&c.mesh, "bottom");
	for (int i = 0; i < c.mesh.node_count; ++i) {
		const double height = c.mesh.nodes[3 * i + 1] - 2;
		if ((height <= 1e-12) != set_has(plate, i)) fail_msg("node %d at height %g m", i, height);
		assert_true(height > -0.05 - 1e-12); // rounding near 2
	}
	for (int i = 0; i < bottom->count; ++i) assert_true(set_has(plate, bottom->nodes[i]));
	shape_free(&c);
}

static void the_top_is_the_upper_side_of_the_last_layer(void** state) {
	(void)state;
	ShapeCase c;
	shape_make(&c, fluted);
	const JnNodeSet *top = mesh_set(&c.mesh, "top"), *bottom = mesh_set(&c.mesh, "bottom");
	double highest = 0;
	assert_int_equal(top->count, bottom->count);
	assert_int_equal(top->count, 11 * 11 + 2 * 40); // the square core and two rings
	for (int i = 0; i < top->count; ++i) {
		const double height = c.mesh.nodes[3 * top->nodes[i] + 1] - 2;
		assert_true(height > 0.5 * (1 - 0.1) - 1e-12 && height <= 0.5 + 1e-12); // the rounded edge is a tenth lower
		highest = fmax(highest, height);
	}
	assert_true(fabs(highest - 0.5) < 1e-12);
	shape_free(&c);
}

// The area within r(a) = R (1 + d cos(n a)) is pi R^2 (1 + d^2 / 2); a straight jello without rounding is a prism on it.
static void a_straight_jello_has_the_volume_of_its_fluted_prism(void** state) {
	(void)state;
	static const char* const text = "{type: jello, height: 2, radius: 1, taper: 1, rounding: 0, plate_radius: 1.5, "
									"plate_thickness: 0.5, flutes: 8, flute_depth: 0.1, cells: [192, 8, 2]}";
	ShapeCase c;
	shape_make(&c, text);
	const double pi = 3.14159265358979323846;
	const double expected = 2 * pi * (1 + 0.1 * 0.1 / 2) + 0.5 * pi * 1.5 * 1.5;
	const double volume = mesh_volume(&c.mesh);
	print_message("volume %.8g, expected %.8g\n", volume, expected);
	// chords of 24 cells a flute: curvature of the wave against that of the circle 1 + 0.1 * 64, each (2 pi / 192)^2 / 6
	assert_true(fabs(volume - expected) < 1e-3 * expected);
	shape_free(&c);
}

static void the_default_has_about_three_thousand_hexahedra(void** state) {
	(void)state;
	ShapeCase c;
	shape_make(&c, "{type: jello}");
	print_message("%d nodes, %d hexahedra\n", c.mesh.node_count, c.mesh.cell_count);
	assert_in_range(c.mesh.cell_count, 2500, 4000);
	shape_free(&c);
}

static void numbers_that_make_no_jello_are_refused(void** state) {
	(void)state;
	shape_expect_refusal("{type: jello, plate_radius: 0.3}", "beyond the foot");
	shape_expect_refusal("{type: jello, flutes: 20}", "use 80 or more");
	shape_expect_refusal("{type: jello, cells: [46, 2, 2]}", "use 44 or 48");
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(the_plate_is_all_that_lies_at_or_below_the_foot),
		cmocka_unit_test(the_top_is_the_upper_side_of_the_last_layer),
		cmocka_unit_test(a_straight_jello_has_the_volume_of_its_fluted_prism),
		cmocka_unit_test(the_default_has_about_three_thousand_hexahedra),
		cmocka_unit_test(numbers_that_make_no_jello_are_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
