/// @file adaptive_test.c
/// The adaptive controllers on the spring and on small models: tolerances are met, work is counted, methods that do not suit
/// are refused, and what is said when a run ends.
#include "support/spring_case.h"

static SpringRun run_with(const char* method, double duration, const char* step) {
	char settings[400];
	snprintf(settings, sizeof settings,
			 "{duration: %g s, integrator: {method: %s}, newton: {tolerance: 1e-10}, step: %s}", duration, method,
			 step);
	return spring_run(the_spring(), settings);
}

// ---- force_error

// The run of the paper's figure 1 with linearised Newmark: the fourth power describes the error, so that fewer attempts are
// refused, at the same final error.
static void the_fourth_power_is_refused_less_often_than_the_third(void** state) {
	(void)state;
	SpringRun run[2];
	const SpringRun truth = run_with("rk4", 2, "{dt: 0.1 ms}");
	for (int i = 0; i < 2; ++i) {
		char step[160];
		snprintf(step, sizeof step, "{controller: force_error, tolerance: 1e-6 m, exponent: %d, dt: 0.1 ms}", 3 + i);
		run[i] = run_with("linearized_newmark", 2, step);
		print_message("q = %d: %d steps, %d refused, final error %.3e m\n", 3 + i, run[i].steps, run[i].rejected,
					  fabs(run[i].x - truth.x));
	}
	assert_true(run[1].rejected <= 0.6 * run[0].rejected);
	const double errors[] = {fabs(run[0].x - truth.x), fabs(run[1].x - truth.x)};
	expect_near(errors[1], errors[0], 0.1 * errors[0], "final error"); // the steps are other ones
}

// ---- embedded

static void accepted_steps_meet_the_tolerance_and_come_near_it(void** state) {
	(void)state;
	static const char* const methods[] = {"sdirk2", "tr_bdf2", "sdirk3", "ros2", "esdirk436", "rodas4"};
	for (int i = 0; i < 6; ++i) {
		SpringCase c;
		char settings[200];
		const double tolerance = 1e-5;
		double sum = 0;
		snprintf(settings, sizeof settings,
				 "{duration: 2 s, integrator: %s, newton: {tolerance: 1e-11}, step: {controller: embedded}}",
				 methods[i]);
		assert_int_equal(spring_open(&c, the_spring(), settings), JN_OK);
		int rejected = 0;
		while (!jn_sim_is_done(c.sim)) {
			assert_int_equal(jn_sim_step(c.sim), JN_OK);
			const double r = jn_sim_last_report(c.sim)->error / tolerance;
			assert_true(r <= 1);
			sum += r;
			rejected += jn_sim_last_report(c.sim)->rejected;
		}
		const int steps = (int)jn_sim_steps(c.sim);
		print_message("%-10s %4d steps, %2d refused, mean error %.2f of the tolerance\n", methods[i], steps, rejected,
					  sum / steps);
		// the estimate passes through zero as the spring swings, where steps are limited by their growth
		assert_true(sum / steps > 0.1 && rejected <= 0.1 * steps);
		spring_close(&c);
	}
}

static void a_smaller_tolerance_gives_a_smaller_error(void** state) {
	(void)state;
	const SpringRun truth = run_with("rk4", 1, "{dt: 0.05 ms}");
	double before = INFINITY;
	for (double tolerance = 1e-4; tolerance > 0.5e-7; tolerance *= 0.1) {
		char step[128];
		snprintf(step, sizeof step, "{controller: embedded, tolerance: %g m}", tolerance);
		const SpringRun run = run_with("sdirk2", 1, step);
		const double error = fabs(run.x - truth.x);
		print_message("tolerance %g m: %d steps, error %.2e m\n", tolerance, run.steps, error);
		// per step of third order, in all of second: the error goes with the two thirds of the tolerance, a factor of 4.6
		assert_true(error < 0.5 * before);
		before = error;
	}
}

static void a_relative_tolerance_adds_to_the_absolute_one(void** state) {
	(void)state;
	const SpringRun strict = run_with("sdirk2", 2, "{controller: embedded, tolerance: 1e-6 m}");
	const SpringRun loose = run_with("sdirk2", 2, "{controller: embedded, tolerance: 1e-6 m, relative: 1e-3}");
	assert_true(loose.steps < strict.steps);
}

// ---- zienkiewicz_xie

