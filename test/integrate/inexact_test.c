/// @file inexact_test.c
/// Inexact Newton steps, taken where the linear solver iterates, against full solves with a new tangent each: the same
/// accelerations to the tolerance of the stage, for less work.
#include "support/model_case.h"

enum { ROOT, LINEAR, MINIMIZE, AUTO };
enum { REUSE_AUTO, REUSE_NEVER };
enum { GUESS_ZERO, GUESS_LINEAR = 2, GUESS_PARALLEL, GUESS_AUTO };
enum { STEPS = 8, BLOCK = 1 };
static const double dt = 1.0 / 64;

static const JnCgDef cg = {.tolerance = 1e-8, .max_iterations = 2000, .precondition = BLOCK};

typedef void Prepare(ModelCase* c);

static void swinging_box(ModelCase* c) {
	case_box(c, JN_HEX8, "stable_neo_hookean");
	case_gravity(c, 3, -9.81, 0);
	c->body.mass = 1;
}

static void box_of_frozen_rotations(ModelCase* c) {
	case_box(c, JN_HEX8, "corotated_frozen");
	case_gravity(c, 3, -9.81, 0);
	c->body.velocity[0] = 1;
}

static const struct {
	const char* name;
	Prepare* prepare;
} models[] = {{"swinging box", swinging_box},
			  {"driven box", case_driven_bar},
			  {"damped box", case_damped_body},
			  {"frozen rotations", box_of_frozen_rotations}};
enum { MODELS = sizeof models / sizeof *models };

static const char* const methods[] = {"backward_euler", "sdirk2", "tr_bdf2_b",         "esdirk325",           "newmark",
									  "hht_alpha",      "bdf2",   "generalized_alpha", "average_vector_field"};
enum { METHODS = sizeof methods / sizeof *methods };

// The worst residual goes to rig->report.
static void run(Prepare* prepare, const char* method, JnNewtonDef newton, bool iterates, Rig* rig, JnReport* total) {
	ModelCase c;
	double worst = 0;
	prepare(&c);
	case_method(&c, row_named(&jn_integrator_list, method));
	c.sim.newton = newton;
	if (iterates) c.sim.model.solver = (JnVariant){&jn_solver_cg.row, (void*)&cg};
	rig_create(rig, &c, 1);
	*total = (JnReport){0};
	for (int i = 0; i < STEPS; ++i) {
		rig_step(rig, dt);
		total->newton += rig->report.newton;
		total->iterations += rig->report.iterations;
		total->tangents += rig->report.tangents;
		worst = fmax(worst, rig->report.residual);
	}
	total->residual = worst;
}

// Stages leave 1e-9 of some 50 N on nodes of 0.1 kg and more: 5e-7 m/s^2, over 0.125 s 4e-9 m and 6e-8 m/s. What
// multistep methods carry along, and stages that are added up, may double it.
static void inexact_and_exact_steps_end_at_the_same_state(void** state) {
	(void)state;
	for (int m = 0; m < MODELS; ++m)
		for (int k = 0; k < METHODS; ++k) {
			Rig exact, inexact;
			JnReport of_exact, of_inexact;
			const JnNewtonDef full = {.tolerance = 1e-12, .max_iterations = 60, .reuse = REUSE_NEVER};
			const JnNewtonDef rough = {.mode = AUTO, .tolerance = 1e-9, .max_iterations = 60, .guess = GUESS_AUTO};
			run(models[m].prepare, methods[k], full, false, &exact, &of_exact);
			run(models[m].prepare, methods[k], rough, true, &inexact, &of_inexact);
			assert_true(of_inexact.residual <= 1e-9); // as asked for
			expect_near(largest_difference(exact.start.x, inexact.start.x, exact.length), 0, 1e-8, "%s, %s: positions",
						models[m].name, methods[k]);
			expect_near(largest_difference(exact.start.v, inexact.start.v, exact.length), 0, 1.2e-7,
						"%s, %s: velocities", models[m].name, methods[k]);
			rig_destroy(&exact);
			rig_destroy(&inexact);
		}
}

static void all_modes_take_inexact_steps_to_the_same_state(void** state) {
	(void)state;
	Rig expected;
	JnReport total;
	run(swinging_box, "sdirk2", (JnNewtonDef){.tolerance = 1e-9, .max_iterations = 60}, true, &expected, &total);
	for (int mode = MINIMIZE; mode <= AUTO; ++mode) {
		Rig rig;
		run(swinging_box, "sdirk2", (JnNewtonDef){.mode = mode, .tolerance = 1e-9, .max_iterations = 60}, true, &rig,
			&total);
		expect_near(largest_difference(rig.start.x, expected.start.x, rig.length), 0, 1e-8, "mode %d",
					mode); // as above
		rig_destroy(&rig);
	}
	rig_destroy(&expected);
}

