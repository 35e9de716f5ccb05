/// @file force_error_test.c
/// The controller `force_error`: what it measures, against the formulas of the paper; what it costs; how the error depends on
/// the step; what it refuses.
#include "support/spring_case.h"

// A controller beside an integrator on a system, stepped by hand.
typedef struct Judge {
	double options[16];
	JnController* controller;
	double tolerance;
} Judge;

// Bounds so wide that the verdict's size tells the error.
static void judge_open(Judge* judge, JnIntegrator* integrator, JnSystem* sys) {
	const JnRow* row = row_named(&jn_controller_list, "force_error");
	JnArena arena = {0};
	*judge = (Judge){.tolerance = 1};
	assert_true(row->options_size <= sizeof judge->options);
	assert_int_equal(jn_keys_read(row->keys, NULL, "", &arena, judge->options), JN_OK);
	*(double*)option(row, judge->options, "tolerance") = judge->tolerance;
	*(double*)option(row, judge->options, "exponent") = 1;
	*(double*)option(row, judge->options, "safety") = 1;
	*(double*)option(row, judge->options, "highest") = INFINITY;
	*(double*)option(row, judge->options, "lowest") = 0;
	*(double*)option(row, judge->options, "dt_max") = INFINITY;
	assert_int_equal(
		jn_controller_create(&(JnVariant){row, judge->options}, "step", integrator, sys, &judge->controller), JN_OK);
	jn_arena_free(&arena);
}

// The error that the controller found in a step from `start`: dt tolerance / size of the next.
static double measured(Judge* judge, JnSystem* sys, const JnState* start, JnState* end, double dt) {
	JnIntegrator* integrator = judge->controller->integrator;
	JnReport report = {0};
	JnStep step = {.sys = sys, .start = start, .end = end, .dt = dt, .wanted = dt, .method = integrator->type};
	JnVerdict verdict;
	sys->report = &report;
	assert_int_equal(sys->ops->begin(sys, start), JN_OK);
	assert_int_equal(jn_controller_prepare(judge->controller, &step), JN_OK);
	assert_int_equal(integrator->type->step(integrator, &step), JN_OK);
	sys->report = &report;
	assert_int_equal(judge->controller->type->judge(judge->controller, &step, JN_OK, &verdict), JN_OK);
	assert_true(verdict.accepted);
	return dt * judge->tolerance / verdict.dt;
}

typedef struct SpringJudge {
	SpringCase spring;
	Judge judge;
	JnIntegrator* integrator;
	JnState start, end;
} SpringJudge;

static void spring_judge_open(SpringJudge* j, const char* method, double x, double v) {
	ModelCase options = {0};
	assert_int_equal(spring_open(&j->spring, the_spring(), "{duration: 1 s}"), JN_OK);
	JnSpace* space = j->spring.sys->space;
	case_method(&options, row_named(&jn_integrator_list, method));
	options.sim.newton = (JnNewtonDef){.tolerance = 1e-13, .max_iterations = 60};
	static double kept[32]; // the integrator keeps a pointer to its options
	memcpy(kept, options.method, sizeof kept);
	options.sim.integrator.options = kept;
	j->integrator = jn_integrator_create(&options.sim.integrator, &options.sim.newton, space);
	assert_non_null(j->integrator);
	assert_int_equal(jn_state_create(space, &j->start), JN_OK);
	assert_int_equal(jn_state_create(space, &j->end), JN_OK);
	j->start.x[0] = x;
	j->start.v[0] = v;
	jn_state_touch(space, &j->start);
	judge_open(&j->judge, j->integrator, j->spring.sys);
}

static void spring_judge_close(SpringJudge* j) {
	jn_controller_destroy(j->judge.controller);
	jn_integrator_destroy(j->integrator);
	jn_state_destroy(j->spring.sys->space, &j->start);
	jn_state_destroy(j->spring.sys->space, &j->end);
	spring_close(&j->spring);
}

static double force_at(Spring spring, double x, double v) {
	double f = 0;
	spring_force(&spring, 0, &x, &v, &f);
	return f;
}

