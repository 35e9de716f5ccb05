// The tree's answers against looking at every triangle, and against formulas for spheres and cubes.
#include "mesh/triangle_tree.h"
#include "surface_case.h"

/// Between 0 and 1; a linear congruential generator (Knuth's MMIX).
static double next_random(uint64_t* seed) {
	*seed = *seed * 6364136223846793005u + 1442695040888963407u;
	return (double)(*seed >> 11) / 9007199254740992.0;
}

static void random_point(uint64_t* seed, double size, double p[3]) {
	for (int a = 0; a < 3; a++) p[a] = size * (2 * next_random(seed) - 1);
}

static JnTriangleTree tree_of(const JnSurface* s, JnArena* arena) {
	JnTriangleTree tree;
	assert_int_equal(jn_triangle_tree_create(s, arena, &tree), JN_OK);
	return tree;
}

/// The triangle `triangle` of a surface as a surface.
static JnSurface one_triangle(const JnSurface* s, int triangle) {
	return (JnSurface){s->node_count, s->nodes, 1, s->triangles + 3 * triangle};
}

static void nearest_point_is_that_of_a_search_over_all_triangles(void** state) {
	(void)state;
	JnArena arena = {0};
	const JnSurface s = surface_sphere(&arena, 1, 7);
	const JnTriangleTree tree = tree_of(&s, &arena);
	uint64_t seed = 1;
	for (int i = 0; i < 200; i++) {
		double p[3];
		random_point(&seed, 2, p);
		JnSurfacePoint best = {.distance = INFINITY};
		for (int t = 0; t < s.triangle_count; t++) {
			const JnSurface one = one_triangle(&s, t);
			const JnTriangleTree single = tree_of(&one, &arena);
			const JnSurfacePoint found = jn_triangle_tree_nearest(&single, p);
			if (found.distance >= best.distance) continue;
			best = found;
			best.triangle = t;
		}
		const JnSurfacePoint found = jn_triangle_tree_nearest(&tree, p);
		assert_true(found.distance == best.distance); // the same sums in the same order
		assert_int_equal(found.triangle, best.triangle);
	}
	jn_arena_free(&arena);
}

static void distance_to_a_cube_is_that_of_the_formula(void** state) {
	(void)state;
	JnArena arena = {0};
	const JnSurface s = surface_cube(&arena, -1, 2);
	const JnTriangleTree tree = tree_of(&s, &arena);
	uint64_t seed = 2;
	double worst = 0;
	for (int i = 0; i < 2000; i++) {
		double p[3], outside = 0, inside = INFINITY;
		random_point(&seed, 3, p);
		for (int a = 0; a < 3; a++) {
			outside += pow(fmax(fabs(p[a]) - 1, 0), 2);
			inside = fmin(inside, 1 - fabs(p[a]));
		}
		const JnSurfacePoint found = jn_triangle_tree_nearest(&tree, p);
		worst = fmax(worst, fabs(found.distance - (outside > 0 ? sqrt(outside) : inside)));
		assert_true(found.weights[0] >= 0 && found.weights[1] >= 0 && found.weights[2] >= 0);
		assert_true(fabs(found.weights[0] + found.weights[1] + found.weights[2] - 1) < 1e-15);
	}
	assert_near("largest error of a distance", worst, 0, 1e-14); // tens of roundings of numbers up to 4
	jn_arena_free(&arena);
}

static void points_inside_a_cube_and_outside_are_told_apart(void** state) {
	(void)state;
	JnArena arena = {0};
	const JnSurface s = surface_cube(&arena, -1, 2);
	const JnTriangleTree tree = tree_of(&s, &arena);
	uint64_t seed = 3;
	int inside = 0;
	for (int i = 0; i < 5000; i++) {
		double p[3];
		random_point(&seed, 1.5, p);
		const bool expected = fmax(fmax(fabs(p[0]), fabs(p[1])), fabs(p[2])) < 1;
		assert_int_equal(jn_triangle_tree_winding(&tree, p), expected ? 1 : 0);
		inside += expected;
	}
	assert_true(inside > 1000 && inside < 2500);
	jn_arena_free(&arena);
}

static void rays_through_edges_and_corners_count_once(void** state) {
	(void)state;
	JnArena arena = {0};
	const JnSurface cube = surface_cube(&arena, -1, 2), ball = surface_sphere(&arena, 1, 12);
	const JnTriangleTree boxes = tree_of(&cube, &arena), balls = tree_of(&ball, &arena);
	for (int i = -20; i <= 20; i++) { // y = z is a diagonal of the cube's side, and ends at its corners
		const double p[3] = {0.25, i / 10.0, i / 10.0};
		assert_int_equal(jn_triangle_tree_is_inside(&boxes, p),
						 i >= -10 && i < 10); // on the box: below or left is inside
		for (int turn = 0; turn < 3; turn++) {
			const double outside[3] = {turn == 0 ? -5 : 5, i / 10.0, turn == 1 ? 0 : i / 10.0};
			assert_int_equal(jn_triangle_tree_winding(&boxes, outside), 0);
		}
	}
	for (int i = 0; i < ball.node_count; i++) { // just inside and outside of each node, on the line from the middle
		double in[3], out[3];
		for (int a = 0; a < 3; a++) {
			in[a] = 0.9 * ball.nodes[3 * i + a];
			out[a] = 1.1 * ball.nodes[3 * i + a];
		}
		const double left[3] = {-7, ball.nodes[3 * i + 1], ball.nodes[3 * i + 2]}; // its ray meets the node
		assert_int_equal(jn_triangle_tree_winding(&balls, in), 1);
		assert_int_equal(jn_triangle_tree_winding(&balls, out), 0);
		assert_int_equal(jn_triangle_tree_winding(&balls, left), 0);
	}
	jn_arena_free(&arena);
}

