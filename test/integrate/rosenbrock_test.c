/// @file rosenbrock_test.c
/// The coefficients of Rosenbrock methods against their order conditions, and the computed properties against an
/// independent table, made apart from jounce in 50-digit arithmetic and printed with 8 digits.
#include <complex.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "integrate/rosenbrock.h"
#include "integrate/rosenbrock_tableau.h"

typedef struct Reference {
	const char* name;
	const JnRosenbrock* method;
	const JnIntegratorType* row;
	int order, a_stable, stiffly_accurate;
	double r_infinity;
	int dispersion_order;
	double dispersion;
	int dissipation_order;
	double dissipation;
	int embedded_order;
	double embedded_r_infinity;
} Reference;

// Sums of b_i phi_i with b up to 2.5 and phi up to 3 from coefficients up to 34, each rounded to 1.1e-16.
static const double CONDITION = 1e-14;
static const double DIGITS = 1e-7;    // the reference prints 8 digits: half a unit of the last is at most 5e-8
static const double ROUNDING = 2e-15; // relative to the sum of up to 6 |terms|

// clang-format off
#define ROW(name, ...) {#name, &jn_rosenbrock_##name, &jn_##name, __VA_ARGS__}
static const Reference REFERENCES[] = {
	// name, order, A-stable, stiffly accurate, R(infinity), dispersion order and constant, dissipation order and constant
	// (0, 0: none), order and R(infinity) of the embedded weights (0, 0: none)
	ROW(linearized_euler,    1, 1, 0,         0.0, 2,    0.33333333, 1,          0.5, 0,           0),
	ROW(linearized_midpoint, 2, 1, 0,        -1.0, 2,   0.083333333, 0,            0, 0,           0),
	ROW(ros2,                2, 1, 0,         0.0, 2,   0.040440115, 3, 0.0036796564, 1,  -2.4142136),
	ROW(ros3p,               3, 1, 0, -0.73205081, 4,   0.098112522, 3,  0.089779189, 2, -0.73205081),
	ROW(ros3pl,              3, 1, 1,         0.0, 4,   0.015402883, 3,  0.025897085, 2,       -0.25),
	ROW(ros3prl2,            3, 1, 1,         0.0, 4,   0.015402883, 3,  0.025897085, 2,       -0.25),
	ROW(ros34pw2,            3, 1, 1,         0.0, 4,   0.015402883, 3,  0.025897085, 2, -0.47834977),
	ROW(ros34pw3,            4, 1, 0, -0.63041494, 4,    -0.1643929, 5,   0.44856194, 2, -0.43376283),
	ROW(rodas3,              3, 1, 1,         0.0, 4,  0.0083333333, 3,  0.020833333, 2,         0.0),
	ROW(rodas4,              4, 1, 1,         0.0, 4, 0.00072636314, 5,  8.712225e-5, 3,         0.0),
};
// clang-format on
enum { REFERENCE_COUNT = sizeof REFERENCES / sizeof REFERENCES[0] };

static void check_int(const char* method, const char* property, int value, int expected) {
	if (value != expected) fail_msg("%s: %s is %d, expected %d", method, property, value, expected);
}

static void check_near(const char* method, const char* property, double value, double expected, double tolerance) {
	if (value == expected || fabs(value - expected) <= tolerance) return;
	fail_msg("%s: %s is %.17g, expected %.17g, tolerance %g", method, property, value, expected, tolerance);
}

static void row_sums_of_the_slope_form_are_alpha_and_gamma(void** state) {
	(void)state;
	for (int m = 0; m < REFERENCE_COUNT; m++) {
		const JnRosenbrock* method = REFERENCES[m].method;
		const JnSlopeForm form = jn_rosenbrock_slopes(method);
		for (int i = 0; i < method->stages; i++) {
			double alpha = 0, gamma = 0, size = 1;
			for (int j = 0; j <= i; j++) {
				alpha += form.alpha[i][j];
				gamma += form.gamma[i][j];
				size += fabs(form.alpha[i][j]) + fabs(form.gamma[i][j]);
			}
			check_near(REFERENCES[m].name, "row sum of alpha", alpha, method->alpha[i], ROUNDING * size);
			check_near(REFERENCES[m].name, "row sum of gamma", gamma, method->gamma_sum[i], ROUNDING * size);
		}
	}
}

static void rows_state_the_computed_order_and_the_square_of_gamma(void** state) {
	(void)state;
	for (int m = 0; m < REFERENCE_COUNT; m++) {
		JnTableauProperties is = {0};
		REFERENCES[m].row->properties(REFERENCES[m].row->table, &is);
		const double gamma = REFERENCES[m].method->gamma;
		check_int(REFERENCES[m].name, "stated order", REFERENCES[m].row->order, is.order);
		check_near(REFERENCES[m].name, "force weight", REFERENCES[m].row->force_weight, gamma * gamma, ROUNDING);
	}
}

static void orders_are_the_reference(void** state) {
	(void)state;
	for (int m = 0; m < REFERENCE_COUNT; m++) {
		const JnTableauProperties is = jn_rosenbrock_properties(REFERENCES[m].method);
		check_int(REFERENCES[m].name, "order", is.order, REFERENCES[m].order);
		check_near(REFERENCES[m].name, "order residual", is.order_residual, 0, CONDITION);
		check_int(REFERENCES[m].name, "stages", is.stages, REFERENCES[m].method->stages);
		check_int(REFERENCES[m].name, "solves", is.implicit_solves, REFERENCES[m].method->stages);
		check_int(REFERENCES[m].name, "stiffly accurate", is.stiffly_accurate, REFERENCES[m].stiffly_accurate);
	}
}

