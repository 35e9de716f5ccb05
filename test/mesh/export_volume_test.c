// Volumes into files and back: the same nodes, cells, sets and volume; meshio reads them alike.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

#include <cmocka.h>

#include "mesh/format/export.h"
#include "mesh/format/import.h"
#include "mesh/shape/shape.h"
#include "support/support.h"

static const char* const names[] = {"mesh.msh", "mesh.vtu"};
static int plate_nodes[] = {0, 3, 7, 11}, tip_nodes[] = {3, 9}, all_nodes[1000];

/// A box with coordinates that need all digits, and three sets that overlap.
static JnMesh make(int shape, JnNodeSet sets[3], JnArena* arena) {
	JnMesh mesh;
	const JnBoxDef def = {
		.origin = {0.1, -1e-3 / 3, 1e5}, .size = {1 / 3.0, 0.7, 2}, .cells = {3, 2, 2}, .element = shape};
	assert_int_equal(jn_generate_box(&def, arena, &mesh), JN_OK);
	for (int i = 0; i < mesh.node_count; ++i) all_nodes[i] = i;
	sets[0] = (JnNodeSet){"plate", 4, plate_nodes};
	sets[1] = (JnNodeSet){"the tip", 2, tip_nodes};
	sets[2] = (JnNodeSet){"all", mesh.node_count, all_nodes};
	mesh.sets = sets;
	mesh.set_count = 3;
	return mesh;
}

static void expect_same(const JnMesh* mesh, const JnMesh* expected) {
	assert_int_equal(mesh->shape, expected->shape);
	assert_int_equal(mesh->node_count, expected->node_count);
	assert_int_equal(mesh->cell_count, expected->cell_count);
	assert_memory_equal(mesh->nodes, expected->nodes, 3 * (size_t)expected->node_count * sizeof(double));
	const int entries = expected->cell_count * jn_shape_info[expected->shape].nodes;
	assert_memory_equal(mesh->cells, expected->cells, (size_t)entries * sizeof(int));
	assert_int_equal(mesh->set_count, expected->set_count);
	for (int s = 0; s < expected->set_count; ++s) {
		assert_string_equal(mesh->sets[s].name, expected->sets[s].name);
		assert_int_equal(mesh->sets[s].count, expected->sets[s].count);
		assert_memory_equal(mesh->sets[s].nodes, expected->sets[s].nodes,
							(size_t)expected->sets[s].count * sizeof(int));
	}
	for (int cell = 0; cell < expected->cell_count; ++cell)
		assert_true(jn_mesh_cell_volume(mesh, cell) == jn_mesh_cell_volume(expected, cell));
}

static void a_round_trip_keeps_every_bit(void** state) {
	for (int shape = 0; shape < JN_SOLID_SHAPE_COUNT; ++shape)
		for (int i = 0; i < 2; ++i) {
			JnArena arena = {0};
			JnNodeSet sets[3];
			JnImport import;
			const char* path = path_join(*state, names[i]);
			const JnMesh mesh = make(shape, sets, &arena);
			log_capture();
			assert_int_equal(jn_export_volume(&mesh, path), JN_OK);
			if (jn_import(path, &arena, &import) != JN_OK) fail_msg("%s", log_text());
			assert_string_equal(log_text(), "");
			log_release();
			assert_true(import.is_volume);
			expect_same(&import.volume, &mesh);
			jn_arena_free(&arena);
		}
}

/// Several blocks of 2^20 bytes, the last not full.
static void large_arrays_are_written_in_blocks(void** state) {
	JnArena arena = {0};
	JnMesh mesh;
	JnImport import;
	const char* path = path_join(*state, "large.vtu");
	const JnBoxDef def = {.size = {1, 1, 1}, .cells = {52, 41, 30}, .element = JN_HEX8};
	assert_int_equal(jn_generate_box(&def, &arena, &mesh), JN_OK);
	assert_true(3 * sizeof(double) * (size_t)mesh.node_count > (3 << 19));
	assert_int_equal(jn_export_volume(&mesh, path), JN_OK);
	assert_int_equal(jn_import(path, &arena, &import), JN_OK);
	expect_same(&import.volume, &mesh);
	jn_arena_free(&arena);
}

