// Volumes from files: written by meshio and by hand in nineteen codings (volume_files.py), read bit by bit; broken ones.
#include <dirent.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

#include <cmocka.h>

#include "mesh/format/import.h"
#include "mesh/shape/shape.h"
#include "support/support.h"

static const char* const shape_names[JN_SOLID_SHAPE_COUNT] = {"tet4", "tet10", "hex8"};

/// What all tests share: a folder of files, and the meshes that they hold.
typedef struct Files {
	char folder[256];
	JnArena arena;
	JnMesh meshes[JN_SOLID_SHAPE_COUNT];
	bool have_python;
} Files;

static void write_mesh(const Files* files, const JnMesh* mesh) {
	char name[64];
	snprintf(name, sizeof name, "nodes_%s.txt", shape_names[mesh->shape]);
	FILE* file = fopen(path_join(files->folder, name), "w");
	assert_non_null(file);
	for (int i = 0; i < 3 * mesh->node_count; ++i) fprintf(file, "%.17g%c", mesh->nodes[i], i % 3 == 2 ? '\n' : ' ');
	fclose(file);
	snprintf(name, sizeof name, "cells_%s.txt", shape_names[mesh->shape]);
	file = fopen(path_join(files->folder, name), "w");
	assert_non_null(file);
	const int each = jn_shape_info[mesh->shape].nodes;
	for (int i = 0; i < each * mesh->cell_count; ++i)
		fprintf(file, "%d%c", mesh->cells[i], i % each == each - 1 ? '\n' : ' ');
	fclose(file);
}

static int set_up(void** state) {
	static Files files;
	char command[1024];
	if (folder_create(files.folder) != 0) return -1;
	for (int shape = 0; shape < JN_SOLID_SHAPE_COUNT; ++shape) {
		// eighths: exact in a float and in eleven digits of text
		const JnBoxDef def = {.origin = {1, -2, 0.5}, .size = {1, 0.5, 1.5}, .cells = {2, 1, 3}, .element = shape};
		if (jn_generate_box(&def, &files.arena, &files.meshes[shape]) != JN_OK) return -1;
		write_mesh(&files, &files.meshes[shape]);
	}
	snprintf(command, sizeof command, "%s %s/test/mesh/volume_files.py %s", JN_PYTHON, JN_SOURCE_DIR, files.folder);
	const int ending = system(command);
	files.have_python = WIFEXITED(ending) && WEXITSTATUS(ending) == 0;
	if (!files.have_python && !(WIFEXITED(ending) && WEXITSTATUS(ending) == 77)) return -1;
	*state = &files;
	return 0;
}

static int tear_down(void** state) {
	Files* files = *state;
	folder_remove(files->folder);
	jn_arena_free(&files->arena);
	return 0;
}

static void expect_same(const JnMesh* mesh, const JnMesh* expected, const char* name) {
	const size_t entries = (size_t)expected->cell_count * (size_t)jn_shape_info[expected->shape].nodes;
	if (mesh->shape != expected->shape || mesh->node_count != expected->node_count ||
		mesh->cell_count != expected->cell_count)
		fail_msg("%s: shape %d with %d nodes and %d cells", name, mesh->shape, mesh->node_count, mesh->cell_count);
	if (memcmp(mesh->nodes, expected->nodes, 3 * (size_t)expected->node_count * sizeof(double)) != 0)
		fail_msg("%s: other coordinates", name);
	if (memcmp(mesh->cells, expected->cells, entries * sizeof(int)) != 0) fail_msg("%s: other cells", name);
}

/// Call `check` for each file whose name begins with `prefix`; how many there were.
static int for_each(const Files* files, const char* prefix, void (*check)(const Files*, const char* name)) {
	DIR* folder = opendir(files->folder);
	int count = 0;
	assert_non_null(folder);
	for (const struct dirent* entry; (entry = readdir(folder)) != NULL;)
		if (strncmp(entry->d_name, prefix, strlen(prefix)) == 0) {
			check(files, entry->d_name);
			++count;
		}
	closedir(folder);
	return count;
}

