// Mesh files of a few lines, written here: what VTK 9, Gmsh and modellers write beside cells, surfaces in volume formats, and
// damage of each kind with the words that tell of it.
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cmocka.h>

#include "mesh/format/export.h"
#include "mesh/format/import.h"
#include "mesh/shape/shape.h"
#include "support/support.h"

static char folder[256];
static JnArena arena;

static int set_up(void** state) {
	(void)state;
	return folder_create(folder);
}

static int tear_down(void** state) {
	(void)state;
	jn_arena_free(&arena);
	folder_remove(folder);
	return 0;
}

static JnStatus import(const char* name, const char* text, JnImport* out) {
	file_write(path_join(folder, name), text);
	*out = (JnImport){0};
	log_capture();
	const JnStatus status = jn_import(path_join(folder, name), &arena, out);
	log_release();
	return status;
}

static void expect_read(const char* name, const char* text, JnImport* out) {
	if (import(name, text, out) != JN_OK) fail_msg("%s: %s", name, log_text());
}

/// A file and a part of what is said of it; it is named first.
typedef struct Damage {
	const char *name, *text, *words;
} Damage;

static void expect_refusals(const Damage* list) {
	for (const Damage* d = list; d->name != NULL; ++d) {
		JnImport unused;
		if (import(d->name, d->text, &unused) != JN_BAD_INPUT) fail_msg("%s (%s) is taken", d->name, d->words);
		if (strstr(log_text(), d->name) == NULL || strstr(log_text(), d->words) == NULL)
			fail_msg("'%s' is not in: %s", d->words, log_text());
	}
}

// ---- VTK

#define VTK_HEAD "# vtk DataFile Version 5.1\nwritten by hand\nASCII\nDATASET UNSTRUCTURED_GRID\n"
#define VTK_POINTS "POINTS 4 double\n0 0 0 1 0 0 0 1 0 0 0 1\n"
#define VTK_METADATA "METADATA\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0 1\n\n"

static void metadata_of_vtk_9_are_passed_over(void** state) {
	(void)state;
	JnImport out;
	expect_read("metadata.vtk",
				VTK_HEAD VTK_POINTS VTK_METADATA "CELLS 2 4\nOFFSETS vtktypeint64\n0 4\nCONNECTIVITY vtktypeint64\n"
												 "0 1 2 3\nCELL_TYPES 1\n10\n",
				&out);
	assert_true(out.is_volume);
	assert_int_equal(out.volume.shape, JN_TET4);
	assert_true(jn_mesh_cell_volume(&out.volume, 0) == 1.0 / 6); // of 0 and 1: exact
}

// The tetrahedron's four faces.
#define FACES "3 0 2 1 3 0 1 3 3 1 2 3 3 2 0 3\n"

static void triangles_in_a_vtk_file_are_a_surface(void** state) {
	(void)state;
	JnImport out;
	expect_read("faces.vtk", VTK_HEAD VTK_POINTS "CELLS 4 16\n" FACES "CELL_TYPES 4\n5 5 5 5\n", &out);
	assert_false(out.is_volume);
	assert_int_equal(out.surface.triangle_count, 4);
	assert_int_equal(out.surface.node_count, 4);
	const double volume = jn_surface_volume(&out.surface);
	if (!(volume > 1.0 / 6 - 1e-15 && volume < 1.0 / 6 + 1e-15)) fail_msg("volume %.17g, expected 1/6", volume);
}

static void cells_of_vtk_that_cannot_be_are_named(void** state) {
	(void)state;
	expect_refusals((const Damage[]){
		{"lines.vtk", VTK_HEAD VTK_POINTS "CELLS 1 3\n2 0 1\nCELL_TYPES 1\n3\n", "neither volume cells nor triangles"},
		{"squares.vtk", VTK_HEAD VTK_POINTS "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n9\n", "cells of VTK's type 9"},
		{"wedge.vtk", VTK_HEAD VTK_POINTS "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n13\n", "cells of VTK's type 13"},
		{"mixed.vtk", VTK_HEAD VTK_POINTS "CELLS 2 10\n4 0 1 2 3 4 0 1 2 3\nCELL_TYPES 2\n10 13\n",
		 "cells of several types (VTK's 10 and 13)"},
		{"offsets.vtk",
		 VTK_HEAD VTK_POINTS "CELLS 2 4\nOFFSETS vtktypeint64\n1 4\nCONNECTIVITY vtktypeint64\n0 1 2 3\n"
							 "CELL_TYPES 1\n10\n",
		 "OFFSETS does not begin with 0"},
		{"field.vtk", VTK_HEAD "FIELD data 1\nmass 40 40 double\n1 2 3\n" VTK_POINTS,
		 "an array of FIELD is longer than the file"},
		{NULL, NULL, NULL},
	});
}

