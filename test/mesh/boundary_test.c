// Boundaries of meshes: closed, outward, and around just the volume of the cells.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "mesh/boundary.h"
#include "mesh/shape/shape.h"
#include "mesh/surface.h"

static JnMesh make(int shape, JnArena* arena) {
	JnMesh mesh;
	const JnBoxDef def = {.origin = {1, -2, 3}, .size = {1, 2, 3}, .cells = {3, 2, 4}, .element = shape};
	assert_int_equal(jn_generate_box(&def, arena, &mesh), JN_OK);
	return mesh;
}

static JnSurface boundary_of(const JnMesh* mesh, JnArena* arena) {
	JnSurface surface = {.node_count = mesh->node_count, .nodes = mesh->nodes};
	assert_int_equal(jn_mesh_boundary(mesh, arena, &surface.triangle_count, &surface.triangles), JN_OK);
	return surface;
}

static double volume_of(const JnMesh* mesh) {
	double volume = 0;
	for (int cell = 0; cell < mesh->cell_count; ++cell) volume += jn_mesh_cell_volume(mesh, cell);
	return volume;
}

/// Every directed edge comes once, and so does its opposite.
static void expect_closed(const JnSurface* surface) {
	const size_t nodes = (size_t)surface->node_count;
	unsigned char* count = calloc(nodes * nodes, 1);
	assert_non_null(count);
	for (int t = 0; t < surface->triangle_count; ++t)
		for (int k = 0; k < 3; ++k) {
			const int a = surface->triangles[3 * t + k], b = surface->triangles[3 * t + (k + 1) % 3];
			assert_in_range(a, 0, surface->node_count - 1);
			assert_int_equal(count[(size_t)a * nodes + (size_t)b]++, 0);
		}
	for (size_t a = 0; a < nodes; ++a)
		for (size_t b = 0; b < a; ++b) assert_int_equal(count[a * nodes + b], count[b * nodes + a]);
	free(count);
}

static void boundaries_are_closed(void** unused) {
	(void)unused;
	for (int shape = 0; shape < JN_SOLID_SHAPE_COUNT; ++shape) {
		JnArena arena = {0};
		const JnMesh mesh = make(shape, &arena);
		const JnSurface surface = boundary_of(&mesh, &arena);
		expect_closed(&surface);
		jn_arena_free(&arena);
	}
}

static void a_boundary_has_the_triangles_of_its_faces(void** unused) {
	(void)unused;
	static const int triangles_a_square[JN_SOLID_SHAPE_COUNT] = {[JN_TET4] = 2, [JN_TET10] = 8, [JN_HEX8] = 2};
	for (int shape = 0; shape < JN_SOLID_SHAPE_COUNT; ++shape) {
		JnArena arena = {0};
		const JnMesh mesh = make(shape, &arena);
		const JnSurface surface = boundary_of(&mesh, &arena);
		assert_int_equal(surface.triangle_count, 2 * (3 * 2 + 2 * 4 + 3 * 4) * triangles_a_square[shape]);
		jn_arena_free(&arena);
	}
}

/// Moved nodes keep straight edges for tet4 only in general; an affine map does for all: x += 0.3 y - 0.2 z and so on.
static void a_boundary_holds_the_volume_of_the_cells(void** unused) {
	(void)unused;
	for (int shape = 0; shape < JN_SOLID_SHAPE_COUNT; ++shape) {
		JnArena arena = {0};
		const JnMesh mesh = make(shape, &arena);
		const JnSurface surface = boundary_of(&mesh, &arena);
		for (int round = 0; round < 2; ++round) {
			// volumes of some 100 pieces with coordinates below 6, against 6: roundings of 1e-13
			assert_true(fabs(jn_surface_volume(&surface) - volume_of(&mesh)) < 1e-11);
			for (int i = 0; i < mesh.node_count; ++i) {
				double* X = mesh.nodes + 3 * i;
				X[0] += 0.3 * X[1] - 0.2 * X[2];
				X[2] += 0.1 * X[0];
			}
		}
		assert_true(volume_of(&mesh) > 5.9);
		jn_arena_free(&arena);
	}
}

/// Any positions of tet4 nodes: faces are flat, inner ones cancel.
static void bent_tetrahedra_keep_volume_and_boundary_equal(void** unused) {
	(void)unused;
	JnArena arena = {0};
	const JnMesh mesh = make(JN_TET4, &arena);
	const JnSurface surface = boundary_of(&mesh, &arena);
	for (int i = 0; i < 3 * mesh.node_count; ++i) mesh.nodes[i] += 0.1 * sin(17.0 * i);
	assert_true(fabs(jn_surface_volume(&surface) - volume_of(&mesh)) < 1e-11);
	expect_closed(&surface);
	jn_arena_free(&arena);
}

static void one_cell_is_all_boundary(void** unused) {
	(void)unused;
	static const int triangles[JN_SOLID_SHAPE_COUNT] = {[JN_TET4] = 4, [JN_TET10] = 16, [JN_HEX8] = 12};
	for (int shape = 0; shape < JN_SOLID_SHAPE_COUNT; ++shape) {
		JnArena arena = {0};
		JnMesh mesh = make(shape, &arena);
		mesh.cell_count = 1;
		const JnSurface surface = boundary_of(&mesh, &arena);
		assert_int_equal(surface.triangle_count, triangles[shape]);
		expect_closed(&surface);
		assert_true(fabs(jn_surface_volume(&surface) - jn_mesh_cell_volume(&mesh, 0)) < 1e-13); // as above, one cell
		jn_arena_free(&arena);
	}
}

/// The diagonal of a quadrilateral leaves from its lowest node, whoever looks at it: two meshes side by side agree.
static void quadrilaterals_are_cut_from_their_lowest_node(void** unused) {
	(void)unused;
	JnArena arena = {0};
	const JnMesh mesh = make(JN_HEX8, &arena);
	const JnSurface surface = boundary_of(&mesh, &arena);
	for (int t = 0; t < surface.triangle_count; t += 2) {
		const int *first = surface.triangles + 3 * t, *second = first + 3;
		assert_int_equal(first[0], second[0]);
		for (int k = 1; k < 3; ++k) assert_true(first[0] < first[k] && second[0] < second[k]);
	}
	jn_arena_free(&arena);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(boundaries_are_closed),
		cmocka_unit_test(a_boundary_has_the_triangles_of_its_faces),
		cmocka_unit_test(a_boundary_holds_the_volume_of_the_cells),
		cmocka_unit_test(bent_tetrahedra_keep_volume_and_boundary_equal),
		cmocka_unit_test(one_cell_is_all_boundary),
		cmocka_unit_test(quadrilaterals_are_cut_from_their_lowest_node),
	};
	return cmocka_run_group_tests_name("boundary", tests, NULL, NULL);
}
