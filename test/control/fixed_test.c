/// @file fixed_test.c
/// The controller `fixed`: halves what fails, comes back to its grid exactly, gives up after `cuts`.
#include "support/model_case.h"

typedef struct FixedCase {
	double options[8];
	JnController* controller;
	JnVerdict verdict;
} FixedCase;

static void fixed_create(FixedCase* c, double dt, int cuts, int recovery) {
	*c = (FixedCase){0};
	const JnRow* row = row_named(&jn_controller_list, "fixed");
	*(double*)option(row, c->options, "dt") = dt;
	*(int*)option(row, c->options, "cuts") = cuts;
	*(int*)option(row, c->options, "recovery") = recovery;
	assert_int_equal(jn_controller_create(&(JnVariant){row, c->options}, "step", NULL, NULL, &c->controller), JN_OK);
	c->verdict.dt = c->controller->type->first(c->controller);
}

// An attempt of the size that the last verdict asked for, or of `dt`.
static JnStatus judge_size(FixedCase* c, JnStatus outcome, double dt) {
	JnStep step = {.dt = dt, .wanted = dt};
	return c->controller->type->judge(c->controller, &step, outcome, &c->verdict);
}

static JnStatus judge(FixedCase* c, JnStatus outcome) {
	return judge_size(c, outcome, c->verdict.dt);
}

static void steps_that_work_keep_their_size(void** state) {
	(void)state;
	FixedCase c;
	fixed_create(&c, 0.003, 3, 2);
	for (int i = 0; i < 10; ++i) {
		assert_true(c.verdict.dt == 0.003);
		assert_int_equal(judge(&c, JN_OK), JN_OK);
		assert_true(c.verdict.accepted);
	}
	jn_controller_destroy(c.controller);
}

static void every_outcome_but_ok_is_refused_and_halved(void** state) {
	(void)state;
	const JnStatus outcomes[] = {JN_NOT_CONVERGED, JN_INDEFINITE, JN_NOT_FINITE};
	FixedCase c;
	fixed_create(&c, 0.003, 10, 2);
	for (int i = 0; i < 3; ++i) {
		assert_int_equal(judge(&c, outcomes[i]), JN_OK);
		assert_false(c.verdict.accepted);
		assert_true(c.verdict.dt == ldexp(0.003, -i - 1));
	}
	jn_controller_destroy(c.controller);
}

static void the_run_ends_after_the_last_cut(void** state) {
	(void)state;
	for (int cuts = 0; cuts < 4; ++cuts) {
		FixedCase c;
		fixed_create(&c, 0.003, cuts, 2);
		for (int i = 0; i < cuts; ++i) assert_int_equal(judge(&c, JN_NOT_CONVERGED), JN_OK);
		assert_int_equal(judge(&c, JN_NOT_CONVERGED), JN_RUN_FAILED);
		assert_false(c.verdict.accepted);
		jn_controller_destroy(c.controller);
	}
}

// Failures at random. The time is counted in units of dt / 2^20 by exact integers, of which doubles are exact up to 2^53.
static void whole_steps_start_on_the_grid_whatever_fails(void** state) {
	(void)state;
	FixedCase c;
	fixed_create(&c, 1, 20, 3);
	uint64_t seed = 11;
	double t = 0;
	int whole = 0, halved = 0;
	for (int i = 0; i < 20000; ++i) {
		const double dt = c.verdict.dt;
		const bool fails = dt > 1.0 / 1024 && random_number(&seed) > 0.8;
		if (dt == 1) {
			++whole;
			if (t != floor(t)) fail_msg("a whole step starts at %.17g, expected a whole number", t);
		}
		// a step of 2^-k starts at a multiple of 2^-k: it never reaches over a grid point of its own level
		if (t / dt != floor(t / dt)) fail_msg("a step of %g starts at %.17g, expected a multiple", dt, t);
		halved += fails;
		assert_int_equal(judge(&c, fails ? JN_NOT_CONVERGED : JN_OK), JN_OK);
		if (c.verdict.accepted) t += dt;
	}
	assert_true(whole > 100 && halved > 100);
	jn_controller_destroy(c.controller);
}

static void the_size_comes_back_after_recovery(void** state) {
	(void)state;
	FixedCase c;
	fixed_create(&c, 1, 20, 4);
	assert_int_equal(judge(&c, JN_NOT_CONVERGED), JN_OK);
	assert_int_equal(judge(&c, JN_NOT_CONVERGED), JN_OK);
	const double sizes[] = {0.25, 0.25, 0.25, 0.25, 1}; // 4 quarters: recovered, and on the grid
	for (int i = 0; i < 5; ++i) {
		expect_near(c.verdict.dt, sizes[i], 0, "step %d", i);
		assert_int_equal(judge(&c, JN_OK), JN_OK);
	}
	jn_controller_destroy(c.controller);
}

// The last step of a run may be far shorter than dt: halving dt until it is below that costs no attempts.
static void a_short_last_step_that_fails_is_cut_below_its_own_size(void** state) {
	(void)state;
	FixedCase c;
	fixed_create(&c, 1, 10, 4);
	assert_int_equal(judge_size(&c, JN_NOT_CONVERGED, 0.1), JN_OK);
	expect_near(c.verdict.dt, 0.0625, 0, "size after a failure with dt = 0.1"); // the largest 2^-k below
	jn_controller_destroy(c.controller);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(steps_that_work_keep_their_size),
		cmocka_unit_test(every_outcome_but_ok_is_refused_and_halved),
		cmocka_unit_test(the_run_ends_after_the_last_cut),
		cmocka_unit_test(whole_steps_start_on_the_grid_whatever_fails),
		cmocka_unit_test(the_size_comes_back_after_recovery),
		cmocka_unit_test(a_short_last_step_that_fails_is_cut_below_its_own_size),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