// Nodes 5 and 6 of the upper face have changed places: straight-sided corners then have volumes of both signs.
static void a_hexahedron_whose_nodes_are_in_another_order_is_named(void** state) {
	(void)state;
	expect_refusals((const Damage[]){
		{"folded.vtk",
		 VTK_HEAD "POINTS 8 double\n0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 1 1 1 0 1 0 1 1\n"
				  "CELLS 1 9\n8 0 1 2 3 4 5 6 7\nCELL_TYPES 1\n12\n",
		 "hex8 cell"},
		{NULL, NULL, NULL},
	});
	log_expect("partly inside out; is the order of nodes that of the format?");
}

static void a_piece_of_vtu_without_points_is_passed_over(void** state) {
	(void)state;
	JnImport unused;
	assert_int_equal(import("empty.vtu",
							"<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>"
							"<Piece NumberOfPoints=\"0\" NumberOfCells=\"0\"/></UnstructuredGrid></VTKFile>\n",
							&unused),
					 JN_BAD_INPUT);
	log_expect("empty.vtu: has no Piece with points");
}

// ---- Gmsh

#define MSH_HEAD "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
#define MSH_NODES "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n"
#define MSH_ELEMENTS "$Elements\n1\n1 4 2 0 1 1 2 3 4\n$EndElements\n"

static void heads_of_msh_that_no_gmsh_writes_are_refused(void** state) {
	(void)state;
	expect_refusals((const Damage[]){
		{"script.msh", "Point(1) = {0, 0, 0};   // a script of Gmsh\n", "does not begin with $MeshFormat"},
		{"none.msh", "$MeshFormat\nno version at all\n$EndMeshFormat\n", "has no version below $MeshFormat"},
		{"old.msh", "$MeshFormat\n1 0 8\n$EndMeshFormat\n", "is MSH 1; save it as version 2.2 or 4.1"},
		{"between.msh", "$MeshFormat\n4 0 8\n$EndMeshFormat\n", "is MSH 4; save it as version 2.2 or 4.1"},
		{"small.msh", "$MeshFormat\n2.2 0 4\n$EndMeshFormat\n" MSH_NODES, "a file type 0 or a number size 4"},
		{"type.msh", "$MeshFormat\n2.2 3 8\n$EndMeshFormat\n" MSH_NODES, "a file type 3 or a number size 8"},
		{"words.msh", MSH_HEAD "$Nodes\nmany\n$EndNodes\n" MSH_ELEMENTS, "$Nodes does not begin with its counts"},
		{"count.msh", MSH_HEAD "$Nodes\n40000\n$EndNodes\n" MSH_ELEMENTS, "more than its"},
		{"lines.msh", MSH_HEAD "$Nodes\n4\n1 0 0 0\n$EndNodes\n" MSH_ELEMENTS, "lines where its counts ask for"},
		{"short.msh", "$MeshFormat\n4.1 1 8\n$EndMeshFormat\n$Nodes\n1234567$EndNodes\n" MSH_ELEMENTS,
		 "$Nodes does not begin with its counts"},
		{"cut.msh", MSH_HEAD "$Nodes\n4\n1 0 0 0\n", "the file is cut off"},
		{"bare.msh", MSH_HEAD MSH_NODES, "has no section $Elements"},
		{NULL, NULL, NULL},
	});
}

static bool has_gmsh(void) {
	JnImport out;
	return import("good.msh", MSH_HEAD MSH_NODES MSH_ELEMENTS, &out) == JN_OK;
}

static void contents_of_msh_that_cannot_be_are_refused(void** state) {
	(void)state;
	if (!has_gmsh()) skip();
	expect_refusals((const Damage[]){
		{"twice.msh", MSH_HEAD "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n3 0 0 1\n$EndNodes\n" MSH_ELEMENTS, "twice.msh"},
		{"missing.msh", MSH_HEAD MSH_NODES "$Elements\n1\n1 4 2 0 1 1 2 3 9\n$EndElements\n", "missing.msh"},
		{"wedge.msh", MSH_HEAD MSH_NODES "$Elements\n1\n1 7 2 0 1 1 2 3 4 1\n$EndElements\n", "cells of Gmsh's type 7"},
		{"line.msh", MSH_HEAD MSH_NODES "$Elements\n1\n1 1 2 0 1 1 2\n$EndElements\n",
		 "holds neither volume cells nor triangles"},
		{"square.msh", MSH_HEAD MSH_NODES "$Elements\n1\n1 3 2 0 1 1 2 3 4\n$EndElements\n",
		 "jounce knows flat triangles"},
		{"nan.msh", MSH_HEAD "$Nodes\n4\n1 0 0 nan\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n" MSH_ELEMENTS, "nan.msh"},
		{NULL, NULL, NULL},
	});
}

