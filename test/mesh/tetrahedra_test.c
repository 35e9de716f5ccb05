// Surfaces filled with tetrahedra: their volume, faces and quality, the same each time; the scanned models where they are.
#include "mesh/fill/tetrahedra.h"

#include <unistd.h>

#include "mesh/boundary.h"
#include "mesh/fill/resurface.h"
#include "mesh/format/import.h"
#include "mesh/quality.h"
#include "surface_case.h"

/// Without Gmsh there is nothing to be tested.
static void need_gmsh(void) {
	JnArena arena = {0};
	JnMesh mesh;
	Words words;
	const JnSurface cube = surface_cube(&arena, 0, 1);
	words_keep(&words);
	const JnStatus status = jn_tetrahedra_inside(&cube, 1, "probe", &arena, &mesh);
	jn_log_set_sink(NULL, NULL);
	jn_arena_free(&arena);
	if (status != JN_OK && strstr(words.text, "this needs Gmsh") != NULL) skip();
}

static double volume_of(const JnMesh* mesh) {
	double volume = 0;
	for (int cell = 0; cell < mesh->cell_count; cell++) {
		const double one = jn_mesh_cell_volume(mesh, cell);
		assert_true(one > 0);
		volume += one;
	}
	return volume;
}

static JnMesh make(const JnSurface* surface, double size, double least_quality, JnArena* arena) {
	JnMesh mesh;
	JnQuality quality;
	assert_int_equal(jn_tetrahedra_fill(surface, size, "test", arena, &mesh), JN_OK);
	assert_int_equal(mesh.shape, JN_TET4);
	assert_int_equal(jn_mesh_quality(&mesh, &quality), JN_OK);
	print_message("%d triangles at %g m: %d nodes, %d cells, mean ratio min %.3f median %.3f\n",
				  surface->triangle_count, size, mesh.node_count, mesh.cell_count, quality.min, quality.median);
	assert_true(quality.min > least_quality);
	assert_true(quality.median > 0.7); // well-made Delaunay meshes have about 0.8
	return mesh;
}

static void a_cube_keeps_its_edges(void** unused) {
	(void)unused;
	need_gmsh();
	JnArena arena = {0};
	const JnSurface cube = surface_cube(&arena, -1, 2);
	const JnMesh mesh = make(&cube, 0.4, 0.2, &arena);
	assert_near("volume", volume_of(&mesh), 8, 1e-9); // nothing is cut off: rounding of some 1e3 cells alone
	int corners = 0, on_edges = 0;
	for (int i = 0; i < mesh.node_count; i++) {
		int outer = 0;
		for (int a = 0; a < 3; a++) outer += fabs(fabs(mesh.nodes[3 * i + a]) - 1) < 1e-12;
		corners += outer == 3;
		on_edges += outer == 2;
	}
	assert_int_equal(corners, 8);
	assert_true(on_edges >= 12 * 3); // 2 / 0.4 = 5 pieces, of 4/3 at most: 4 pieces, 3 nodes between
	jn_arena_free(&arena);
}

static void a_sphere_is_filled_to_its_chords(void** unused) {
	(void)unused;
	need_gmsh();
	JnArena arena = {0};
	const JnSurface sphere = surface_sphere(&arena, 1, 24);
	const JnMesh mesh = make(&sphere, 0.25, 0.2, &arena);
	const double whole = jn_surface_volume(&sphere);
	assert_near("volume", volume_of(&mesh), whole, 0.03 * whole); // chords of 0.25 lie 0.8 % of the radius inside
	jn_arena_free(&arena);
}

static void two_parts_are_filled_each(void** unused) {
	(void)unused;
	need_gmsh();
	JnArena arena = {0};
	const JnSurface cube = surface_cube(&arena, 0, 1), both = surface_join(&arena, &cube, &cube, 3);
	const JnMesh mesh = make(&both, 0.4, 0.2, &arena);
	assert_near("volume", volume_of(&mesh), 2, 1e-9); // as above
	jn_arena_free(&arena);
}

