/// @file tableau_test.c
/// The coefficients against their order conditions, the computed properties against an independent table, and both
/// against methods that are known to fail: perturbed ones, explicit ones, and one unstable at middle frequencies.
#include <complex.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "integrate/dirk_tableau.h"
#include "tableau_reference.h"

typedef struct Reference {
	const char* name;
	const JnTableau* tableau;
	JnTableauProperties expected;
	int embedded_order;
	double embedded_r_infinity;
} Reference;

static const double CONDITION = 1e-14; // some 50 roundings of terms below 1
static const double DIGITS = 1e-7;     // the reference prints 8 digits: half a unit of the last is at most 5e-8
static const double ROUNDING = 1e-15;  // a row sum of up to 6 terms

static const JnTableau explicit_euler = {.stages = 1, .b = {1}};

static const JnTableau rk4 = {
	.stages = 4,
	.a = {{0}, {0.5}, {0, 0.5}, {0, 0, 1}},
	.b = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6},
	.c = {0, 0.5, 0.5, 1},
};

// clang-format off
// Dormand and Prince 1980, RK5(4)7FM.
static const JnTableau dormand_prince = {
	.stages = 7,
	.a = {
		{0},
		{1.0 / 5},
		{3.0 / 40, 9.0 / 40},
		{44.0 / 45, -56.0 / 15, 32.0 / 9},
		{19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
		{9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
		{35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84},
	},
	.b = {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84},
	.c = {0, 1.0 / 5, 3.0 / 10, 4.0 / 5, 8.0 / 9, 1, 1},
	.has_embedded = true,
	.b_embedded = {5179.0 / 57600, 0, 7571.0 / 16695, 393.0 / 640, -92097.0 / 339200, 187.0 / 2100, 1.0 / 40},
	.embedded_order = 4,
};

#define LIBRARY(name) &jn_tableau_##name
#define LOCAL(name) &name
#define REFERENCE(NAME, tableau_of, p, so, n, A, L, sa, fe, rinf, q, cq, r, cr, eo, er) \
	{#NAME, tableau_of(NAME), {.order = p, .stage_order = so, .implicit_solves = n, .a_stable = A, .l_stable = L, \
	 .stiffly_accurate = sa, .first_explicit = fe, .r_infinity = rinf, .dispersion_order = q, .dispersion = cq, \
	 .dissipation_order = r, .dissipation = cr}, eo, er},
#define IMPLICIT(name, ...) REFERENCE(name, LIBRARY, __VA_ARGS__)
#define EXPLICIT(name, ...) REFERENCE(name, LOCAL, __VA_ARGS__)
static const Reference REFERENCES[] = {
	IMPLICIT_REFERENCES(IMPLICIT)
	EXPLICIT_REFERENCES(EXPLICIT)
};
// clang-format on
enum { REFERENCE_COUNT = sizeof REFERENCES / sizeof REFERENCES[0] };

static JnTableau with_embedded_weights(const JnTableau* tableau) {
	JnTableau embedded = *tableau;
	for (int i = 0; i < tableau->stages; i++) embedded.b[i] = tableau->b_embedded[i];
	return embedded;
}

static void check_int(const char* method, const char* property, int value, int expected) {
	if (value != expected) fail_msg("%s: %s is %d, expected %d", method, property, value, expected);
}

static void check_near(const char* method, const char* property, double value, double expected, double tolerance) {
	if (value == expected || fabs(value - expected) <= tolerance) return;
	fail_msg("%s: %s is %.17g, expected %.17g, tolerance %g", method, property, value, expected, tolerance);
}

static void every_row_sum_is_its_abscissa(void** state) {
	(void)state;
	for (int m = 0; m < REFERENCE_COUNT; m++) {
		const JnTableau* tableau = REFERENCES[m].tableau;
		for (int i = 0; i < tableau->stages; i++) {
			double sum = 0, size = 1;
			for (int j = 0; j < tableau->stages; j++) {
				sum += tableau->a[i][j];
				size += fabs(tableau->a[i][j]);
			}
			check_near(REFERENCES[m].name, "row sum", sum, tableau->c[i], ROUNDING * size);
		}
	}
}

static void every_tableau_is_lower_triangular(void** state) {
	(void)state;
	for (int m = 0; m < REFERENCE_COUNT; m++)
		for (int i = 0; i < JN_MAX_STAGES; i++)
			for (int j = i + 1; j < JN_MAX_STAGES; j++) assert_true(REFERENCES[m].tableau->a[i][j] == 0);
}

static void order_conditions_hold_to_rounding(void** state) {
	(void)state;
	for (int m = 0; m < REFERENCE_COUNT; m++) {
		const JnTableauProperties is = jn_tableau_properties(REFERENCES[m].tableau);
		check_near(REFERENCES[m].name, "order residual", is.order_residual, 0, CONDITION);
	}
}

static void orders_are_the_reference(void** state) {
	(void)state;
	for (int m = 0; m < REFERENCE_COUNT; m++) {
		const JnTableauProperties is = jn_tableau_properties(REFERENCES[m].tableau);
		const JnTableauProperties* expected = &REFERENCES[m].expected;
		check_int(REFERENCES[m].name, "order", is.order, expected->order);
		check_int(REFERENCES[m].name, "stage order", is.stage_order, expected->stage_order);
		check_int(REFERENCES[m].name, "implicit solves", is.implicit_solves, expected->implicit_solves);
		check_int(REFERENCES[m].name, "stiffly accurate", is.stiffly_accurate, expected->stiffly_accurate);
		check_int(REFERENCES[m].name, "first explicit", is.first_explicit, expected->first_explicit);
	}
}

static void stability_is_the_reference(void** state) {
	(void)state;
	for (int m = 0; m < REFERENCE_COUNT; m++) {
		const JnTableauProperties is = jn_tableau_properties(REFERENCES[m].tableau);
		const JnTableauProperties* expected = &REFERENCES[m].expected;
		check_int(REFERENCES[m].name, "A-stable", is.a_stable, expected->a_stable);
		check_int(REFERENCES[m].name, "L-stable", is.l_stable, expected->l_stable);
		check_near(REFERENCES[m].name, "R(infinity)", is.r_infinity, expected->r_infinity,
				   DIGITS * fabs(expected->r_infinity));
	}
}

static void dispersion_and_dissipation_are_the_reference(void** state) {
	(void)state;
	for (int m = 0; m < REFERENCE_COUNT; m++) {
		const JnTableauProperties is = jn_tableau_properties(REFERENCES[m].tableau);
		const JnTableauProperties* expected = &REFERENCES[m].expected;
		check_int(REFERENCES[m].name, "dispersion order", is.dispersion_order, expected->dispersion_order);
		check_int(REFERENCES[m].name, "dissipation order", is.dissipation_order, expected->dissipation_order);
		check_near(REFERENCES[m].name, "dispersion", is.dispersion, expected->dispersion,
				   DIGITS * fabs(expected->dispersion));
		check_near(REFERENCES[m].name, "dissipation", is.dissipation, expected->dissipation,
				   DIGITS * fabs(expected->dissipation));
	}
}

static void embedded_weights_are_the_reference(void** state) {
	(void)state;
	for (int m = 0; m < REFERENCE_COUNT; m++) {
		const Reference* expected = &REFERENCES[m];
		check_int(expected->name, "has embedded", expected->tableau->has_embedded, expected->embedded_order > 0);
		if (!expected->tableau->has_embedded) continue;
		const JnTableau embedded = with_embedded_weights(expected->tableau);
		const JnTableauProperties is = jn_tableau_properties(&embedded);
		check_int(expected->name, "stated embedded order", embedded.embedded_order, expected->embedded_order);
		check_int(expected->name, "embedded order", is.order, expected->embedded_order);
		check_near(expected->name, "embedded order residual", is.order_residual, 0, CONDITION);
		check_near(expected->name, "embedded R(infinity)", is.r_infinity, expected->embedded_r_infinity,
				   DIGITS * fabs(expected->embedded_r_infinity));
	}
}

static void perturbed_weight_is_not_consistent(void** state) {
	(void)state;
	for (int m = 0; m < REFERENCE_COUNT; m++)
		for (int i = 0; i < REFERENCES[m].tableau->stages; i++) {
			JnTableau wrong = *REFERENCES[m].tableau;
			wrong.b[i] += 1e-6;
			check_int(REFERENCES[m].name, "order with a wrong weight", jn_tableau_properties(&wrong).order, 0);
		}
}

/// b.c = 1/2 moves by b_i 1e-6, at least 1.5e-8 here.
static void perturbed_coefficient_leaves_order_one(void** state) {
	(void)state;
	for (int m = 0; m < REFERENCE_COUNT; m++)
		for (int i = 0; i < REFERENCES[m].tableau->stages; i++)
			for (int j = 0; j <= i && REFERENCES[m].tableau->b[i] != 0; j++) {
				JnTableau wrong = *REFERENCES[m].tableau;
				wrong.a[i][j] += 1e-6;
				check_int(REFERENCES[m].name, "order with a wrong entry", jn_tableau_properties(&wrong).order, 1);
			}
}

static void wrong_abscissa_has_no_stage_order(void** state) {
	(void)state;
	JnTableau wrong = jn_tableau_esdirk325;
	wrong.c[2] += 1e-6;
	assert_int_equal(jn_tableau_properties(&wrong).stage_order, 0);
}

/// The only method here that passes all 17 trees; with its other weights it fails some of those with five nodes.
static void dormand_prince_has_orders_five_and_four(void** state) {
	(void)state;
	const JnTableauProperties is = jn_tableau_properties(&dormand_prince);
	assert_int_equal(is.order, 5);
	check_near("dormand_prince", "order residual", is.order_residual, 0, CONDITION);
	const JnTableau embedded = with_embedded_weights(&dormand_prince);
	assert_int_equal(jn_tableau_properties(&embedded).order, 4);
}

/// R(z) = 1 + z sum_i b_i y_i with the stages y_i = 1 + z sum_j a_ij y_j solved one by one.
static double complex amplification(const JnTableau* tableau, double complex z) {
	double complex stage[JN_MAX_STAGES], end = 1;
	for (int i = 0; i < tableau->stages; i++) {
		double complex sum = 1;
		for (int j = 0; j < i; j++) sum += z * tableau->a[i][j] * stage[j];
		stage[i] = sum / (1 - z * tableau->a[i][i]);
		end += z * tableau->b[i] * stage[i];
	}
	return end;
}

static void stability_function_is_one_step_of_the_test_equation(void** state) {
	(void)state;
	const double complex points[] = {-0.3, -4, 0.7 * I, 5 * I, -1 + 2 * I, 0.1 - 3 * I};
	for (int m = 0; m < REFERENCE_COUNT; m++)
		for (int k = 0; k < (int)(sizeof points / sizeof points[0]); k++) {
			double p[JN_MAX_STAGES + 1], q[JN_MAX_STAGES + 1];
			jn_tableau_stability(REFERENCES[m].tableau, p, q);
			double complex above = 0, below = 0;
			for (int n = JN_MAX_STAGES; n >= 0; n--) {
				above = above * points[k] + p[n];
				below = below * points[k] + q[n];
			}
			const double error = cabs(above / below - amplification(REFERENCES[m].tableau, points[k]));
			check_near(REFERENCES[m].name, "error of P/Q", error, 0, 1e-12); // terms reach 1e3 at |z| = 5
		}
}

/// The third root of g^3 - 3g^2 + 3g/2 - 1/6: order 3 and R(infinity) = 0 as SDIRK3, but |R(iy)| > 1 for small y.
static void sdirk3_with_its_small_root_is_not_a_stable(void** state) {
	(void)state;
	const double g = 0.15898389998867660;
	const double b1 = -(6 * g * g - 16 * g + 1) / 4, b2 = (6 * g * g - 20 * g + 5) / 4;
	const JnTableau small = {
		.stages = 3, .a = {{g}, {(1 - g) / 2, g}, {b1, b2, g}}, .b = {b1, b2, g}, .c = {g, (1 + g) / 2, 1}};
	const JnTableauProperties is = jn_tableau_properties(&small);
	assert_int_equal(is.order, 3);
	assert_true(is.r_infinity == 0);
	assert_false(is.a_stable);
	assert_false(is.l_stable);
}

/// P = 1 + z^2 / 2, Q = (1 - z/3)^3: E(w) = 4/3 w - 23/108 w^2 + w^3 / 729 is negative for 6.5 < w < 149 alone.
static void instability_at_middle_frequencies_is_not_a_stable(void** state) {
	(void)state;
	const double g = 1.0 / 3;
	const JnTableau middle = {
		.stages = 3, .a = {{g}, {1, g}, {0, 1, g}}, .b = {1.0 / 6, 17.0 / 27, 11.0 / 54}, .c = {g, 1 + g, 1 + g}};
	double p[JN_MAX_STAGES + 1], q[JN_MAX_STAGES + 1];
	jn_tableau_stability(&middle, p, q);
	check_near("middle", "p[2]", p[2], 0.5, ROUNDING);
	assert_true(p[1] == 0 && p[3] == 0);
	assert_false(jn_tableau_properties(&middle).a_stable);
	assert_true(cabs(amplification(&middle, I * sqrt(5.0))) < 1);
	assert_true(cabs(amplification(&middle, I * sqrt(50.0))) > 1);
	assert_true(cabs(amplification(&middle, I * sqrt(200.0))) < 1);
}

/// Midpoint steps of -h/2 and 3h/2: |R(iy)| = 1 throughout, but R has a pole at -4.
static void pole_in_the_left_half_plane_is_not_a_stable(void** state) {
	(void)state;
	const JnTableau left = {.stages = 2, .a = {{-0.25}, {-0.5, 0.75}}, .b = {-0.5, 1.5}, .c = {-0.25, 0.25}};
	const JnTableauProperties is = jn_tableau_properties(&left);
	assert_int_equal(is.order, 2);
	assert_int_equal(is.dissipation_order, 0);
	check_near("left", "|R(3i)|", cabs(amplification(&left, 3 * I)), 1, ROUNDING);
	assert_false(is.a_stable);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(every_row_sum_is_its_abscissa),
		cmocka_unit_test(every_tableau_is_lower_triangular),
		cmocka_unit_test(order_conditions_hold_to_rounding),
		cmocka_unit_test(orders_are_the_reference),
		cmocka_unit_test(stability_is_the_reference),
		cmocka_unit_test(dispersion_and_dissipation_are_the_reference),
		cmocka_unit_test(embedded_weights_are_the_reference),
		cmocka_unit_test(perturbed_weight_is_not_consistent),
		cmocka_unit_test(perturbed_coefficient_leaves_order_one),
		cmocka_unit_test(wrong_abscissa_has_no_stage_order),
		cmocka_unit_test(dormand_prince_has_orders_five_and_four),
		cmocka_unit_test(stability_function_is_one_step_of_the_test_equation),
		cmocka_unit_test(sdirk3_with_its_small_root_is_not_a_stable),
		cmocka_unit_test(instability_at_middle_frequencies_is_not_a_stable),
		cmocka_unit_test(pole_in_the_left_half_plane_is_not_a_stable),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
