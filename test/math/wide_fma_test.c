// Sums of a product and a number rounded once by two lanes, against the C library's fma.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "math/wide_float.h"

enum { TRIES = 400000 };

static uint64_t next(uint64_t* seed) {
	*seed = *seed * 6364136223846793005u + 1442695040888963407u;
	return *seed >> 20 ^ *seed << 20;
}

// 1 to 53 random bits, so that ties and exact sums occur, times a power of two up to 2^spread or 2^-spread.
static double number(uint64_t* seed, int bits, int spread) {
	const uint64_t r = next(seed), kept = (r >> 11) | 1;
	const int few = 1 + (int)((next(seed) >> 16) % (unsigned)bits);
	const int power = (int)((next(seed) >> 24) % (2 * (unsigned)spread + 1)) - spread;
	return ldexp((r & 1 ? -1.0 : 1.0) * (double)(kept & ((UINT64_C(1) << few) - 1)), power - few);
}

static void expect_fma(double a, double b, double c) {
	const double expected = fma(a, b, c), got = wide_fma(wide_set(a), wide_set(b), wide_set(c))[0];
	if (memcmp(&got, &expected, sizeof got) != 0 && !(isnan(got) && isnan(expected)))
		fail_msg("fma(%a, %a, %a) is %a, expected %a", a, b, c, got, expected);
}

static void two_lanes_round_a_product_and_a_sum_once(void** state) {
	(void)state;
	uint64_t seed = 1;
	for (int i = 0; i < TRIES; ++i) {
		const double a = number(&seed, 53, 40), b = number(&seed, 53, 40), c = number(&seed, 53, 120);
		expect_fma(a, b, c);
		expect_fma(a, b, -a * b); // what is left is the error of the product
		expect_fma(a, b, nextafter(-a * b, c));
	}
}

static void zeros_keep_their_sign_and_infinity_and_nan_stay(void** state) {
	(void)state;
	static const double special[] = {0, -0.0, 1, -1, 3, 1e-300, -1e300, INFINITY, -INFINITY, NAN};
	enum { COUNT = sizeof special / sizeof *special };
	for (int i = 0; i < COUNT; ++i)
		for (int j = 0; j < COUNT; ++j)
			for (int k = 0; k < COUNT; ++k) {
				const double product = fabs(special[i] * special[j]),
							 largest = fmax(fabs(special[i]), fabs(special[j]));
				// below 1e-290 the error of a product is no number; a product of numbers that is none is not meant
				if ((product != 0 && product < 1e-290) || (isinf(product) && largest < INFINITY)) continue;
				expect_fma(special[i], special[j], special[k]);
			}
}

static void two_lanes_round_floats_once(void** state) {
	(void)state;
	uint64_t seed = 2;
	for (int i = 0; i < TRIES; ++i) {
		const float a = (float)number(&seed, 24, 20), b = (float)number(&seed, 24, 20);
		const float tie = -a * b,
					c = i % 2 != 0 ? (float)number(&seed, 24, 60) : nextafterf(tie, (float)number(&seed, 1, 1));
		const float expected = fmaf(a, b, c),
					got = wide_float_fma(wide_float_set(a), wide_float_set(b), wide_float_set(c))[0];
		if (memcmp(&got, &expected, sizeof got) != 0)
			fail_msg("fmaf(%a, %a, %a) is %a, expected %a", (double)a, (double)b, (double)c, (double)got,
					 (double)expected);
	}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(two_lanes_round_a_product_and_a_sum_once),
		cmocka_unit_test(zeros_keep_their_sign_and_infinity_and_nan_stay),
		cmocka_unit_test(two_lanes_round_floats_once),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
