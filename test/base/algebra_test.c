// The loops of all vector widths that this processor has: the same bits, and those of the plain definition.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/algebra.h"
#include "base/processor.h"

enum { MOST = 1000 };

static const size_t lengths[] = {0, 1, 7, 8, 15, 16, 17, 64, 909, MOST};
enum { LENGTHS = sizeof lengths / sizeof *lengths };

static double a[MOST], b[MOST], c[MOST], d[MOST], out[MOST];

static int fill(void** state) {
	(void)state;
	for (int k = 0; k < MOST; ++k) {
		a[k] = sin(1.7 * k) * exp(3 * cos(0.3 * k));
		b[k] = cos(2.9 * k) * exp(2 * sin(0.7 * k));
		c[k] = sin(0.1 * k + 1);
		d[k] = 1 / (1.0 + k);
	}
	return 0;
}

static int list_widths(const JnAlgebra* list[3]) {
	int count = 0;
	list[count++] = &jn_algebra_2;
#if defined(__x86_64__)
	if (jn_processor_width() >= 4) list[count++] = &jn_algebra_4;
	if (jn_processor_width() >= 8) list[count++] = &jn_algebra_8;
#endif
	return count;
}

#define EACH_WIDTH(algebra)                                                                                            \
	const JnAlgebra* each[3];                                                                                          \
	const int each_count = list_widths(each);                                                                          \
	for (int w = 0; w < each_count; ++w)                                                                               \
		for (const JnAlgebra* algebra = each[w]; algebra != NULL; algebra = NULL)

static void sums_are_those_of_plain_loops(void** state) {
	(void)state;
	const JnTerm terms[] = {{2, a}, {-0.3, b}, {0.7, c}, {1.1, d}};
	EACH_WIDTH(algebra) for (int i = 0; i < LENGTHS; ++i) {
		const size_t n = lengths[i];
		for (int count = 1; count <= 4; ++count) {
			algebra->combine(n, count, terms, out);
			for (size_t k = 0; k < n; ++k) {
				double sum = 2 * a[k];
				if (count > 1) sum += -0.3 * b[k];
				if (count > 2) sum += 0.7 * c[k];
				if (count > 3) sum += 1.1 * d[k];
				assert_true(out[k] == sum);
			}
		}
		algebra->multiply(n, a, b, out);
		for (size_t k = 0; k < n; ++k) assert_true(out[k] == a[k] * b[k]);
		memcpy(out, c, sizeof out);
		algebra->accumulate(n, -0.3, a, b, out);
		for (size_t k = 0; k < n; ++k) assert_true(out[k] == c[k] + -0.3 * (a[k] * b[k]));
	}
}

static void every_width_gives_the_same_dot_product(void** state) {
	(void)state;
	EACH_WIDTH(algebra)
	for (int i = 0; i < LENGTHS; ++i) assert_true(algebra->dot(lengths[i], a, b) == jn_algebra_2.dot(lengths[i], a, b));
}

static void the_largest_entry_is_found_wherever_it_stands(void** state) {
	(void)state;
	double x[40];
	EACH_WIDTH(algebra) for (size_t n = 1; n <= 40; ++n) for (size_t place = 0; place < n; ++place) {
		for (size_t k = 0; k < n; ++k) x[k] = 0.5 - (double)(k % 2);
		x[place] = -7;
		assert_true(algebra->max(n, x) == 7);
		x[place] = -INFINITY;
		assert_true(algebra->max(n, x) == INFINITY);
		x[(place + 3) % n] = NAN;
		assert_true(isnan(algebra->max(n, x)));
	}
}

static void an_advance_tells_of_every_end_that_is_not_finite(void** state) {
	(void)state;
	static double v[MOST], x[MOST], ones[MOST], force[MOST];
	const double bad[] = {NAN, INFINITY, -INFINITY};
	for (int k = 0; k < MOST; ++k) ones[k] = 1;
	EACH_WIDTH(algebra) for (size_t n = 1; n < 40; ++n) {
		const JnAdvance by = {
			.kick = 1, .drift = 2, .inverse_mass = ones, .force = force, .x = x, .v = v, .x_out = out, .v_out = d};
		JnAdvance kick = by;
		kick.drift = 0;
		assert_true(algebra->advance(0, n, &by) && algebra->advance(0, n, &kick));
		for (int i = 0; i < 3; ++i) {
			force[n - 1] = bad[i];
			assert_false(algebra->advance(0, n, &by) || algebra->advance(0, n, &kick));
			force[n - 1] = 0;
		}
		v[n - 1] = 1e308; // x + 2 v is beyond all numbers, v is not
		assert_false(algebra->advance(0, n, &by));
		assert_true(algebra->advance(0, n, &kick));
		v[n - 1] = 0;
	}
	fill(NULL); // d
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(sums_are_those_of_plain_loops),
		cmocka_unit_test(every_width_gives_the_same_dot_product),
		cmocka_unit_test(the_largest_entry_is_found_wherever_it_stands),
		cmocka_unit_test(an_advance_tells_of_every_end_that_is_not_finite),
	};
	return cmocka_run_group_tests(tests, fill, NULL);
}
