// Units, axes, size and place of what comes from a file, and their keys.
#include "base/key.h"
#include "mesh/shape/placement.h"
#include "surface_case.h"

static const JnKey placement_keys[] = {JN_PLACEMENT_KEY_ROWS(JnPlacementDef, ), {0}};

static const JnPlacementDef as_it_is = {.scale = 1};

static void assert_point(const double* x, double expected_x, double expected_y, double expected_z) {
	if (x[0] != expected_x || x[1] != expected_y || x[2] != expected_z)
		fail_msg("value (%.17g, %.17g, %.17g), expected (%.17g, %.17g, %.17g)", x[0], x[1], x[2], expected_x,
				 expected_y, expected_z);
}

static void placement_as_it_is_changes_nothing(void** state) {
	(void)state;
	double x[3] = {0.1, -2, 3e-7};
	assert_int_equal(jn_placement_apply(&as_it_is, "p", 1, x), JN_OK);
	assert_point(x, 0.1, -2, 3e-7);
}

static void up_axis_becomes_y_without_a_mirror(void** state) {
	(void)state;
	for (int up = 0; up < 3; up++) {
		JnPlacementDef def = as_it_is;
		def.up = up;
		double x[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
		assert_int_equal(jn_placement_apply(&def, "p", 3, x), JN_OK);
		const int axis = (up + 1) % 3; // y, z, x
		assert_point(x + 3 * axis, 0, 1, 0);
		const double* c = x + 6;
		const double determinant = c[0] * (x[1] * x[5] - x[2] * x[4]) + c[1] * (x[2] * x[3] - x[0] * x[5]) +
								   c[2] * (x[0] * x[4] - x[1] * x[3]);
		assert_true(determinant == 1);
	}
}

static void quarter_turns_are_exact_and_right_handed(void** state) {
	(void)state;
	static const double expected[3][3] = {{1, -3, 2}, {3, 2, -1}, {-2, 1, 3}};
	for (int a = 0; a < 3; a++) {
		JnPlacementDef def = as_it_is;
		def.rotate[a] = M_PI / 2;
		double x[3] = {1, 2, 3};
		assert_int_equal(jn_placement_apply(&def, "p", 1, x), JN_OK);
		assert_point(x, expected[a][0], expected[a][1], expected[a][2]);
	}
}

static void turn_by_an_angle_moves_along_the_circle(void** state) {
	(void)state;
	JnPlacementDef def = as_it_is;
	def.rotate[2] = M_PI / 6;
	double x[3] = {2, 0, 5};
	assert_int_equal(jn_placement_apply(&def, "p", 1, x), JN_OK);
	assert_near("x", x[0], sqrt(3), 1e-15); // one rounding of cos and of the product each
	assert_near("y", x[1], 1, 1e-15);
	assert_near("z", x[2], 5, 0);
}

static void steps_come_in_the_documented_order(void** state) {
	(void)state;
	// (1, 2, 3) -> up z: (1, 3, -2) -> scale 2: (2, 6, -4) -> x by 90 degrees: (2, 4, 6) -> z by 90 degrees: (-4, 2, 6)
	const JnPlacementDef def = {
		.up = 1, .scale = 2, .rotate = {M_PI / 2, 0, M_PI / 2}, .fit = 3, .translate = {10, 20, 30}};
	double x[6] = {1, 2, 3, 0, 0, 0}; // the box's largest edge is then 6; fit halves it
	assert_int_equal(jn_placement_apply(&def, "p", 2, x), JN_OK);
	assert_point(x, 8, 21, 33);
	assert_point(x + 3, 10, 20, 30);
}

static void fit_of_a_single_place_is_refused(void** state) {
	(void)state;
	Words words;
	JnPlacementDef def = as_it_is;
	def.fit = 1;
	double x[6] = {1, 2, 3, 1, 2, 3};
	words_keep(&words);
	assert_int_equal(jn_placement_apply(&def, "bodies[0].shape", 2, x), JN_BAD_INPUT);
	assert_says(&words, "bodies[0].shape.fit: all 2 nodes lie at one place");
}

static void places_beyond_all_numbers_are_refused(void** state) {
	(void)state;
	Words words;
	JnPlacementDef def = as_it_is;
	def.scale = 1e300;
	double x[3] = {1e10, 0, 0};
	words_keep(&words);
	assert_int_equal(jn_placement_apply(&def, "p", 1, x), JN_BAD_INPUT);
	assert_says(&words, "p: node 0 is not at a finite place");
}

static void keys_take_millimetres_and_degrees(void** state) {
	(void)state;
	JnArena arena = {0};
	JnDocument document;
	JnPlacementDef def;
	assert_int_equal(
		jn_document_parse("p.yaml", "up: z\nscale: 1 mm\nrotate: [0, 90 deg, 0]\nfit: 20 cm\n", &arena, &document),
		JN_OK);
	assert_int_equal(jn_keys_read(placement_keys, document.root, "", &arena, &def), JN_OK);
	assert_int_equal(def.up, 1);
	assert_near("scale", def.scale, 0.001, 0);
	assert_near("rotate", def.rotate[1], M_PI / 2, 1e-15); // one rounding of 90 * (pi / 180)
	assert_near("fit", def.fit, 0.2, 0);
	assert_near("translate", def.translate[2], 0, 0);
	jn_arena_free(&arena);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(placement_as_it_is_changes_nothing),
		cmocka_unit_test(up_axis_becomes_y_without_a_mirror),
		cmocka_unit_test(quarter_turns_are_exact_and_right_handed),
		cmocka_unit_test(turn_by_an_angle_moves_along_the_circle),
		cmocka_unit_test(steps_come_in_the_documented_order),
		cmocka_unit_test(fit_of_a_single_place_is_refused),
		cmocka_unit_test(places_beyond_all_numbers_are_refused),
		cmocka_unit_test(keys_take_millimetres_and_degrees),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
