/// @file choice_test.c
/// Which way is chosen, from counts alone.
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "solve/choice.h"

// A sheet of 97 x 97 x 2 nodes; its factor as CHOLMOD counts it.
enum { NODES = 18818, BLOCKS = 180000 };
static const double flops = 3.5e9, entries = 1.04e7;
static const bool all[JN_WAY_COUNT] = {true, false, true, true, true, true};

static void learn_all(JnChoice* choice) {
	jn_choice_learn(choice, JN_WAY_INCOMPLETE, 45, 1.6);
	jn_choice_learn(choice, JN_WAY_MULTIGRID, 60, 9);
	jn_choice_learn_factor(choice, flops, entries);
}

// `count` matrices with a solve each, to four digits; `rate[way]` iterations a digit.
static void solve_some(JnChoice* choice, int count, const double rate[JN_WAY_COUNT]) {
	for (int i = 0; i < count; ++i) {
		jn_choice_next(choice);
		jn_choice_count_matrix(choice, jn_choice_renews(choice));
		jn_choice_count_solve(choice, choice->way == JN_WAY_DIRECT ? 0 : (int)(4 * rate[choice->way]), 4);
	}
}

static void a_soft_sheet_stays_with_the_incomplete_factor(void** state) {
	(void)state;
	static const double rate[JN_WAY_COUNT] = {0, 0, 7.5, 0.5, 1.7, 1.4};
	JnChoice choice;
	jn_choice_begin(&choice, NODES, BLOCKS, true, all);
	assert_int_equal(choice.way, JN_WAY_INCOMPLETE);
	learn_all(&choice);
	solve_some(&choice, 1000, rate);
	assert_int_equal(choice.way, JN_WAY_INCOMPLETE);
	assert_int_equal(choice.changes, 0);
}

static void a_stiff_sheet_comes_to_a_kept_factor_and_stays(void** state) {
	(void)state;
	static const double rate[JN_WAY_COUNT] = {0, 0, 75, 0.55, 19, 2.8};
	JnChoice choice;
	jn_choice_begin(&choice, NODES, BLOCKS, true, all);
	learn_all(&choice);
	solve_some(&choice, 20, rate);
	assert_int_equal(choice.way, JN_WAY_KEPT);
	solve_some(&choice, 1000, rate);
	assert_int_equal(choice.way, JN_WAY_KEPT);
	assert_int_equal(choice.changes, 1);
}

// What served may cease to, and serve again.
static void a_problem_that_changes_is_followed(void** state) {
	(void)state;
	static const double soft[JN_WAY_COUNT] = {0, 0, 7.5, 3, 1.7, 1.4}, stiff[JN_WAY_COUNT] = {0, 0, 75, 0.55, 19, 2.8};
	JnChoice choice;
	jn_choice_begin(&choice, NODES, BLOCKS, true, all);
	learn_all(&choice);
	solve_some(&choice, 50, stiff);
	assert_int_equal(choice.way, JN_WAY_KEPT);
	solve_some(&choice, 300, soft); // a factor that hardly helps
	assert_int_not_equal(choice.way, JN_WAY_KEPT);
	assert_in_range(choice.changes, 2, 4);
}

static void unknown_ways_are_asked_about_only_when_work_was_done(void** state) {
	(void)state;
	static const double rate[JN_WAY_COUNT] = {0, 0, 75, 0.55, 19, 2.8};
	JnChoice choice;
	jn_choice_begin(&choice, NODES, BLOCKS, true, all);
	jn_choice_learn(&choice, JN_WAY_INCOMPLETE, 45, 1.6);
	assert_false(jn_choice_wants_to_know(&choice, JN_WAY_KEPT));
	solve_some(&choice, 20, rate);
	assert_true(jn_choice_wants_to_know(&choice, JN_WAY_KEPT));
	assert_int_equal(choice.way, JN_WAY_INCOMPLETE); // nothing is known to be better
}

static void a_stale_factor_is_renewed_when_its_age_has_cost_as_much(void** state) {
	(void)state;
	static const bool kept_only[JN_WAY_COUNT] = {[JN_WAY_KEPT] = true};
	JnChoice choice;
	int renewed = 0;
	jn_choice_begin(&choice, NODES, BLOCKS, true, kept_only);
	jn_choice_learn_factor(&choice, flops, entries);
	for (int i = 0, age = 0; i < 1000; ++i) {
		const bool renews = jn_choice_renews(&choice);
		jn_choice_next(&choice);
		jn_choice_count_matrix(&choice, renews);
		renewed += renews;
		age = renews ? 0 : age + 1;
		jn_choice_count_solve(&choice, 4 + age / 4, 4); // one more iteration every four matrices
	}
	// excess w a^2 / 8 reaches the price of a factor F = 31 w at a = 16
	assert_in_range(renewed, 40, 80);
}

static void what_fails_is_replaced_until_nothing_is_left(void** state) {
	(void)state;
	JnChoice choice;
	jn_choice_begin(&choice, NODES, BLOCKS, true, all);
	int ways = 1;
	while (jn_choice_forbid(&choice, choice.way)) ++ways;
	assert_int_equal(ways, 5);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_soft_sheet_stays_with_the_incomplete_factor),
		cmocka_unit_test(a_stiff_sheet_comes_to_a_kept_factor_and_stays),
		cmocka_unit_test(a_problem_that_changes_is_followed),
		cmocka_unit_test(unknown_ways_are_asked_about_only_when_work_was_done),
		cmocka_unit_test(a_stale_factor_is_renewed_when_its_age_has_cost_as_much),
		cmocka_unit_test(what_fails_is_replaced_until_nothing_is_left),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