static void check_good(const Files* files, const char* name) {
	JnArena arena = {0};
	JnImport import;
	int shape = 0;
	while (strncmp(name + 5, shape_names[shape], strlen(shape_names[shape])) != 0 ||
		   name[5 + strlen(shape_names[shape])] != '_')
		++shape;
	log_capture();
	if (jn_import(path_join(files->folder, name), &arena, &import) != JN_OK) fail_msg("%s: %s", name, log_text());
	log_release();
	assert_true(import.is_volume);
	expect_same(&import.volume, &files->meshes[shape], name);
	jn_arena_free(&arena);
}

static void every_coding_of_every_shape_is_read_bit_by_bit(void** state) {
	const Files* files = *state;
	if (!files->have_python) skip();
	assert_int_equal(for_each(files, "good_", check_good), 19 * JN_SOLID_SHAPE_COUNT);
}

/// The nodes with the lowest y are marked by an array "set:low" in the files written by hand.
static void point_data_of_vtu_become_node_sets(void** state) {
	const Files* files = *state;
	if (!files->have_python) skip();
	static const char* const names[] = {"good_tet10_vtu_raw.vtu", "good_tet10_vtu_appended_zlib_big.vtu"};
	for (int i = 0; i < 2; ++i) {
		JnArena arena = {0};
		JnImport import;
		assert_int_equal(jn_import(path_join(files->folder, names[i]), &arena, &import), JN_OK);
		assert_int_equal(import.volume.set_count, 1);
		const JnNodeSet* set = &import.volume.sets[0];
		assert_string_equal(set->name, "low");
		int expected = 0;
		for (int node = 0; node < import.volume.node_count; ++node)
			if (import.volume.nodes[3 * node + 1] == -2) assert_int_equal(set->nodes[expected++], node);
		assert_int_equal(set->count, expected);
		jn_arena_free(&arena);
	}
}

static void check_bad(const Files* files, const char* name) {
	JnArena arena = {0};
	JnImport import;
	const char* path = path_join(files->folder, name);
	log_capture();
	const JnStatus status = jn_import(path, &arena, &import);
	if (status != JN_BAD_INPUT) fail_msg("%s: %s", name, jn_status_name(status));
	if (strncmp(log_text(), path, strlen(path)) != 0) fail_msg("%s: the message is \"%s\"", name, log_text());
	log_release();
	jn_arena_free(&arena);
}

static void every_broken_file_is_refused_with_its_name(void** state) {
	const Files* files = *state;
	if (!files->have_python) skip();
	assert_in_range(for_each(files, "bad_", check_bad), 19 * 10, 1000);
}

/// Files with a few bytes changed by chance may be read or refused.
static void check_noise(const Files* files, const char* name) {
	const bool is_gmsh = strstr(name, ".msh") != NULL; // reading costs a process
	const char* path = path_join(files->folder, name);
	char target[300];
	snprintf(target, sizeof target, "%s/noise%s", files->folder, strrchr(name, '.'));
	FILE* file = fopen(path, "rb");
	char data[1 << 15], copy[1 << 15];
	const size_t size = fread(data, 1, sizeof data, file);
	fclose(file);
	uint32_t seed = 1;
	for (int attempt = 0; attempt < (is_gmsh ? 4 : 200); ++attempt) {
		memcpy(copy, data, size);
		for (int k = 0; k <= attempt % 4; ++k) {
			seed = seed * 1664525u + 1013904223u;
			copy[(seed >> 8) % size] = (char)(attempt % 2 == 0 ? '0' + (seed >> 4) % 10 : seed >> 24);
		}
		file = fopen(target, "wb");
		assert_int_equal(fwrite(copy, 1, size, file), size);
		fclose(file);
		JnArena arena = {0};
		JnImport import;
		const JnStatus status = jn_import(target, &arena, &import);
		assert_true(status == JN_OK || status == JN_BAD_INPUT);
		jn_arena_free(&arena);
	}
}

static void random_bytes_crash_nothing(void** state) {
	const Files* files = *state;
	if (!files->have_python) skip();
	log_capture();
	assert_int_equal(for_each(files, "good_tet4_", check_noise), 19);
	log_release();
}

