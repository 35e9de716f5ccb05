// Area, volume and repair of surfaces, against cubes and spheres of known size.
#include "surface_case.h"

static void cube_has_its_volume_and_area(void** state) {
	(void)state;
	JnArena arena = {0};
	const JnSurface s = surface_cube(&arena, 1000, 0.5);
	assert_near("volume", jn_surface_volume(&s), 0.125, 0); // powers of two: exact, even far from the origin
	assert_near("area", jn_surface_area(&s), 1.5, 0);
	jn_arena_free(&arena);
}

static void sphere_volume_converges_with_order_two(void** state) {
	(void)state;
	JnArena arena = {0};
	const double exact = 4.0 / 3 * M_PI;
	const JnSurface coarse = surface_sphere(&arena, 1, 16), fine = surface_sphere(&arena, 1, 32);
	const double ratio = (exact - jn_surface_volume(&coarse)) / (exact - jn_surface_volume(&fine));
	assert_near("ratio of errors at half the size", ratio, 4, 0.1); // the next term is of order four: 1/16^2 of it
	jn_arena_free(&arena);
}

static void good_surface_passes_repair_unchanged_and_silent(void** state) {
	(void)state;
	JnArena arena = {0};
	Words words;
	JnSurface s = surface_sphere(&arena, 1, 8);
	const JnSurface before = surface_sphere(&arena, 1, 8);
	words_keep(&words);
	assert_int_equal(jn_surface_repair(&s, "ball"), JN_OK);
	assert_int_equal(words.warnings + words.errors, 0);
	assert_int_equal(s.node_count, before.node_count);
	assert_memory_equal(s.nodes, before.nodes, 3 * (size_t)s.node_count * sizeof *s.nodes);
	assert_memory_equal(s.triangles, before.triangles, 3 * (size_t)s.triangle_count * sizeof *s.triangles);
	jn_arena_free(&arena);
}

static void inside_out_surface_is_turned(void** state) {
	(void)state;
	JnArena arena = {0};
	Words words;
	JnSurface s = surface_cube(&arena, 0, 1);
	for (int i = 0; i < 12; i++) surface_reverse(&s, i);
	assert_near("volume before", jn_surface_volume(&s), -1, 0);
	words_keep(&words);
	assert_int_equal(jn_surface_repair(&s, "cube"), JN_OK);
	assert_near("volume", jn_surface_volume(&s), 1, 0);
	assert_int_equal(words.warnings, 1);
	assert_says(&words, "cube: repaired: 12 triangles turned");
	jn_arena_free(&arena);
}

static void any_single_flipped_triangle_is_turned_back(void** state) {
	(void)state;
	JnArena arena = {0};
	Words words;
	for (int flipped = 0; flipped < 12; flipped++) {
		JnSurface s = surface_cube(&arena, 0, 1);
		surface_reverse(&s, flipped);
		words_keep(&words);
		assert_int_equal(jn_surface_repair(&s, "cube"), JN_OK);
		assert_true(jn_surface_volume(&s) == 1);
		assert_says(&words, "repaired: 1 triangles turned");
	}
	jn_arena_free(&arena);
}

/// Each triangle with corners of its own, as STL has them, and nodes that nobody uses.
static JnSurface triangle_soup(JnArena* arena, const JnSurface* from, double noise) {
	JnSurface s = surface_new(arena, 3 * from->triangle_count + 2, from->triangle_count + 1);
	for (int i = 0; i < 3 * from->triangle_count; i++) {
		s.triangles[i] = i;
		for (int a = 0; a < 3; a++) s.nodes[3 * i + a] = from->nodes[3 * from->triangles[i] + a] + (i % 2 ? noise : 0);
	}
	s.nodes[3 * (s.node_count - 1)] = s.nodes[3 * (s.node_count - 2)] = 0.5; // nobody's
	put_triangle(&s, from->triangle_count, 0, 0, 1);
	return s;
}