// linearised Backward Euler has F~ = M dv/dt, linearised Newmark F~ = 2 M dv/dt - F0 (AD; M = 1 here).
static void linearised_methods_leave_the_force_that_they_took(void** state) {
	(void)state;
	const struct {
		const char* method;
		double weight, slope, start; // F~ = slope dv/dt + start F0
	} cases[] = {{"linearized_euler", 1, 1, 0}, {"linearized_newmark", 0.25, 2, -1}};
	for (int i = 0; i < 2; ++i)
		for (double dt = 0.1; dt > 1e-3; dt *= 0.5) {
			SpringJudge j;
			spring_judge_open(&j, cases[i].method, -0.7, 3);
			const double error = measured(&j.judge, j.spring.sys, &j.start, &j.end, dt);
			const double before = force_at(*the_spring(), j.start.x[0], j.start.v[0]);
			const double after = force_at(*the_spring(), j.end.x[0], j.end.v[0]);
			const double taken = cases[i].slope * (j.end.v[0] - j.start.v[0]) / dt + cases[i].start * before;
			const double expected = cases[i].weight * dt * dt * fabs(after - taken);
			// rounding of forces of some 300 N, times dt^2
			expect_near(error, expected, 1e-12 * 300 * dt * dt, "%s, dt = %g", cases[i].method, dt);
			spring_judge_close(&j);
		}
}

// Newton's methods are judged by a difference of forces, which must tell what the tangent of the start would.
static void a_difference_of_forces_tells_what_the_tangent_would(void** state) {
	(void)state;
	const char* const methods[] = {"backward_euler", "newmark", "sdirk2", "tr_bdf2", "hht_alpha"};
	for (int i = 0; i < 5; ++i) {
		SpringJudge j;
		const double dt = 0.01;
		spring_judge_open(&j, methods[i], -0.7, 3);
		const double error = measured(&j.judge, j.spring.sys, &j.start, &j.end, dt);
		double stiffness, damping;
		spring_tangent(&j.spring.spring, 0, j.start.x, j.start.v, &stiffness, &damping);
		const double predicted = force_at(*the_spring(), j.start.x[0], j.start.v[0]) -
								 stiffness * (j.end.x[0] - j.start.x[0]) - damping * (j.end.v[0] - j.start.v[0]);
		const double missed = fabs(force_at(*the_spring(), j.end.x[0], j.end.v[0]) - predicted);
		const double expected = j.integrator->type->force_weight * dt * dt * missed;
		// the third-order term, here below that of second order, counts a 64th too much
		expect_near(error, expected, 0.02 * expected, "%s", methods[i]);
		spring_judge_close(&j);
	}
}

static double slope_of(const char* method, double x, double v) {
	double errors[2];
	for (int i = 0; i < 2; ++i) {
		SpringJudge j;
		spring_judge_open(&j, method, x, v);
		errors[i] = measured(&j.judge, j.spring.sys, &j.start, &j.end, ldexp(1e-3, -i));
		spring_judge_close(&j);
	}
	return log2(errors[0] / errors[1]);
}

// Not 3, as the paper assumes: the linearisation's error is of second order. At rest the velocity's part is of third order,
// and the position's of fourth.
static void the_error_falls_with_the_fourth_power_of_the_step_and_the_fifth_from_rest(void** state) {
	(void)state;
	const char* const methods[] = {"linearized_euler", "linearized_newmark", "backward_euler", "newmark"};
	for (int i = 0; i < 4; ++i) {
		const double moving = slope_of(methods[i], -0.7, 3), resting = slope_of(methods[i], -1, 0);
		print_message("%-20s slope %.3f, from rest %.3f\n", methods[i], moving, resting);
		expect_near(moving, 4, 0.1, "%s", methods[i]); // the next term is some 5 % at 1 ms
		expect_near(resting, 5, 0.1, "%s, from rest", methods[i]);
	}
}

static void set(ModelCase* c, const char* controller, const char* key, double value) {
	*(double*)option(row_named(&jn_controller_list, controller), c->control, key) = value;
}