/// Import a text as a file of that name; what it says when it fails is in log_text().
static JnStatus import_text(const Files* files, const char* name, const char* text, JnArena* arena, JnImport* import) {
	const char* path = path_join(files->folder, name);
	file_write(path, text);
	log_capture();
	const JnStatus status = jn_import(path, arena, import);
	log_release();
	return status;
}

#define MSH_HEAD "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
#define TET_NODES "$Nodes\n5\n70 0 0 1\n10 0 0 0\n30 0 1 0\n20 1 0 0\n99 5 5 5\n$EndNodes\n"

static void physical_groups_of_all_dimensions_become_node_sets(void** state) {
	JnArena arena = {0};
	JnImport import;
	static const char text[] = MSH_HEAD
		"$PhysicalNames\n3\n0 1 \"tip\"\n2 2 \"plate\"\n3 3 \"body\"\n$EndPhysicalNames\n" TET_NODES
		"$Elements\n4\n1 15 2 1 1 70\n2 2 2 2 1 10 20 30\n3 1 2 7 1 10 70\n8 4 2 3 1 10 20 30 70\n$EndElements\n";
	assert_int_equal(import_text(*state, "groups.msh", text, &arena, &import), JN_OK);
	const JnMesh* mesh = &import.volume;
	assert_int_equal(mesh->node_count, 4); // 99 is in no cell
	static const struct {
		const char* name;
		int count, nodes[4];
	} expected[] = {{"tip", 1, {3}}, {"curve_7", 2, {0, 3}}, {"plate", 3, {0, 1, 2}}, {"body", 4, {0, 1, 2, 3}}};
	assert_int_equal(mesh->set_count, 4);
	for (int s = 0; s < 4; ++s) {
		assert_string_equal(mesh->sets[s].name, expected[s].name);
		assert_int_equal(mesh->sets[s].count, expected[s].count);
		assert_memory_equal(mesh->sets[s].nodes, expected[s].nodes, (size_t)expected[s].count * sizeof(int));
	}
	jn_arena_free(&arena);
}

