// Which surfaces bound a solid, and what is said about the others.
#include "mesh/surface_edges.h"
#include "surface_case.h"

static JnStatus check(const JnSurface* s, Words* words) {
	words_keep(words);
	return jn_surface_check_closed(s, "part");
}

static void cubes_and_spheres_are_closed(void** state) {
	(void)state;
	JnArena arena = {0};
	Words words;
	const JnSurface cube = surface_cube(&arena, -3, 7), ball = surface_sphere(&arena, 1e-3, 24);
	const JnSurface pair = surface_join(&arena, &cube, &cube, 7.5);
	assert_int_equal(check(&cube, &words), JN_OK);
	assert_int_equal(check(&ball, &words), JN_OK);
	assert_int_equal(check(&pair, &words), JN_OK);
	jn_arena_free(&arena);
}

static void open_box_is_refused_with_the_edges_of_its_hole(void** state) {
	(void)state;
	JnArena arena = {0};
	Words words;
	JnSurface s = surface_cube(&arena, 0, 1);
	memmove(s.triangles, s.triangles + 6, 30 * sizeof *s.triangles); // without the side at z = 0
	s.triangle_count = 10;
	assert_int_equal(check(&s, &words), JN_BAD_INPUT);
	assert_says(&words, "part: the surface is open");
	assert_says(&words, "(0, 0, 0)-(1, 0, 0)");
	assert_says(&words, "(0, 0, 0)-(0, 1, 0)");
	assert_says(&words, "(1, 0, 0)-(1, 1, 0)");
	assert_says(&words, "(0, 1, 0)-(1, 1, 0)");
	assert_says(&words, "(4 in all)");
	assert_says(&words, "Fill Holes");
	jn_arena_free(&arena);
}

static void first_five_offenders_are_named_and_all_are_counted(void** state) {
	(void)state;
	JnArena arena = {0};
	Words words;
	JnSurface s = surface_sphere(&arena, 1, 8);
	s.triangle_count = 4;
	assert_int_equal(check(&s, &words), JN_BAD_INPUT);
	int named = 0;
	for (const char* at = words.text; (at = strstr(at, ")-(")) != NULL; at++) named++;
	assert_int_equal(named, 5);
	assert_says(&words, ", and more (");
	jn_arena_free(&arena);
}

static void doubled_triangle_is_refused(void** state) {
	(void)state;
	JnArena arena = {0};
	Words words;
	const JnSurface cube = surface_cube(&arena, 0, 1);
	const JnSurface s = surface_join(&arena, &cube, &cube, 0);
	JnSurface twice = s;
	for (int i = 0; i < 36; i++) twice.triangles[36 + i] = cube.triangles[i];
	assert_int_equal(check(&twice, &words), JN_BAD_INPUT);
	assert_says(&words, "more than two triangles");
	assert_says(&words, "(18 in all)");
	jn_arena_free(&arena);
}

static void triangle_that_faces_the_wrong_side_is_refused(void** state) {
	(void)state;
	JnArena arena = {0};
	Words words;
	JnSurface s = surface_cube(&arena, 0, 1);
	surface_reverse(&s, 4);
	assert_int_equal(check(&s, &words), JN_BAD_INPUT);
	assert_says(&words, "opposite sides");
	assert_says(&words, "(3 edges)");
	jn_arena_free(&arena);
}

static void crossing_spheres_are_refused_and_apart_accepted(void** state) {
	(void)state;
	JnArena arena = {0};
	Words words;
	const JnSurface ball = surface_sphere(&arena, 1, 12);
	static const double apart[] = {0.01, 1, 1.9, 1.99};
	for (int i = 0; i < 4; i++) {
		const JnSurface s = surface_join(&arena, &ball, &ball, apart[i]);
		assert_int_equal(check(&s, &words), JN_BAD_INPUT);
		assert_says(&words, "triangles cross");
		assert_says(&words, "near (");
	}
	const JnSurface s = surface_join(&arena, &ball, &ball, 2.001);
	assert_int_equal(check(&s, &words), JN_OK);
	jn_arena_free(&arena);
}

