// A surface in cells: it is where it was, moves with the cells, and what cannot be carried is refused.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/log.h"
#include "mesh/embed.h"
#include "mesh/shape/shape.h"

enum { POINTS = 500 };

static char messages[2048];

static void keep_message(void* user, JnLogLevel level, const char* message) {
	(void)user, (void)level;
	snprintf(messages, sizeof messages, "%s", message);
}

static int start(void** state) {
	(void)state;
	messages[0] = '\0';
	jn_log_set_sink(keep_message, NULL);
	return 0;
}

/// Numbers between 0 and 1, the same every time (Halton's sequence).
static double halton(int i, int base) {
	double sum = 0, part = 1.0 / base;
	for (int k = i + 1; k > 0; k /= base, part /= base) sum += part * (k % base);
	return sum;
}

/// A box from (1, -2, 3) of edges 0.5, 0.25, 2, whose nodes are moved a little: cells with bent faces.
static JnMesh make_mesh(JnShape shape, double bend, JnArena* arena) {
	const JnBoxDef def = {.origin = {1, -2, 3}, .size = {0.5, 0.25, 2}, .cells = {4, 3, 9}, .element = (int)shape};
	JnMesh mesh;
	assert_int_equal(jn_generate_box(&def, arena, &mesh), JN_OK);
	for (int i = 0; i < 3 * mesh.node_count; i++) mesh.nodes[i] += bend * (halton(i, 7) - 0.5);
	return mesh;
}

/// Points in the box, grown by `outside` on all sides, as a surface of unrelated triangles.
static JnSurface make_points(double outside, JnArena* arena) {
	JnSurface surface = {.node_count = POINTS, .triangle_count = POINTS / 3};
	surface.nodes = jn_arena_take(arena, 3 * POINTS, sizeof(double));
	surface.triangles = jn_arena_take(arena, POINTS, sizeof(int));
	const double low[3] = {1, -2, 3}, size[3] = {0.5, 0.25, 2};
	const int base[3] = {2, 3, 5};
	for (int i = 0; i < 3 * POINTS; i++) {
		const int a = i % 3;
		surface.nodes[i] = low[a] - outside + (size[a] + 2 * outside) * halton(i / 3, base[a]);
	}
	for (int i = 0; i < POINTS; i++) surface.triangles[i] = i;
	return surface;
}

static double largest_gap(const double* a, const double* b, int count) {
	double gap = 0;
	for (int i = 0; i < count; i++) gap = fmax(gap, fabs(a[i] - b[i]));
	return gap;
}

/// y = A x + c, far from a rotation.
static void move(const double* x, int count, double* y) {
	static const double A[3][3] = {{1.3, -0.4, 0.2}, {0.7, 0.5, -1.1}, {0.1, 0.9, 2}}, c[3] = {-3, 5, 0.25};
	for (int i = 0; i < 3 * count; i++) {
		const double* p = x + 3 * (i / 3);
		y[i] = A[i % 3][0] * p[0] + A[i % 3][1] * p[1] + A[i % 3][2] * p[2] + c[i % 3];
	}
}

