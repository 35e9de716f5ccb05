// Pairs of near points against looking at all pairs.
#include "detect/neighbours.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/random.h"

enum { POINTS = 600 };

static void scatter(double* x, const double size[3], uint64_t seed) {
	JnRandom random = {seed};
	for (int k = 0; k < 3 * POINTS; ++k) x[k] = size[k % 3] * jn_random_uniform(&random);
}

static double square_between(const double* x, int i, int j) {
	double sum = 0;
	for (int a = 0; a < 3; ++a) sum += (x[3 * i + a] - x[3 * j + a]) * (x[3 * i + a] - x[3 * j + a]);
	return sum;
}

static void expect_all_pairs(const double* x, double radius, JnNeighbours* found) {
	int pairs = 0;
	assert_int_equal(jn_neighbours_find(x, POINTS, radius, "test", found), JN_OK);
	for (int i = 0; i < POINTS; ++i) {
		int place = found->starts[i];
		for (int j = i + 1; j < POINTS; ++j) {
			if (!(square_between(x, i, j) <= radius * radius)) continue;
			if (place >= found->starts[i + 1] || found->list[place] != j)
				fail_msg("pair %d %d is missing, or not in its place", i, j);
			++place;
			++pairs;
		}
		assert_int_equal(place, found->starts[i + 1]);
	}
	print_message("radius %g: %d pairs\n", radius, pairs);
}

static void all_pairs_are_found_in_order(void** state) {
	(void)state;
	static double x[3 * POINTS];
	static const double sizes[][3] = {{1, 1, 1}, {1, 1, 0}, {5, 0.1, 0}, {0, 0, 0}};
	static const double radii[] = {0.05, 0.2, 3};
	JnNeighbours found = {0}; // filled again and again
	for (int s = 0; s < 4; ++s)
		for (int r = 0; r < 3; ++r) {
			scatter(x, sizes[s], 7 + (uint64_t)s);
			expect_all_pairs(x, radii[r], &found);
		}
	jn_neighbours_release(&found);
}

// A few points far away must not make the grid of cells larger than memory.
static void far_points_and_points_nowhere_do_no_harm(void** state) {
	(void)state;
	static double x[3 * POINTS];
	JnNeighbours found = {0};
	scatter(x, (double[3]){1, 1, 1}, 3);
	x[0] = 1e9, x[3 * 17 + 1] = -1e12, x[3 * 40 + 2] = NAN, x[3 * 41] = INFINITY, x[3 * 42 + 1] = 1e308,
	x[3 * 43] = -1e308;
	expect_all_pairs(x, 0.2, &found);
	jn_neighbours_release(&found);
}

// 0.3 is not three times 0.1 in doubles; a lattice's points at the radius are neighbours all the same.
static void points_of_a_lattice_at_the_radius_are_neighbours(void** state) {
	(void)state;
	double x[3 * 11] = {0};
	JnNeighbours found = {0};
	for (int i = 0; i < 11; ++i) x[3 * i] = 0.1 * i;
	assert_int_equal(jn_neighbours_find(x, 11, 0.3, "test", &found), JN_OK);
	assert_int_equal(found.starts[11], 10 + 9 + 8);
	jn_neighbours_release(&found);
}

static void no_points_have_no_pairs(void** state) {
	(void)state;
	JnNeighbours found = {0};
	assert_int_equal(jn_neighbours_find(NULL, 0, 1, "test", &found), JN_OK);
	assert_int_equal(found.starts[0], 0);
	jn_neighbours_release(&found);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(all_pairs_are_found_in_order),
		cmocka_unit_test(far_points_and_points_nowhere_do_no_harm),
		cmocka_unit_test(points_of_a_lattice_at_the_radius_are_neighbours),
		cmocka_unit_test(no_points_have_no_pairs),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
