/// @file failure_test.c
/// Simulations whose steps fail: they are cut, come back, or end with the last good state untouched.
#include "support/model_case.h"

static void silent(void* user, JnLogLevel level, const char* message) {
	(void)message;
	*(int*)user += level == JN_LOG_ERROR;
}

// Backward Euler at dt = 1/16 s needs more Newton iterations than it gets while the beam falls fast; at 1/64 s it does not.
static void hard_case(ModelCase* c) {
	case_box(c, JN_HEX8, "stable_neo_hookean");
	case_gravity(c, 0, -9.81, 0);
	case_method(c, row_named(&jn_integrator_list, "backward_euler"));
	c->sim.newton = (JnNewtonDef){.tolerance = 1e-9, .max_iterations = 4, .reuse = 1};
	*(double*)option(c->sim.step.row, c->control, "dt") = 1.0 / 16;
	c->sim.duration = 2;
}

static void failing_steps_are_cut_and_the_run_comes_back_to_its_grid(void** state) {
	(void)state;
	ModelCase c;
	hard_case(&c);
	JnSim* sim = NULL;
	assert_int_equal(jn_sim_create(&c.sim, 1, &sim), JN_OK);
	int rejected = 0, small = 0;
	bool came_back = false;
	while (!jn_sim_is_done(sim)) {
		const double before = jn_sim_state(sim)->t;
		assert_int_equal(jn_sim_step(sim), JN_OK);
		const double dt = jn_sim_last_dt(sim);
		rejected += jn_sim_last_report(sim)->rejected;
		small += dt < 1.0 / 16;
		// sizes are powers of two, so that sums are exact
		expect_near(jn_sim_state(sim)->t, before + dt, 0, "time");
		if (dt == 1.0 / 16) {
			expect_near(before * 16, floor(before * 16), 0, "start of a whole step, in steps");
			came_back |= small > 0;
		}
	}
	assert_true(rejected > 0 && small > 0);
	assert_true(came_back);
	expect_near(jn_sim_state(sim)->t, 2, 0, "end");
	jn_sim_destroy(sim);
}

static void a_run_that_cannot_go_on_keeps_its_last_good_state(void** state) {
	(void)state;
	ModelCase c;
	hard_case(&c);
	*(int*)option(c.sim.step.row, c.control, "cuts") = 1;
	c.sim.newton.max_iterations = 3;
	JnSim* sim = NULL;
	assert_int_equal(jn_sim_create(&c.sim, 1, &sim), JN_OK);
	const size_t bytes = 3 * (size_t)jn_model_node_count(jn_sim_model(sim)) * sizeof(double);
	double *x = malloc(bytes), *v = malloc(bytes);
	int messages = 0;
	jn_log_set_sink(silent, &messages);
	JnStatus status = JN_OK;
	double t = 0, dt = 0;
	while (status == JN_OK && !jn_sim_is_done(sim)) {
		t = jn_sim_state(sim)->t;
		dt = jn_sim_last_dt(sim);
		memcpy(x, jn_sim_state(sim)->x, bytes);
		memcpy(v, jn_sim_state(sim)->v, bytes);
		status = jn_sim_step(sim);
	}
	const long steps = jn_sim_steps(sim);
	for (int again = 0; again < 2; ++again) { // once more: it fails in the same way
		assert_int_equal(status, JN_RUN_FAILED);
		assert_int_equal(messages, 1 + again);
		assert_memory_equal(jn_sim_state(sim)->x, x, bytes);
		assert_memory_equal(jn_sim_state(sim)->v, v, bytes);
		assert_true(jn_sim_state(sim)->t == t);
		assert_int_equal(jn_sim_steps(sim), steps);
		expect_near(jn_sim_last_dt(sim), dt, 0, "size of the last accepted step");
		status = jn_sim_step(sim);
	}
	jn_log_set_sink(NULL, NULL);
	free(x);
	free(v);
	jn_sim_destroy(sim);
}

