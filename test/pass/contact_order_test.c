/// @file contact_order_test.c
/// Contact keeps the order of the predictor where nothing touches; and the paper's equation (19) as printed does not, which
/// is why the corrector has another form: with C = M + dt^2 K,
///
///   printed   min 1/2 v' C v - c' v,  c = M vp + dt K (up - un),  u = un + dt v
///   here      c = C vp,  x = xp + theta dt (v - vp)
///
/// Without contact the minimum is v = C^-1 c. That is vp here, and in the printed form only where up = un + dt vp: for
/// Backward Euler.
#include "detect/obstacle.h"
#include "solve/qp.h"
#include "support/model_case.h"

// ---- the pass

/// A box that spins and swings, 1 mm above a floor that it never meets.
static void watched_box(ModelCase* c, JnObstacleDef* floor, double* plane) {
	case_box(c, JN_HEX8, "stable_neo_hookean");
	c->box = (JnBoxDef){.origin = {0, 0, 0.001}, .size = {0.2, 0.2, 0.2}, .cells = {1, 1, 1}, .element = JN_HEX8};
	c->body.fix.count = 0;
	c->body.velocity[2] = 2;
	c->body.spin[0] = 3;
	c->body.spin[2] = 4;
	c->body.contact = (JnBodyContactDef){.active = true, .surface = "default"};
	const JnRow* shape = row_named(&jn_obstacle_list, "plane");
	((double*)option(shape, plane, "normal"))[2] = 1;
	*floor = (JnObstacleDef){.name = "floor", .shape = {shape, plane}, .surface = "default"};
	c->sim.model.obstacles = (JnItems){1, floor};
	c->sim.duration = 0.25;
	c->sim.newton.tolerance = 1e-12;
}

static void end_of(const ModelCase* c, int steps, double* x) {
	JnSim* sim = NULL;
	ModelCase copy = *c; // the step is an option behind a pointer: put it into the case itself
	copy.sim.step.options = copy.control;
	*(double*)option(copy.sim.step.row, copy.control, "dt") = c->sim.duration / steps;
	assert_int_equal(jn_sim_create(&copy.sim, 1, &sim), JN_OK);
	while (!jn_sim_is_done(sim)) assert_int_equal(jn_sim_step(sim), JN_OK);
	memcpy(x, jn_sim_state(sim)->x, 24 * sizeof *x);
	jn_sim_destroy(sim);
}

static void sdirk2_keeps_order_two_beside_an_obstacle(void** state) {
	(void)state;
	ModelCase c;
	JnObstacleDef floor;
	double plane[8] = {0}, exact[24], coarse[24], fine[24];
	JnContactDef contact = {.margin = 0.1, .friction = 0.5, .rounds = 8};
	JnArena options = {0};
	watched_box(&c, &floor, plane);
	const JnRow* solver = row_named(&jn_qp_list, "auto");
	contact.solver = (JnVariant){solver, jn_arena_take(&options, 1, solver->options_size)};
	assert_int_equal(jn_keys_read(solver->keys, NULL, "", &options, contact.solver.options), JN_OK);
	end_of(&c, 4096, exact);
	end_of(&c, 128, fine);
	c.sim.contact = &contact;
	end_of(&c, 128, coarse);
	assert_memory_equal(coarse, fine, sizeof coarse);
	end_of(&c, 256, fine);
	const double order = log2(largest_difference(coarse, exact, 24) / largest_difference(fine, exact, 24));
	print_message("errors %g and %g m\n", largest_difference(coarse, exact, 24), largest_difference(fine, exact, 24));
	expect_near(order, 2, 0.15, "order"); // what the next term of the error leaves at these steps
	jn_arena_free(&options);
}

// ---- the printed form, by hand

enum { PRINTED, HERE };

/// A linear box that swings, so that every method is at its own order.
static void linear_box(ModelCase* c, const char* method) {
	case_box(c, JN_HEX8, "linear");
	c->box = (JnBoxDef){.size = {0.2, 0.2, 0.4}, .cells = {1, 1, 2}, .element = JN_HEX8};
	c->body.velocity[0] = 0.1;
	c->sim.integrator.row = row_named(&jn_integrator_list, method);
	c->sim.newton.tolerance = 1e-13;
}