// A soft box under gravity, stepped by force_error.
static void soft_box(ModelCase* c, const char* law, const char* method) {
	static double control[32];
	JnArena arena = {0};
	const JnRow* row = row_named(&jn_controller_list, "force_error");
	case_box(c, JN_HEX8, law);
	case_gravity(c, 2, -9.81, 0);
	case_method(c, row_named(&jn_integrator_list, method));
	assert_true(row->options_size <= sizeof c->control);
	assert_int_equal(jn_keys_read(row->keys, NULL, "", &arena, control), JN_OK);
	memcpy(c->control, control, row->options_size);
	c->sim.step.row = row;
	set(c, "force_error", "tolerance", 1e-4);
	c->sim.duration = 0.5;
	jn_arena_free(&arena);
}

// The forces at the accepted end are those of the next start: one evaluation a step for methods that solve once.
static void a_linearised_step_costs_one_force_and_a_rejection_two(void** state) {
	(void)state;
	const char* const methods[] = {"linearized_euler", "linearized_newmark"};
	for (int i = 0; i < 2; ++i) {
		ModelCase c;
		JnSim* sim = NULL;
		soft_box(&c, "stable_neo_hookean", methods[i]);
		assert_int_equal(jn_sim_create(&c.sim, 1, &sim), JN_OK);
		int clean = 0;
		while (!jn_sim_is_done(sim)) {
			assert_int_equal(jn_sim_step(sim), JN_OK);
			const JnReport* report = jn_sim_last_report(sim);
			if (jn_sim_steps(sim) == 1) continue; // knows no forces at its start
			clean += report->rejected == 0;
			// an attempt needs those of its end, and after a rejection those of the start again
			assert_int_equal(report->forces, 1 + 2 * report->rejected);
			assert_int_equal(report->tangents, 1);
		}
		assert_true(clean > 10);
		jn_sim_destroy(sim);
	}
}

// Forces that are linear over a step have no error at all: this controller alone would let the step grow for ever.
static void a_linear_material_has_no_force_error(void** state) {
	(void)state;
	const char* const methods[] = {"linearized_newmark", "backward_euler", "tr_bdf2"};
	for (int i = 0; i < 3; ++i) {
		ModelCase c;
		Rig rig;
		Judge judge;
		soft_box(&c, "linear", methods[i]);
		rig_create(&rig, &c, 1);
		for (int k = 0; k < 5; ++k) rig_step(&rig, 0.01);
		judge_open(&judge, rig.integrator, rig.sys);
		const double error = measured(&judge, rig.sys, &rig.start, &rig.end, 0.05);
		// rounding: 64 times that of the forces
		expect_near(error, 0, 1e-11, "%s", methods[i]);
		jn_controller_destroy(judge.controller);
		rig_destroy(&rig);
	}
}

// The change of what is prescribed is part of what the linearisation knows.
static void nor_has_one_whose_face_is_driven(void** state) {
	(void)state;
	const char* const methods[] = {"linearized_newmark", "linearized_euler", "backward_euler"};
	for (int i = 0; i < 3; ++i) {
		ModelCase c;
		Rig rig;
		Judge judge;
		soft_box(&c, "linear", methods[i]);
		case_drive(&c, FACE_Z_HIGH, 0.05, 2);
		rig_create(&rig, &c, 1);
		judge_open(&judge, rig.integrator, rig.sys);
		expect_near(measured(&judge, rig.sys, &rig.start, &rig.end, 0.05), 0, 1e-11, "%s", methods[i]); // rounding
		jn_controller_destroy(judge.controller);
		rig_destroy(&rig);
	}
}

static void refuse(const char* settings, const char* first, const char* second) {
	SpringCase c;
	log_capture();
	assert_int_equal(spring_open(&c, the_spring(), settings), JN_BAD_INPUT);
	assert_null(c.sim);
	log_expect(first);
	log_expect(second);
	spring_close(&c);
}