static void stability_is_the_reference(void** state) {
	(void)state;
	for (int m = 0; m < REFERENCE_COUNT; m++) {
		const Reference* expected = &REFERENCES[m];
		const JnTableauProperties is = jn_rosenbrock_properties(expected->method);
		check_int(expected->name, "A-stable", is.a_stable, expected->a_stable);
		check_int(expected->name, "L-stable", is.l_stable, expected->r_infinity == 0);
		check_near(expected->name, "R(infinity)", is.r_infinity, expected->r_infinity, DIGITS);
		check_int(expected->name, "dispersion order", is.dispersion_order, expected->dispersion_order);
		check_int(expected->name, "dissipation order", is.dissipation_order, expected->dissipation_order);
		check_near(expected->name, "dispersion", is.dispersion, expected->dispersion,
				   DIGITS * fabs(expected->dispersion));
		check_near(expected->name, "dissipation", is.dissipation, expected->dissipation,
				   DIGITS * fabs(expected->dissipation));
	}
}

static void embedded_weights_are_the_reference(void** state) {
	(void)state;
	for (int m = 0; m < REFERENCE_COUNT; m++) {
		const Reference* expected = &REFERENCES[m];
		check_int(expected->name, "has embedded", expected->method->has_embedded, expected->embedded_order > 0);
		if (!expected->method->has_embedded) continue;
		JnRosenbrock embedded = *expected->method;
		for (int i = 0; i < embedded.stages; i++) embedded.m[i] = embedded.m_embedded[i];
		const JnTableauProperties is = jn_rosenbrock_properties(&embedded);
		check_int(expected->name, "stated embedded order", embedded.embedded_order, expected->embedded_order);
		check_int(expected->name, "embedded order", is.order, expected->embedded_order);
		check_near(expected->name, "embedded R(infinity)", is.r_infinity, expected->embedded_r_infinity, DIGITS);
	}
}

/// R(z) = 1 + sum m_i u_i with the stages of the transformed form solved one by one, h = 1.
static double complex amplification(const JnRosenbrock* method, double complex z) {
	double complex u[JN_MAX_STAGES], end = 1;
	for (int i = 0; i < method->stages; i++) {
		double complex y = 1, coupling = 0;
		for (int j = 0; j < i; j++) {
			y += method->a[i][j] * u[j];
			coupling += method->c[i][j] * u[j];
		}
		u[i] = (z * y + coupling) / (1 / method->gamma - z);
		end += method->m[i] * u[i];
	}
	return end;
}

/// R - exp falls like z^(p+1), which the slope form has no part in.
static void transformed_form_follows_the_exponential_to_its_order(void** state) {
	(void)state;
	const double complex direction = 0.6 + 0.8 * I;
	for (int m = 0; m < REFERENCE_COUNT; m++) {
		const double complex coarse = 0.04 * direction, fine = 0.02 * direction;
		const double before = cabs(amplification(REFERENCES[m].method, coarse) - cexp(coarse));
		const double after = cabs(amplification(REFERENCES[m].method, fine) - cexp(fine));
		// 0.2: the next term of the series, at |z| = 0.04 with a ratio of constants up to 5
		check_near(REFERENCES[m].name, "order of R", log2(before / after) - 1, REFERENCES[m].order, 0.2);
	}
}

static void transformed_form_does_not_grow_on_the_imaginary_axis(void** state) {
	(void)state;
	for (int m = 0; m < REFERENCE_COUNT; m++)
		for (double y = 1e-2; y < 1e4; y *= 1.1) {
			const double growth = cabs(amplification(REFERENCES[m].method, I * y)) - 1;
			// stages of up to 34 |u| cancel to R: some 100 roundings of 1e-16 each
			if (growth > 1e-13) fail_msg("%s: |R(%g i)| - 1 = %g", REFERENCES[m].name, y, growth);
		}
}

static void perturbed_coefficients_lose_the_order(void** state) {
	(void)state;
	for (int m = 0; m < REFERENCE_COUNT; m++)
		for (int i = 0; i < REFERENCES[m].method->stages; i++) {
			JnRosenbrock wrong = *REFERENCES[m].method;
			wrong.m[i] += 1e-6;
			// what is lost depends on the leading term of u_i, but the full order of a method above the first is always lost
			if (jn_rosenbrock_properties(&wrong).order >= REFERENCES[m].order && REFERENCES[m].order > 1)
				fail_msg("%s: order %d in spite of a wrong m[%d]", REFERENCES[m].name, REFERENCES[m].order, i);
			for (int j = 0; j < i && REFERENCES[m].order > 2; j++) {
				wrong = *REFERENCES[m].method;
				wrong.c[i][j] += 1e-6;
				if (jn_rosenbrock_properties(&wrong).order >= REFERENCES[m].order)
					fail_msg("%s: order %d in spite of a wrong c[%d][%d]", REFERENCES[m].name, REFERENCES[m].order, i,
							 j);
			}
		}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(row_sums_of_the_slope_form_are_alpha_and_gamma),
		cmocka_unit_test(rows_state_the_computed_order_and_the_square_of_gamma),
		cmocka_unit_test(orders_are_the_reference),
		cmocka_unit_test(stability_is_the_reference),
		cmocka_unit_test(embedded_weights_are_the_reference),
		cmocka_unit_test(transformed_form_follows_the_exponential_to_its_order),
		cmocka_unit_test(transformed_form_does_not_grow_on_the_imaginary_axis),
		cmocka_unit_test(perturbed_coefficients_lose_the_order),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
