/// @file space_test.c
/// The host space: sums that may overwrite a term, reductions whose bits depend on nothing but the numbers, NaN.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/space.h"

// Not a multiple of a chunk (4096), and long enough that 4 threads are woken (65536 entries each).
enum { LENGTH = 4 * 65536 + 4096 * 3 + 13 };

static const size_t lengths[] = {1, 7, 8, 4095, 4096, 4097, LENGTH};
enum { LENGTH_COUNT = sizeof lengths / sizeof *lengths };

static JnSpace* new_space(size_t length, int threads) {
	JnSpace* space = jn_host_space_create(length, threads);
	assert_non_null(space);
	return space;
}

static JnVec filled(JnSpace* space, double shift) {
	JnVec vec = space->ops->create(space);
	assert_non_null(vec);
	for (size_t k = 0; k < space->length; ++k) vec[k] = sin(1.7 * (double)k + shift) * exp(3 * cos(0.3 * (double)k));
	return vec;
}

static void a_new_vector_is_zero_and_aligned(void** state) {
	(void)state;
	for (int i = 0; i < LENGTH_COUNT; ++i) {
		JnSpace* space = new_space(lengths[i], 1);
		JnVec vec = space->ops->create(space);
		assert_int_equal((uintptr_t)vec % 64, 0);
		for (size_t k = 0; k < space->length; ++k) assert_true(vec[k] == 0);
		space->ops->destroy(space, vec);
		space->ops->destroy(space, NULL);
		jn_host_space_destroy(space);
	}
}

static void combine_sums_in_the_order_of_its_terms(void** state) {
	(void)state;
	for (int i = 0; i < LENGTH_COUNT; ++i)
		for (int threads = 1; threads <= 4; ++threads) {
			JnSpace* space = new_space(lengths[i], threads);
			JnVec a = filled(space, 0), b = filled(space, 1), c = filled(space, 2), out = space->ops->create(space);
			space->ops->combine(space, out, 3, (JnTerm[]){{2, a}, {-0.3, b}, {0.7, c}});
			for (size_t k = 0; k < space->length; ++k) assert_true(out[k] == 2 * a[k] + -0.3 * b[k] + 0.7 * c[k]);
			space->ops->combine(space, out, 0, NULL);
			for (size_t k = 0; k < space->length; ++k) assert_true(out[k] == 0);
			for (int v = 0; v < 4; ++v) space->ops->destroy(space, (JnVec[]){a, b, c, out}[v]);
			jn_host_space_destroy(space);
		}
}

static void combine_may_write_to_any_of_its_terms(void** state) {
	(void)state;
	for (int position = 0; position < 3; ++position) {
		JnSpace* space = new_space(LENGTH, 4);
		JnVec v[3] = {filled(space, 0), filled(space, 1), filled(space, 2)}, out = space->ops->create(space);
		const JnTerm terms[] = {{2, v[0]}, {-0.3, v[1]}, {0.7, v[2]}, {1.1, v[position]}};
		space->ops->combine(space, out, 4, terms);
		space->ops->combine(space, v[position], 4, terms);
		assert_memory_equal(v[position], out, LENGTH * sizeof *out);
		for (int i = 0; i < 3; ++i) space->ops->destroy(space, v[i]);
		space->ops->destroy(space, out);
		jn_host_space_destroy(space);
	}
}

static void dot_has_the_same_bits_for_any_number_of_threads(void** state) {
	(void)state;
	for (int i = 0; i < LENGTH_COUNT; ++i) {
		double expected = 0;
		for (int threads = 1; threads <= 4; ++threads) {
			JnSpace* space = new_space(lengths[i], threads);
			JnVec a = filled(space, 0), b = filled(space, 1);
			const double value = space->ops->dot(space, a, b);
			if (threads == 1) expected = value;
			if (memcmp(&value, &expected, sizeof value) != 0)
				fail_msg("%d threads: %.17g, expected %.17g, no tolerance", threads, value, expected);
			space->ops->destroy(space, a);
			space->ops->destroy(space, b);
			jn_host_space_destroy(space);
		}
	}
}

static void dot_is_the_sum_of_products(void** state) {
	(void)state;
	for (int i = 0; i < LENGTH_COUNT; ++i) {
		JnSpace* space = new_space(lengths[i], 2);
		JnVec a = filled(space, 0), b = filled(space, 1);
		long double sum = 0, size = 0;
		for (size_t k = 0; k < space->length; ++k) {
			sum += (long double)a[k] * b[k];
			size += fabsl((long double)a[k] * b[k]);
		}
		const double value = space->ops->dot(space, a, b);
		// 600 additions in a row at most (4096 / 8 in a chunk, then the chunks), each rounding by 1.1e-16
		if (!(fabsl(value - sum) <= 7e-14L * size))
			fail_msg("%.17g, expected %.17Lg, tolerance %.3Lg", value, sum, 7e-14L * size);
		space->ops->destroy(space, a);
		space->ops->destroy(space, b);
		jn_host_space_destroy(space);
	}
}

static void max_is_the_largest_size(void** state) {
	(void)state;
	JnSpace* space = new_space(5, 1);
	JnVec a = space->ops->create(space);
	assert_true(space->ops->max(space, a) == 0);
	memcpy(a, (double[]){1, -7, 3, -0.0, 6.5}, 5 * sizeof *a);
	assert_true(space->ops->max(space, a) == 7);
	a[2] = -INFINITY;
	assert_true(space->ops->max(space, a) == INFINITY);
	space->ops->destroy(space, a);
	jn_host_space_destroy(space);
}

static void max_sees_a_nan_wherever_it_stands(void** state) {
	(void)state;
	JnSpace* space = new_space(5000, 4);
	for (size_t place = 0; place < space->length; place += 833) {
		JnVec a = filled(space, 0);
		a[(place + 1) % space->length] = INFINITY;
		a[place] = NAN;
		assert_true(isnan(space->ops->max(space, a)));
		space->ops->destroy(space, a);
	}
	jn_host_space_destroy(space);
}

static void a_copied_state_has_the_same_bytes_and_stamp(void** state) {
	(void)state;
	JnSpace* space = new_space(1000, 2);
	JnState a, b;
	assert_int_equal(jn_state_create(space, &a), JN_OK);
	assert_int_equal(jn_state_create(space, &b), JN_OK);
	for (size_t k = 0; k < space->length; ++k) {
		a.x[k] = sin((double)k);
		a.v[k] = cos((double)k);
	}
	a.t = 3;
	jn_state_touch(space, &a);
	assert_true(a.stamp != b.stamp);
	jn_state_copy(space, &a, &b);
	assert_memory_equal(a.x, b.x, 1000 * sizeof(double));
	assert_memory_equal(a.v, b.v, 1000 * sizeof(double));
	assert_true(a.t == b.t && a.stamp == b.stamp && a.x != b.x);
	jn_state_touch(space, &b);
	assert_true(a.stamp != b.stamp);
	jn_state_destroy(space, &a);
	jn_state_destroy(space, &b);
	assert_null(a.x);
	jn_host_space_destroy(space);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_new_vector_is_zero_and_aligned),
		cmocka_unit_test(combine_sums_in_the_order_of_its_terms),
		cmocka_unit_test(combine_may_write_to_any_of_its_terms),
		cmocka_unit_test(dot_has_the_same_bits_for_any_number_of_threads),
		cmocka_unit_test(dot_is_the_sum_of_products),
		cmocka_unit_test(max_is_the_largest_size),
		cmocka_unit_test(max_sees_a_nan_wherever_it_stands),
		cmocka_unit_test(a_copied_state_has_the_same_bytes_and_stamp),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