/// meshio prints the sums of nodes and cells with weights that see every place and order.
static void meshio_reads_the_same_mesh(void** state) {
	static const char script[] =
		"import sys\n"
		"try: import meshio, numpy as np\n"
		"except ImportError: sys.exit(77)\n"
		"mesh = meshio.read(sys.argv[1])\n"
		"cells = [c.data for c in mesh.cells if c.type in ('tetra', 'tetra10', 'hexahedron')][0]\n"
		"flat = cells.ravel()\n"
		"points = mesh.points.ravel()\n"
		"print(len(points), len(flat), int((flat * np.arange(1, len(flat) + 1)).sum()), float(points[-1]).hex(),"
		" float(points[4]).hex(), file=open(sys.argv[2], 'w'))\n";
	file_write(path_join(*state, "read.py"), script);
	for (int k = 0; k < 2 * JN_SOLID_SHAPE_COUNT; ++k) {
		JnArena arena = {0};
		JnNodeSet sets[3];
		char command[4096];
		const char *path = path_join(*state, names[k % 2]), *words = path_join(*state, "words");
		const JnMesh mesh = make(k / 2, sets, &arena);
		assert_int_equal(jn_export_volume(&mesh, path), JN_OK);
		snprintf(command, sizeof command, "%s %s %s %s", JN_PYTHON, path_join(*state, "read.py"), path, words);
		const int ending = system(command);
		if (WIFEXITED(ending) && WEXITSTATUS(ending) == 77) skip();
		assert_int_equal(ending, 0);
		char* text = file_read(words);
		int points = 0, entries = 0;
		long long sum = 0, expected = 0;
		double last = 0, fourth = 0;
		assert_int_equal(sscanf(text, "%d %d %lld %la %la", &points, &entries, &sum, &last, &fourth), 5);
		free(text);
		assert_int_equal(points, 3 * mesh.node_count);
		assert_int_equal(entries, mesh.cell_count * jn_shape_info[mesh.shape].nodes);
		for (int i = 0; i < entries; ++i) expected += (long long)mesh.cells[i] * (i + 1);
		assert_true(sum == expected);
		assert_true(last == mesh.nodes[points - 1] && fourth == mesh.nodes[4]);
		jn_arena_free(&arena);
	}
}

static void names_of_sets_may_hold_what_xml_reserves(void** state) {
	JnArena arena = {0};
	JnNodeSet sets[3];
	JnImport import;
	JnMesh mesh = make(JN_HEX8, sets, &arena);
	sets[0].name = "a<b & \"c\"";
	const char* path = path_join(*state, "names.vtu");
	assert_int_equal(jn_export_volume(&mesh, path), JN_OK);
	assert_int_equal(jn_import(path, &arena, &import), JN_OK);
	expect_same(&import.volume, &mesh);
	log_capture();
	assert_int_equal(jn_export_volume(&mesh, path_join(*state, "names.msh")), JN_BAD_INPUT);
	assert_non_null(strstr(log_text(), "cannot hold the name"));
	log_release();
	assert_false(path_exists(path_join(*state, "names.msh")));
	jn_arena_free(&arena);
}

static void what_cannot_be_written_is_told(void** state) {
	JnArena arena = {0};
	JnNodeSet sets[3];
	const JnMesh mesh = make(JN_TET4, sets, &arena);
	log_capture();
	assert_int_equal(jn_export_volume(&mesh, path_join(*state, "mesh.obj")), JN_BAD_INPUT);
	assert_non_null(strstr(log_text(), ".msh or .vtu"));
	assert_true(jn_export_volume(&mesh, path_join(*state, "no/folder/mesh.vtu")) == JN_IO_FAILED);
	assert_true(jn_export_volume(&mesh, path_join(*state, "no/folder/mesh.msh")) < 0);
	log_release();
	jn_arena_free(&arena);
}

static int set_up(void** state) {
	static char folder[256];
	*state = folder;
	return folder_create(folder);
}

static int tear_down(void** state) {
	folder_remove(*state);
	return 0;
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_round_trip_keeps_every_bit),   cmocka_unit_test(large_arrays_are_written_in_blocks),
		cmocka_unit_test(meshio_reads_the_same_mesh),     cmocka_unit_test(names_of_sets_may_hold_what_xml_reserves),
		cmocka_unit_test(what_cannot_be_written_is_told),
	};
	return cmocka_run_group_tests_name("export_volume", tests, set_up, tear_down);
}
