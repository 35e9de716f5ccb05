// Zero sets as surfaces: closed, on the zero set, well shaped, the same each time; also those of wild functions.
#include "mesh/fill/isosurface.h"

#include "mesh/fill/remesh.h"
#include "mesh/shape/distance.h"
#include "surface_case.h"

static double sphere_at(const void* shape, const double p[3]) {
	(void)shape;
	return jn_distance_sphere(p, (double[]){0.3, -0.2, 0.1}, 0.5);
}

static double torus_at(const void* shape, const double p[3]) {
	(void)shape;
	return hypot(hypot(p[0], p[2]) - 0.5, p[1]) - 0.2;
}

/// A sum of waves: folds, tunnels and parts much thinner than a triangle.
static double waves_at(const void* shape, const double p[3]) {
	const double k = *(const double*)shape;
	return sin(k * p[0]) * cos(1.3 * k * p[1]) + sin(0.9 * k * p[1] + 1) * cos(k * p[2]) + sin(1.1 * k * p[2]) * p[0];
}

static const JnField sphere = {sphere_at, NULL, {-0.2, -0.7, -0.4}, {0.8, 0.3, 0.6}};
static const JnField torus = {torus_at, NULL, {-0.7, -0.2, -0.7}, {0.7, 0.2, 0.7}};

static JnSurface make(const JnField* field, double size, JnArena* arena) {
	JnSurface surface;
	assert_int_equal(jn_isosurface(field, size, "test", arena, &surface), JN_OK);
	return surface;
}

static double worst_quality(const JnSurface* s) {
	double worst = 1;
	for (int t = 0; t < s->triangle_count; t++) {
		const int* n = s->triangles + 3 * t;
		worst = fmin(worst, jn_triangle_quality(s->nodes + 3 * n[0], s->nodes + 3 * n[1], s->nodes + 3 * n[2]));
	}
	return worst;
}

/// Nodes minus edges plus triangles: 2 for a sphere, 0 for a torus. A closed surface has 3 / 2 edges a triangle.
static int euler(const JnSurface* s) {
	return s->node_count - s->triangle_count / 2;
}

static void a_sphere_and_a_torus_have_their_topology_and_volume(void** unused) {
	(void)unused;
	JnArena arena = {0};
	const JnSurface ball = make(&sphere, 0.08, &arena), ring = make(&torus, 0.08, &arena);
	assert_int_equal(jn_surface_check_closed(&ball, "ball"), JN_OK);
	assert_int_equal(jn_surface_check_closed(&ring, "ring"), JN_OK);
	assert_int_equal(euler(&ball), 2);
	assert_int_equal(euler(&ring), 0);
	// chords of length L lie up to L^2 / 8r inside a curve of radius r: 0.3 % of the ball, 2 % of the ring's tube
	const double ball_volume = M_PI / 6, ring_volume = 2 * M_PI * M_PI * 0.5 * 0.2 * 0.2;
	assert_near("volume of the ball", jn_surface_volume(&ball), ball_volume, 0.015 * ball_volume);
	assert_near("volume of the ring", jn_surface_volume(&ring), ring_volume, 0.04 * ring_volume);
	jn_arena_free(&arena);
}

static void nodes_lie_on_the_zero_set(void** unused) {
	(void)unused;
	JnArena arena = {0};
	const JnSurface ball = make(&sphere, 0.07, &arena);
	double worst = 0;
	for (int i = 0; i < ball.node_count; i++) worst = fmax(worst, fabs(sphere_at(NULL, ball.nodes + 3 * i)));
	assert_near("farthest node", worst, 0, 1e-3 * 0.07); // projected by Newton to 1e-6 of the size, most of them
	jn_arena_free(&arena);
}

static void triangles_are_well_shaped_and_of_the_size_asked_for(void** unused) {
	(void)unused;
	JnArena arena = {0};
	const double sizes[] = {0.05, 0.1, 0.15};
	for (int k = 0; k < 3; k++) {
		const JnSurface ball = make(&sphere, sizes[k], &arena);
		const double quality = worst_quality(&ball), area = jn_surface_area(&ball) / ball.triangle_count;
		print_message("size %g: %d triangles, worst quality %.2f\n", sizes[k], ball.triangle_count, quality);
		assert_true(quality > 0.5);
		// edges lie between 4/5 and 4/3 of the size, areas between the squares of these
		const double edge = sqrt(area * 4 / sqrt(3)) / sizes[k];
		assert_true(edge > 0.8 && edge < 4.0 / 3);
	}
	jn_arena_free(&arena);
}

static void any_function_gives_a_surface_whose_edges_have_two_triangles(void** unused) {
	(void)unused;
	for (double k = 3; k < 20; k += 2.7) {
		JnArena arena = {0};
		const JnField waves = {waves_at, &k, {-1, -1, -1}, {1, 1, 1}};
		const JnSurface s = make(&waves, 0.2, &arena);
		JnHalfEdges edges;
		assert_int_equal(jn_half_edges_create(&s, "waves", &edges), JN_OK); // refuses all else
		assert_int_equal(edges.node_count, s.node_count);                   // no two parts share a node
		jn_half_edges_free(&edges);
		assert_true(jn_surface_volume(&s) > 0);
		jn_arena_free(&arena);
	}
}

static void the_same_function_gives_the_same_surface(void** unused) {
	(void)unused;
	JnArena arena = {0};
	const JnSurface a = make(&torus, 0.1, &arena), b = make(&torus, 0.1, &arena);
	assert_int_equal(a.node_count, b.node_count);
	assert_int_equal(a.triangle_count, b.triangle_count);
	assert_memory_equal(a.nodes, b.nodes, 3 * (size_t)a.node_count * sizeof *a.nodes);
	assert_memory_equal(a.triangles, b.triangles, 3 * (size_t)a.triangle_count * sizeof *a.triangles);
	jn_arena_free(&arena);
}

static void sizes_far_from_the_shape_are_refused(void** unused) {
	(void)unused;
	JnArena arena = {0};
	JnSurface s;
	Words words;
	words_keep(&words);
	assert_int_equal(jn_isosurface(&sphere, 1e-5, "ball", &arena, &s), JN_BAD_INPUT);
	assert_says(&words, "ball: triangles of 1e-05 m need a grid of");
	const JnField empty = {sphere_at, NULL, {5, 5, 5}, {6, 6, 6}};
	assert_int_equal(jn_isosurface(&empty, 0.1, "ball", &arena, &s), JN_BAD_INPUT);
	assert_says(&words, "ball: nothing of it is as large as 0.1 m");
	jn_log_set_sink(NULL, NULL);
	jn_arena_free(&arena);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_sphere_and_a_torus_have_their_topology_and_volume),
		cmocka_unit_test(nodes_lie_on_the_zero_set),
		cmocka_unit_test(triangles_are_well_shaped_and_of_the_size_asked_for),
		cmocka_unit_test(any_function_gives_a_surface_whose_edges_have_two_triangles),
		cmocka_unit_test(the_same_function_gives_the_same_surface),
		cmocka_unit_test(sizes_far_from_the_shape_are_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