// ---- surfaces

#define PLY(rest) "ply\nformat ascii 1.0\n" rest
#define PLY_VERTICES "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
#define PLY_FACES "element face 1\nproperty list uchar int vertex_indices\n"
#define TEN(x) x x x x x x x x x x

static void headers_of_ply_that_cannot_be_are_named_with_their_line(void** state) {
	(void)state;
	expect_refusals((const Damage[]){
		{"other.ply", "plyometric\n", "does not begin with 'ply'"},
		{"orphan.ply", PLY("property float x\nend_header\n"), "orphan.ply:3: 'property float x' is not understood"},
		{"type.ply", PLY("element vertex 1\nproperty half x\nend_header\n"), ":4: 'property half x' is not understood"},
		{"list.ply", PLY("element face 1\nproperty list half int vertex_index\nend_header\n"),
		 ":4: 'property list half"},
		{"values.ply", PLY("element face 1\nproperty list uchar half vertex_index\nend_header\n"),
		 ":4: 'property list"},
		{"half.ply", PLY("element vertex 1\nproperty float\nend_header\n"), ":4: 'property float' is not understood"},
		{"negative.ply", PLY("element vertex -1\nend_header\n"), ":3: 'element vertex -1' is not understood"},
		{"many.ply", PLY(TEN("element a 0\n") TEN("element b 0\n") "end_header\n"),
		 ":19: 'element b 0' is not understood"},
		{"wide.ply",
		 PLY("element vertex 1\n" TEN("property int a\n") TEN("property int b\n") TEN("property int c\n")
				 TEN("property int d\n") TEN("property int e\n") TEN("property int f\n")
					 TEN("property int g\n") "end_header\n"),
		 ":68: 'property int g' is not understood"},
		{"early.ply", "ply\nend_header\n", ":2: 'end_header' is not understood"},
		{"endless.ply", PLY(PLY_VERTICES), "the header does not end"},
		{NULL, NULL, NULL},
	});
}