// v = C^-1 c without any contact, and the position that belongs to it.
static void correct(Rig* rig, double dt, int form) {
	JnMatrix *stiffness, *matrix;
	const size_t bytes = (size_t)rig->length * sizeof(double);
	double *c = malloc(bytes), *moved = malloc(bytes), *v = malloc(bytes);
	assert_true(c != NULL && moved != NULL && v != NULL);
	assert_int_equal(rig->sys->ops->linearize(rig->sys, &rig->end), JN_OK);
	for (int k = 0; k < rig->length; ++k) moved[k] = rig->end.x[k] - rig->start.x[k];
	for (int k = 0; form == HERE && k < rig->length; ++k) moved[k] = dt * rig->end.v[k];
	assert_int_equal(rig->sys->ops->matrix(rig->sys, (JnShift){0, 0, dt}, &stiffness), JN_OK);
	stiffness->ops->apply(stiffness, moved, c); // dt K (up - un), or dt^2 K vp
	assert_int_equal(rig->sys->ops->matrix(rig->sys, (JnShift){1, 0, 0}, &matrix), JN_OK);
	matrix->ops->apply(matrix, rig->end.v, v);
	for (int k = 0; k < rig->length; ++k) c[k] += v[k];
	rig->sys->ops->hold(rig->sys, c);
	assert_int_equal(rig->sys->ops->matrix(rig->sys, (JnShift){1, 0, dt * dt}, &matrix), JN_OK);
	assert_int_equal(matrix->ops->solve(matrix, c, v), JN_OK);
	for (int k = 0; k < rig->length; ++k) {
		rig->end.x[k] = form == HERE ? rig->end.x[k] + dt * (v[k] - rig->end.v[k]) : rig->start.x[k] + dt * v[k];
		rig->end.v[k] = v[k];
	}
	jn_state_touch(rig->space, &rig->end);
	free(c);
	free(moved);
	free(v);
}

/// Positions after 1/8 s, with the corrector of a form after every step, or without any (form < 0).
static void swing(const char* method, int steps, int form, double* x) {
	ModelCase c;
	Rig rig;
	linear_box(&c, method);
	rig_create(&rig, &c, 1);
	const double dt = 0.125 / steps;
	for (int i = 0; i < steps; ++i) {
		assert_int_equal(rig_attempt(&rig, dt), JN_OK);
		if (form >= 0) correct(&rig, dt, form);
		rig_accept(&rig, dt);
	}
	memcpy(x, rig.start.x, (size_t)rig.length * sizeof *x);
	rig_destroy(&rig);
}

enum { LENGTH = 36 };

static double order_of(const char* method, int form) {
	double exact[LENGTH], coarse[LENGTH], fine[LENGTH];
	swing(method, 4096, -1, exact);
	swing(method, 64, form, coarse);
	swing(method, 128, form, fine);
	return log2(largest_difference(coarse, exact, LENGTH) / largest_difference(fine, exact, LENGTH));
}

// Errors of both steps are well within their asymptotic range: 0.15 is what the next terms leave.
static void equation_19_as_printed_takes_sdirk2_to_order_one_without_any_contact(void** state) {
	(void)state;
	expect_near(order_of("sdirk2", -1), 2, 0.15, "order of SDIRK2");
	expect_near(order_of("sdirk2", PRINTED), 1, 0.15, "order of SDIRK2 with (19) as printed");
	expect_near(order_of("sdirk2", HERE), 2, 0.15, "order of SDIRK2 with c = C vp");
}

// Backward Euler moves by dt times its end's velocity, so both forms are the same there.
static void equation_19_as_printed_leaves_backward_euler_alone(void** state) {
	(void)state;
	double alone[LENGTH], printed[LENGTH], moved[LENGTH];
	swing("backward_euler", 64, -1, alone);
	swing("backward_euler", 64, PRINTED, printed);
	expect_near(largest_difference(alone, printed, LENGTH), 0, 1e-12,
				"change of Backward Euler [m]"); // tolerance of Newton
	swing("sdirk2", 64, -1, alone);
	swing("sdirk2", 64, PRINTED, moved);
	print_message("change of SDIRK2: %g m\n", largest_difference(alone, moved, LENGTH));
	assert_true(largest_difference(alone, moved, LENGTH) > 1e-5); // of a swing of millimetres
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(sdirk2_keeps_order_two_beside_an_obstacle),
		cmocka_unit_test(equation_19_as_printed_takes_sdirk2_to_order_one_without_any_contact),
		cmocka_unit_test(equation_19_as_printed_leaves_backward_euler_alone),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
