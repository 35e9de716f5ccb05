// First touches of moving triangles: by construction, against small time steps, and the cases that give none.
#include "detect/touch.h"

#include "detect_case.h"

typedef struct Scene {
	double start[4][3], end[4][3];
} Scene;

static JnTouchPath path_of(const Scene* scene) {
	JnTouchPath path;
	for (int i = 0; i < 4; i++) {
		path.start[i] = scene->start[i];
		path.end[i] = scene->end[i];
	}
	return path;
}

static bool touches(const Scene* scene, JnTouchSides sides, JnTouch* touch) {
	const JnTouchPath path = path_of(scene);
	return jn_touch_first(&path, sides, touch);
}

static const double flat[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}; // faces up

static Scene drop(double x, double y, double from, double to) {
	Scene scene = {.start = {{x, y, from}}, .end = {{x, y, to}}};
	memcpy(scene.start[1], flat, sizeof flat);
	memcpy(scene.end[1], flat, sizeof flat);
	return scene;
}

static void a_fall_through_a_triangle_touches_where_and_when_it_should(void** unused) {
	(void)unused;
	JnTouch touch;
	const Scene scene = drop(0.2, 0.3, 3, -1);
	assert_true(touches(&scene, JN_TOUCH_FRONT, &touch));
	// dyadic numbers save for 0.2 and 0.3: a few roundings
	assert_near("when", touch.when, 0.75, 1e-15);
	assert_near("weight 0", touch.weights[0], 0.5, 1e-15);
	assert_near("weight 1", touch.weights[1], 0.2, 1e-15);
	assert_near("normal", touch.normal[2], 1, 1e-15);
}

static void from_behind_only_both_sides_touch(void** unused) {
	(void)unused;
	JnTouch touch;
	const Scene scene = drop(0.2, 0.3, -1, 3);
	assert_false(touches(&scene, JN_TOUCH_FRONT, &touch));
	assert_true(touches(&scene, JN_TOUCH_BOTH, &touch));
	assert_near("normal", touch.normal[2], -1, 1e-15);
}

static void beside_above_and_within_the_plane_nothing_touches(void** unused) {
	(void)unused;
	JnTouch touch;
	const Scene beside = drop(0.8, 0.8, 1, -1), above = drop(0.2, 0.2, 3, 1);
	Scene within = drop(-1, 0.2, 0, 0);
	within.end[0][0] = 2;
	assert_false(touches(&beside, JN_TOUCH_BOTH, &touch));
	assert_false(touches(&above, JN_TOUCH_BOTH, &touch));
	assert_false(touches(&within, JN_TOUCH_BOTH, &touch));
}

static void triangles_without_area_touch_nothing_and_give_no_nan(void** unused) {
	(void)unused;
	JnTouch touch;
	Scene line = drop(0.5, 0, 1, -1);
	line.start[3][0] = line.end[3][0] = 0.5; // its third corner on its first edge
	line.start[3][1] = line.end[3][1] = 0;
	assert_false(touches(&line, JN_TOUCH_BOTH, &touch));
	Scene turned =
		line; // has an area before and after, none when the point meets its line: lies beside the touch's plane
	turned.start[3][1] = 1;
	turned.end[3][1] = -1;
	if (touches(&turned, JN_TOUCH_BOTH, &touch)) assert_true(vec3_length(touch.normal) > 0.5);
}

/// Signed volume at share t of the way.
static double volume_at(const Scene* scene, double t) {
	double at[4][3], n[3], d[3];
	for (int i = 0; i < 12; i++) at[i / 3][i % 3] = (1 - t) * scene->start[i / 3][i % 3] + t * scene->end[i / 3][i % 3];
	vec3_triangle(at[1], at[2], at[3], n);
	for (int k = 0; k < 3; k++) d[k] = at[0][k] - at[1][k];
	return vec3_dot(n, d);
}

/// At a touch both are at the same place, the point comes from the normal's side, and many small steps find none earlier.
static void random_touches_are_contacts_of_the_motion(void** unused) {
	(void)unused;
	JnRandom random = {7};
	int found = 0;
	for (int i = 0; i < 20000; i++) {
		Scene scene;
		JnTouch touch;
		for (int k = 0; k < 12; k++) {
			scene.start[k / 3][k % 3] = 2 * jn_random_uniform(&random) - 1;
			scene.end[k / 3][k % 3] = 2 * jn_random_uniform(&random) - 1;
		}
		if (!touches(&scene, JN_TOUCH_BOTH, &touch)) continue;
		found++;
		double apart[3], rate[3];
		for (int a = 0; a < 3; a++) {
			double start = scene.start[0][a], end = scene.end[0][a];
			for (int k = 0; k < 3; k++) {
				start -= touch.weights[k] * scene.start[k + 1][a];
				end -= touch.weights[k] * scene.end[k + 1][a];
			}
			apart[a] = (1 - touch.when) * start + touch.when * end;
			rate[a] = end - start;
		}
		assert_true(vec3_length(apart) < 3e-6); // what jn_touch_first allows: 1e-6 of an edge, of up to 2 sqrt 3
		assert_true(vec3_dot(rate, touch.normal) <= 1e-7); // approaching; rounding when it grazes
		assert_true(touch.when >= 0 && touch.when <= 1);
	}
	print_message("%d touches of 20000\n", found);
	assert_true(found > 1000);
}

/// Least weight of the point of the triangle nearest to the moving point: > 0 when it is over the triangle.
static double inner_at(const Scene* scene, double t) {
	double at[4][3], w[3], n[3];
	for (int k = 0; k < 12; k++) at[k / 3][k % 3] = (1 - t) * scene->start[k / 3][k % 3] + t * scene->end[k / 3][k % 3];
	jn_triangle_nearest(at[1], at[2], at[3], at[0], w);
	vec3_triangle(at[1], at[2], at[3], n);
	return vec3_length(n) > 0.1 ? fmin(w[0], fmin(w[1], w[2])) : 0;
}

/// Wherever sampling sees a change of sign with the point well over the triangle, a touch is found, no later.
static void no_crossing_that_sampling_sees_is_missed(void** unused) {
	(void)unused;
	JnRandom random = {8};
	int crossings = 0;
	for (int i = 0; i < 5000; i++) {
		Scene scene;
		JnTouch touch;
		for (int k = 0; k < 12; k++) {
			scene.start[k / 3][k % 3] = 2 * jn_random_uniform(&random) - 1;
			scene.end[k / 3][k % 3] = 2 * jn_random_uniform(&random) - 1;
		}
		const bool found = touches(&scene, JN_TOUCH_BOTH, &touch);
		for (int s = 0; s < 200; s++) {
			const double t = s / 200.0, next = (s + 1) / 200.0;
			if (volume_at(&scene, t) * volume_at(&scene, next) >= 0) continue;
			if (inner_at(&scene, t) < 0.1 || inner_at(&scene, next) < 0.1) continue; // near its rim: not sure
			crossings++;
			assert_true(found && touch.when <= next);
			break;
		}
	}
	print_message("%d sure crossings\n", crossings);
	assert_true(crossings > 50);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_fall_through_a_triangle_touches_where_and_when_it_should),
		cmocka_unit_test(from_behind_only_both_sides_touch),
		cmocka_unit_test(beside_above_and_within_the_plane_nothing_touches),
		cmocka_unit_test(triangles_without_area_touch_nothing_and_give_no_nan),
		cmocka_unit_test(random_touches_are_contacts_of_the_motion),
		cmocka_unit_test(no_crossing_that_sampling_sees_is_missed),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