static void explicit_methods_are_refused_by_name(void** state) {
	(void)state;
	int refused = 0;
	for (int i = 0; i < jn_integrator_list.count; ++i) {
		const JnIntegratorType* type = (const JnIntegratorType*)jn_integrator_list.rows[i];
		char settings[160];
		snprintf(settings, sizeof settings,
				 "{duration: 1 s, integrator: {method: %s}, step: {controller: force_error}}", type->row.name);
		if (type->force_weight > 0) continue;
		refuse(settings, type->row.name, "force_error");
		++refused;
	}
	assert_true(refused > 5);
}

static void options_that_make_no_sense_are_refused_with_a_remedy(void** state) {
	(void)state;
	const struct {
		const char *keys, *place, *words;
	} wrong[] = {
		{"tolerance: 0", "step.tolerance", "use"},
		{"tolerance: -1e-5 m", "step.tolerance", "outside"},
		{"safety: 0", "step.safety", "0.5"},
		{"safety: 1.5", "step.safety", "0.5"},
		{"exponent: 0.5", "step.exponent", "use 4"},
		{"exponent: 9", "step.exponent", "use 4"},
		{"dt_min: 1 s, dt_max: 1 ms, dt: 1 ms", "step.dt_min", "lower it"},
		{"dt: 1 ms, dt_min: 2 ms", "step.dt", "between"},
		{"dt: 1 s, dt_max: 2 ms", "step.dt", "between"},
		{"lowest: 1", "step.lowest", "outside"},
		{"highest: 1", "step.highest", "outside"},
	};
	for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
		char settings[200];
		snprintf(settings, sizeof settings, "{duration: 1 s, integrator: newmark, step: {controller: force_error, %s}}",
				 wrong[i].keys);
		refuse(settings, wrong[i].place, wrong[i].words);
	}
}

static void a_tolerance_that_no_step_meets_ends_the_run_with_dt_min(void** state) {
	(void)state;
	SpringCase c;
	JnStatus status =
		spring_open(&c, the_spring(),
					"{duration: 1 s, integrator: newmark, step: {controller: force_error, tolerance: 1e-9 m, "
					"dt: 20 ms, dt_min: 8 ms}}");
	while (status == JN_OK && !jn_sim_is_done(c.sim)) status = jn_sim_step(c.sim);
	assert_int_equal(status, JN_RUN_FAILED);
	log_expect("force error");
	log_expect("step.dt_min = 0.008 s");
	log_expect("step.tolerance");
	spring_close(&c);
}

static void forces_that_fail_are_cut_down_to_dt_min(void** state) {
	(void)state;
	SpringCase c;
	Spring spring = *the_spring();
	spring.fails_after = 60;
	JnStatus status = spring_open(
		&c, &spring, "{duration: 1 s, integrator: newmark, step: {controller: force_error, dt_min: 1e-6 s}}");
	while (status == JN_OK && !jn_sim_is_done(c.sim)) status = jn_sim_step(c.sim);
	assert_int_equal(status, JN_RUN_FAILED);
	log_expect("not finite");
	log_expect("step.dt_min = 1e-06 s");
	spring_close(&c);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(linearised_methods_leave_the_force_that_they_took),
		cmocka_unit_test(a_difference_of_forces_tells_what_the_tangent_would),
		cmocka_unit_test(the_error_falls_with_the_fourth_power_of_the_step_and_the_fifth_from_rest),
		cmocka_unit_test(a_linearised_step_costs_one_force_and_a_rejection_two),
		cmocka_unit_test(a_linear_material_has_no_force_error),
		cmocka_unit_test(nor_has_one_whose_face_is_driven),
		cmocka_unit_test(explicit_methods_are_refused_by_name),
		cmocka_unit_test(options_that_make_no_sense_are_refused_with_a_remedy),
		cmocka_unit_test(a_tolerance_that_no_step_meets_ends_the_run_with_dt_min),
		cmocka_unit_test(forces_that_fail_are_cut_down_to_dt_min),
	};
	return cmocka_run_group_tests(tests, log_set_up, log_tear_down);
}
