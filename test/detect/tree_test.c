// Boxes of a moving skin: they hold all that they should, are refitted, and the tree is built anew when its order is bad.
#include "detect/tree.h"

#include "detect_case.h"

/// A tree over a surface, with motion of its own.
typedef struct Moving {
	JnSkin skin;
	JnSkinMotion motion;
	JnSkinTree tree;
} Moving;

static Moving* moving(const JnSurface* surface, double margin, JnArena* arena) {
	Moving* m = jn_arena_take(arena, 1, sizeof *m); // the tree points to the skin beside it
	assert_non_null(m);
	assert_int_equal(jn_skin_from_triangles(surface->triangle_count, surface->triangles, arena, &m->skin), JN_OK);
	assert_int_equal(m->skin.vertex_count, surface->node_count);
	const JnSurface copy = surface_new(arena, surface->node_count, 0),
					other = surface_new(arena, surface->node_count, 0);
	for (int i = 0; i < 3 * surface->node_count; i++) copy.nodes[i] = other.nodes[i] = surface->nodes[i];
	m->motion = (JnSkinMotion){.start = copy.nodes, .end = other.nodes, .margin = margin};
	assert_int_equal(jn_skin_tree_create(&m->skin, arena, &m->tree), JN_OK);
	return m;
}

static void scatter(double* x, int count, double reach, uint64_t seed) {
	JnRandom random = {seed};
	for (int i = 0; i < 3 * count; i++) x[i] += reach * (2 * jn_random_uniform(&random) - 1);
}

static void assert_holds(const JnTreeBox* box, const double* x, double margin) {
	for (int a = 0; a < 3; a++) {
		assert_true(box->low[a] <= x[a] - margin);
		assert_true(box->high[a] >= x[a] + margin);
	}
}

/// Every triangle is in one leaf; its vertices, at both moments, and the margin are in all boxes above.
static void assert_valid(const Moving* m, JnArena* arena) {
	const JnTriangleTree* tree = &m->tree.tree;
	int* seen = jn_arena_take(arena, (size_t)m->skin.triangle_count, sizeof *seen);
	int* owned = jn_arena_take(arena, (size_t)m->skin.vertex_count, sizeof *owned);
	for (int i = 0; i < m->skin.triangle_count; i++) {
		seen[tree->order[i]]++;
		for (int k = 0; k < 3; k++) {
			const int v = m->skin.triangles[3 * tree->order[i] + k];
			for (int box = tree->leaf_count + i / JN_TREE_LEAF; box >= 1; box /= 2) {
				assert_holds(&tree->boxes[box], m->motion.start + 3 * v, m->motion.margin);
				assert_holds(&tree->boxes[box], m->motion.end + 3 * v, m->motion.margin);
			}
		}
	}
	for (int i = 0; i < m->tree.vertex_start[tree->leaf_count]; i++) owned[m->tree.vertices[i]]++;
	for (int i = 0; i < m->skin.triangle_count; i++) assert_int_equal(seen[i], 1);
	for (int i = 0; i < m->skin.vertex_count; i++) assert_int_equal(owned[i], 1);
}

static void boxes_hold_the_whole_step_and_the_margin(void** unused) {
	(void)unused;
	JnArena arena = {0};
	const JnSurface sphere = surface_sphere(&arena, 1, 9);
	Moving* m = moving(&sphere, 0.01, &arena);
	scatter(m->motion.end, sphere.node_count, 0.5, 1);
	assert_true(jn_skin_tree_follow(&m->tree, &m->motion, 2, 1));
	assert_valid(m, &arena);
	scatter(m->motion.start, sphere.node_count, 0.1, 2);
	jn_skin_tree_refit(&m->tree, &m->motion, 2);
	assert_valid(m, &arena);
	jn_arena_free(&arena);
}

static void boxes_are_the_same_for_any_number_of_threads(void** unused) {
	(void)unused;
	JnArena arena = {0};
	const JnSurface sphere = surface_sphere(&arena, 1, 60);
	Moving *one = moving(&sphere, 0.01, &arena), *many = moving(&sphere, 0.01, &arena);
	jn_skin_tree_build(&one->tree, &one->motion, 1);
	for (int threads = 2; threads <= 4; threads += 2) {
		jn_skin_tree_build(&many->tree, &many->motion, threads);
		assert_memory_equal(one->tree.tree.boxes + 1, many->tree.tree.boxes + 1,
							(2 * (size_t)one->tree.tree.leaf_count - 1) * sizeof(JnTreeBox));
		assert_true(one->tree.cost == many->tree.cost);
	}
	jn_arena_free(&arena);
}