static void soup_is_welded_and_its_scraps_go_with_one_warning(void** state) {
	(void)state;
	JnArena arena = {0};
	Words words;
	const JnSurface cube = surface_cube(&arena, 0, 1);
	JnSurface s = triangle_soup(&arena, &cube, 1e-10); // a tenth of the distance at which nodes are joined
	words_keep(&words);
	assert_int_equal(jn_surface_repair(&s, "soup"), JN_OK);
	assert_int_equal(s.node_count, 8);
	assert_int_equal(s.triangle_count, 12);
	assert_near("volume", jn_surface_volume(&s), 1, 1e-9); // six faces moved by up to 1e-10
	assert_int_equal(words.warnings, 1);
	assert_says(&words, "29 nodes joined"); // 36 + 2 - 8 corners - 1 lone node
	assert_says(&words, "1 triangles without area dropped");
	assert_says(&words, "1 unused nodes dropped");
	jn_arena_free(&arena);
}

static void nodes_farther_apart_than_the_tolerance_stay(void** state) {
	(void)state;
	JnArena arena = {0};
	const JnSurface cube = surface_cube(&arena, 0, 1);
	Words words;
	JnSurface s = triangle_soup(&arena, &cube, 1e-8); // ten times the distance
	words_keep(&words);
	(void)jn_surface_repair(&s, "soup");
	assert_true(s.node_count > 8);
	jn_arena_free(&arena);
}

static void cavity_faces_inward_and_a_kernel_in_it_outward(void** state) {
	(void)state;
	JnArena arena = {0};
	Words words;
	const JnSurface outer = surface_cube(&arena, 0, 4), hole = surface_cube(&arena, 1, 2),
					core = surface_cube(&arena, 1.5, 1);
	const JnSurface two = surface_join(&arena, &hole, &outer, 0);
	JnSurface s = surface_join(&arena, &two, &core, 0);
	words_keep(&words);
	assert_int_equal(jn_surface_repair(&s, "nut"), JN_OK);
	assert_near("volume", jn_surface_volume(&s), 64 - 8 + 1, 1e-12); // rounding of some hundred products below 100
	assert_says(&words, "12 triangles turned");
	assert_int_equal(jn_surface_check_closed(&s, "nut"), JN_OK);
	jn_arena_free(&arena);
}

static void parts_beside_each_other_both_face_outward(void** state) {
	(void)state;
	JnArena arena = {0};
	Words words;
	const JnSurface a = surface_cube(&arena, 0, 1);
	JnSurface b = surface_cube(&arena, 0, 1);
	for (int i = 0; i < 12; i++) surface_reverse(&b, i);
	JnSurface s = surface_join(&arena, &a, &b, 3);
	words_keep(&words);
	assert_int_equal(jn_surface_repair(&s, "pair"), JN_OK);
	assert_near("volume", jn_surface_volume(&s), 2, 1e-14); // few roundings of numbers up to 4
	jn_arena_free(&arena);
}

static void flat_triangle_on_an_edge_is_joined_with_its_neighbour(void** state) {
	(void)state;
	JnArena arena = {0};
	Words words;
	const JnSurface cube = surface_cube(&arena, 0, 1);
	JnSurface s = surface_new(&arena, 9, 14);
	memcpy(s.nodes, cube.nodes, 24 * sizeof *s.nodes);
	memcpy(s.triangles, cube.triangles, 36 * sizeof *s.triangles);
	const int* t =
		cube.triangles; // its edge t[0] t[1] gets a node in the middle, and a flat triangle towards the other side
	for (int a = 0; a < 3; a++) s.nodes[24 + a] = 0.5 * (cube.nodes[3 * t[0] + a] + cube.nodes[3 * t[1] + a]);
	put_triangle(&s, 0, t[0], 8, t[2]);
	put_triangle(&s, 12, 8, t[1], t[2]);
	put_triangle(&s, 13, t[0], t[1], 8);
	words_keep(&words);
	assert_int_equal(jn_surface_repair(&s, "cap"), JN_OK);
	assert_says(&words, "1 triangles without area joined");
	assert_int_equal(s.triangle_count, 14);
	assert_int_equal(jn_surface_check_closed(&s, "cap"), JN_OK);
	assert_near("volume", jn_surface_volume(&s), 1, 1e-15); // corners at 0, 1/2 and 1
	assert_near("area", jn_surface_area(&s), 6, 1e-15);
	jn_arena_free(&arena);
}

