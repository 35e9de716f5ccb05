// Box meshes: counts, volumes, conformity, mid-edge nodes, limits.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "mesh/shape/shape.h"

static const JnBoxDef box = {.origin = {1, -2, 3}, .size = {0.5, 0.25, 2}, .cells = {3, 2, 4}};

static JnMesh make(JnShape shape, JnArena* arena) {
	JnBoxDef def = box;
	JnMesh mesh;
	def.element = (int)shape;
	assert_int_equal(jn_generate_box(&def, arena, &mesh), JN_OK);
	assert_int_equal(mesh.shape, shape);
	return mesh;
}

static void a_box_has_the_nodes_and_cells_of_its_grid(void** unused) {
	(void)unused;
	static const int node_count[JN_SOLID_SHAPE_COUNT] = {4 * 3 * 5, 7 * 5 * 9, 4 * 3 * 5};
	static const int cell_count[JN_SOLID_SHAPE_COUNT] = {6 * 24, 6 * 24, 24};
	for (int shape = 0; shape < JN_SOLID_SHAPE_COUNT; shape++) {
		JnArena arena = {0};
		const JnMesh mesh = make(shape, &arena);
		assert_int_equal(mesh.node_count, node_count[shape]);
		assert_int_equal(mesh.cell_count, cell_count[shape]);
		bool* used = jn_arena_take(&arena, (size_t)mesh.node_count, sizeof(bool));
		for (int k = 0; k < mesh.cell_count * jn_shape_info[shape].nodes; k++) used[mesh.cells[k]] = true;
		for (int i = 0; i < mesh.node_count; i++) assert_true(used[i]);
		jn_arena_free(&arena);
	}
}

static void cells_are_positive_and_fill_the_box(void** unused) {
	(void)unused;
	for (int shape = 0; shape < JN_SOLID_SHAPE_COUNT; shape++) {
		JnArena arena = {0};
		const JnMesh mesh = make(shape, &arena);
		const double share = 0.25 / mesh.cell_count;
		for (int cell = 0; cell < mesh.cell_count; cell++) {
			// coordinates near 3 have the rounding 4e-16, edges 0.1
			assert_true(fabs(jn_mesh_cell_volume(&mesh, cell) - share) < 1e-13 * share);
		}
		jn_arena_free(&arena);
	}
}

static int compare_ints(const void* a, const void* b) {
	return (*(const int*)a > *(const int*)b) - (*(const int*)a < *(const int*)b);
}

/// A face by its nodes in rising order, so that equal faces have equal bytes.
typedef struct Face {
	int nodes[6];
} Face;

static int compare_faces(const void* a, const void* b) {
	return memcmp(a, b, sizeof(Face));
}

static bool on_boundary(const JnMesh* mesh, const Face* face, int count) {
	for (int plane = 0; plane < 6; plane++) {
		const int a = plane / 2;
		const double place = box.origin[a] + (plane % 2 == 1 ? box.size[a] : 0);
		int on = 0;
		for (int i = 0; i < count; i++) on += fabs(mesh->nodes[3 * face->nodes[i] + a] - place) < 1e-12;
		if (on == count) return true;
	}
	return false;
}

static void interior_faces_belong_to_two_cells_and_outer_faces_to_one(void** unused) {
	(void)unused;
	for (int shape = 0; shape < JN_SOLID_SHAPE_COUNT; shape++) {
		const JnShapeInfo* info = &jn_shape_info[shape];
		JnArena arena = {0};
		const JnMesh mesh = make(shape, &arena);
		const int count = mesh.cell_count * info->faces;
		Face* faces = jn_arena_take(&arena, (size_t)count, sizeof(Face));
		for (int k = 0; k < count * info->face_nodes; k++) {
			const int face = k / info->face_nodes, cell = face / info->faces;
			const int local = info->face[face % info->faces * info->face_nodes + k % info->face_nodes];
			faces[face].nodes[k % info->face_nodes] = mesh.cells[cell * info->nodes + local];
		}
		for (int k = 0; k < count; k++) qsort(faces[k].nodes, (size_t)info->face_nodes, sizeof(int), compare_ints);
		qsort(faces, (size_t)count, sizeof(Face), compare_faces);
		for (int k = 0, same = 1; k < count; k += same) {
			for (same = 1; k + same < count && compare_faces(&faces[k], &faces[k + same]) == 0;) same++;
			assert_int_equal(same, on_boundary(&mesh, &faces[k], info->face_nodes) ? 1 : 2);
		}
		jn_arena_free(&arena);
	}
}