static void check_affine(JnShape shape, double bend, double outside) {
	JnArena arena = {0};
	const JnMesh mesh = make_mesh(shape, bend, &arena);
	const JnSurface surface = make_points(outside, &arena);
	JnEmbedding* embedding = NULL;
	assert_int_equal(jn_embedding_create(&surface, &mesh, "box", &arena, &embedding), JN_OK);
	double *at = jn_arena_take(&arena, 3 * POINTS, sizeof *at), *moved = jn_arena_take(&arena, 3 * POINTS, sizeof *at);
	double* x = jn_arena_take(&arena, 3 * (size_t)mesh.node_count, sizeof *x);
	jn_embedding_positions(embedding, mesh.nodes, at);
	const double rest_gap = largest_gap(at, surface.nodes, 3 * POINTS);
	move(mesh.nodes, mesh.node_count, x);
	move(surface.nodes, POINTS, moved);
	jn_embedding_positions(embedding, x, at);
	const double moved_gap = largest_gap(at, moved, 3 * POINTS);
	print_message("%s, bent by %g, outside by %g: %.1e at rest, %.1e moved\n", jn_shape_info[shape].name, bend, outside,
				  rest_gap, moved_gap);
	// Coordinates up to 14, eight products each: rounding of some 1e-15 each
	assert_true(rest_gap < 1e-12 && moved_gap < 1e-12);
	for (int i = 0; i < POINTS; i++) {
		double sum = 0;
		for (int k = 0; k < embedding->cell_nodes; k++) sum += embedding->weights[i * embedding->cell_nodes + k];
		assert_true(fabs(sum - 1) < 1e-12);
	}
	jn_arena_free(&arena);
}

static void vertices_inside_are_carried_by_any_affine_motion(void** unused) {
	(void)unused;
	check_affine(JN_HEX8, 0, 0);
	check_affine(JN_TET4, 0, 0);
}

static void vertices_in_bent_cells_are_carried_by_any_affine_motion(void** unused) {
	(void)unused;
	check_affine(JN_HEX8, 0.02, 0);
	check_affine(JN_TET4, 0.02, 0);
}

static void vertices_outside_are_carried_by_any_affine_motion(void** unused) {
	(void)unused;
	check_affine(JN_HEX8, 0.02, 0.08);
	check_affine(JN_TET4, 0.02, 0.08);
}

// Inside, the weights are shape functions: none is negative.
static void vertices_inside_have_no_negative_weight(void** unused) {
	(void)unused;
	for (int i = 0; i < 2; i++) {
		JnArena arena = {0};
		const JnMesh mesh = make_mesh(i == 0 ? JN_HEX8 : JN_TET4, 0, &arena);
		const JnSurface surface = make_points(0, &arena);
		JnEmbedding* embedding = NULL;
		assert_int_equal(jn_embedding_create(&surface, &mesh, "box", &arena, &embedding), JN_OK);
		for (int k = 0; k < POINTS * embedding->cell_nodes; k++) assert_true(embedding->weights[k] > -1e-8);
		jn_arena_free(&arena);
	}
}

// One cube, one node lifted: the vertex at (r, s, t) follows by r s t.
static void vertex_follows_the_shape_functions_of_its_cube(void** unused) {
	(void)unused;
	JnArena arena = {0};
	const JnBoxDef def = {.size = {2, 2, 2}, .cells = {1, 1, 1}, .element = JN_HEX8};
	JnMesh mesh;
	assert_int_equal(jn_generate_box(&def, &arena, &mesh), JN_OK);
	double vertex[3] = {0.5, 1, 1.5}, at[3];
	const JnSurface surface = {.node_count = 1, .nodes = vertex};
	JnEmbedding* embedding = NULL;
	assert_int_equal(jn_embedding_create(&surface, &mesh, "cube", &arena, &embedding), JN_OK);
	for (int i = 0; i < mesh.node_count; i++) {
		double* x = mesh.nodes + 3 * i;
		if (x[0] > 1 && x[1] > 1 && x[2] > 1) x[1] += 8;
	}
	jn_embedding_positions(embedding, mesh.nodes, at);
	assert_true(fabs(at[1] - (1 + 8 * 0.25 * 0.5 * 0.75)) < 1e-14); // a few roundings of numbers below 8
	jn_arena_free(&arena);
}

