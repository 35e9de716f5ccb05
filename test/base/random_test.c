// Random numbers: the published stream, and moments of the distributions.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/random.h"

enum { SAMPLES = 100000 };

// First numbers of Vigna's splitmix64.c (public domain) from the seed 1234567.
static void the_stream_is_that_of_splitmix64(void** state) {
	(void)state;
	static const uint64_t expected[5] = {6457827717110365317u, 3203168211198807973u, 9817491932198370423u,
										 4593380528125082431u, 16408922859458223821u};
	JnRandom random = {1234567};
	for (int i = 0; i < 5; ++i) assert_true(jn_random_bits(&random) == expected[i]);
}

static void uniform_numbers_have_mean_a_half_and_variance_a_twelfth(void** state) {
	(void)state;
	JnRandom random = {0};
	double sum = 0, squares = 0;
	for (int i = 0; i < SAMPLES; ++i) {
		const double value = jn_random_uniform(&random);
		assert_true(value >= 0 && value < 1);
		sum += value;
		squares += (value - 0.5) * (value - 0.5);
	}
	// five standard errors: sqrt(1/12 / n) = 9e-4, and sqrt((1/80 - 1/144) / n) = 2.4e-4
	assert_true(fabs(sum / SAMPLES - 0.5) < 4.6e-3);
	assert_true(fabs(squares / SAMPLES - 1.0 / 12) < 1.2e-3);
}

// Uniform in the ball: the share within radius r is r^3, and no direction is preferred.
static void points_fill_the_ball_evenly(void** state) {
	(void)state;
	JnRandom random = {7};
	int within_half = 0;
	double sum[3] = {0};
	for (int i = 0; i < SAMPLES; ++i) {
		double p[3];
		jn_random_in_ball(&random, p);
		const double radius = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
		assert_true(radius <= 1 + 1e-15); // rounding of the square root
		within_half += radius <= 0.5;
		for (int axis = 0; axis < 3; ++axis) sum[axis] += p[axis];
	}
	// five standard errors: sqrt(1/8 * 7/8 / n) = 1.05e-3, and sqrt(1/5 / n) = 1.4e-3
	assert_true(fabs((double)within_half / SAMPLES - 0.125) < 5.3e-3);
	for (int axis = 0; axis < 3; ++axis) assert_true(fabs(sum[axis] / SAMPLES) < 7.1e-3);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(the_stream_is_that_of_splitmix64),
		cmocka_unit_test(uniform_numbers_have_mean_a_half_and_variance_a_twelfth),
		cmocka_unit_test(points_fill_the_ball_evenly),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