static void winding_counts_layers_and_the_side_they_face(void** state) {
	(void)state;
	JnArena arena = {0};
	const JnSurface outer = surface_cube(&arena, -2, 4);
	JnSurface inner = surface_cube(&arena, -1, 2);
	const double middle[3] = {0.1, 0.2, 0.3}, between[3] = {1.5, 0.2, 0.3};
	const JnSurface both = surface_join(&arena, &outer, &inner, 0);
	const JnTriangleTree twice = tree_of(&both, &arena);
	assert_int_equal(jn_triangle_tree_winding(&twice, middle), 2);
	assert_int_equal(jn_triangle_tree_winding(&twice, between), 1);
	for (int i = 0; i < 12; i++) surface_reverse(&inner, i);
	const JnSurface hollow = surface_join(&arena, &outer, &inner, 0);
	const JnTriangleTree cavity = tree_of(&hollow, &arena);
	assert_int_equal(jn_triangle_tree_winding(&cavity, middle), 0);
	assert_int_equal(jn_triangle_tree_winding(&cavity, between), 1);
	jn_arena_free(&arena);
}

typedef struct Found {
	int count, last_first;
	long long sum;
} Found;

static JnStatus add_pair(void* user, int first, int second) {
	Found* found = user;
	assert_true(first < second && first >= found->last_first);
	found->last_first = first;
	found->count++;
	found->sum += 1000003LL * first + 7LL * second;
	return JN_OK;
}

static bool boxes_touch(const JnSurface* s, int first, int second) {
	for (int a = 0; a < 3; a++) {
		double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
		for (int i = 0; i < 6; i++) {
			const double x = s->nodes[3 * s->triangles[3 * (i < 3 ? first : second) + i % 3] + a];
			low[i / 3] = fmin(low[i / 3], x);
			high[i / 3] = fmax(high[i / 3], x);
		}
		if (low[0] > high[1] || low[1] > high[0]) return false;
	}
	return true;
}

static void pairs_are_all_pairs_whose_boxes_touch_once_each(void** state) {
	(void)state;
	JnArena arena = {0};
	const JnSurface s = surface_sphere(&arena, 1, 9);
	const JnTriangleTree tree = tree_of(&s, &arena);
	Found found = {0}, expected = {0};
	assert_int_equal(jn_triangle_tree_pairs(&tree, add_pair, &found), JN_OK);
	for (int i = 0; i < s.triangle_count; i++)
		for (int k = i + 1; k < s.triangle_count; k++)
			if (boxes_touch(&s, i, k)) (void)add_pair(&expected, i, k);
	print_message("pairs: value %d, expected %d\n", found.count, expected.count);
	assert_int_equal(found.count, expected.count);
	assert_true(found.sum == expected.sum);
	jn_arena_free(&arena);
}

static JnStatus stop_at_third(void* user, int triangle) {
	(void)triangle;
	return ++*(int*)user == 3 ? JN_RUN_FAILED : JN_OK;
}

static void visit_ends_when_it_is_told_to(void** state) {
	(void)state;
	JnArena arena = {0};
	const JnSurface s = surface_cube(&arena, 0, 1);
	const JnTriangleTree tree = tree_of(&s, &arena);
	const double low[3] = {0, 0, 0}, high[3] = {1, 1, 1};
	int visits = 0;
	assert_int_equal(jn_triangle_tree_in_box(&tree, low, high, stop_at_third, &visits), JN_RUN_FAILED);
	assert_int_equal(visits, 3);
	jn_arena_free(&arena);
}

static void empty_surface_has_no_nearest_point_and_no_inside(void** state) {
	(void)state;
	JnArena arena = {0};
	const JnSurface s = surface_new(&arena, 0, 0);
	const JnTriangleTree tree = tree_of(&s, &arena);
	const double p[3] = {0};
	assert_int_equal(jn_triangle_tree_nearest(&tree, p).triangle, -1);
	assert_false(jn_triangle_tree_is_inside(&tree, p));
	jn_arena_free(&arena);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(nearest_point_is_that_of_a_search_over_all_triangles),
		cmocka_unit_test(distance_to_a_cube_is_that_of_the_formula),
		cmocka_unit_test(points_inside_a_cube_and_outside_are_told_apart),
		cmocka_unit_test(rays_through_edges_and_corners_count_once),
		cmocka_unit_test(winding_counts_layers_and_the_side_they_face),
		cmocka_unit_test(pairs_are_all_pairs_whose_boxes_touch_once_each),
		cmocka_unit_test(visit_ends_when_it_is_told_to),
		cmocka_unit_test(empty_surface_has_no_nearest_point_and_no_inside),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
