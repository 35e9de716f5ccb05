// Quality of cells of known shape.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#include "mesh/quality.h"
#include "mesh/shape/shape.h"

/// Tens of roundings of numbers near 1.
static const double ROUNDING = 1e-14;

static void expect_near(double value, double expected, double tolerance) {
	if (!(fabs(value - expected) <= tolerance))
		fail_msg("%.17g, expected %.17g, tolerance %.1g", value, expected, tolerance);
}

/// A tetrahedron on three corners of a cube, which (-1, -1, 1) makes regular.
static double quality_of_tet(double x, double y, double z, JnShape shape) {
	double nodes[30] = {1, 1, 1, -1, 1, -1, 1, -1, -1, 0, 0, 0};
	int cells[10] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
	nodes[9] = x, nodes[10] = y, nodes[11] = z;
	return jn_cell_quality(&(JnMesh){.shape = shape, .node_count = 10, .nodes = nodes, .cell_count = 1, .cells = cells},
						   0);
}

static void a_regular_tetrahedron_has_quality_one(void** unused) {
	(void)unused;
	expect_near(fabs(quality_of_tet(-1, -1, 1, JN_TET4)), 1, ROUNDING);
	expect_near(fabs(quality_of_tet(-1, -1, 1, JN_TET10)), 1, ROUNDING);
}

/// Corner of a cube: V = 1/6, squared edges 3 * 1 + 3 * 2, hence 12 (1/2)^(2/3) / 9 = 0.83994...
static void the_corner_of_a_cube_has_its_mean_ratio(void** unused) {
	(void)unused;
	double nodes[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
	int right[] = {0, 1, 2, 3}, inverted[] = {0, 2, 1, 3};
	JnMesh mesh = {.shape = JN_TET4, .node_count = 4, .nodes = nodes, .cell_count = 1, .cells = right};
	const double expected = 12 * pow(0.5, 2.0 / 3) / 9;
	expect_near(jn_cell_quality(&mesh, 0), expected, ROUNDING);
	mesh.cells = inverted;
	expect_near(jn_cell_quality(&mesh, 0), -expected, ROUNDING);
}

static void quality_does_not_depend_on_size(void** unused) {
	(void)unused;
	double nodes[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
	int cells[] = {0, 1, 2, 3};
	const JnMesh mesh = {.shape = JN_TET4, .node_count = 4, .nodes = nodes, .cell_count = 1, .cells = cells};
	const double before = jn_cell_quality(&mesh, 0);
	for (int i = 0; i < 12; ++i) nodes[i] *= 1e-6;
	expect_near(jn_cell_quality(&mesh, 0), before, ROUNDING);
}

static void a_flat_tetrahedron_has_quality_zero(void** unused) {
	(void)unused;
	// (1/3, 1/3, -1/3) is the middle of the base; the cube root of a rounded volume of 1e-17 is 1e-6, its square 1e-11
	expect_near(quality_of_tet(1.0 / 3, 1.0 / 3, -1.0 / 3, JN_TET4), 0, 1e-10);
	double nodes[12] = {0};
	int cells[] = {0, 1, 2, 3};
	const JnMesh point = {.shape = JN_TET4, .node_count = 4, .nodes = nodes, .cell_count = 1, .cells = cells};
	expect_near(jn_cell_quality(&point, 0), 0, 0);
}

static JnMesh unit_cube(double nodes[24], int cells[8]) {
	static const double cube[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
	memcpy(nodes, cube, sizeof cube);
	for (int i = 0; i < 8; ++i) cells[i] = i;
	return (JnMesh){.shape = JN_HEX8, .node_count = 8, .nodes = nodes, .cell_count = 1, .cells = cells};
}

static void cubes_and_boxes_have_scaled_jacobian_one(void** unused) {
	(void)unused;
	double nodes[24];
	int cells[8];
	const JnMesh mesh = unit_cube(nodes, cells);
	expect_near(jn_cell_quality(&mesh, 0), 1, 0);
	for (int i = 0; i < 8; ++i) nodes[3 * i + 1] *= 1e-3;
	expect_near(jn_cell_quality(&mesh, 0), 1, ROUNDING);
}

/// x += z tan(60 degrees): each corner's upright edge leans, its cosine to the normal is 1/2.
static void a_sheared_cube_has_the_cosine_of_its_angle(void** unused) {
	(void)unused;
	double nodes[24];
	int cells[8];
	const JnMesh mesh = unit_cube(nodes, cells);
	for (int i = 0; i < 8; ++i) nodes[3 * i] += sqrt(3) * nodes[3 * i + 2];
	expect_near(jn_cell_quality(&mesh, 0), 0.5, ROUNDING);
}

/// A node pushed through its cube to (1, 1, 1) / 3: its edges (-1, 2, 2) / 3, (2, -1, 2) / 3 and (2, 2, -1) / 3 are
/// orthonormal, and left-handed.
static void the_worst_corner_of_a_hexahedron_counts(void** unused) {
	(void)unused;
	double nodes[24];
	int cells[8];
	const JnMesh mesh = unit_cube(nodes, cells);
	for (int k = 0; k < 3; ++k) nodes[18 + k] = 1.0 / 3;
	expect_near(jn_cell_quality(&mesh, 0), -1, ROUNDING);
}

static void an_inverted_cube_has_scaled_jacobian_minus_one(void** unused) {
	(void)unused;
	double nodes[24];
	int cells[8];
	const JnMesh mesh = unit_cube(nodes, cells);
	for (int i = 0; i < 8; ++i) nodes[3 * i + 2] *= -1;
	expect_near(jn_cell_quality(&mesh, 0), -1, 0);
}

static void a_mesh_tells_its_worst_cell_and_its_median(void** unused) {
	(void)unused;
	JnArena arena = {0};
	JnMesh mesh;
	JnQuality quality;
	assert_int_equal(
		jn_generate_box(&(JnBoxDef){.size = {3, 1, 1}, .cells = {3, 1, 1}, .element = JN_HEX8}, &arena, &mesh), JN_OK);
	for (int i = 0; i < mesh.node_count; ++i) // the last cell leans by 45 degrees
		if (mesh.nodes[3 * i] == 3 && mesh.nodes[3 * i + 1] == 1) mesh.nodes[3 * i + 1] = 2;
	assert_int_equal(jn_mesh_quality(&mesh, &quality), JN_OK);
	assert_string_equal(quality.measure, "scaled Jacobian");
	assert_int_equal(quality.worst, 2);
	expect_near(quality.min, sqrt(0.5), ROUNDING);
	expect_near(quality.median, 1, ROUNDING);
	mesh.cell_count = 0;
	assert_int_equal(jn_mesh_quality(&mesh, &quality), JN_OK);
	assert_int_equal(quality.worst, -1);
	jn_arena_free(&arena);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_regular_tetrahedron_has_quality_one),
		cmocka_unit_test(the_corner_of_a_cube_has_its_mean_ratio),
		cmocka_unit_test(quality_does_not_depend_on_size),
		cmocka_unit_test(a_flat_tetrahedron_has_quality_zero),
		cmocka_unit_test(cubes_and_boxes_have_scaled_jacobian_one),
		cmocka_unit_test(a_sheared_cube_has_the_cosine_of_its_angle),
		cmocka_unit_test(the_worst_corner_of_a_hexahedron_counts),
		cmocka_unit_test(an_inverted_cube_has_scaled_jacobian_minus_one),
		cmocka_unit_test(a_mesh_tells_its_worst_cell_and_its_median),
	};
	return cmocka_run_group_tests_name("quality", tests, NULL, NULL);
}
