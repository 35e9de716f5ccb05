// What is put right in a volume mesh, and what is refused.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#include "mesh/repair.h"
#include "mesh/shape/shape.h"
#include "support/support.h"

static JnMesh make(int shape, JnArena* arena) {
	JnMesh mesh;
	const JnBoxDef def = {.origin = {5, 0, 0}, .size = {1, 2, 1}, .cells = {2, 3, 1}, .element = shape};
	assert_int_equal(jn_generate_box(&def, arena, &mesh), JN_OK);
	return mesh;
}

static JnStatus repair(JnMesh* mesh, JnArena* arena) {
	log_capture();
	const JnStatus status = jn_mesh_repair(mesh, "box.msh", arena);
	log_release();
	return status;
}

static void expect_refusal(JnMesh* mesh, JnArena* arena, const char* words) {
	assert_int_equal(repair(mesh, arena), JN_BAD_INPUT);
	if (strncmp(log_text(), "box.msh: ", 9) != 0 || strstr(log_text(), words) == NULL)
		fail_msg("\"%s\" does not say \"%s\"", log_text(), words);
	jn_arena_free(arena);
}

static void a_good_mesh_stays_as_it_is(void** unused) {
	(void)unused;
	for (int shape = 0; shape < JN_SOLID_SHAPE_COUNT; ++shape) {
		JnArena arena = {0};
		const JnMesh before = make(shape, &arena);
		JnMesh mesh = make(shape, &arena);
		assert_int_equal(repair(&mesh, &arena), JN_OK);
		assert_string_equal(log_text(), "");
		assert_int_equal(mesh.node_count, before.node_count);
		assert_memory_equal(mesh.nodes, before.nodes, 3 * (size_t)mesh.node_count * sizeof(double));
		const size_t entries = (size_t)mesh.cell_count * (size_t)jn_shape_info[shape].nodes;
		assert_memory_equal(mesh.cells, before.cells, entries * sizeof(int));
		jn_arena_free(&arena);
	}
}