// A rough tolerance needs few products: most of them would be for digits that curvature takes away.
static void inexact_steps_need_less_than_half_of_the_products(void** state) {
	(void)state;
	Rig rig;
	JnReport full, inexact;
	JnNewtonDef newton = {.tolerance = 1e-4, .max_iterations = 60, .reuse = REUSE_NEVER, .guess = GUESS_LINEAR};
	run(swinging_box, "sdirk2", newton, true, &rig, &full);
	rig_destroy(&rig);
	newton.reuse = REUSE_AUTO;
	run(swinging_box, "sdirk2", newton, true, &rig, &inexact);
	rig_destroy(&rig);
	if (2 * inexact.iterations > full.iterations)
		fail_msg("%d products, expected at most half of %d", inexact.iterations, full.iterations);
	if (inexact.newton > full.newton + STEPS / 2)
		fail_msg("%d Newton iterations, expected about %d", inexact.newton, full.newton);
}

static void a_law_that_is_linear_in_a_step_takes_one_iteration_a_stage(void** state) {
	(void)state;
	Rig rig;
	JnReport total;
	const JnNewtonDef newton = {.mode = AUTO, .tolerance = 1e-4, .max_iterations = 60, .guess = GUESS_AUTO};
	run(box_of_frozen_rotations, "sdirk2", newton, true, &rig, &total);
	assert_true(total.newton <= 2 * STEPS); // fewer where a guess is within the tolerance
	assert_true(total.residual <= 1e-4);
	rig_destroy(&rig);
}

// What is asked for is what is solved for: no eight digits where four will do.
static void mode_linear_solves_to_the_tolerance_of_the_stage(void** state) {
	(void)state;
	Rig rig;
	JnReport rough, fine;
	JnNewtonDef newton = {.mode = LINEAR, .tolerance = 1e-3, .max_iterations = 60};
	run(box_of_frozen_rotations, "sdirk2", newton, true, &rig, &rough);
	assert_true(rough.residual <= 1e-3);
	rig_destroy(&rig);
	newton.tolerance = 1e-8;
	run(box_of_frozen_rotations, "sdirk2", newton, true, &rig, &fine);
	assert_true(fine.residual <= 1e-8);
	assert_true(rough.newton == fine.newton && 3 * rough.iterations < 2 * fine.iterations);
	rig_destroy(&rig);
}

// Motion under constant forces: the third solution of sdirk2's first stage lies on the parallel through the two before.
static void guesses_parallel_to_the_step_before_save_products(void** state) {
	(void)state;
	Rig rig;
	JnReport zero, parallel;
	JnNewtonDef newton = {.tolerance = 1e-6, .max_iterations = 60, .guess = GUESS_ZERO};
	run(swinging_box, "sdirk2", newton, true, &rig, &zero);
	rig_destroy(&rig);
	newton.guess = GUESS_PARALLEL;
	run(swinging_box, "sdirk2", newton, true, &rig, &parallel);
	rig_destroy(&rig);
	if (parallel.iterations >= zero.iterations)
		fail_msg("%d products, expected less than %d", parallel.iterations, zero.iterations);
}

// Free boxes of which most elements are inverted: where the residual finds no way down, inexact directions lead down the
// energy like exact ones.
static void thrown_bodies_are_solved_in_modes_minimize_and_auto(void** state) {
	(void)state;
	for (int mode = MINIMIZE; mode <= AUTO; ++mode)
		for (uint64_t seed = 1; seed <= 3; ++seed) {
			ModelCase c;
			Rig rig;
			swinging_box(&c);
			c.material.young = 1e6;
			c.body.fix.count = 0;
			c.sim.model.solver = (JnVariant){&jn_solver_cg.row, (void*)&cg};
			c.sim.newton = (JnNewtonDef){.mode = mode, .tolerance = 1e-6, .max_iterations = 200, .guess = GUESS_LINEAR};
			rig_create(&rig, &c, 1);
			rig.sys->force_scale = 0; // that of the thrown state
			rig_shake(&rig, 7919 * seed, 0.4, 0);
			for (int i = 0; i < 4; ++i) {
				rig_step(&rig, 0.005);
				assert_true(rig.report.residual <= 1e-6); // as asked for
			}
			rig_destroy(&rig);
		}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(inexact_and_exact_steps_end_at_the_same_state),
		cmocka_unit_test(all_modes_take_inexact_steps_to_the_same_state),
		cmocka_unit_test(inexact_steps_need_less_than_half_of_the_products),
		cmocka_unit_test(a_law_that_is_linear_in_a_step_takes_one_iteration_a_stage),
		cmocka_unit_test(mode_linear_solves_to_the_tolerance_of_the_stage),
		cmocka_unit_test(guesses_parallel_to_the_step_before_save_products),
		cmocka_unit_test(thrown_bodies_are_solved_in_modes_minimize_and_auto),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