static void the_given_triangles_are_the_outer_faces(void** unused) {
	(void)unused;
	need_gmsh();
	JnArena arena = {0};
	JnMesh mesh;
	int count, *faces;
	const JnSurface sphere = surface_sphere(&arena, 1, 8);
	assert_int_equal(jn_tetrahedra_inside(&sphere, 0.4, "test", &arena, &mesh), JN_OK);
	assert_memory_equal(mesh.nodes, sphere.nodes, 3 * (size_t)sphere.node_count * sizeof *sphere.nodes);
	assert_int_equal(jn_mesh_boundary(&mesh, &arena, &count, &faces), JN_OK);
	assert_int_equal(count, sphere.triangle_count);
	for (int i = 0; i < 3 * count; i++) assert_true(faces[i] < sphere.node_count);
	// the same polyhedron, summed in another order
	assert_near("volume", volume_of(&mesh), jn_surface_volume(&sphere), 1e-12);
	jn_arena_free(&arena);
}

static void the_same_surface_gives_the_same_mesh(void** unused) {
	(void)unused;
	need_gmsh();
	JnArena arena = {0};
	const JnSurface sphere = surface_sphere(&arena, 1, 12);
	const JnMesh a = make(&sphere, 0.3, 0, &arena), b = make(&sphere, 0.3, 0, &arena);
	assert_int_equal(a.node_count, b.node_count);
	assert_int_equal(a.cell_count, b.cell_count);
	assert_memory_equal(a.nodes, b.nodes, 3 * (size_t)a.node_count * sizeof *a.nodes);
	assert_memory_equal(a.cells, b.cells, 4 * (size_t)a.cell_count * sizeof *a.cells);
	jn_arena_free(&arena);
}

static void the_zero_set_of_the_distance_serves_where_the_surface_does_not(void** unused) {
	(void)unused;
	JnArena arena = {0};
	JnSurface around;
	const JnSurface cube = surface_cube(&arena, 0, 1);
	assert_int_equal(jn_resurface_around(&cube, 0.1, "test", &arena, &around), JN_OK);
	const double volume = jn_surface_volume(&around);
	assert_true(volume > 0.95 && volume < 1); // edges are rounded, 12 of about 0.1^2 / 4 each
	jn_arena_free(&arena);
}

/// A bent sheet, 0.02 thick: its two sides are much nearer to each other than the size of the triangles.
static void sheets_thinner_than_a_triangle_do_not_cross_themselves(void** unused) {
	(void)unused;
	JnArena arena = {0};
	JnSurface sheet = surface_sphere(&arena, 1, 40), along;
	for (int i = 0; i < sheet.node_count; i++) {
		double* x = sheet.nodes + 3 * i;
		x[2] = 0.01 * x[2] + 0.8 * x[0] * x[0];
	}
	assert_int_equal(jn_resurface_along(&sheet, 0.3, "test", &arena, &along), JN_OK);
	assert_int_equal(jn_surface_check_closed(&along, "test"), JN_OK);
	jn_arena_free(&arena);
}

/// A ball with a cavity in it, between spheres of the last two radii; without: a shell alone.
static JnSurface ball_with_gap(JnArena* arena, double radius, double outer, double inner) {
	JnSurface whole = surface_sphere(arena, radius, 8), cavity = surface_sphere(arena, outer, 8);
	const JnSurface core = surface_sphere(arena, inner, 8);
	for (int t = 0; t < cavity.triangle_count; t++) surface_reverse(&cavity, t);
	const JnSurface shell = surface_join(arena, &whole, &cavity, 0);
	return inner > 0 ? surface_join(arena, &shell, &core, 0) : shell;
}

// No triangles of 0.5 keep two spheres apart that are 1e-5 from each other; without the gap there is a ball.
static void a_gap_that_cells_cannot_follow_is_left_out_with_a_warning(void** unused) {
	(void)unused;
	need_gmsh();
	JnArena arena = {0};
	Words words;
	JnMesh mesh;
	const JnSurface surface = ball_with_gap(&arena, 1, 0.6, 0.59999), ball = surface_sphere(&arena, 1, 8);
	words_keep(&words);
	assert_int_equal(jn_tetrahedra_fill(&surface, 0.5, "ball", &arena, &mesh), JN_OK);
	jn_log_set_sink(NULL, NULL);
	assert_says(&words, "ball: cells of 0.5 m cannot follow the surface: edges were rounded and thin parts left out");
	const double whole = jn_surface_volume(&ball);
	assert_near("volume", volume_of(&mesh), whole, 0.12 * whole); // chords of 0.5 lie 3.2 % of the radius inside
	jn_arena_free(&arena);
}