/// Mirrored, all cells are inside out; turned, they have their volume again and mid-edge nodes are in the middle.
static void cells_inside_out_are_turned(void** unused) {
	(void)unused;
	static const int edges[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
	for (int shape = 0; shape < JN_SOLID_SHAPE_COUNT; ++shape) {
		JnArena arena = {0};
		JnMesh mesh = make(shape, &arena);
		for (int i = 0; i < mesh.node_count; ++i) mesh.nodes[3 * i] *= -1;
		assert_true(jn_mesh_cell_volume(&mesh, 0) < 0);
		assert_int_equal(repair(&mesh, &arena), JN_OK);
		assert_non_null(strstr(log_text(), "cells were inside out"));
		double volume = 0;
		for (int cell = 0; cell < mesh.cell_count; ++cell) {
			assert_true(jn_mesh_cell_volume(&mesh, cell) > 0);
			volume += jn_mesh_cell_volume(&mesh, cell);
			const int* nodes = mesh.cells + cell * jn_shape_info[shape].nodes;
			for (int k = 0; k < 18 && shape == JN_TET10; ++k) {
				const double *a = mesh.nodes + 3 * nodes[edges[k / 3][0]], *b = mesh.nodes + 3 * nodes[edges[k / 3][1]];
				const double middle = mesh.nodes[3 * nodes[4 + k / 3] + k % 3];
				assert_true(fabs(middle - (a[k % 3] + b[k % 3]) / 2) < 1e-14); // rounding of numbers below 6
			}
		}
		assert_true(fabs(volume - 2) < 1e-12); // 36 cells of coordinates below 6
		jn_arena_free(&arena);
	}
}

static void unused_nodes_go_and_sets_follow(void** unused) {
	(void)unused;
	JnArena arena = {0};
	JnMesh mesh = make(JN_HEX8, &arena);
	const int last = mesh.node_count - 1;
	int all[] = {0, 1, last}, gone[] = {0};
	JnNodeSet sets[] = {{"gone", 1, gone}, {"all", 3, all}};
	mesh.sets = sets;
	mesh.set_count = 2;
	mesh.cells += 8; // without the first cell
	mesh.cell_count -= 1;
	bool is_used[100] = {false};
	for (int k = 0; k < 8 * mesh.cell_count; ++k) is_used[mesh.cells[k]] = true;
	int used = 0;
	for (int i = 0; i <= last; ++i) used += is_used[i];
	const int rank = is_used[0]; // of node 1
	double end[3];
	memcpy(end, mesh.nodes + 3 * last, sizeof end);
	assert_false(is_used[0]);
	assert_int_equal(repair(&mesh, &arena), JN_OK);
	assert_int_equal(mesh.node_count, used);
	assert_int_equal(mesh.set_count, 1);
	assert_non_null(strstr(log_text(), "\"gone\" is left out"));
	assert_string_equal(mesh.sets[0].name, "all");
	assert_int_equal(mesh.sets[0].count, 2);
	assert_int_equal(mesh.sets[0].nodes[0], rank);
	assert_int_equal(mesh.sets[0].nodes[1], used - 1);
	assert_memory_equal(mesh.nodes + 3 * (used - 1), end, sizeof end);
	jn_arena_free(&arena);
}

static void the_first_offenders_are_named(void** unused) {
	(void)unused;
	JnArena arena = {0};
	JnMesh mesh = make(JN_TET4, &arena);
	for (int cell = 10; cell < 17; ++cell) mesh.cells[4 * cell] = mesh.node_count + cell;
	expect_refusal(&mesh, &arena,
				   "7 cells with node numbers that are out of range (counted from 0: 10, 11, 12, 13, 14, ...)");
	mesh = make(JN_TET4, &arena);
	mesh.cells[4 * 3 + 2] = -1;
	expect_refusal(&mesh, &arena, "1 cell with node numbers that are out of range (counted from 0: 3)");
}

static void a_node_twice_in_a_cell_is_refused(void** unused) {
	(void)unused;
	for (int shape = 0; shape < JN_SOLID_SHAPE_COUNT; ++shape) {
		JnArena arena = {0};
		JnMesh mesh = make(shape, &arena);
		const int nodes = jn_shape_info[shape].nodes;
		mesh.cells[2 * nodes + 3] = mesh.cells[2 * nodes];
		expect_refusal(&mesh, &arena, "1 cell with a node twice (counted from 0: 2)");
	}
}

static void infinite_coordinates_are_refused(void** unused) {
	(void)unused;
	const double bad[] = {NAN, INFINITY, -INFINITY};
	for (int i = 0; i < 3; ++i) {
		JnArena arena = {0};
		JnMesh mesh = make(JN_TET10, &arena);
		mesh.nodes[3 * 4 + i] = bad[i];
		expect_refusal(&mesh, &arena, "1 node with coordinates that are not finite (counted from 0: 4)");
	}
}

static void nodes_at_one_place_are_refused(void** unused) {
	(void)unused;
	JnArena arena = {0};
	JnMesh mesh = make(JN_HEX8, &arena);
	// two cells that share no node: the second has copies of the first one's face
	static double nodes[48] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
	static int cells[16];
	for (int i = 0; i < 16; ++i) cells[i] = i;
	for (int i = 0; i < 24; ++i) nodes[24 + i] = nodes[i] + (i % 3 == 2);
	mesh.nodes = nodes, mesh.node_count = 16, mesh.cells = cells, mesh.cell_count = 2;
	expect_refusal(&mesh, &arena, "4 nodes at the place of another");
}

static void cells_without_volume_are_refused(void** unused) {
	(void)unused;
	for (int shape = 0; shape < JN_SOLID_SHAPE_COUNT; ++shape) {
		JnArena arena = {0};
		JnMesh mesh = make(shape, &arena);
		for (int i = 0; i < mesh.node_count; ++i) {
			mesh.nodes[3 * i] += 1e-3 * i; // no two at one place, all in one plane
			mesh.nodes[3 * i + 2] = 2 * mesh.nodes[3 * i];
		}
		expect_refusal(&mesh, &arena, "without volume");
	}
}

/// Half a millimetre of a metre is thin, not flat.
static void thin_cells_are_let_through(void** unused) {
	(void)unused;
	JnArena arena = {0};
	JnMesh mesh = make(JN_HEX8, &arena);
	for (int i = 0; i < mesh.node_count; ++i) mesh.nodes[3 * i + 2] *= 5e-4;
	assert_int_equal(repair(&mesh, &arena), JN_OK);
	jn_arena_free(&arena);
}

/// VTK's voxel counts its corners otherwise: 2 and 3, 6 and 7 are exchanged.
static void hexahedra_with_crossed_corners_are_refused(void** unused) {
	(void)unused;
	JnArena arena = {0};
	JnMesh mesh = make(JN_HEX8, &arena);
	for (int k = 2; k < 8; k += 4) {
		const int swap = mesh.cells[k];
		mesh.cells[k] = mesh.cells[k + 1];
		mesh.cells[k + 1] = swap;
	}
	expect_refusal(&mesh, &arena, "(counted from 0: 0)");
}

static void a_mesh_without_cells_is_refused(void** unused) {
	(void)unused;
	JnArena arena = {0};
	JnMesh mesh = make(JN_HEX8, &arena);
	mesh.cell_count = 0;
	expect_refusal(&mesh, &arena, "no cells");
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_good_mesh_stays_as_it_is),
		cmocka_unit_test(cells_inside_out_are_turned),
		cmocka_unit_test(unused_nodes_go_and_sets_follow),
		cmocka_unit_test(the_first_offenders_are_named),
		cmocka_unit_test(a_node_twice_in_a_cell_is_refused),
		cmocka_unit_test(infinite_coordinates_are_refused),
		cmocka_unit_test(nodes_at_one_place_are_refused),
		cmocka_unit_test(cells_without_volume_are_refused),
		cmocka_unit_test(thin_cells_are_let_through),
		cmocka_unit_test(hexahedra_with_crossed_corners_are_refused),
		cmocka_unit_test(a_mesh_without_cells_is_refused),
	};
	return cmocka_run_group_tests_name("repair", tests, NULL, NULL);
}
