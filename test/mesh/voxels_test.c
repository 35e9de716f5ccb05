// Cubes around closed surfaces: counts against geometry, symmetry, touching and inside, hinges, limits, the embedding.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/log.h"
#include "mesh/embed.h"
#include "mesh/fill/voxel_grid.h"
#include "mesh/fill/voxels.h"

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

static const int box_corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
									 {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
static const int box_triangle[36] = {0, 3, 2, 0, 2, 1, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
									 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};

/// Boxes from low[i] to high[i], each closed by itself.
static JnSurface make_boxes(JnArena* arena, int count, const double low[][3], const double high[][3]) {
	JnSurface surface = {.node_count = 8 * count, .triangle_count = 12 * count};
	surface.nodes = jn_arena_take(arena, (size_t)(24 * count), sizeof(double));
	surface.triangles = jn_arena_take(arena, (size_t)(36 * count), sizeof(int));
	for (int b = 0; b < count; b++) {
		for (int k = 0; k < 24; k++)
			surface.nodes[24 * b + k] = box_corner[k / 3][k % 3] == 1 ? high[b][k % 3] : low[b][k % 3];
		for (int k = 0; k < 36; k++) surface.triangles[36 * b + k] = 8 * b + box_triangle[k];
	}
	return surface;
}

/// Latitudes and longitudes, the same under every change of sign and under x <-> z.
static JnSurface make_sphere(JnArena* arena, int rings, double radius) {
	const int around = 2 * rings;
	JnSurface s = {.node_count = 2 + (rings - 1) * around};
	s.nodes = jn_arena_take(arena, 3 * (size_t)s.node_count, sizeof(double));
	s.triangles = jn_arena_take(arena, 6 * (size_t)(rings * around), sizeof(int));
	s.nodes[1] = radius, s.nodes[4] = -radius;
	for (int i = 1; i < rings; i++) {
		for (int k = 0; k < around; k++) {
			double* at = s.nodes + 3 * (2 + (i - 1) * around + k);
			at[0] = radius * sin(M_PI * i / rings) * cos(2 * M_PI * k / around);
			at[1] = radius * cos(M_PI * i / rings);
			at[2] = radius * sin(M_PI * i / rings) * sin(2 * M_PI * k / around);
		}
	}
	for (int i = 0; i < rings; i++) {
		for (int k = 0; k < around; k++) {
			const int next = (k + 1) % around;
			const int a = i == 0 ? 0 : 2 + (i - 1) * around + k, b = i == 0 ? 0 : 2 + (i - 1) * around + next;
			const int c = i == rings - 1 ? 1 : 2 + i * around + k, d = i == rings - 1 ? 1 : 2 + i * around + next;
			const int both[6] = {a, b, d, a, d, c};
			const int from = i == 0 ? 3 : 0, to = i == rings - 1 ? 3 : 6; // one triangle at the poles
			memcpy(s.triangles + 3 * s.triangle_count, both + from, (size_t)(to - from) * sizeof(int));
			s.triangle_count += (to - from) / 3;
		}
	}
	return s;
}

static double volume_of(const JnMesh* mesh, double size) {
	double volume = 0;
	for (int cell = 0; cell < mesh->cell_count; cell++) {
		const double own = jn_mesh_cell_volume(mesh, cell);
		assert_true(fabs(own - size * size * size) < 1e-12 * size * size * size); // coordinates near 1 round by 1e-16
		volume += own;
	}
	return volume;
}

static void volume_of_a_sphere_is_reached_from_above(void** unused) {
	(void)unused;
	JnArena arena = {0};
	const JnSurface sphere = make_sphere(&arena, 24, 1);
	const double exact = jn_surface_volume(&sphere);
	double before = INFINITY;
	for (int n = 4; n <= 64; n *= 2) {
		JnMesh mesh;
		assert_int_equal(jn_voxels_fill(&sphere, 2.0 / n, "sphere", &arena, &mesh), JN_OK);
		const double excess = volume_of(&mesh, 2.0 / n) / exact - 1;
		print_message("size 1/%d: %d cells, volume over by %.4f\n", n / 2, mesh.cell_count, excess);
		// Touched cubes reach at most sqrt(3) size beyond the surface: (1 + sqrt(3) size)^3, and a third for the facets.
		assert_true(excess > 0 && excess < 1.1 * (pow(1 + sqrt(3.0) * 2 / n, 3) - 1));
		assert_true(excess < 0.75 * before); // first order would be 0.5; small counts are uneven
		before = excess;
	}
	assert_string_equal(messages, "");
	jn_arena_free(&arena);
}

static bool has_cube_at(const JnMesh* mesh, const double centre[3], double size) {
	for (int cell = 0; cell < mesh->cell_count; cell++) {
		const double* low = mesh->nodes + 3 * mesh->cells[8 * cell];
		bool is_same = true;
		for (int a = 0; a < 3; a++) is_same = is_same && fabs(low[a] + size / 2 - centre[a]) < 1e-9 * size;
		if (is_same) return true;
	}
	return false;
}

static void cubes_are_as_symmetric_as_the_surface(void** unused) {
	(void)unused;
	JnArena arena = {0};
	const JnSurface sphere = make_sphere(&arena, 12, 0.3);
	const double sizes[] = {0.06, 0.0437, 0.1}; // even, odd, exact
	for (int i = 0; i < 3; i++) {
		JnMesh mesh;
		assert_int_equal(jn_voxels_fill(&sphere, sizes[i], "sphere", &arena, &mesh), JN_OK);
		for (int cell = 0; cell < mesh.cell_count; cell++) {
			double mirrored[3];
			for (int k = 0; k < 3; k++) mirrored[k] = mesh.nodes[3 * mesh.cells[8 * cell] + k] + sizes[i] / 2;
			for (int k = 0; k < 3; k++) {
				mirrored[k] = -mirrored[k];
				assert_true(has_cube_at(&mesh, mirrored, sizes[i]));
			}
		}
	}
	jn_arena_free(&arena);
}

static void box_of_whole_cubes_is_filled_exactly(void** unused) {
	(void)unused;
	JnArena arena = {0};
	const double low[1][3] = {{-1.1, 7, 0.3}}, high[1][3] = {{-0.8, 7.7, 0.5}}; // 3, 7 and 2 cubes, up to rounding
	const JnSurface box = make_boxes(&arena, 1, low, high);
	JnMesh mesh;
	assert_int_equal(jn_voxels_fill(&box, 0.1, "box", &arena, &mesh), JN_OK);
	assert_int_equal(mesh.cell_count, 3 * 7 * 2);
	assert_int_equal(mesh.node_count, 4 * 8 * 3);
	jn_arena_free(&arena);
}

// A step of two boxes: the cubes beside the lower one share a face with the surface, and are outside.
static void cubes_that_only_share_a_face_stay_empty(void** unused) {
	(void)unused;
	JnArena arena = {0};
	const double low[2][3] = {{0, 0, 0}, {0, 1, 0}}, high[2][3] = {{4, 1, 2}, {2, 3, 2}};
	const JnSurface step = make_boxes(&arena, 2, low, high);
	JnMesh mesh;
	assert_int_equal(jn_voxels_fill(&step, 1, "step", &arena, &mesh), JN_OK);
	assert_int_equal(mesh.cell_count, 4 * 1 * 2 + 2 * 2 * 2);
	jn_arena_free(&arena);
}

// A hollow box whose wall is thinner than a cube: the cavity of 8^3 cubes stays empty.
static void cavity_stays_empty(void** unused) {
	(void)unused;
	JnArena arena = {0};
	const double low[2][3] = {{0, 0, 0}, {0.9, 0.9, 0.9}}, high[2][3] = {{10, 10, 10}, {9.1, 9.1, 9.1}};
	const JnSurface hollow = make_boxes(&arena, 2, low, high);
	for (int k = 36; k < 72; k += 3) { // the inner one faces inward
		const int node = hollow.triangles[k];
		hollow.triangles[k] = hollow.triangles[k + 1];
		hollow.triangles[k + 1] = node;
	}
	JnMesh mesh;
	assert_int_equal(jn_voxels_fill(&hollow, 1, "hollow", &arena, &mesh), JN_OK);
	assert_int_equal(mesh.cell_count, 1000 - 512);
	jn_arena_free(&arena);
}

// What is marked column by column must be what a test of every cube against every triangle finds.
static void every_touched_cube_is_found(void** unused) {
	(void)unused;
	JnArena arena = {0};
	const JnSurface sphere = make_sphere(&arena, 5, 1); // large triangles in all directions
	const int n = 23;
	JnVoxelGrid grid = {.low = {-1.05, -1.1, -1.02}, .size = 0.097, .counts = {n, n, n}};
	grid.cubes = jn_arena_take(&arena, (size_t)(n * n * n), 1);
	jn_voxel_mark(&grid, &sphere);
	for (int i = 0; i < n * n * n; i++) {
		const int at[3] = {i % n, i / n % n, i / n / n};
		double centre[3], corners[3][3], distance = INFINITY;
		for (int a = 0; a < 3; a++) centre[a] = grid.low[a] + (at[a] + 0.5) * grid.size;
		for (int t = 0; t < sphere.triangle_count; t++) {
			for (int k = 0; k < 9; k++)
				corners[k / 3][k % 3] = sphere.nodes[3 * sphere.triangles[3 * t + k / 3] + k % 3];
			distance = fmin(distance, jn_voxel_distance(corners, centre));
		}
		assert_int_equal(grid.cubes[i] == JN_VOXEL_TOUCHED, distance < grid.size / 2);
	}
	jn_arena_free(&arena);
}

static void distance_of_a_cube_to_a_triangle_is_that_of_hand(void** unused) {
	(void)unused;
	double flat[3][3] = {{-9, -9, 2}, {9, -9, 2}, {0, 9, 2}}, slope[3][3] = {{3, 0, 0}, {0, 3, 0}, {0, 0, 3}};
	double corner[3][3] = {{1, 1, 1}, {5, 1, 1}, {1, 5, 1}};
	const double origin[3] = {0};
	assert_true(jn_voxel_distance(flat, origin) == 2);
	assert_true(fabs(jn_voxel_distance(slope, origin) - 1) < 1e-15); // x + y + z = 3 meets the cube's corner (1, 1, 1)
	assert_true(fabs(jn_voxel_distance(corner, origin) - 1) < 1e-15);
}

static void parts_that_share_an_edge_bring_a_warning(void** unused) {
	(void)unused;
	JnArena arena = {0};
	const double low[2][3] = {{0, 0, 0}, {2, 2, 0}}, high[2][3] = {{2, 2, 3}, {4, 4, 3}};
	const JnSurface boxes = make_boxes(&arena, 2, low, high);
	JnMesh mesh;
	assert_int_equal(jn_voxels_fill(&boxes, 1, "bodies[0].shape", &arena, &mesh), JN_OK);
	assert_int_equal(mesh.cell_count, 24);
	assert_non_null(strstr(messages, "bodies[0].shape: the cubes are 2 parts"));
	assert_non_null(strstr(messages, "(nodes there: 4)")); // an edge of three cubes
	jn_arena_free(&arena);
}

static void parts_that_share_a_corner_bring_a_warning(void** unused) {
	(void)unused;
	JnArena arena = {0};
	const double low[2][3] = {{0, 0, 0}, {2, 2, 2}}, high[2][3] = {{2, 2, 2}, {4, 4, 4}};
	const JnSurface boxes = make_boxes(&arena, 2, low, high);
	JnMesh mesh;
	assert_int_equal(jn_voxels_fill(&boxes, 1, "boxes", &arena, &mesh), JN_OK);
	assert_non_null(strstr(messages, "2 parts"));
	assert_non_null(strstr(messages, "(nodes there: 1)"));
	jn_arena_free(&arena);
}

static void parts_that_stand_apart_bring_none(void** unused) {
	(void)unused;
	JnArena arena = {0};
	const double low[2][3] = {{0, 0, 0}, {3, 3, 3}}, high[2][3] = {{2, 2, 2}, {4, 4, 4}};
	const JnSurface boxes = make_boxes(&arena, 2, low, high);
	JnMesh mesh;
	assert_int_equal(jn_voxels_fill(&boxes, 1, "boxes", &arena, &mesh), JN_OK);
	assert_int_equal(mesh.cell_count, 9);
	assert_string_equal(messages, "");
	jn_arena_free(&arena);
}

static void too_many_cubes_are_refused_before_memory_is_taken(void** unused) {
	(void)unused;
	JnArena arena = {0};
	const JnSurface sphere = make_sphere(&arena, 6, 1);
	const size_t used = arena.used;
	JnMesh mesh;
	const double sizes[] = {1e-3, 1e-9, 1e-300};
	for (int i = 0; i < 3; i++) {
		assert_int_equal(jn_voxels_fill(&sphere, sizes[i], "bodies[0].shape", &arena, &mesh), JN_BAD_INPUT);
		assert_non_null(strstr(messages, "bodies[0].shape: cubes of"));
		assert_int_equal(arena.used, used);
	}
	const JnSurface empty = {0};
	assert_int_equal(jn_voxels_fill(&empty, 1, "nothing", &arena, &mesh), JN_BAD_INPUT);
	assert_non_null(strstr(messages, "nothing: the surface has no triangles"));
	jn_arena_free(&arena);
}

static void cube_larger_than_the_surface_holds_it(void** unused) {
	(void)unused;
	JnArena arena = {0};
	const JnSurface sphere = make_sphere(&arena, 6, 1);
	JnMesh mesh;
	assert_int_equal(jn_voxels_fill(&sphere, 50, "sphere", &arena, &mesh), JN_OK);
	assert_int_equal(mesh.cell_count, 1);
	jn_arena_free(&arena);
}

static void surface_is_carried_along(void** unused) {
	(void)unused;
	JnArena arena = {0};
	const JnSurface sphere = make_sphere(&arena, 24, 1);
	JnMesh mesh;
	assert_int_equal(jn_voxels_fill(&sphere, 0.13, "sphere", &arena, &mesh), JN_OK);
	assert_non_null(mesh.embedding);
	assert_int_equal(mesh.embedding->surface.triangle_count, sphere.triangle_count);
	double* at = jn_arena_take(&arena, 3 * (size_t)sphere.node_count, sizeof *at);
	jn_embedding_positions(mesh.embedding, mesh.nodes, at);
	for (int i = 0; i < 3 * sphere.node_count; i++) assert_true(fabs(at[i] - sphere.nodes[i]) < 1e-12); // radius 1
	for (int i = 0; i < 8 * sphere.node_count; i++) // a vertex is inside its cell
		assert_true(mesh.embedding->weights[i] > -1e-8 && mesh.embedding->weights[i] < 1 + 1e-8);
	jn_arena_free(&arena);
}

#define TEST(name) cmocka_unit_test_setup(name, start)

int main(void) {
	const struct CMUnitTest tests[] = {
		TEST(volume_of_a_sphere_is_reached_from_above),
		TEST(cubes_are_as_symmetric_as_the_surface),
		TEST(box_of_whole_cubes_is_filled_exactly),
		TEST(cubes_that_only_share_a_face_stay_empty),
		TEST(cavity_stays_empty),
		TEST(every_touched_cube_is_found),
		TEST(distance_of_a_cube_to_a_triangle_is_that_of_hand),
		TEST(parts_that_share_an_edge_bring_a_warning),
		TEST(parts_that_share_a_corner_bring_a_warning),
		TEST(parts_that_stand_apart_bring_none),
		TEST(too_many_cubes_are_refused_before_memory_is_taken),
		TEST(cube_larger_than_the_surface_holds_it),
		TEST(surface_is_carried_along),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
