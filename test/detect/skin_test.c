// Skins: numbering of their vertices, positions by nodes and by cells.
#include "detect/skin.h"

#include "detect_case.h"

static void only_nodes_that_triangles_use_become_vertices(void** unused) {
	(void)unused;
	JnArena arena = {0};
	JnSkin skin;
	const int triangles[] = {9, 2, 5, 5, 2, 7}, nodes[] = {2, 5, 7, 9}, own[] = {3, 0, 1, 1, 0, 2};
	assert_int_equal(jn_skin_from_triangles(2, triangles, &arena, &skin), JN_OK);
	assert_int_equal(skin.vertex_count, 4);
	assert_int_equal(skin.carriers, 1);
	assert_memory_equal(skin.nodes, nodes, sizeof nodes);
	assert_memory_equal(skin.triangles, own, sizeof own);
	jn_arena_free(&arena);
}

static void positions_are_those_of_the_nodes(void** unused) {
	(void)unused;
	JnArena arena = {0};
	JnSkin skin;
	double x[30], out[9];
	for (int i = 0; i < 30; i++) x[i] = i;
	assert_int_equal(jn_skin_from_triangles(1, (int[]){9, 0, 4}, &arena, &skin), JN_OK);
	jn_skin_positions(&skin, x, out);
	const double expected[] = {0, 1, 2, 12, 13, 14, 27, 28, 29};
	assert_memory_equal(out, expected, sizeof expected);
	jn_arena_free(&arena);
}

static void negative_nodes_are_refused(void** unused) {
	(void)unused;
	JnArena arena = {0};
	JnSkin skin;
	Words words;
	words_keep(&words);
	const JnStatus status = jn_skin_from_triangles(1, (int[]){0, -1, 2}, &arena, &skin);
	jn_log_set_sink(NULL, NULL);
	assert_int_equal(status, JN_BAD_INPUT);
	assert_says(&words, "-1");
	jn_arena_free(&arena);
}

static void embedded_vertices_follow_their_cells(void** unused) {
	(void)unused;
	JnArena arena = {0};
	JnSkin skin;
	const int nodes[] = {0, 1, 1, 2, 2, 0};
	const double weights[] = {0.5, 0.5, 0.25, 0.75, 1, 0};
	int triangle[] = {0, 1, 2};
	const JnEmbedding embedding = {
		.surface = {3, NULL, 1, triangle}, .cell_nodes = 2, .nodes = nodes, .weights = weights};
	assert_int_equal(jn_skin_from_embedding(&embedding, 10, &arena, &skin), JN_OK);
	assert_int_equal(skin.nodes[3], 12);
	double x[39] = {0}, out[9];
	const double known[9] = {1, 2, 3, 5, 6, 7, 9, 2, 4};
	memcpy(x + 30, known, sizeof known);
	jn_skin_positions(&skin, x, out);
	const double expected[] = {3, 4, 5, 8, 3, 4.75, 9, 2, 4}; // sums of quarters: exact
	assert_memory_equal(out, expected, sizeof expected);
	jn_arena_free(&arena);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(only_nodes_that_triangles_use_become_vertices),
		cmocka_unit_test(positions_are_those_of_the_nodes),
		cmocka_unit_test(negative_nodes_are_refused),
		cmocka_unit_test(embedded_vertices_follow_their_cells),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