static void a_run_that_fails_at_once_has_no_last_step(void** state) {
	(void)state;
	ModelCase c;
	hard_case(&c);
	c.sim.newton.max_iterations = 1;
	*(int*)option(c.sim.step.row, c.control, "cuts") = 1;
	JnSim* sim = NULL;
	int messages = 0;
	assert_int_equal(jn_sim_create(&c.sim, 1, &sim), JN_OK);
	jn_log_set_sink(silent, &messages);
	assert_int_equal(jn_sim_step(sim), JN_RUN_FAILED);
	jn_log_set_sink(NULL, NULL);
	assert_int_equal(jn_sim_steps(sim), 0);
	assert_true(jn_sim_state(sim)->t == 0);
	expect_near(jn_sim_last_dt(sim), 0, 0, "size of the last accepted step");
	jn_sim_destroy(sim);
}

// The cut run must have stepped as a run does that takes those sizes from the beginning: nothing of a failed attempt stays.
static void a_failed_attempt_leaves_no_trace(void** state) {
	(void)state;
	ModelCase c;
	Rig clean, failed;
	hard_case(&c);
	c.sim.newton.max_iterations = 60;
	rig_create(&clean, &c, 1);
	rig_create(&failed, &c, 1);
	for (int i = 0; i < 4; ++i) {
		failed.integrator->newton.max_iterations = 1;
		assert_int_equal(rig_attempt(&failed, 1.0 / 16), JN_NOT_CONVERGED);
		jn_integrator_forget(failed.integrator);
		failed.integrator->newton.max_iterations = 60;
		rig_step(&failed, 1.0 / 32);
		rig_step(&clean, 1.0 / 32);
		assert_memory_equal(failed.start.x, clean.start.x, (size_t)clean.length * sizeof(double));
		assert_memory_equal(failed.start.v, clean.start.v, (size_t)clean.length * sizeof(double));
	}
	rig_destroy(&clean);
	rig_destroy(&failed);
}

static void the_last_step_ends_on_the_duration(void** state) {
	(void)state;
	ModelCase c;
	hard_case(&c);
	c.sim.newton.max_iterations = 60;
	const double durations[] = {0.3, 0.3125, 0.01};
	for (int i = 0; i < 3; ++i) {
		JnSim* sim = NULL;
		c.sim.duration = durations[i];
		assert_int_equal(jn_sim_create(&c.sim, 1, &sim), JN_OK);
		while (!jn_sim_is_done(sim)) assert_int_equal(jn_sim_step(sim), JN_OK);
		expect_near(jn_sim_state(sim)->t, durations[i], 1e-15, "end"); // rounding of five sums
		assert_int_equal(jn_sim_steps(sim), (long)ceil(durations[i] * 16 - 1e-9));
		jn_sim_destroy(sim);
	}
}

static void no_step_of_rounding_size_is_taken(void** state) {
	(void)state;
	ModelCase c;
	hard_case(&c);
	c.sim.newton.max_iterations = 60;
	*(double*)option(c.sim.step.row, c.control, "dt") = 0.1; // ten of them are not 1 in floating point
	c.sim.duration = 1;
	JnSim* sim = NULL;
	assert_int_equal(jn_sim_create(&c.sim, 1, &sim), JN_OK);
	while (!jn_sim_is_done(sim)) assert_int_equal(jn_sim_step(sim), JN_OK);
	assert_int_equal(jn_sim_steps(sim), 10);
	expect_near(jn_sim_state(sim)->t, 1, 1e-15, "end"); // rounding of ten sums
	jn_sim_destroy(sim);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(failing_steps_are_cut_and_the_run_comes_back_to_its_grid),
		cmocka_unit_test(a_run_that_cannot_go_on_keeps_its_last_good_state),
		cmocka_unit_test(a_run_that_fails_at_once_has_no_last_step),
		cmocka_unit_test(a_failed_attempt_leaves_no_trace),
		cmocka_unit_test(the_last_step_ends_on_the_duration),
		cmocka_unit_test(no_step_of_rounding_size_is_taken),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