static void nodes_are_numbered_in_the_order_of_their_tags(void** state) {
	JnArena arena = {0};
	JnImport import;
	static const char text[] = MSH_HEAD TET_NODES "$Elements\n1\n1 4 2 0 1 10 20 30 70\n$EndElements\n";
	static const double nodes[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
	assert_int_equal(import_text(*state, "order.msh", text, &arena, &import), JN_OK);
	assert_memory_equal(import.volume.nodes, nodes, sizeof nodes);
	jn_arena_free(&arena);
}

static void cells_inside_out_are_turned_and_told(void** state) {
	JnArena arena = {0};
	JnImport import;
	static const char text[] = MSH_HEAD TET_NODES "$Elements\n1\n1 4 2 0 1 20 10 30 70\n$EndElements\n";
	assert_int_equal(import_text(*state, "turned.msh", text, &arena, &import), JN_OK);
	assert_true(jn_mesh_cell_volume(&import.volume, 0) > 0.1);
	assert_non_null(strstr(log_text(), "1 of 1 cells were inside out"));
	jn_arena_free(&arena);
}

static void triangles_alone_are_a_surface(void** state) {
	JnArena arena = {0};
	JnImport import;
	static const char text[] = MSH_HEAD TET_NODES
		"$Elements\n4\n1 2 2 0 1 10 30 20\n2 2 2 0 1 10 20 70\n3 2 2 0 1 20 30 70\n4 2 2 0 1 10 70 30\n$EndElements\n";
	assert_int_equal(import_text(*state, "surface.msh", text, &arena, &import), JN_OK);
	assert_false(import.is_volume);
	assert_int_equal(import.surface.triangle_count, 4);
	assert_true(fabs(jn_surface_volume(&import.surface) - 1.0 / 6) < 1e-15); // a few roundings of numbers below 1
	jn_arena_free(&arena);
}

static void expect_refusal(const Files* files, const char* name, const char* text, const char* words) {
	JnArena arena = {0};
	JnImport import;
	assert_int_equal(import_text(files, name, text, &arena, &import), JN_BAD_INPUT);
	if (strstr(log_text(), words) == NULL) fail_msg("%s does not say \"%s\"", log_text(), words);
	jn_arena_free(&arena);
}

static void what_jounce_cannot_simulate_is_named(void** state) {
	const Files* files = *state;
	static const char nodes[] =
		MSH_HEAD "$Nodes\n8\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n$EndNodes\n";
	char text[1000];
	snprintf(text, sizeof text, "%s%s", nodes, "$Elements\n1\n1 6 2 0 1 1 2 3 5 6 7\n$EndElements\n");
	expect_refusal(files, "prism.msh", text, "cells of Gmsh's type 6; jounce knows tet4, tet10 or hex8");
	snprintf(text, sizeof text, "%s%s", nodes,
			 "$Elements\n2\n1 5 2 0 1 1 2 3 4 5 6 7 8\n2 4 2 0 1 1 2 3 5\n$EndElements\n");
	expect_refusal(files, "mixed.msh", text, "several types");
	snprintf(text, sizeof text, "%s%s", nodes, "$Elements\n1\n1 1 2 0 1 1 2\n$EndElements\n");
	expect_refusal(files, "line.msh", text, "neither volume cells nor triangles");
	expect_refusal(files, "old.msh", "$MeshFormat\n4.0 0 8\n$EndMeshFormat\n",
				   "is MSH 4; save it as version 2.2 or 4.1");
	expect_refusal(files, "script.msh", "SystemCall \"true\"; // a script of Gmsh's",
				   "does not begin with $MeshFormat");
	expect_refusal(files, "grid.vtk", "# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\n", "POLYDATA");
	expect_refusal(
		files, "mixed.vtk",
		"# vtk DataFile Version 3.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\n"
		"CELLS 2 9\n4 0 1 2 3 3 0 1 2\nCELL_TYPES 2\n10 13\n",
		"several types (VTK's 10 and 13)");
	expect_refusal(files, "lz4.vtu", "<VTKFile type=\"UnstructuredGrid\" compressor=\"vtkLZ4DataCompressor\"/>",
				   "zlib");
	expect_refusal(files, "image.vtu", "<VTKFile type=\"ImageData\"/>", "UnstructuredGrid");
	static const char piece[] = "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"/>";
	snprintf(text, sizeof text,
			 "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>%s%s</UnstructuredGrid></VTKFile>", piece, piece);
	expect_refusal(files, "pieces.vtu", text, "several pieces");
}

static void entities_are_not_expanded(void** state) {
	expect_refusal(*state, "bomb.vtu",
				   "<?xml version=\"1.0\"?><!DOCTYPE x [<!ENTITY a SYSTEM \"/etc/passwd\">]><VTKFile>&a;</VTKFile>",
				   "document type");
}

static void a_file_that_is_not_there_is_an_io_error(void** state) {
	const Files* files = *state;
	static const char* const names[] = {"none.msh", "none.vtk", "none.vtu"};
	for (int i = 0; i < 3; ++i) {
		JnArena arena = {0};
		JnImport import;
		log_capture();
		assert_int_equal(jn_import(path_join(files->folder, names[i]), &arena, &import), JN_IO_FAILED);
		assert_non_null(strstr(log_text(), names[i]));
		log_release();
		jn_arena_free(&arena);
	}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(every_coding_of_every_shape_is_read_bit_by_bit),
		cmocka_unit_test(point_data_of_vtu_become_node_sets),
		cmocka_unit_test(every_broken_file_is_refused_with_its_name),
		cmocka_unit_test(random_bytes_crash_nothing),
		cmocka_unit_test(physical_groups_of_all_dimensions_become_node_sets),
		cmocka_unit_test(nodes_are_numbered_in_the_order_of_their_tags),
		cmocka_unit_test(cells_inside_out_are_turned_and_told),
		cmocka_unit_test(triangles_alone_are_a_surface),
		cmocka_unit_test(what_jounce_cannot_simulate_is_named),
		cmocka_unit_test(entities_are_not_expanded),
		cmocka_unit_test(a_file_that_is_not_there_is_an_io_error),
	};
	return cmocka_run_group_tests_name("import_volume", tests, set_up, tear_down);
}
