// The triangles that show an obstacle: they lie on it, face out of it and hold together.
#include "detect/obstacle_surface.h"

#include "detect_case.h"

static const JnPlaneDef plane = {.point = {1, 2, 3}, .normal = {0, 3, 4}};
static const JnSphereDef ball = {.center = {0.1, 0.2, -0.1}, .radius = 0.7};
static const JnSphereDef hollow = {.center = {0.1, 0.2, -0.1}, .radius = 0.7, .inside = true};
static const JnBlockDef block = {
	.center = {0.3, 0.1, 0.2}, .half = {0.5, 0.3, 0.8}, .axes = {0.8, 0.6, 0, -0.36, 0.48, 0.8, 0.48, -0.64, 0.6}};
static const JnCapsuleDef capsule = {.ends = {{-0.5, 0, 0.1}, {0.6, 0.4, 0.2}}, .radius = 0.25};
static const JnCapsuleDef point = {.ends = {{1, 1, 1}, {1, 1, 1}}, .radius = 0.5};
static const JnTreeBox around = {{-1, -1, 4}, {1, 0, 5}};

static const JnObstacle all[] = {{&jn_obstacle_plane, &plane},     {&jn_obstacle_sphere, &ball},
								 {&jn_obstacle_sphere, &hollow},   {&jn_obstacle_block, &block},
								 {&jn_obstacle_capsule, &capsule}, {&jn_obstacle_capsule, &point}};
enum { ALL = sizeof all / sizeof *all };

static void nodes_lie_on_the_obstacle_and_triangles_face_out_of_it(void** unused) {
	(void)unused;
	JnArena arena = {0};
	for (int i = 0; i < ALL; i++) {
		JnSurface surface;
		double normal[3];
		assert_int_equal(jn_obstacle_surface(&all[i], &around, &arena, &surface), JN_OK);
		for (int k = 0; k < surface.node_count; k++) // a dozen roundings of numbers up to 5
			assert_true(fabs(jn_obstacle_distance(&all[i], surface.nodes + 3 * k, normal)) < 1e-14);
		for (int k = 0; k < surface.triangle_count; k++) {
			const int* t = surface.triangles + 3 * k;
			double area[3], middle[3];
			vec3_triangle(surface.nodes + 3 * t[0], surface.nodes + 3 * t[1], surface.nodes + 3 * t[2], area);
			for (int a = 0; a < 3; a++)
				middle[a] =
					(surface.nodes[3 * t[0] + a] + surface.nodes[3 * t[1] + a] + surface.nodes[3 * t[2] + a]) / 3;
			jn_obstacle_distance(&all[i], middle, normal);
			assert_true(vec3_dot(area, normal) > 0.99 * vec3_length(area)); // 7.5 degrees of arc a triangle
		}
	}
	jn_arena_free(&arena);
}

// Area 4 pi r^2 and volume 4/3 pi r^3 of balls, with pi r^2 l for the rod between two halves; what the chords of arcs of
// 7.5 degrees cut off is 0.9 % of the volume at most.
static void closed_ones_have_the_volume_of_formulas(void** unused) {
	(void)unused;
	JnArena arena = {0};
	const double length = vec3_distance(capsule.ends[0], capsule.ends[1]);
	const double expected[ALL] = {0,
								  4.0 / 3 * M_PI * 0.343,
								  -4.0 / 3 * M_PI * 0.343,
								  8 * 0.5 * 0.3 * 0.8,
								  M_PI * 0.0625 * (length + 4.0 / 3 * 0.25),
								  4.0 / 3 * M_PI * 0.125};
	for (int i = 1; i < ALL; i++) {
		JnSurface surface;
		assert_int_equal(jn_obstacle_surface(&all[i], &around, &arena, &surface), JN_OK);
		const double volume = jn_surface_volume(&surface);
		print_message("%d: volume %g, expected %g\n", i, volume, expected[i]);
		assert_true(fabs(volume - expected[i]) < 0.009 * fabs(expected[i]));
		if (expected[i] > 0) assert_int_equal(jn_surface_check_closed(&surface, "surface"), JN_OK);
	}
	jn_arena_free(&arena);
}

static void the_square_of_a_plane_lies_below_the_whole_box(void** unused) {
	(void)unused;
	JnArena arena = {0};
	JnSurface square;
	assert_int_equal(jn_obstacle_surface(&all[0], &around, &arena, &square), JN_OK);
	const double *a = square.nodes, *b = square.nodes + 3, *d = square.nodes + 9;
	for (int corner = 0; corner < 8; corner++) {
		double u = 0, v = 0, uu = 0, vv = 0;
		for (int i = 0; i < 3; i++) {
			const double p = corner >> i & 1 ? around.high[i] : around.low[i];
			u += (p - a[i]) * (b[i] - a[i]);
			v += (p - a[i]) * (d[i] - a[i]);
			uu += (b[i] - a[i]) * (b[i] - a[i]);
			vv += (d[i] - a[i]) * (d[i] - a[i]);
		}
		assert_true(u > 0.1 * uu && u < 0.9 * uu && v > 0.1 * vv && v < 0.9 * vv);
	}
	jn_arena_free(&arena);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(nodes_lie_on_the_obstacle_and_triangles_face_out_of_it),
		cmocka_unit_test(closed_ones_have_the_volume_of_formulas),
		cmocka_unit_test(the_square_of_a_plane_lies_below_the_whole_box),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