static void newmarks_family_is_served_with_its_own_accelerations(void** state) {
	(void)state;
	static const char* const methods[] = {"newmark", "linearized_newmark", "hht_alpha", "generalized_alpha"};
	const SpringRun truth = run_with("rk4", 1, "{dt: 0.05 ms}");
	for (int i = 0; i < 4; ++i) {
		double errors[2];
		for (int k = 0; k < 2; ++k) {
			char step[128];
			snprintf(step, sizeof step, "{controller: zienkiewicz_xie, tolerance: %g m}", k == 0 ? 1e-5 : 1e-7);
			const SpringRun run = run_with(methods[i], 1, step);
			errors[k] = fabs(run.x - truth.x);
			print_message("%-20s %d steps, %d refused, error %.2e m\n", methods[i], run.steps, run.rejected, errors[k]);
		}
		assert_true(errors[1] < 0.2 * errors[0]);
	}
}

// ---- step_doubling

// The spring's matrix is new in each attempt: the whole step and its two halves factor three times.
static void two_halves_are_counted_with_the_whole(void** state) {
	(void)state;
	SpringCase c;
	assert_int_equal(spring_open(&c, the_spring(),
								 "{duration: 1 s, integrator: linearized_euler, step: {controller: step_doubling}}"),
					 JN_OK);
	while (!jn_sim_is_done(c.sim)) {
		assert_int_equal(jn_sim_step(c.sim), JN_OK);
		const JnReport* report = jn_sim_last_report(c.sim);
		assert_int_equal(report->factorizations, 3 * (1 + report->rejected));
	}
	spring_close(&c);
}

static void the_halves_that_are_kept_are_those_of_two_steps(void** state) {
	(void)state;
	const char* doubling = "{controller: step_doubling, keep: halves, dt: 20 ms, tolerance: 1 m}";
	const SpringRun kept = run_with("linearized_newmark", 1, doubling);
	const SpringRun halves = run_with("linearized_newmark", 1, "{dt: 10 ms}");
	assert_int_equal(kept.steps, 50);
	assert_int_equal(halves.steps, 100);
	expect_near(kept.x, halves.x, 1e-13, "x"); // times are other sums
}

static void quadrature_returns_to_its_grid(void** state) {
	(void)state;
	SpringCase c;
	assert_int_equal(spring_open(&c, the_spring(),
								 "{duration: 1 s, integrator: newmark, step: {controller: step_doubling, dt: 0.125 s, "
								 "tolerance: 1e-4 m}}"),
					 JN_OK);
	int small = 0;
	while (!jn_sim_is_done(c.sim)) {
		const double before = jn_sim_state(c.sim)->t;
		assert_int_equal(jn_sim_step(c.sim), JN_OK);
		const double dt = jn_sim_last_dt(c.sim);
		small += dt < 0.125;
		// powers of two are exact: a step of 2^-k starts at a multiple of 2^-k
		expect_near(before / dt, floor(before / dt), 0, "start of a step, in its own size");
	}
	assert_true(small > 0);
	spring_close(&c);
}

// The last step of 50 ms is shorter than its size of 125 ms: one that is refused is cut below its own.
static void a_short_last_step_is_halved_below_its_own_size(void** state) {
	(void)state;
	SpringCase c;
	assert_int_equal(
		spring_open(&c, the_spring(),
					"{duration: 50 ms, integrator: newmark, step: {controller: step_doubling, dt: 0.125 s, "
					"tolerance: 1e-4 m}}"),
		JN_OK);
	assert_int_equal(jn_sim_step(c.sim), JN_OK);
	assert_true(jn_sim_last_report(c.sim)->rejected > 0);
	const double level = log2(0.125 / jn_sim_last_dt(c.sim));
	expect_near(level, round(level), 0, "halvings of the first size");
	assert_true(level >= 2 && level <= 1 + jn_sim_last_report(c.sim)->rejected); // 62.5 ms is no attempt
	spring_close(&c);
}

// ---- speed_limit

static void a_step_goes_the_distance_at_the_speed_of_its_start(void** state) {
	(void)state;
	SpringCase c;
	int free_steps = 0;
	assert_int_equal(
		spring_open(
			&c, the_spring(),
			"{duration: 1 s, integrator: newmark, step: {controller: speed_limit, distance: 2 cm, dt_max: 50 ms}}"),
		JN_OK);
	assert_int_equal(jn_sim_step(c.sim), JN_OK);
	while (!jn_sim_is_done(c.sim)) {
		const double best = 0.02 / fabs(jn_sim_state(c.sim)->v[0]), before = jn_sim_last_dt(c.sim);
		const double left = 1 - jn_sim_state(c.sim)->t;
		assert_int_equal(jn_sim_step(c.sim), JN_OK);
		const double expected = fmin(fmin(fmax(best, 0.2 * before), 5 * before), 0.05);
		free_steps += expected == best;
		expect_near(jn_sim_last_dt(c.sim), fmin(expected, left), 1e-12, "size"); // rounding of the end's time
	}
	assert_true(free_steps > 10);
	spring_close(&c);
}