static void faces_look_outward(void** unused) {
	(void)unused;
	for (int shape = 0; shape < JN_SOLID_SHAPE_COUNT; shape++) {
		const JnShapeInfo* info = &jn_shape_info[shape];
		JnArena arena = {0};
		const JnMesh mesh = make(shape, &arena);
		const int corners = shape == JN_HEX8 ? 8 : 4;
		for (int face = 0; face < info->faces; face++) {
			double center[3] = {0}, normal[3];
			for (int i = 0; i < corners; i++) {
				for (int a = 0; a < 3; a++) center[a] += mesh.nodes[3 * mesh.cells[i] + a] / corners;
			}
			const int* local = info->face + face * info->face_nodes;
			const double* p[3];
			for (int i = 0; i < 3; i++) p[i] = mesh.nodes + 3 * mesh.cells[local[i]];
			double outward = 0;
			for (int a = 0; a < 3; a++) {
				const int b = (a + 1) % 3, c = (a + 2) % 3;
				normal[a] = (p[1][b] - p[0][b]) * (p[2][c] - p[0][c]) - (p[1][c] - p[0][c]) * (p[2][b] - p[0][b]);
				outward += normal[a] * (p[0][a] - center[a]);
			}
			assert_true(outward > 0);
		}
		jn_arena_free(&arena);
	}
}

static void tet10_nodes_stand_in_the_middle_of_their_edges(void** unused) {
	(void)unused;
	static const int edges[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
	JnArena arena = {0};
	const JnMesh mesh = make(JN_TET10, &arena);
	for (int k = 0; k < mesh.cell_count * 18; k++) {
		const int *cell = mesh.cells + k / 18 * 10, e = k / 3 % 6, a = k % 3;
		const double p = mesh.nodes[3 * cell[edges[e][0]] + a], q = mesh.nodes[3 * cell[edges[e][1]] + a];
		assert_true(fabs(mesh.nodes[3 * cell[4 + e] + a] - 0.5 * (p + q)) < 1e-15 * 4); // one rounding near 4
	}
	jn_arena_free(&arena);
}

static void volume_of_an_inverted_cell_is_negative(void** unused) {
	(void)unused;
	for (int shape = 0; shape < JN_SOLID_SHAPE_COUNT; shape++) {
		JnArena arena = {0};
		const JnMesh mesh = make(shape, &arena);
		for (int i = 0; i < mesh.node_count; i++) mesh.nodes[3 * i] *= -1;
		assert_true(jn_mesh_cell_volume(&mesh, 0) < 0);
		jn_arena_free(&arena);
	}
}

static char last_message[2048];

static void keep_message(void* user, JnLogLevel level, const char* message) {
	(void)user, (void)level;
	snprintf(last_message, sizeof last_message, "%s", message);
}

static void a_box_with_too_many_cells_is_refused(void** unused) {
	(void)unused;
	JnArena arena = {0};
	JnMesh mesh;
	const JnBoxDef def = {.size = {1, 1, 1}, .cells = {4096, 4096, 2}, .element = JN_HEX8};
	jn_log_set_sink(keep_message, NULL);
	assert_int_equal(jn_generate_box(&def, &arena, &mesh), JN_BAD_INPUT);
	jn_log_set_sink(NULL, NULL);
	assert_non_null(strstr(last_message, "4096 x 4096 x 2"));
	assert_true(arena.used == 0);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_box_has_the_nodes_and_cells_of_its_grid),
		cmocka_unit_test(cells_are_positive_and_fill_the_box),
		cmocka_unit_test(interior_faces_belong_to_two_cells_and_outer_faces_to_one),
		cmocka_unit_test(faces_look_outward),
		cmocka_unit_test(tet10_nodes_stand_in_the_middle_of_their_edges),
		cmocka_unit_test(volume_of_an_inverted_cell_is_negative),
		cmocka_unit_test(a_box_with_too_many_cells_is_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