// A corner is the vertex's own cell on the far side only: a cell nearer by its box but not by itself is not taken.
static void vertex_outside_follows_the_nearest_cell(void** unused) {
	(void)unused;
	JnArena arena = {0};
	double nodes[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 3, 3, 3, 4, 3, 3, 3, 4, 3, 3, 3, 4};
	int cells[] = {0, 1, 2, 3, 4, 5, 6, 7};
	const JnMesh mesh = {.shape = JN_TET4, .node_count = 8, .nodes = nodes, .cell_count = 2, .cells = cells};
	double vertex[3] = {2.8, 2.8, 2.8}; // in the box of the first cell, 2.5 away from it; 0.35 from the second
	const JnSurface surface = {.node_count = 1, .nodes = vertex};
	JnEmbedding* embedding = NULL;
	assert_int_equal(jn_embedding_create(&surface, &mesh, "pair", &arena, &embedding), JN_OK);
	for (int i = 0; i < 4; i++) assert_int_equal(embedding->nodes[i], 4 + i);
	jn_arena_free(&arena);
}

static void vertex_farther_out_than_its_cell_is_large_is_refused(void** unused) {
	(void)unused;
	JnArena arena = {0};
	const JnMesh mesh = make_mesh(JN_HEX8, 0, &arena);
	JnSurface surface = make_points(0, &arena);
	surface.nodes[3 * 17] = 1.5 + 0.2; // cells are 0.222 long
	JnEmbedding* embedding = NULL;
	assert_int_equal(jn_embedding_create(&surface, &mesh, "bodies[2].shape", &arena, &embedding), JN_OK);
	surface.nodes[3 * 17] = 1.5 + 0.25;
	surface.nodes[3 * 90 + 1] = 1000;
	embedding = NULL;
	assert_int_equal(jn_embedding_create(&surface, &mesh, "bodies[2].shape", &arena, &embedding), JN_BAD_INPUT);
	assert_null(embedding);
	assert_non_null(strstr(messages, "bodies[2].shape: vertex 17 of the surface at (1.75, "));
	assert_non_null(strstr(messages, "lies 0.25 m outside"));
	assert_non_null(strstr(messages, "2 vertices like this"));
	jn_arena_free(&arena);
}

static void quadratic_cells_are_refused(void** unused) {
	(void)unused;
	JnArena arena = {0};
	const JnMesh mesh = make_mesh(JN_TET10, 0, &arena);
	const JnSurface surface = make_points(0, &arena);
	JnEmbedding* embedding = NULL;
	assert_int_equal(jn_embedding_create(&surface, &mesh, "box", &arena, &embedding), JN_BAD_INPUT);
	assert_non_null(strstr(messages, "tet10"));
	jn_arena_free(&arena);
}

static void cell_without_volume_is_refused_by_number(void** unused) {
	(void)unused;
	JnArena arena = {0};
	double nodes[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, vertex[3] = {0.2, 0.2, 0};
	int cells[] = {0, 1, 2, 3};
	const JnMesh mesh = {.shape = JN_TET4, .node_count = 4, .nodes = nodes, .cell_count = 1, .cells = cells};
	const JnSurface surface = {.node_count = 1, .nodes = vertex};
	JnEmbedding* embedding = NULL;
	assert_int_equal(jn_embedding_create(&surface, &mesh, "flat", &arena, &embedding), JN_BAD_INPUT);
	assert_non_null(strstr(messages, "flat: cell 0 has no volume"));
	jn_arena_free(&arena);
}

#define TEST(name) cmocka_unit_test_setup(name, start)

int main(void) {
	const struct CMUnitTest tests[] = {
		TEST(vertices_inside_are_carried_by_any_affine_motion),
		TEST(vertices_in_bent_cells_are_carried_by_any_affine_motion),
		TEST(vertices_outside_are_carried_by_any_affine_motion),
		TEST(vertices_inside_have_no_negative_weight),
		TEST(vertex_follows_the_shape_functions_of_its_cube),
		TEST(vertex_outside_follows_the_nearest_cell),
		TEST(vertex_farther_out_than_its_cell_is_large_is_refused),
		TEST(quadratic_cells_are_refused),
		TEST(cell_without_volume_is_refused_by_number),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