static void a_shell_thinner_than_cells_can_be_is_refused(void** unused) {
	(void)unused;
	need_gmsh();
	JnArena arena = {0};
	Words words;
	JnMesh mesh;
	JnSurface along;
	const JnSurface surface = ball_with_gap(&arena, 1, 0.99999, 0);
	words_keep(&words);
	assert_int_equal(jn_resurface_along(&surface, 0.5, "shell", &arena, &along), JN_BAD_INPUT);
	assert_says(&words, "shell: parts of the surface are too near to each other for triangles of 0.5 m");
	assert_int_equal(jn_tetrahedra_fill(&surface, 0.5, "shell", &arena, &mesh), JN_BAD_INPUT);
	assert_says(&words, "shell: nothing of it is as large as 0.25 m");
	jn_log_set_sink(NULL, NULL);
	jn_arena_free(&arena);
}

static void sizes_and_surfaces_that_cannot_be_are_refused(void** unused) {
	(void)unused;
	JnArena arena = {0};
	JnMesh mesh;
	Words words;
	JnSurface cube = surface_cube(&arena, 0, 1);
	words_keep(&words);
	assert_int_equal(jn_tetrahedra_fill(&cube, 1e-4, "cube", &arena, &mesh), JN_BAD_INPUT);
	assert_says(&words, "cube: tetrahedra of 0.0001 m in 1 m^3 are some");
	for (int t = 0; t < cube.triangle_count; t++) surface_reverse(&cube, t);
	assert_int_equal(jn_tetrahedra_fill(&cube, 0.3, "cube", &arena, &mesh), JN_BAD_INPUT);
	assert_says(&words, "cube: the surface has no inside");
	jn_log_set_sink(NULL, NULL);
	jn_arena_free(&arena);
}

/// Fill a model at a share of its height, if tools/fetch_models has brought it.
static void fill_model(const char* path, double share, double volume_loss) {
	need_gmsh();
	if (access(path, R_OK) != 0) {
		print_message("%s is not there: tools/fetch_models\n", path);
		skip();
	}
	JnArena arena = {0};
	JnImport file;
	assert_int_equal(jn_import(path, &arena, &file), JN_OK);
	double low = INFINITY, high = -INFINITY;
	for (int i = 0; i < file.surface.node_count; i++) {
		low = fmin(low, file.surface.nodes[3 * i + 1]);
		high = fmax(high, file.surface.nodes[3 * i + 1]);
	}
	// flat ears and fingers are one cell thick: some cells have all four nodes on the surface and are as flat as it is
	const JnMesh mesh = make(&file.surface, share * (high - low), 0.01, &arena);
	const double whole = jn_surface_volume(&file.surface);
	assert_near("volume", volume_of(&mesh), whole, volume_loss * whole);
	jn_arena_free(&arena);
}

static void the_armadillo_is_filled(void** unused) {
	(void)unused;
	fill_model(JN_SOURCE_DIR "/models/armadillo.off", 1.0 / 25,
			   0.05); // fingers and tail are two or three chords around
}

static void the_bunny_is_filled(void** unused) {
	(void)unused;
	fill_model(JN_SOURCE_DIR "/models/bunny.off", 1.0 / 20, 0.03);
}

static void the_elephant_is_filled(void** unused) {
	(void)unused;
	fill_model(JN_SOURCE_DIR "/models/elephant.off", 1.0 / 25, 0.05); // as are its tail and tusks
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_cube_keeps_its_edges),
		cmocka_unit_test(a_sphere_is_filled_to_its_chords),
		cmocka_unit_test(two_parts_are_filled_each),
		cmocka_unit_test(the_given_triangles_are_the_outer_faces),
		cmocka_unit_test(the_same_surface_gives_the_same_mesh),
		cmocka_unit_test(the_zero_set_of_the_distance_serves_where_the_surface_does_not),
		cmocka_unit_test(sheets_thinner_than_a_triangle_do_not_cross_themselves),
		cmocka_unit_test(a_gap_that_cells_cannot_follow_is_left_out_with_a_warning),
		cmocka_unit_test(a_shell_thinner_than_cells_can_be_is_refused),
		cmocka_unit_test(sizes_and_surfaces_that_cannot_be_are_refused),
		cmocka_unit_test(the_armadillo_is_filled),
		cmocka_unit_test(the_bunny_is_filled),
		cmocka_unit_test(the_elephant_is_filled),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
