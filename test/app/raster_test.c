// What obstacles do to pictures: they are seen behind and below bodies, and the view is that of the bodies alone.
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "detect/obstacle_surface.h"
#include "reproduce/canvas.c"
#include "reproduce/raster.c"

enum { WIDTH = 120, HEIGHT = 90, BACKGROUND = 246 }; // 255 * 0.965

static JnArena arena;

static JnSurface block_of(double low, double high, double half) {
	const JnBlockDef block = {.center = {0, (low + high) / 2, 0},
							  .half = {half, (high - low) / 2, half},
							  .axes = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
	const JnObstacle obstacle = {&jn_obstacle_block, &block};
	JnSurface surface;
	assert_int_equal(jn_obstacle_surface(&obstacle, NULL, &arena, &surface), JN_OK);
	return surface;
}

/// A cube of 1 m on the ground, seen from `elevation` degrees, with an obstacle.
static View draw(double elevation, JnSurface obstacle, unsigned char* pixels) {
	static const int bodies[12] = {0};
	Picture picture = {.camera = {20, elevation}, .width = WIDTH, .height = HEIGHT, .count = 1};
	picture.panels[0] = (Panel){.surface = block_of(0, 1, 0.5), .bodies = bodies, .obstacles = obstacle};
	const View view = raster_view(&picture);
	assert_int_equal(raster_panel(&picture.panels[0], &view, WIDTH, pixels), JN_OK);
	return view;
}

static int grey_at(const unsigned char* pixels, int x, int y) {
	const unsigned char* p = pixels + 3 * (y * WIDTH + x);
	return p[0] == p[1] && p[1] == p[2] ? p[0] : -1;
}

typedef unsigned char Pixels[3 * WIDTH * HEIGHT];

static void obstacles_leave_the_view_as_it_is(void** unused) {
	(void)unused;
	Pixels pixels;
	const View without = draw(20, (JnSurface){0}, pixels), with = draw(20, block_of(-1, 0, 50), pixels);
	assert_memory_equal(&without, &with, sizeof with);
}

static void a_floor_is_grey_below_and_fades_above(void** unused) {
	(void)unused;
	Pixels without, with;
	draw(20, (JnSurface){0}, without);
	draw(20, block_of(-1, 0, 50), with);
	const int left = 20, middle = WIDTH / 2;
	assert_int_equal(grey_at(without, left, HEIGHT - 10), BACKGROUND);
	const int floor = grey_at(with, left, HEIGHT - 10);
	print_message("grey of the floor %d of 255\n", floor);
	assert_true(floor > 150 && floor < 235);
	assert_int_equal(grey_at(with, left, 2), BACKGROUND);
	const size_t body = 3 * (HEIGHT / 2 * WIDTH + (size_t)middle);
	assert_int_equal(grey_at(with, middle, HEIGHT / 2), -1);
	assert_memory_equal(with + body, without + body, 3);
}

static void an_obstacle_in_front_hides_bodies(void** unused) {
	(void)unused;
	Pixels pixels;
	JnSurface wall = block_of(0, 1, 0.1);
	for (int i = 0; i < wall.node_count; i++) wall.nodes[3 * i + 2] += 0.7;
	draw(0, wall, pixels);
	assert_true(grey_at(pixels, WIDTH / 2 - 5, HEIGHT / 2) > 0 || grey_at(pixels, WIDTH / 2 - 12, HEIGHT / 2) > 0);
}

// As it is solid below, one looks through it at the bodies.
static void a_floor_is_not_seen_from_below(void** unused) {
	(void)unused;
	Pixels without, with;
	double square[12] = {-9, 0, -9, -9, 0, 9, 9, 0, 9, 9, 0, -9};
	int triangles[6] = {0, 1, 2, 0, 2, 3};
	draw(-20, (JnSurface){0}, without);
	draw(-20, (JnSurface){4, square, 2, triangles}, with);
	assert_memory_equal(without, with, sizeof with);
	draw(20, (JnSurface){0}, without);
	draw(20, (JnSurface){4, square, 2, triangles}, with);
	assert_memory_not_equal(without, with, sizeof with);
}

// The pieces are cut elsewhere: of the light of a plane only rounding remains, of its fading less than a grey of 255 / 50.
// Depth is linear within a piece, wrong by its square over the distance of the camera, some 2 mm: where the body meets the
// floor a few pixels, of 10 mm, change hands.
static void a_huge_floor_looks_like_a_large_one(void** unused) {
	(void)unused;
	Pixels large, huge;
	draw(20, block_of(-1, 0, 50), large);
	draw(20, block_of(-1, 0, 5e5), huge);
	int different = 0;
	for (size_t i = 0; i < sizeof large; i += 3) different += abs(large[i] - huge[i]) > 5;
	print_message("%d pixels differ\n", different);
	assert_true(different <= 5);
}

static int free_arena(void** unused) {
	(void)unused;
	jn_arena_free(&arena);
	return 0;
}

/// Two balls on the line of sight, the nearer one smaller.
static void near_points_hide_far_ones_and_have_the_colours_of_their_values(void** unused) {
	(void)unused;
	Pixels pixels;
	double at[] = {0, 0, 0, 0, 0, 1, 3, 0, 0}, values[] = {0, 1, 0};
	Picture picture = {.width = WIDTH, .height = HEIGHT, .count = 1};
	picture.panels[0].points = (PanelPoints){3, at, values, {"damage", 0, 1, 0.4}};
	const View view = raster_view(&picture);
	assert_int_equal(raster_panel(&picture.panels[0], &view, WIDTH, pixels), JN_OK);
	const int y = HEIGHT / 2, left = (int)(WIDTH / 2 - view.scale * 1.5 / CANVAS_FINER);
	const unsigned char *front = pixels + 3 * (y * WIDTH + left), *right = pixels + 3 * (y * WIDTH + WIDTH - left);
	print_message("near: %d %d %d, alone: %d %d %d\n", front[0], front[1], front[2], right[0], right[1], right[2]);
	assert_true(front[0] > 2 * front[1]);                         // the dark red of the highest value
	assert_true(abs(right[0] - right[2]) < 30 && right[0] > 100); // the pale one of the lowest
	assert_int_equal(grey_at(pixels, WIDTH / 2, y), BACKGROUND);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(near_points_hide_far_ones_and_have_the_colours_of_their_values),
		cmocka_unit_test(obstacles_leave_the_view_as_it_is),
		cmocka_unit_test(a_floor_is_grey_below_and_fades_above),
		cmocka_unit_test(an_obstacle_in_front_hides_bodies),
		cmocka_unit_test(a_floor_is_not_seen_from_below),
		cmocka_unit_test(a_huge_floor_looks_like_a_large_one),
	};
	return cmocka_run_group_tests(tests, NULL, free_arena);
}
