// Middle nodes: the same counts, volumes and node sets as a box that was generated with them.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "mesh/fill/quadratic.h"
#include "mesh/shape/shape.h"

static const JnBoxDef box = {.size = {1, 2, 3}, .cells = {2, 3, 2}};

static JnMesh make_box(JnShape shape, JnArena* arena) {
	JnBoxDef def = box;
	JnMesh mesh;
	def.element = (int)shape;
	assert_int_equal(jn_generate_box(&def, arena, &mesh), JN_OK);
	return mesh;
}

static void counts_are_those_of_a_generated_box(void** unused) {
	(void)unused;
	JnArena arena = {0};
	const JnMesh tet4 = make_box(JN_TET4, &arena), expected = make_box(JN_TET10, &arena);
	JnMesh tet10;
	assert_int_equal(jn_mesh_add_middles(&tet4, &arena, &tet10), JN_OK);
	assert_int_equal(tet10.shape, JN_TET10);
	assert_int_equal(tet10.node_count, expected.node_count);
	assert_int_equal(tet10.cell_count, expected.cell_count);
	jn_arena_free(&arena);
}

// Halves of sums of doubles of similar size are exact but for the last bit.
static void every_middle_lies_between_its_corners(void** unused) {
	(void)unused;
	static const int ends[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
	JnArena arena = {0};
	const JnMesh tet4 = make_box(JN_TET4, &arena);
	JnMesh tet10;
	assert_int_equal(jn_mesh_add_middles(&tet4, &arena, &tet10), JN_OK);
	for (int cell = 0; cell < tet10.cell_count; ++cell) {
		const int* nodes = tet10.cells + 10 * cell;
		for (int k = 0; k < 18; ++k) {
			const double* X = tet10.nodes + k % 3;
			const double middle = (X[3 * nodes[ends[k / 3][0]]] + X[3 * nodes[ends[k / 3][1]]]) / 2;
			assert_true(fabs(X[3 * nodes[4 + k / 3]] - middle) < 1e-15 * 3);
		}
		assert_true(jn_mesh_cell_volume(&tet10, cell) == jn_mesh_cell_volume(&tet4, cell));
	}
	jn_arena_free(&arena);
}

static void a_node_set_gains_the_middles_between_its_nodes(void** unused) {
	(void)unused;
	JnArena arena = {0};
	JnMesh tet4 = make_box(JN_TET4, &arena), tet10;
	int nodes[64];
	JnNodeSet bottom = {.name = "bottom", .nodes = nodes};
	for (int i = 0; i < tet4.node_count; ++i)
		if (tet4.nodes[3 * i + 1] == 0) nodes[bottom.count++] = i;
	tet4.set_count = 1;
	tet4.sets = &bottom;
	assert_int_equal(jn_mesh_add_middles(&tet4, &arena, &tet10), JN_OK);
	int on_bottom = 0;
	for (int i = 0; i < tet10.node_count; ++i) on_bottom += tet10.nodes[3 * i + 1] == 0;
	assert_int_equal(tet10.set_count, 1);
	assert_string_equal(tet10.sets[0].name, "bottom");
	assert_int_equal(tet10.sets[0].count, on_bottom);
	for (int i = 0; i < tet10.sets[0].count; ++i) {
		assert_true(tet10.nodes[3 * tet10.sets[0].nodes[i] + 1] == 0);
		if (i > 0) assert_true(tet10.sets[0].nodes[i] > tet10.sets[0].nodes[i - 1]);
	}
	jn_arena_free(&arena);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(counts_are_those_of_a_generated_box),
		cmocka_unit_test(every_middle_lies_between_its_corners),
		cmocka_unit_test(a_node_set_gains_the_middles_between_its_nodes),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