static void contents_of_ply_that_do_not_fit_are_refused(void** state) {
	(void)state;
	expect_refusals((const Damage[]){
		{"few.ply", PLY(PLY_VERTICES PLY_FACES "end_header\n0 0 0\n1 0 0\n0 x 0\n3 0 1 2\n"),
		 "vertex 2 of 3 is cut off or has no numbers"},
		{"more.ply", PLY(PLY_VERTICES PLY_FACES "end_header\n0 0 0\n1 0 0 7\n0 1 0\n3 0 1 2\n"),
		 "vertex 1 of 3 has more numbers than the header says"},
		{"listless.ply", PLY(PLY_VERTICES PLY_FACES "end_header\n0 0 0\n1 0 0\n0 1 0\nthree 0 1 2\n"),
		 "face 0 of 1 is cut off or has no numbers"},
		{"long.ply", PLY(PLY_VERTICES PLY_FACES "end_header\n0 0 0\n1 0 0\n0 1 0\n300 0 1 2\n"),
		 "face 0 of 1 has a list longer than the file"},
		{"minus.ply", PLY(PLY_VERTICES PLY_FACES "end_header\n0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n"),
		 "face 0 of 1 has a list longer than the file"},
		{"absent.ply", PLY(PLY_VERTICES PLY_FACES "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
		 "face 0 of 1 names a vertex that is not there"},
		{"cut.ply", PLY("element vertex 3000\nproperty float x\nend_header\n0\n"), "declares 3000 of 'vertex'"},
		{NULL, NULL, NULL},
	});
}

// Comments, Windows' ends of lines, other names and elements that nobody asked for.
static void a_ply_file_may_hold_more_than_a_surface(void** state) {
	(void)state;
	JnImport out;
	expect_read(
		"rich.ply",
		"ply\r\nformat ascii 1.0\r\ncomment by hand\r\nobj_info none\r\nelement vertex 4\r\nproperty float x\r\n"
		"property float y\r\nproperty float z\r\nelement face 4\r\nproperty list uchar int vertex_index\r\n"
		"element note 1\r\nproperty int a\r\nend_header\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n0 0 1\r\n3 0 2 1\r\n"
		"3 0 1 3\r\n3 1 2 3\r\n3 2 0 3\r\n7\r\n",
		&out);
	assert_int_equal(out.surface.triangle_count, 4);
}

static void a_surface_without_triangles_is_refused(void** state) {
	(void)state;
	expect_refusals((const Damage[]){
		{"points.ply", PLY(PLY_VERTICES "end_header\n0 0 0\n1 0 0\n0 1 0\n"), "points.ply"},
		{"lines.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\nl 2 3\n", "has no triangles"},
		{NULL, NULL, NULL},
	});
}

// ---- files that are none, or cannot be written

static void what_is_not_a_file_is_said_to_be_none(void** state) {
	(void)state;
	JnImport unused;
	static const char* const names[] = {"folder.vtk", "folder.vtu", "folder.obj", "folder.msh"};
	for (int i = 0; i < 4; ++i) {
		assert_int_equal(mkdir(path_join(folder, names[i]), 0700), 0);
		log_capture();
		assert_int_equal(jn_import(path_join(folder, names[i]), &arena, &unused), JN_IO_FAILED);
		log_release();
		log_expect(": is not a file");
	}
}

/// Call `write` while no file may grow beyond `bytes`.
static JnStatus limited(rlim_t bytes, JnStatus (*write)(void)) {
	struct rlimit before, now;
	getrlimit(RLIMIT_FSIZE, &before);
	now = before;
	now.rlim_cur = bytes;
	void (*const handler)(int) = signal(SIGXFSZ, SIG_IGN);
	setrlimit(RLIMIT_FSIZE, &now);
	log_capture();
	const JnStatus status = write();
	log_release();
	setrlimit(RLIMIT_FSIZE, &before);
	signal(SIGXFSZ, handler);
	return status;
}

static void make_box(JnMesh* mesh) {
	const JnBoxDef def = {.size = {1, 1, 1}, .cells = {8, 8, 8}, .element = JN_TET10};
	assert_int_equal(jn_generate_box(&def, &arena, mesh), JN_OK);
}

static JnStatus write_vtu(void) {
	JnMesh mesh;
	make_box(&mesh);
	return jn_export_volume(&mesh, path_join(folder, "limited.vtu"));
}

static JnStatus read_ply(void) {
	JnImport out;
	return jn_import(path_join(folder, "many.ply"), &arena, &out);
}

static void a_volume_that_cannot_be_written_to_its_end_is_not_there(void** state) {
	(void)state;
	assert_int_equal(limited(4096, write_vtu), JN_IO_FAILED);
	log_expect("limited.vtu: cannot write the file: File too large");
	assert_null(fopen(path_join(folder, "limited.vtu"), "r"));
}

static void a_volume_that_cannot_take_its_name_says_why(void** state) {
	(void)state;
	JnMesh mesh;
	make_box(&mesh);
	assert_int_equal(mkdir(path_join(folder, "taken.vtu"), 0700), 0);
	log_capture();
	assert_int_equal(jn_export_volume(&mesh, path_join(folder, "taken.vtu")), JN_IO_FAILED);
	log_release();
	log_expect("taken.vtu: cannot write the file: ");
}

// What was read goes from child to parent through a file in memory, for which there may be no room.
static void a_surface_too_large_for_memory_says_so(void** state) {
	(void)state;
	static char text[200000];
	int used =
		snprintf(text, sizeof text,
				 PLY("element vertex 3000\nproperty float x\nproperty float y\nproperty float z\n") "element face "
																									"2998\nproperty "
																									"list uchar int "
																									"vertex_index\nend_"
																									"header\n");
	for (int i = 0; i < 3000; ++i) used += snprintf(text + used, sizeof text - (size_t)used, "%d %d 0\n", i, i % 2);
	for (int i = 0; i < 2998; ++i)
		used += snprintf(text + used, sizeof text - (size_t)used, "3 %d %d %d\n", i, i + 1, i + 2);
	file_write(path_join(folder, "many.ply"), text);
	assert_int_equal(limited(4096, read_ply), JN_OUT_OF_MEMORY);
	log_expect("many.ply: no memory for ");
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(metadata_of_vtk_9_are_passed_over),
		cmocka_unit_test(triangles_in_a_vtk_file_are_a_surface),
		cmocka_unit_test(cells_of_vtk_that_cannot_be_are_named),
		cmocka_unit_test(a_hexahedron_whose_nodes_are_in_another_order_is_named),
		cmocka_unit_test(a_piece_of_vtu_without_points_is_passed_over),
		cmocka_unit_test(heads_of_msh_that_no_gmsh_writes_are_refused),
		cmocka_unit_test(contents_of_msh_that_cannot_be_are_refused),
		cmocka_unit_test(headers_of_ply_that_cannot_be_are_named_with_their_line),
		cmocka_unit_test(contents_of_ply_that_do_not_fit_are_refused),
		cmocka_unit_test(a_ply_file_may_hold_more_than_a_surface),
		cmocka_unit_test(a_surface_without_triangles_is_refused),
		cmocka_unit_test(what_is_not_a_file_is_said_to_be_none),
		cmocka_unit_test(a_volume_that_cannot_be_written_to_its_end_is_not_there),
		cmocka_unit_test(a_volume_that_cannot_take_its_name_says_why),
		cmocka_unit_test(a_surface_too_large_for_memory_says_so),
	};
	return cmocka_run_group_tests(tests, set_up, tear_down);
}
