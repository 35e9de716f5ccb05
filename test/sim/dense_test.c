/// @file dense_test.c
/// States between steps: their order, their ends, what contact makes of them; and steps that end on given times.
#include "support/spring_case.h"

static const Spring linear = {.k_x = 100, .k_v = 0, .cubic = 0}; // x = -cos 10 t

// Largest errors of x and v between steps of exact_size dt, relative to the amplitudes.
static void find_errors(double dt, double* x_error, double* v_error) {
	SpringCase c;
	JnState s;
	char settings[160];
	snprintf(settings, sizeof settings, "{duration: 1 s, integrator: pefrl, step: {dt: %.17g s}}", dt);
	assert_int_equal(spring_open(&c, &linear, settings), JN_OK);
	assert_int_equal(jn_state_create(c.sys->space, &s), JN_OK);
	*x_error = *v_error = 0;
	while (!jn_sim_is_done(c.sim)) {
		const double before = jn_sim_state(c.sim)->t;
		assert_int_equal(jn_sim_step(c.sim), JN_OK);
		for (int k = 1; k < 8; ++k) {
			const double t = before + k / 8.0 * dt;
			jn_sim_state_at(c.sim, t, &s);
			assert_true(s.t == t);
			*x_error = fmax(*x_error, fabs(s.x[0] + cos(10 * t)));
			*v_error = fmax(*v_error, 0.1 * fabs(s.v[0] - 10 * sin(10 * t)));
		}
	}
	jn_state_destroy(c.sys->space, &s);
	spring_close(&c);
}

static void positions_have_order_four_and_velocities_three(void** state) {
	(void)state;
	double x[2], v[2];
	for (int i = 0; i < 2; ++i) find_errors(ldexp(1.0 / 64, -i), &x[i], &v[i]);
	print_message("x %.2e %.2e, v %.2e %.2e\n", x[0], x[1], v[0], v[1]);
	expect_near(log2(x[0] / x[1]), 4, 0.1, "order of x"); // the method's own error is of order 4 too, and far smaller
	expect_near(log2(v[0] / v[1]), 3, 0.1, "order of v");
}

static void the_ends_of_a_step_are_met_exactly(void** state) {
	(void)state;
	SpringCase c;
	JnState s;
	assert_int_equal(spring_open(&c, the_spring(), "{duration: 1 s, integrator: newmark, step: {dt: 10 ms}}"), JN_OK);
	assert_int_equal(jn_state_create(c.sys->space, &s), JN_OK);
	for (int i = 0; i < 5; ++i) {
		const double t = jn_sim_state(c.sim)->t, x = jn_sim_state(c.sim)->x[0], v = jn_sim_state(c.sim)->v[0];
		assert_int_equal(jn_sim_step(c.sim), JN_OK);
		jn_sim_state_at(c.sim, t, &s);
		expect_near(s.x[0], x, 0, "x at the start of the step");
		expect_near(s.v[0], v, 0, "v at the start of the step");
		jn_sim_state_at(c.sim, jn_sim_state(c.sim)->t, &s);
		expect_near(s.x[0], jn_sim_state(c.sim)->x[0], 0, "x at its end");
		expect_near(s.v[0], jn_sim_state(c.sim)->v[0], 0, "v at its end");
	}
	jn_state_destroy(c.sys->space, &s);
	spring_close(&c);
}

static void driven_nodes_are_where_they_should_be(void** state) {
	(void)state;
	ModelCase c;
	JnSim* sim = NULL;
	JnState s;
	case_box(&c, JN_HEX8, "stable_neo_hookean");
	case_drive(&c, FACE_Z_HIGH, 0.05, 2);
	assert_int_equal(jn_sim_create(&c.sim, 1, &sim), JN_OK);
	JnSpace* space = jn_sim_system(sim)->space;
	const int node = jn_model_nearest(jn_sim_model(sim), (const double[3]){0, 0, 0.4});
	assert_int_equal(jn_state_create(space, &s), JN_OK);
	for (int i = 0; i < 10; ++i) {
		assert_int_equal(jn_sim_step(sim), JN_OK);
		const double t = jn_sim_state(sim)->t - 0.3 / 128;
		jn_sim_state_at(sim, t, &s);
		const double moved = s.x[3 * node] - jn_model_rest(jn_sim_model(sim))[3 * node];
		expect_near(moved, 0.05 * sin(4 * acos(-1) * t), 1e-15, "driven node"); // rounding
	}
	jn_state_destroy(space, &s);
	jn_sim_destroy(sim);
}

// A controller's own size must come through steps that are shortened for other reasons.
static void steps_end_on_the_times_asked_for_and_control_goes_on(void** state) {
	(void)state;
	static const char* const controllers[] = {
		"{controller: force_error, tolerance: 1e-5 m}", "{controller: stretch_limit, stretch: 0.05}",
		"{controller: zienkiewicz_xie, tolerance: 1e-4 m}", "{dt: 7 ms}", "{controller: speed_limit, distance: 2 cm}"};
	for (int i = 0; i < 5; ++i) {
		SpringCase c;
		char settings[200];
		snprintf(settings, sizeof settings, "{duration: 2 s, integrator: newmark, step: %s}", controllers[i]);
		const SpringRun whole = spring_run(the_spring(), settings);
		assert_int_equal(spring_open(&c, the_spring(), settings), JN_OK);
		const double interval = 0.1;
		int met = 0;
		jn_sim_stop_at(c.sim, interval);
		while (!jn_sim_is_done(c.sim)) {
			const double wanted = jn_sim_next_dt(c.sim);
			assert_int_equal(jn_sim_step(c.sim), JN_OK);
			const double t = jn_sim_state(c.sim)->t, stop = interval * (met + 1);
			assert_true(t <= stop + 1e-12);
			if (t < stop - 1e-12) continue;
			const bool is_clipped = jn_sim_last_report(c.sim)->rejected == 0 && jn_sim_last_dt(c.sim) < 0.99 * wanted;
			const bool has_own_size = i == 1 || i == 3; // the others read theirs off each step, if it tells enough
			if (is_clipped && has_own_size) assert_true(jn_sim_next_dt(c.sim) >= wanted);
			++met;
			jn_sim_stop_at(c.sim, interval * (met + 1));
		}
		assert_int_equal(met, 20);
		print_message("%-50s %d steps, %ld with stops\n", controllers[i], whole.steps, jn_sim_steps(c.sim));
		assert_true(jn_sim_steps(c.sim) <= whole.steps + 2 * met); // at most the two that a stop cuts a step into
		spring_close(&c);
	}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(positions_have_order_four_and_velocities_three),
		cmocka_unit_test(the_ends_of_a_step_are_met_exactly),
		cmocka_unit_test(driven_nodes_are_where_they_should_be),
		cmocka_unit_test(steps_end_on_the_times_asked_for_and_control_goes_on),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
