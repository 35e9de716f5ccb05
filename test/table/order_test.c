/// @file order_test.c
/// Every method of the list has its order on every problem, or the lower one that theory gives for a stated reason. The
/// same sweep writes docs/orders.md.
#include "table/order_sweep.h"

#include <setjmp.h>
#include <stdarg.h>

#include "integrate/properties.h"
#include "support/support.h"

#include <cmocka.h>

static const OrderProblem* problem_named(const char* name) {
	for (int i = 0; i < ORDER_PROBLEM_COUNT; ++i)
		if (strcmp(order_problems[i].name, name) == 0) return &order_problems[i];
	fail_msg("no problem '%s'", name);
	return NULL;
}

static void check_orders(const char* name) {
	OrderResult results[ORDER_MOST_METHODS];
	assert_int_equal(order_sweep(problem_named(name), results), JN_OK);
	int wrong = 0;
	for (int i = 0; i < jn_integrator_list.count; ++i) {
		const OrderResult* r = &results[i];
		const bool is_right = order_is_met(r);
		print_message("%-12s %-20s order %d: measured %.3f (plain ratio %.2f, errors %.2e to %.2e)%s\n", name,
					  r->type->row.name, r->expected, r->measured, r->plain, r->largest, r->error,
					  is_right ? "" : " WRONG");
		wrong += !is_right;
	}
	if (wrong > 0) fail_msg("%s: %d methods miss their order", name, wrong);
}

static void every_method_has_its_order_on_a_pendulum(void** state) {
	(void)state;
	check_orders("pendulum");
}

static void every_method_has_its_order_on_two_masses(void** state) {
	(void)state;
	check_orders("pair");
}

static void every_method_has_its_order_on_two_damped_masses(void** state) {
	(void)state;
	check_orders("damped pair");
}

static void every_method_has_its_order_under_a_load_that_depends_on_time(void** state) {
	(void)state;
	check_orders("load");
}

static void every_method_has_its_order_on_a_solid(void** state) {
	(void)state;
	check_orders("solid");
}

static void every_method_has_its_order_on_a_solid_with_a_driven_end(void** state) {
	(void)state;
	check_orders("driven solid");
}

// A method that takes what it was not made for would pass the sweep on the diagonal mass alone.
static void explicit_methods_refuse_a_mass_that_is_not_diagonal(void** state) {
	(void)state;
	OrderSystem pair;
	OrderSolution end;
	const OrderProblem* problem = problem_named("pair");
	assert_int_equal(problem->create(ORDER_MASS_OWN, &pair), JN_OK);
	for (int i = 0; i < jn_integrator_list.count; ++i) {
		const JnIntegratorType* type = (const JnIntegratorType*)jn_integrator_list.rows[i];
		const bool is_refused = (type->needs & JN_NEEDS_DIAGONAL_MASS) != 0;
		log_capture();
		const JnStatus status = order_simulate(problem, &pair, type->row.name, 128, &end);
		log_release();
		if (status != (is_refused ? JN_BAD_INPUT : JN_OK)) fail_msg("%s: %s", type->row.name, jn_status_name(status));
	}
	order_system_destroy(&pair);
}

static void every_exception_changes_what_is_expected_of_some_method(void** state) {
	(void)state;
	for (int e = 0; e < ORDER_EXCEPTION_COUNT; ++e) {
		const OrderProblem* problem = problem_named(order_exceptions[e].problem);
		if (jn_row_find(&jn_integrator_list, order_exceptions[e].method) == NULL) continue; // not in this build
		int uses = 0;
		for (int i = 0; i < jn_integrator_list.count; ++i)
			uses +=
				order_exception((const JnIntegratorType*)jn_integrator_list.rows[i], problem) == &order_exceptions[e];
		if (uses == 0) fail_msg("%s on %s: no method needs this", order_exceptions[e].method, problem->name);
	}
}

// An order above the classical one on linear forces is that of exp(z) - R(z), found from the coefficients. An error of
// order q + 1 in the phase of one step is one of order q in a run.
static void orders_gained_on_linear_forces_are_those_of_the_stability_function(void** state) {
	(void)state;
	for (int i = 0; i < jn_integrator_list.count; ++i) {
		const JnIntegratorType* type = (const JnIntegratorType*)jn_integrator_list.rows[i];
		const OrderException* exception = order_exception(type, problem_named("pair"));
		if (exception == NULL || exception->order == ORDER_EXACT) continue;
		JnIntegratorProperties p;
		jn_integrator_properties(type, &p);
		assert_int_equal(p.dispersion_order < p.dissipation_order ? p.dispersion_order : p.dissipation_order,
						 exception->order);
	}
}

// rodas4 shares nothing with esdirk436 but the equations. What the two differ by is their own error, Newton's and rounding:
// at most 1.8e-13 on the small problems, where the smallest error that is judged is 5e-11, and 5e-14 on the solids, where
// it is 5e-13.
static void the_reference_is_far_more_accurate_than_what_it_judges(void** state) {
	(void)state;
	for (int p = 0; p < ORDER_PROBLEM_COUNT; ++p) {
		const OrderProblem* problem = &order_problems[p];
		const double limit = problem->duration > 1 ? 5e-13 : 1.5e-13;
		OrderSystem system;
		OrderSolution reference = {0}, other = {0};
		assert_int_equal(problem->create(ORDER_MASS_OWN, &system), JN_OK);
		assert_int_equal(order_simulate(problem, &system, "esdirk436", problem->reference, &reference), JN_OK);
		assert_int_equal(order_simulate(problem, &system, "rodas4", problem->reference, &other), JN_OK);
		order_system_destroy(&system);
		const double doubt = order_difference(1, &other, NULL, &reference);
		print_message("%-12s reference differs from that of rodas4 by %.2e\n", problem->name, doubt);
		if (!(doubt <= limit)) fail_msg("%s: %.2e, at most %.2e expected", problem->name, doubt, limit);
	}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(the_reference_is_far_more_accurate_than_what_it_judges),
		cmocka_unit_test(explicit_methods_refuse_a_mass_that_is_not_diagonal),
		cmocka_unit_test(every_exception_changes_what_is_expected_of_some_method),
		cmocka_unit_test(orders_gained_on_linear_forces_are_those_of_the_stability_function),
		cmocka_unit_test(every_method_has_its_order_on_a_pendulum),
		cmocka_unit_test(every_method_has_its_order_on_two_masses),
		cmocka_unit_test(every_method_has_its_order_on_two_damped_masses),
		cmocka_unit_test(every_method_has_its_order_under_a_load_that_depends_on_time),
		cmocka_unit_test(every_method_has_its_order_on_a_solid),
		cmocka_unit_test(every_method_has_its_order_on_a_solid_with_a_driven_end),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