// ---- stretch_limit

static void no_accepted_step_stretches_more_than_allowed(void** state) {
	(void)state;
	SpringCase c;
	int doubled = 0, rejected = 0;
	assert_int_equal(
		spring_open(&c, the_spring(),
					"{duration: 2 s, integrator: newmark, step: {controller: stretch_limit, stretch: 0.04}}"),
		JN_OK);
	while (!jn_sim_is_done(c.sim)) {
		const double x = jn_sim_state(c.sim)->x[0], dt = jn_sim_last_dt(c.sim);
		assert_int_equal(jn_sim_step(c.sim), JN_OK);
		assert_true(fabs(jn_sim_state(c.sim)->x[0] - x) <= 0.04); // of 1 m: nothing is known of its length at rest
		doubled += jn_sim_last_dt(c.sim) == 2 * dt;
		rejected += jn_sim_last_report(c.sim)->rejected;
	}
	assert_true(doubled > 0 && rejected > 0);
	spring_close(&c);
}

// All of a box moves by 1 m; then one of its corners moves by 0.05 m along an edge of 0.1 m.
static void a_model_is_stretched_by_its_edges_not_by_motion(void** state) {
	(void)state;
	ModelCase c;
	Rig rig;
	case_box(&c, JN_HEX8, "linear");
	rig_create(&rig, &c, 1);
	jn_state_copy(rig.space, &rig.start, &rig.end);
	for (int k = 0; k < rig.length; ++k) rig.end.x[k] += 1;
	expect_near(rig.sys->ops->stretch(rig.sys, &rig.start, &rig.end), 0, 1e-14, "stretch of a moved box"); // rounding
	const int corner = jn_model_nearest(rig.model, (const double[3]){0, 0, 0.4});
	rig.end.x[3 * corner] += 0.05;
	expect_near(rig.sys->ops->stretch(rig.sys, &rig.start, &rig.end), 0.5, 1e-12,
				"stretch of an edge of 0.1 m by 0.05 m");
	rig_destroy(&rig);
}

// ---- combined

// Forces that are linear have no force error; the embedded estimate bounds the step.
static void the_estimate_bounds_the_step_where_forces_are_linear(void** state) {
	(void)state;
	const Spring linear = {.k_x = 100, .k_v = 0.1, .cubic = 0};
	const char* head = "{duration: 4 s, integrator: tr_bdf2, step: ";
	char settings[300];
	snprintf(settings, sizeof settings, "%s{controller: force_error}}", head);
	const SpringRun blind = spring_run(&linear, settings);
	snprintf(settings, sizeof settings, "%s{controller: combined, rules: [force_error, embedded]}}", head);
	const SpringRun both = spring_run(&linear, settings);
	snprintf(settings, sizeof settings, "%s{controller: embedded}}", head);
	const SpringRun alone = spring_run(&linear, settings);
	print_message("force_error alone: dt up to %g s; both: %g s; embedded alone: %g s\n", blind.largest_dt,
				  both.largest_dt, alone.largest_dt);
	assert_true(blind.largest_dt > 1);
	assert_true(both.largest_dt < 0.05); // the period is 0.63 s
	assert_int_equal(both.steps, alone.steps);
}

static void the_smaller_step_of_all_rules_is_taken(void** state) {
	(void)state;
	const SpringRun force = run_with("tr_bdf2", 2, "{controller: force_error, tolerance: 1e-5 m}");
	const SpringRun embedded = run_with("tr_bdf2", 2, "{controller: embedded, tolerance: 1e-4 m}");
	const SpringRun both = run_with("tr_bdf2", 2,
									"{controller: combined, rules: [{controller: force_error, tolerance: 1e-5 m}, "
									"{controller: embedded, tolerance: 1e-4 m}]}");
	print_message("force_error %d steps, embedded %d, both %d\n", force.steps, embedded.steps, both.steps);
	assert_true(both.steps >= force.steps && both.steps >= embedded.steps);
}

// ---- what is refused

static void refuse(const char* method, const char* step, const char* first, const char* second) {
	SpringCase c;
	char settings[300];
	snprintf(settings, sizeof settings, "{duration: 1 s, integrator: {method: %s}, step: %s}", method, step);
	log_capture();
	assert_int_equal(spring_open(&c, the_spring(), settings), JN_BAD_INPUT);
	assert_null(c.sim);
	log_expect(first);
	log_expect(second);
	spring_close(&c);
}

