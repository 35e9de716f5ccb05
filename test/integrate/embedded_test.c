/// @file embedded_test.c
/// The embedded estimate of a step's error falls as theory says when the step is halved: with order min(p, p^) + 1, and for
/// sdirk2, whose estimate uses the slope at the start, with order 3.
#include "integrate/tableau.h"
#include "support/model_case.h"

static double estimate(const JnRow* method, double dt) {
	ModelCase c;
	Rig rig;
	case_box(&c, JN_HEX8, "stable_neo_hookean");
	case_gravity(&c, 1, -9.81, 0);
	case_method(&c, method);
	c.sim.newton.tolerance = 1e-13;
	rig_create(&rig, &c, 1);
	for (int i = 0; i < 20; ++i) rig_step(&rig, 1e-3); // away from rest, where leading terms vanish
	assert_int_equal(rig_attempt(&rig, dt), JN_OK);
	const double error = rig.report.error;
	rig_destroy(&rig);
	return error;
}

static void estimates_fall_with_their_order(void** state) {
	(void)state;
	int checked = 0;
	for (int i = 0; i < jn_integrator_list.count; ++i) {
		const JnRow* row = jn_integrator_list.rows[i];
		const JnIntegratorType* type = (const JnIntegratorType*)row;
		if (!is_dirk(row)) continue;
		const JnTableau* table = type->table;
		if (!table->has_embedded) continue;
		const int expected = jn_tableau_properties(table).error_order;
		const double coarse = estimate(row, 1e-3), fine = estimate(row, 5e-4);
		const double order = log2(coarse / fine);
		print_message("%-14s %.3e %.3e order %.2f, expected %d\n", row->name, coarse, fine, order, expected);
		assert_true(fabs(order - expected) < 0.25); // the next term of the series is some 10 % at these steps
		++checked;
	}
	assert_true(checked >= 6);
}

static void methods_without_a_pair_report_zero(void** state) {
	(void)state;
	const JnRow* row = jn_row_find(&jn_integrator_list, "backward_euler");
	assert_true(estimate(row, 1e-3) == 0);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(estimates_fall_with_their_order),
		cmocka_unit_test(methods_without_a_pair_report_zero),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