static void motion_and_size_do_not_make_a_tree_worse(void** unused) {
	(void)unused;
	JnArena arena = {0};
	const JnSurface sphere = surface_sphere(&arena, 1, 20);
	Moving* m = moving(&sphere, 0, &arena);
	assert_true(jn_skin_tree_follow(&m->tree, &m->motion, 2, 1));
	for (int i = 0; i < 3 * sphere.node_count; i++) m->motion.end[i] = m->motion.start[i] + (i % 3 == 0 ? 5 : 0);
	assert_false(jn_skin_tree_follow(&m->tree, &m->motion, 2, 1));
	for (int i = 0; i < 3 * sphere.node_count; i++) m->motion.end[i] = m->motion.start[i] *= 7;
	assert_false(jn_skin_tree_follow(&m->tree, &m->motion, 2, 1));
	// bodies of the same shape: rounding alone differs
	assert_near("cost of the larger one", m->tree.cost, m->tree.cost_built, 1e-9);
	jn_arena_free(&arena);
}

/// Triangles without neighbours that change places: the old order joins what is far apart.
static void a_tree_whose_triangles_mixed_is_built_anew(void** unused) {
	(void)unused;
	JnArena arena = {0};
	const int count = 400;
	JnSurface s = surface_new(&arena, 3 * count, count);
	for (int i = 0; i < count; i++) {
		put_triangle(&s, i, 3 * i, 3 * i + 1, 3 * i + 2);
		for (int k = 0; k < 9; k++) s.nodes[9 * i + k] = (k % 3 == 0 ? i : 0) + (k % 4 == 0);
	}
	Moving* m = moving(&s, 0.01, &arena);
	assert_true(jn_skin_tree_follow(&m->tree, &m->motion, 2, 1));
	assert_false(jn_skin_tree_follow(&m->tree, &m->motion, 2, 1));
	const double before = m->tree.cost;
	for (int i = 0; i < count; i++)
		for (int k = 0; k < 9; k += 3)
			m->motion.start[9 * i + k] = m->motion.end[9 * i + k] = i * 37 % count + (k == 0);
	jn_skin_tree_refit(&m->tree, &m->motion, 1);
	print_message("cost %g, after mixing %g\n", before, m->tree.cost);
	assert_true(m->tree.cost > 2 * before);
	assert_true(jn_skin_tree_follow(&m->tree, &m->motion, 2, 1));
	assert_true(m->tree.cost < 1.1 * before); // the same places again, held by other triangles
	assert_valid(m, &arena);
	jn_arena_free(&arena);
}

static void trees_of_nothing_and_of_one_triangle_are_valid(void** unused) {
	(void)unused;
	JnArena arena = {0};
	JnSurface one = surface_new(&arena, 3, 1);
	put_triangle(&one, 0, 0, 1, 2); // without area: all corners at the origin
	Moving *m = moving(&one, 0, &arena), *none = moving(&(JnSurface){0}, 0, &arena);
	assert_true(jn_skin_tree_follow(&m->tree, &m->motion, 2, 1));
	assert_false(jn_skin_tree_follow(&m->tree, &m->motion, 2, 1));
	assert_valid(m, &arena);
	assert_true(jn_skin_tree_follow(&none->tree, &none->motion, 2, 1));
	assert_true(none->tree.tree.boxes[1].low[0] > none->tree.tree.boxes[1].high[0]);
	jn_arena_free(&arena);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(boxes_hold_the_whole_step_and_the_margin),
		cmocka_unit_test(boxes_are_the_same_for_any_number_of_threads),
		cmocka_unit_test(motion_and_size_do_not_make_a_tree_worse),
		cmocka_unit_test(a_tree_whose_triangles_mixed_is_built_anew),
		cmocka_unit_test(trees_of_nothing_and_of_one_triangle_are_valid),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
