// Meshes that took long are kept: where, and what happens to those that are damaged, or are others than they should be.
#include "mesh/fill/cache.h"

#include <dirent.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "mesh/fill/tetrahedra.h"
#include "mesh/format/export.h"
#include "mesh/shape/shape.h"
#include "support/support.h"
#include "surface_case.h"

static JnArena arena;
static char folder[256];
static JnSurface cube;
static JnMesh made; // what the cube becomes

static void set_variables(const char* own, const char* caches, const char* home) {
	const char* const values[] = {own, caches, home};
	static const char* const names[] = {"JOUNCE_CACHE", "XDG_CACHE_HOME", "HOME"};
	for (int i = 0; i < 3; ++i)
		if (values[i] != NULL)
			setenv(names[i], values[i], 1);
		else
			unsetenv(names[i]);
}

static int set_up(void** state) {
	(void)state;
	Words words;
	if (folder_create(folder) != 0) return -1;
	cube = surface_cube(&arena, 0, 1);
	words_keep(&words);
	const JnStatus status = jn_tetrahedra_fill(&cube, 0.5, "cube", &arena, &made);
	jn_log_set_sink(NULL, NULL);
	if (status != JN_OK) made.cell_count = 0; // without Gmsh
	return 0;
}

static int tear_down(void** state) {
	(void)state;
	jn_arena_free(&arena);
	folder_remove(folder);
	return 0;
}

/// Ask for the mesh of the cube: it is the one made without a cache, bit for bit. Whether it was kept.
static bool ask(double size) {
	JnMesh mesh;
	bool was_kept = false;
	Words words;
	words_keep(&words);
	const JnStatus status = jn_cache_tetrahedra(&cube, size, "cube", &arena, &mesh, &was_kept);
	jn_log_set_sink(NULL, NULL);
	if (status != JN_OK || words.text[0] != '\0') fail_msg("%s", words.text);
	if (size != 0.5) return was_kept;
	assert_int_equal(mesh.cell_count, made.cell_count);
	assert_memory_equal(mesh.cells, made.cells, 4 * (size_t)made.cell_count * sizeof *made.cells);
	assert_memory_equal(mesh.nodes, made.nodes, 3 * (size_t)made.node_count * sizeof *made.nodes);
	return was_kept;
}

/// The only file of a folder.
static const char* only_file(const char* path) {
	static char name[512];
	DIR* list = opendir(path);
	int count = 0;
	assert_non_null(list);
	for (const struct dirent* entry; (entry = readdir(list)) != NULL;)
		if (entry->d_name[0] != '.') {
			snprintf(name, sizeof name, "%.250s/%.250s", path, entry->d_name);
			++count;
		}
	closedir(list);
	assert_int_equal(count, 1);
	return name;
}

static void meshes_lie_where_the_environment_says(void** state) {
	(void)state;
	if (made.cell_count == 0) skip();
	char own[256], caches[256], home[256];
	snprintf(own, sizeof own, "%.200s/own", folder);
	snprintf(caches, sizeof caches, "%.200s/caches", folder);
	snprintf(home, sizeof home, "%.200s/home", folder);
	set_variables(own, caches, home);
	assert_false(ask(0.5));
	assert_true(ask(0.5));
	only_file(own);
	set_variables(NULL, caches, home);
	assert_false(ask(0.5));
	assert_true(ask(0.5));
	only_file(path_join(caches, "jounce"));
	set_variables("", "relative/paths/count/for/nothing", home);
	assert_false(ask(0.5));
	assert_true(ask(0.5));
	only_file(path_join(home, ".cache/jounce"));
}

static void no_mesh_is_kept_where_nothing_can_be(void** state) {
	(void)state;
	if (made.cell_count == 0) skip();
	char file[256];
	static char longest[5000];
	snprintf(file, sizeof file, "%.200s/a_file", folder);
	file_write(file, "in the way\n");
	memset(longest, 'a', sizeof longest - 1);
	longest[0] = '/';
	const char* const settings[][3] = {{"off", folder, folder},
									   {NULL, NULL, NULL},
									   {NULL, NULL, "relative"},
									   {file, NULL, NULL},
									   {longest, NULL, NULL}};
	for (int i = 0; i < 5; ++i) {
		set_variables(settings[i][0], settings[i][1], settings[i][2]);
		for (int k = 0; k < 2; ++k) assert_false(ask(0.5));
	}
}

static void another_size_is_another_mesh(void** state) {
	(void)state;
	if (made.cell_count == 0) skip();
	set_variables(path_join(folder, "sizes"), NULL, NULL);
	assert_false(ask(0.5));
	assert_false(ask(0.6));
	assert_true(ask(0.5));
	assert_true(ask(0.6));
}

static void a_damaged_mesh_is_made_anew(void** state) {
	(void)state;
	if (made.cell_count == 0) skip();
	char own[256];
	snprintf(own, sizeof own, "%.200s/damaged", folder);
	set_variables(own, NULL, NULL);
	assert_false(ask(0.5));
	char* whole = file_read(only_file(own));
	whole[strlen(whole) / 2] = '\0'; // cut off
	file_write(only_file(own), whole);
	free(whole);
	assert_false(ask(0.5));
	assert_true(ask(0.5));
}

static void a_mesh_of_other_cells_is_made_anew(void** state) {
	(void)state;
	if (made.cell_count == 0) skip();
	char own[256];
	JnMesh other;
	snprintf(own, sizeof own, "%.200s/others", folder);
	set_variables(own, NULL, NULL);
	assert_false(ask(0.5));
	const JnBoxDef def = {.size = {1, 1, 1}, .cells = {1, 1, 1}, .element = JN_HEX8};
	assert_int_equal(jn_generate_box(&def, &arena, &other), JN_OK);
	assert_int_equal(jn_export_volume(&other, only_file(own)), JN_OK);
	assert_false(ask(0.5));
	assert_true(ask(0.5));
	// a surface, of triangles (VTK's type 5)
	file_write(only_file(own),
			   "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\"><UnstructuredGrid>"
			   "<Piece NumberOfPoints=\"4\" NumberOfCells=\"4\"><Points><DataArray type=\"Float64\" "
			   "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points><Cells>"
			   "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 2 1 0 1 3 1 2 3 2 0 3</DataArray>"
			   "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3 6 9 12</DataArray>"
			   "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">5 5 5 5</DataArray>"
			   "</Cells></Piece></UnstructuredGrid></VTKFile>\n");
	assert_false(ask(0.5));
	assert_true(ask(0.5));
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(meshes_lie_where_the_environment_says), cmocka_unit_test(no_mesh_is_kept_where_nothing_can_be),
		cmocka_unit_test(another_size_is_another_mesh),          cmocka_unit_test(a_damaged_mesh_is_made_anew),
		cmocka_unit_test(a_mesh_of_other_cells_is_made_anew),
	};
	return cmocka_run_group_tests(tests, set_up, tear_down);
}