static void moebius_strip_is_refused(void** state) {
	(void)state;
	JnArena arena = {0};
	Words words;
	JnSurface s = surface_moebius(&arena, 20);
	words_keep(&words);
	assert_int_equal(jn_surface_repair(&s, "strip"), JN_BAD_INPUT);
	assert_says(&words, "strip: a part of the surface has one side only");
	jn_arena_free(&arena);
}

static void three_triangles_at_an_edge_are_refused_by_position(void** state) {
	(void)state;
	JnArena arena = {0};
	Words words;
	const JnSurface cube = surface_cube(&arena, 0, 1);
	JnSurface s = surface_new(&arena, 8, 13);
	memcpy(s.nodes, cube.nodes, 24 * sizeof *s.nodes);
	memcpy(s.triangles, cube.triangles, 36 * sizeof *s.triangles);
	put_triangle(&s, 12, 0, 1, 7); // an inner wall on the edge 0 1, and on 1 7 and 0 7
	words_keep(&words);
	assert_int_equal(jn_surface_repair(&s, "wall"), JN_BAD_INPUT);
	assert_says(&words, "more than two triangles: (0, 0, 0)-(1, 0, 0)");
	jn_arena_free(&arena);
}

static void coordinates_that_are_no_numbers_are_refused(void** state) {
	(void)state;
	JnArena arena = {0};
	Words words;
	static const double bad[] = {NAN, INFINITY, -INFINITY, 1e31};
	for (int i = 0; i < 4; i++) {
		JnSurface s = surface_cube(&arena, 0, 1);
		s.nodes[3 * 5 + 1] = bad[i];
		words_keep(&words);
		assert_int_equal(jn_surface_repair(&s, "cube"), JN_BAD_INPUT);
		assert_says(&words, "node 5 at");
	}
	jn_arena_free(&arena);
}

static void node_numbers_out_of_range_are_refused(void** state) {
	(void)state;
	JnArena arena = {0};
	Words words;
	JnSurface s = surface_cube(&arena, 0, 1);
	s.triangles[7] = 8;
	words_keep(&words);
	assert_int_equal(jn_surface_repair(&s, "cube"), JN_BAD_INPUT);
	assert_says(&words, "triangle 2 names node 8");
	jn_arena_free(&arena);
}

static void surface_without_area_is_refused(void** state) {
	(void)state;
	JnArena arena = {0};
	Words words;
	JnSurface point = surface_cube(&arena, 3, 0), none = surface_new(&arena, 0, 0);
	words_keep(&words);
	assert_int_equal(jn_surface_repair(&point, "point"), JN_BAD_INPUT);
	assert_int_equal(jn_surface_repair(&none, "none"), JN_BAD_INPUT);
	assert_says(&words, "point: no triangle has an area");
	jn_arena_free(&arena);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(cube_has_its_volume_and_area),
		cmocka_unit_test(sphere_volume_converges_with_order_two),
		cmocka_unit_test(good_surface_passes_repair_unchanged_and_silent),
		cmocka_unit_test(inside_out_surface_is_turned),
		cmocka_unit_test(any_single_flipped_triangle_is_turned_back),
		cmocka_unit_test(soup_is_welded_and_its_scraps_go_with_one_warning),
		cmocka_unit_test(nodes_farther_apart_than_the_tolerance_stay),
		cmocka_unit_test(cavity_faces_inward_and_a_kernel_in_it_outward),
		cmocka_unit_test(parts_beside_each_other_both_face_outward),
		cmocka_unit_test(flat_triangle_on_an_edge_is_joined_with_its_neighbour),
		cmocka_unit_test(moebius_strip_is_refused),
		cmocka_unit_test(three_triangles_at_an_edge_are_refused_by_position),
		cmocka_unit_test(coordinates_that_are_no_numbers_are_refused),
		cmocka_unit_test(node_numbers_out_of_range_are_refused),
		cmocka_unit_test(surface_without_area_is_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
