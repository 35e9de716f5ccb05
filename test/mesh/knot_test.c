// The determinants of knots that are known, by test/support/knot.h: what other tests rely on.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "support/knot.h"

enum { COUNT = 240 };
static const double pi = 3.14159265358979323846;

static void torus_knot(int p, int q, double* points) {
	for (int i = 0; i < COUNT; ++i) {
		const double t = 2 * pi * i / COUNT, r = 2 + cos(q * t);
		points[3 * i] = r * cos(p * t);
		points[3 * i + 1] = r * sin(p * t);
		points[3 * i + 2] = sin(q * t);
	}
}

// |Alexander(-1)| of T(p, q): 1 where both are odd, else the odd one.
static void torus_knots_have_the_determinants_of_theory(void** state) {
	(void)state;
	static const int cases[][3] = {{2, 3, 3}, {2, 5, 5}, {3, 2, 3}, {3, 4, 3}, {3, 5, 1}, {2, 7, 7}, {1, 3, 1}};
	double points[3 * COUNT];
	for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
		torus_knot(cases[k][0], cases[k][1], points);
		assert_int_equal(knot_determinant(COUNT, points, true), cases[k][2]);
	}
}

static void a_figure_eight_has_five(void** state) {
	(void)state;
	double points[3 * COUNT];
	for (int i = 0; i < COUNT; ++i) {
		const double t = 2 * pi * i / COUNT, r = 2 + cos(2 * t);
		points[3 * i] = r * cos(3 * t);
		points[3 * i + 1] = r * sin(3 * t);
		points[3 * i + 2] = sin(4 * t);
	}
	assert_int_equal(knot_determinant(COUNT, points, true), 5);
}

// Crossings alone make no knot: a curve that curls, and a trefoil with one crossing changed.
static void curls_and_wound_curves_have_one(void** state) {
	(void)state;
	double points[3 * COUNT];
	for (int i = 0; i < COUNT; ++i) {
		const double t = 2 * pi * i / COUNT;
		points[3 * i] = cos(t) + 0.8 * cos(6 * t);
		points[3 * i + 1] = sin(t) + 0.8 * sin(6 * t);
		points[3 * i + 2] = 0.3 * sin(t + 0.2);
	}
	assert_int_equal(knot_determinant(COUNT, points, true), 1);
	for (int i = 0; i < COUNT; ++i) {
		points[3 * i] = cos(0.4 * i);
		points[3 * i + 1] = sin(0.4 * i);
		points[3 * i + 2] = 0.05 * i;
	}
	assert_int_equal(knot_determinant(COUNT, points, false), 1); // a helix, open
}

// Shastri's polynomial knot (t^3 - 3 t, t^4 - 4 t^2, t^5 - 10 t) is a trefoil with ends at infinity; with z = t none.
static void an_open_trefoil_has_three(void** state) {
	(void)state;
	double points[3 * COUNT];
	for (int is_tied = 0; is_tied < 2; ++is_tied) {
		for (int i = 0; i < COUNT; ++i) {
			const double t = 6.0 * i / (COUNT - 1) - 3, square = t * t;
			points[3 * i] = t * (square - 3);
			points[3 * i + 1] = square * (square - 4);
			points[3 * i + 2] = is_tied ? t * (square * square - 10) : t;
		}
		assert_int_equal(knot_determinant(COUNT, points, false), is_tied ? 3 : 1);
	}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(torus_knots_have_the_determinants_of_theory),
		cmocka_unit_test(a_figure_eight_has_five),
		cmocka_unit_test(curls_and_wound_curves_have_one),
		cmocka_unit_test(an_open_trefoil_has_three),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
