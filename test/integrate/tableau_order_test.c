/// @file tableau_order_test.c
/// Each of the 8 order conditions with up to four nodes, written out, is seen by jn_tableau_properties: a method that
/// violates one of them alone loses its order there. For fixed A the conditions are linear in b, so that 8 stages give
/// one such method for each by an 8 by 8 solve.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "integrate/tableau.h"

enum { STAGES = JN_MAX_STAGES, CONDITIONS = 8 };

static const int NODES[CONDITIONS] = {1, 2, 3, 3, 4, 4, 4, 4};
static const double DENSITY[CONDITIONS] = {1, 2, 3, 6, 4, 8, 12, 24};

/// Any diagonally implicit A without structure will do.
static JnTableau unstructured(void) {
	JnTableau tableau = {.stages = STAGES};
	for (int i = 0; i < STAGES; i++)
		for (int j = 0; j <= i; j++) {
			tableau.a[i][j] = 0.5 * sin(1.7 * (i + 1) * (i + 1) + 2.3 * j * (i + 2));
			tableau.c[i] += tableau.a[i][j];
		}
	return tableau;
}

static void apply(const JnTableau* tableau, const double in[STAGES], double out[STAGES]) {
	for (int i = 0; i < STAGES; i++) {
		out[i] = 0;
		for (int j = 0; j <= i; j++) out[i] += tableau->a[i][j] * in[j];
	}
}

/// Elementary weights 1, c, c^2, Ac, c^3, c Ac, Ac^2, A^2 c (Hairer, Norsett and Wanner I, table II.2.1).
static void weights(const JnTableau* tableau, double phi[CONDITIONS][STAGES]) {
	for (int i = 0; i < STAGES; i++) {
		phi[0][i] = 1;
		phi[1][i] = tableau->c[i];
		phi[2][i] = tableau->c[i] * tableau->c[i];
		phi[4][i] = tableau->c[i] * phi[2][i];
	}
	apply(tableau, phi[1], phi[3]);
	for (int i = 0; i < STAGES; i++) phi[5][i] = tableau->c[i] * phi[3][i];
	apply(tableau, phi[2], phi[6]);
	apply(tableau, phi[3], phi[7]);
}

/// x = matrix^-1 x by elimination with row exchanges.
static void solve(double matrix[CONDITIONS][CONDITIONS], double x[CONDITIONS]) {
	for (int k = 0; k < CONDITIONS; k++) {
		int pivot = k;
		for (int i = k + 1; i < CONDITIONS; i++)
			if (fabs(matrix[i][k]) > fabs(matrix[pivot][k])) pivot = i;
		for (int j = 0; j < CONDITIONS; j++) {
			const double swap = matrix[k][j];
			matrix[k][j] = matrix[pivot][j];
			matrix[pivot][j] = swap;
		}
		const double swap = x[k];
		x[k] = x[pivot];
		x[pivot] = swap;
		for (int i = k + 1; i < CONDITIONS; i++) {
			const double factor = matrix[i][k] / matrix[k][k];
			for (int j = k; j < CONDITIONS; j++) matrix[i][j] -= factor * matrix[k][j];
			x[i] -= factor * x[k];
		}
	}
	for (int i = CONDITIONS - 1; i >= 0; i--) {
		for (int j = i + 1; j < CONDITIONS; j++) x[i] -= matrix[i][j] * x[j];
		x[i] /= matrix[i][i];
	}
}

/// b . phi_t = 1 / density_t, and `violation` more in condition `wrong` (-1: in none).
static JnTableau method_violating(int wrong, double violation) {
	JnTableau tableau = unstructured();
	double phi[CONDITIONS][STAGES];
	weights(&tableau, phi);
	for (int t = 0; t < CONDITIONS; t++) tableau.b[t] = 1 / DENSITY[t] + (t == wrong ? violation : 0);
	solve(phi, tableau.b);
	return tableau;
}

static void weights_that_meet_all_conditions_give_order_four(void** state) {
	(void)state;
	const JnTableau tableau = method_violating(-1, 0);
	assert_int_equal(jn_tableau_properties(&tableau).order, 4);
}

static void each_condition_alone_lowers_the_order(void** state) {
	(void)state;
	for (int t = 0; t < CONDITIONS; t++) {
		const JnTableau tableau = method_violating(t, 1e-6);
		const int order = jn_tableau_properties(&tableau).order;
		if (order != NODES[t] - 1) fail_msg("without condition %d: order %d, expected %d", t, order, NODES[t] - 1);
	}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(weights_that_meet_all_conditions_give_order_four),
		cmocka_unit_test(each_condition_alone_lowers_the_order),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