static void controllers_refuse_methods_that_they_cannot_serve(void** state) {
	(void)state;
	refuse("backward_euler", "{controller: embedded}", "step.controller: embedded", "backward_euler");
	refuse("newmark", "{controller: embedded}", "embedded", "newmark");
	refuse("sdirk2", "{controller: zienkiewicz_xie}", "zienkiewicz_xie", "sdirk2");
	refuse("newmark, beta: 1/6", "{controller: zienkiewicz_xie}", "beta = 1/6", "newmark");
	refuse("bdf2", "{controller: step_doubling}", "step_doubling", "bdf2");
	refuse("hht_alpha", "{controller: step_doubling}", "step_doubling", "hht_alpha");
	refuse("newmark", "{controller: combined, rules: [force_error, embedded]}", "step.rules[1].controller: embedded",
		   "newmark");
	refuse("rk4", "{controller: combined, rules: [force_error, embedded]}", "step.rules[0].controller: force_error",
		   "rk4");
}

static void a_first_step_outside_of_its_bounds_is_refused(void** state) {
	(void)state;
	static const struct {
		const char *controller, *method;
	} rules[] = {{"force_error", "newmark"},   {"embedded", "tr_bdf2"},      {"zienkiewicz_xie", "newmark"},
				 {"step_doubling", "newmark"}, {"stretch_limit", "newmark"}, {"speed_limit", "newmark"},
				 {"stable", "verlet"}};
	for (size_t i = 0; i < sizeof rules / sizeof *rules; ++i) {
		char step[100];
		snprintf(step, sizeof step, "{controller: %s, dt: 1 ms, dt_min: 1 s}", rules[i].controller);
		refuse(rules[i].method, step, "step.dt: 0.001 s is outside [dt_min, dt_max]", "choose a first step between");
	}
	refuse("newmark", "{controller: force_error, dt_min: 1 s, dt_max: 0.5 s}", "step.dt_min: 1 s is above dt_max",
		   "lower it or raise dt_max");
}

static void a_list_of_rules_must_make_sense(void** state) {
	(void)state;
	refuse("newmark", "{controller: combined, rules: []}", "step.rules", "empty");
	refuse("newmark", "{controller: combined}", "rules", "required");
	refuse("newmark", "{controller: combined, rules: [force_eror]}", "step.rules[0]", "force_error");
	refuse("newmark", "{controller: combined, rules: [{controller: force_error, tolerance: 0}]}",
		   "step.rules[0].tolerance", "outside");
	refuse("newmark", "{controller: combined, rules: [{controller: force_error, dt_min: 1 s}]}", "step.rules[0].dt",
		   "between");
}

static void the_rule_that_ends_a_run_says_so(void** state) {
	(void)state;
	SpringCase c;
	JnStatus status =
		spring_open(&c, the_spring(),
					"{duration: 1 s, integrator: tr_bdf2, step: {controller: combined, rules: [force_error, "
					"{controller: embedded, tolerance: 1e-9 m, dt_min: 0.5 ms}]}}");
	while (status == JN_OK && !jn_sim_is_done(c.sim)) status = jn_sim_step(c.sim);
	assert_int_equal(status, JN_RUN_FAILED);
	log_expect("estimated error");
	log_expect("step.rules[1].dt_min = 0.0005 s");
	spring_close(&c);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(the_fourth_power_is_refused_less_often_than_the_third),
		cmocka_unit_test(accepted_steps_meet_the_tolerance_and_come_near_it),
		cmocka_unit_test(a_smaller_tolerance_gives_a_smaller_error),
		cmocka_unit_test(a_relative_tolerance_adds_to_the_absolute_one),
		cmocka_unit_test(newmarks_family_is_served_with_its_own_accelerations),
		cmocka_unit_test(two_halves_are_counted_with_the_whole),
		cmocka_unit_test(the_halves_that_are_kept_are_those_of_two_steps),
		cmocka_unit_test(quadrature_returns_to_its_grid),
		cmocka_unit_test(a_short_last_step_is_halved_below_its_own_size),
		cmocka_unit_test(a_step_goes_the_distance_at_the_speed_of_its_start),
		cmocka_unit_test(no_accepted_step_stretches_more_than_allowed),
		cmocka_unit_test(a_model_is_stretched_by_its_edges_not_by_motion),
		cmocka_unit_test(the_estimate_bounds_the_step_where_forces_are_linear),
		cmocka_unit_test(the_smaller_step_of_all_rules_is_taken),
		cmocka_unit_test(controllers_refuse_methods_that_they_cannot_serve),
		cmocka_unit_test(a_first_step_outside_of_its_bounds_is_refused),
		cmocka_unit_test(a_list_of_rules_must_make_sense),
		cmocka_unit_test(the_rule_that_ends_a_run_says_so),
	};
	return cmocka_run_group_tests(tests, log_set_up, log_tear_down);
}
