// Half-edges: which surfaces they take, parts that touch in a point, and edits that would leave no surface.
#include "mesh/fill/half_edges.h"

#include "surface_case.h"

/// Two tetrahedra of volume 1/6 that have node 0 in common.
static JnSurface bow_tie(JnArena* arena) {
	static const double nodes[7][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
	JnSurface s = surface_new(arena, 7, 8);
	memcpy(s.nodes, nodes, sizeof nodes);
	put_triangle(&s, 0, 0, 2, 1);
	put_triangle(&s, 1, 0, 1, 3);
	put_triangle(&s, 2, 1, 2, 3);
	put_triangle(&s, 3, 2, 0, 3);
	put_triangle(&s, 4, 0, 4, 5);
	put_triangle(&s, 5, 0, 6, 4);
	put_triangle(&s, 6, 4, 6, 5);
	put_triangle(&s, 7, 5, 6, 0);
	return s;
}

static void parts_that_touch_in_a_point_get_a_node_each(void** unused) {
	(void)unused;
	JnArena arena = {0};
	JnHalfEdges mesh;
	JnSurface out;
	const JnSurface s = bow_tie(&arena);
	assert_int_equal(jn_half_edges_create(&s, "test", &mesh), JN_OK);
	assert_int_equal(mesh.node_count, 8);
	assert_int_equal(jn_valence(&mesh, 0), 3);
	assert_int_equal(jn_valence(&mesh, 7), 3);
	assert_memory_equal(mesh.nodes, mesh.nodes + 21, 3 * sizeof(double));
	assert_int_equal(jn_half_edges_surface(&mesh, &arena, &out), JN_OK);
	assert_near("volume", jn_surface_volume(&out), 2.0 / 6, 1e-15);
	jn_half_edges_free(&mesh);
	jn_arena_free(&arena);
}

static void expect_refusal(const JnSurface* s, const char* part) {
	JnHalfEdges mesh;
	Words words;
	words_keep(&words);
	assert_int_equal(jn_half_edges_create(s, "test", &mesh), JN_BAD_INPUT);
	assert_says(&words, part);
	jn_log_set_sink(NULL, NULL);
	assert_null(mesh.nodes);
}

static void edges_need_two_triangles_that_agree(void** unused) {
	(void)unused;
	JnArena arena = {0};
	JnSurface s = surface_cube(&arena, 0, 1);
	--s.triangle_count;
	expect_refusal(&s, "test: the edge between nodes ");
	++s.triangle_count;
	surface_reverse(&s, 3);
	expect_refusal(&s, "does not have two triangles that agree");
	JnSurface more = surface_new(&arena, 8, 14); // a fin of two triangles back to back on the edge of nodes 0 and 1
	const JnSurface cube = surface_cube(&arena, 0, 1);
	memcpy(more.nodes, cube.nodes, 24 * sizeof(double));
	memcpy(more.triangles, cube.triangles, 36 * sizeof(int));
	put_triangle(&more, 12, 0, 1, 7);
	put_triangle(&more, 13, 1, 0, 7);
	expect_refusal(&more, "test: the edge between nodes 0 and 1 does not have two triangles that agree");
	jn_arena_free(&arena);
}

// A tetrahedron has nothing to give: a flip doubles an edge, a collapse leaves two triangles back to back.
static void a_tetrahedron_cannot_be_flipped_nor_collapsed(void** unused) {
	(void)unused;
	JnArena arena = {0};
	JnHalfEdges mesh;
	JnSurface s = bow_tie(&arena);
	s.triangle_count = 4, s.node_count = 4;
	assert_int_equal(jn_half_edges_create(&s, "test", &mesh), JN_OK);
	for (int h = 0; h < mesh.count; ++h) {
		assert_false(jn_half_edges_flip(&mesh, h));
		assert_false(jn_half_edges_can_collapse(&mesh, h));
	}
	jn_half_edges_free(&mesh);
	jn_arena_free(&arena);
}

// Splits and collapses of a cube keep its volume; a flip of a crease would not.
static void splits_and_their_collapses_keep_the_volume(void** unused) {
	(void)unused;
	JnArena arena = {0};
	JnHalfEdges mesh;
	JnSurface out;
	const JnSurface s = surface_cube(&arena, 0, 1);
	assert_int_equal(jn_half_edges_create(&s, "test", &mesh), JN_OK);
	for (int h = 0; h < 36; ++h) {
		if (mesh.from[h] < 0) continue;
		const int start = mesh.from[h], middle = mesh.node_count;
		assert_int_equal(jn_half_edges_split(&mesh, h), JN_OK);
		int back = mesh.leaving[middle]; // the half-edge from the middle to the start
		for (int k = 0; k < jn_valence(&mesh, middle) && jn_to(&mesh, back) != start; ++k) back = jn_turn(&mesh, back);
		assert_int_equal(jn_to(&mesh, back), start);
		if (h % 2 == 0 && jn_half_edges_can_collapse(&mesh, back)) jn_half_edges_collapse(&mesh, back);
	}
	assert_int_equal(jn_half_edges_surface(&mesh, &arena, &out), JN_OK);
	assert_int_equal(jn_surface_check_closed(&out, "test"), JN_OK);
	assert_near("volume", jn_surface_volume(&out), 1, 1e-14);
	jn_half_edges_free(&mesh);
	jn_arena_free(&arena);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(parts_that_touch_in_a_point_get_a_node_each),
		cmocka_unit_test(edges_need_two_triangles_that_agree),
		cmocka_unit_test(a_tetrahedron_cannot_be_flipped_nor_collapsed),
		cmocka_unit_test(splits_and_their_collapses_keep_the_volume),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