static void faces_that_overlap_in_one_plane_are_refused(void** state) {
	(void)state;
	JnArena arena = {0};
	Words words;
	const JnSurface cube = surface_cube(&arena, 0, 1), small = surface_cube(&arena, 0, 0.5);
	const JnSurface s = surface_join(&arena, &cube, &small, 1); // touches the side x = 1 with its own at x = 1
	assert_int_equal(check(&s, &words), JN_BAD_INPUT);
	assert_says(&words, "triangles cross");
	jn_arena_free(&arena);
}

/// Three points of each triangle, whether they cross, and why.
typedef struct PairCase {
	double p[3][3], q[3][3];
	bool crosses;
	const char* why;
} PairCase;

static void pairs_of_triangles_cross_only_when_they_overlap(void** state) {
	(void)state;
	static const PairCase cases[] = {
		{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{.2, .2, -1}, {.2, .2, 1}, {.3, .2, 1}}, true, "an edge goes through"},
		{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{.2, .2, 0}, {.2, .2, 1}, {.3, .2, 1}}, false, "a corner touches"},
		{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{.2, .2, -1e-6}, {.2, .2, 1}, {.3, .2, 1}}, true, "a corner goes in"},
		{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{1, 0, 0}, {0, 0, 0}, {0, 0, 1}}, false, "neighbours at an edge"},
		{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{1, 0, 0}, {0, 0, 0}, {.5, -1, 0}}, false, "flat neighbours"},
		{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{1, 0, 0}, {0, 0, 0}, {.4, .9, 0}}, true, "neighbours folded over"},
		{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{1, 0, 0}, {0, 0, 0}, {.4, .9, 1e-4}}, false, "a sharp fold"},
		{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 0}, {-1, 0, 0}, {0, -1, 0}}, false, "one common corner"},
		{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 0}, {1, 1, .5}, {1, 1, -.5}}, true, "a common corner, cut in two"},
		{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{2, 0, 0}, {3, 0, 0}, {2, 1, 0}}, false, "one plane, apart"},
		{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
		 {{.1, .1, 0}, {.2, .1, 0}, {.1, .2, 0}},
		 true,
		 "one plane, one in the other"},
		{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, .1}, {1, 0, .1}, {0, 1, .1}}, false, "parallel"},
	};
	for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
		for (int turn = 0; turn < 9; turn++) {
			const double *p[3], *q[3];
			for (int k = 0; k < 3; k++) {
				p[k] = cases[i].p[(k + turn) % 3];
				q[k] = cases[i].q[(k + turn / 3) % 3];
			}
			if (jn_triangles_cross(p, q) != cases[i].crosses || jn_triangles_cross(q, p) != cases[i].crosses)
				fail_msg("%s: expected %s", cases[i].why, cases[i].crosses ? "a crossing" : "none");
		}
	}
}

static void empty_surface_is_refused(void** state) {
	(void)state;
	JnArena arena = {0};
	Words words;
	const JnSurface s = surface_new(&arena, 0, 0);
	assert_int_equal(check(&s, &words), JN_BAD_INPUT);
	assert_says(&words, "no triangles");
	jn_arena_free(&arena);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(cubes_and_spheres_are_closed),
		cmocka_unit_test(open_box_is_refused_with_the_edges_of_its_hole),
		cmocka_unit_test(first_five_offenders_are_named_and_all_are_counted),
		cmocka_unit_test(doubled_triangle_is_refused),
		cmocka_unit_test(triangle_that_faces_the_wrong_side_is_refused),
		cmocka_unit_test(crossing_spheres_are_refused_and_apart_accepted),
		cmocka_unit_test(faces_that_overlap_in_one_plane_are_refused),
		cmocka_unit_test(pairs_of_triangles_cross_only_when_they_overlap),
		cmocka_unit_test(empty_surface_is_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
