/// @file stage_test.c
/// The stage solver: what it must find, whatever its options, and what it does with starts that are far from the
/// solution and forces that are not numbers.
#include "support/model_case.h"
#include "support/point_system.h"

enum { ROOT, LINEAR };
enum { REUSE_AUTO, REUSE_NEVER };
enum { GUESS_ZERO, GUESS_LAST, GUESS_LINEAR };

// ---- one coordinate: r(a) = f(x + kx a) - a ----

static double arctangent(double x) {
	return -1000 * atan(x);
}

static double arctangent_stiffness(double x) {
	return 1000 / (1 + x * x);
}

static double logarithm(double x) {
	return -1000 * log(x);
}

static double logarithm_stiffness(double x) {
	return 1000 / x;
}

static double not_a_number(double x) {
	return x > 100 ? 0 : NAN;
}

static double spring(double x) {
	return -1000 * x;
}

static double spring_stiffness(double x) {
	(void)x;
	return 1000;
}

typedef struct PointCase {
	PointSystem system;
	JnIntegrator* integrator;
	JnState s;
	JnVec x, v, a;
} PointCase;

static void point_case(PointCase* c, double (*force)(double), double (*stiffness)(double), JnNewtonDef newton) {
	point_create(&c->system, force, stiffness);
	JnSpace* space = c->system.base.space;
	const JnVariant method = {.row = row_named(&jn_integrator_list, "backward_euler")};
	c->integrator = jn_integrator_create(&method, &newton, space);
	assert_non_null(c->integrator);
	assert_int_equal(jn_state_create(space, &c->s), JN_OK);
	c->x = space->ops->create(space);
	c->v = space->ops->create(space);
	c->a = space->ops->create(space);
}

static void point_case_destroy(PointCase* c) {
	JnSpace* space = c->system.base.space;
	jn_state_destroy(space, &c->s);
	space->ops->destroy(space, c->x);
	space->ops->destroy(space, c->v);
	space->ops->destroy(space, c->a);
	jn_integrator_destroy(c->integrator);
	point_destroy(&c->system);
}

static JnStatus solve_from(PointCase* c, double x, double kx) {
	for (int k = 0; k < POINT_LENGTH; ++k) c->x[k] = x + 0.1 * k;
	const JnStage stage = {.t = 0, .kx = kx, .kv = sqrt(kx), .x = c->x, .v = c->v};
	return jn_stage_solve(c->integrator, &c->system.base, &stage, &c->s, c->a, &c->system.report);
}

// The residual itself, and s and a that belong together.
static void expect_solved(const PointCase* c, double kx) {
	for (int k = 0; k < POINT_LENGTH; ++k) {
		expect_near(c->system.force(c->s.x[k]) - c->a[k], 0, 1e-9, "residual"); // the tolerance asked for
		expect_near(c->s.x[k], c->x[k] + kx * c->a[k], 1e-12, "x of the stage");
		expect_near(c->s.v[k], sqrt(kx) * c->a[k], 1e-12, "v of the stage");
	}
}

static const JnNewtonDef plain = {.tolerance = 1e-9, .max_iterations = 60};

// Newton on the arctangent diverges from |x| > 1.39 with full steps.
static void a_start_beyond_full_steps_is_solved_by_the_line_search(void** state) {
	(void)state;
	for (int reuse = REUSE_AUTO; reuse <= REUSE_NEVER; ++reuse) {
		PointCase c;
		JnNewtonDef newton = plain;
		newton.reuse = reuse;
		point_case(&c, arctangent, arctangent_stiffness, newton);
		assert_int_equal(solve_from(&c, 5, 1), JN_OK);
		expect_solved(&c, 1);
		if (c.system.report.backtracks == 0) fail_msg("no backtracks, expected some");
		point_case_destroy(&c);
	}
}

// A full Newton step on the logarithm from x = 5 lands at x < 0, where there is no force.
static void the_line_search_comes_back_from_forces_that_are_not_numbers(void** state) {
	(void)state;
	PointCase c;
	point_case(&c, logarithm, logarithm_stiffness, plain);
	assert_int_equal(solve_from(&c, 5, 1), JN_OK);
	expect_solved(&c, 1);
	assert_true(c.system.report.backtracks > 0);
	point_case_destroy(&c);
}

static void a_first_force_that_is_not_a_number_is_reported(void** state) {
	(void)state;
	for (int mode = ROOT; mode <= LINEAR; ++mode) {
		PointCase c;
		JnNewtonDef newton = plain;
		newton.mode = mode;
		point_case(&c, not_a_number, spring_stiffness, newton);
		assert_int_equal(solve_from(&c, 5, 1), JN_NOT_FINITE);
		point_case_destroy(&c);
	}
}

static void too_few_iterations_are_reported(void** state) {
	(void)state;
	PointCase c;
	JnNewtonDef newton = plain;
	newton.max_iterations = 2;
	newton.reuse = REUSE_NEVER; // with a guess of zero, the default here: no second, careful try
	point_case(&c, arctangent, arctangent_stiffness, newton);
	assert_int_equal(solve_from(&c, 5, 1), JN_NOT_CONVERGED);
	assert_int_equal(c.system.report.newton, 2);
	point_case_destroy(&c);
}

static void mode_linear_is_exact_for_a_linear_force(void** state) {
	(void)state;
	PointCase c;
	JnNewtonDef newton = plain;
	newton.mode = LINEAR;
	point_case(&c, spring, spring_stiffness, newton);
	assert_int_equal(solve_from(&c, 5, 0.01), JN_OK);
	for (int k = 0; k < POINT_LENGTH; ++k)
		expect_near(c.a[k], -1000 * c.x[k] / 11, 1e-12, "a"); // -k x / (1 + kx k), to rounding of 500
	assert_int_equal(c.system.report.newton, 1);
	point_case_destroy(&c);
}

static void a_solved_start_costs_one_force_and_no_solve(void** state) {
	(void)state;
	PointCase c;
	point_case(&c, spring, spring_stiffness, plain);
	for (int k = 0; k < POINT_LENGTH; ++k) c.x[k] = 0;
	const JnStage stage = {.kx = 1, .kv = 1, .x = c.x, .v = c.v};
	assert_int_equal(jn_stage_solve(c.integrator, &c.system.base, &stage, &c.s, c.a, &c.system.report), JN_OK);
	assert_int_equal(c.system.report.forces, 1);
	assert_int_equal(c.system.report.tangents + c.system.report.solves + c.system.report.newton, 0);
	point_case_destroy(&c);
}

// A system that does not tell the size of its forces: the tolerance is relative to the first residual.
static void without_typical_forces_the_first_residual_is_the_measure(void** state) {
	(void)state;
	PointCase c;
	JnNewtonDef newton = plain;
	newton.tolerance = 1e-3;
	point_case(&c, arctangent, arctangent_stiffness, newton);
	c.system.base.force_scale = 0;
	assert_int_equal(solve_from(&c, 0.5, 1), JN_OK);
	double first = 0, left = 0;
	for (int k = 0; k < POINT_LENGTH; ++k) {
		first += pow(c.system.force(c.x[k]), 2);
		left += pow(c.system.force(c.s.x[k]) - c.a[k], 2);
	}
	expect_near(c.system.report.residual, sqrt(left / first), 1e-12, "residual"); // rounding of both
	assert_true(c.system.report.residual <= 1e-3);
	point_case_destroy(&c);
}

static double no_force(double x) {
	(void)x;
	return 0;
}

static void without_any_force_there_is_nothing_to_solve(void** state) {
	(void)state;
	PointCase c;
	point_case(&c, no_force, no_force, plain);
	c.system.base.force_scale = 0;
	assert_int_equal(solve_from(&c, 5, 1), JN_OK);
	assert_true(c.system.report.residual == 0 && c.system.report.newton == 0);
	for (int k = 0; k < POINT_LENGTH; ++k) assert_true(c.a[k] == 0 && c.s.x[k] == c.x[k]);
	point_case_destroy(&c);
}

// ---- a solid ----

static void swinging_case(ModelCase* c, const char* law) {
	case_box(c, JN_HEX8, law);
	case_gravity(c, 3, -9.81, 0);
	c->body.velocity[0] = 0.5;
}

static void run_with(const char* law, JnNewtonDef newton, int steps, Rig* rig) {
	ModelCase c;
	swinging_case(&c, law);
	c.sim.newton = newton;
	rig_create(rig, &c, 1);
	for (int i = 0; i < steps; ++i) rig_step(rig, 1.0 / 64);
}

static void modes_of_reuse_and_guesses_agree(void** state) {
	(void)state;
	Rig expected;
	const JnNewtonDef exact = {.tolerance = 1e-12, .max_iterations = 60, .reuse = REUSE_NEVER};
	run_with("stable_neo_hookean", exact, 16, &expected);
	for (int reuse = REUSE_AUTO; reuse <= REUSE_NEVER; ++reuse)
		for (int guess = GUESS_ZERO; guess <= GUESS_LINEAR; ++guess) {
			Rig rig;
			const JnNewtonDef newton = {.tolerance = 1e-10, .max_iterations = 60, .reuse = reuse, .guess = guess};
			run_with("stable_neo_hookean", newton, 16, &rig);
			// 32 stages with residuals of 1e-10 of 50 N: accelerations to 1e-8 m/s^2 at most (nodes of 0.1 kg and up),
			// positions to 1e-8 * t^2 / 2 in 0.25 s
			expect_near(largest_difference(rig.start.x, expected.start.x, rig.length), 0, 1e-9,
						"positions with reuse %d, guess %d", reuse, guess);
			expect_near(largest_difference(rig.start.v, expected.start.v, rig.length), 0, 1e-8,
						"velocities with reuse %d, guess %d", reuse, guess);
			rig_destroy(&rig);
		}
	rig_destroy(&expected);
}

static void root_and_linear_agree_for_linear_laws(void** state) {
	(void)state;
	const char* const laws[] = {"linear", "corotated_frozen"};
	for (int i = 0; i < 2; ++i) {
		Rig root, linear;
		run_with(laws[i], (JnNewtonDef){.mode = ROOT, .tolerance = 1e-12, .max_iterations = 60}, 16, &root);
		run_with(laws[i], (JnNewtonDef){.mode = LINEAR, .tolerance = 1e-12, .max_iterations = 60}, 16, &linear);
		expect_near(linear.report.residual, 0, 1e-10, "residual of one Newton step with %s", laws[i]); // of the weight
		expect_near(largest_difference(root.start.x, linear.start.x, root.length), 0, 1e-11, "%s", laws[i]); // rounding
		rig_destroy(&root);
		rig_destroy(&linear);
	}
}

static void mode_linear_is_not_the_solution_of_a_nonlinear_law(void** state) {
	(void)state;
	Rig linear;
	run_with("stable_neo_hookean", (JnNewtonDef){.mode = LINEAR, .tolerance = 1e-12, .max_iterations = 60}, 8, &linear);
	assert_true(linear.report.residual > 1e-6);
	rig_destroy(&linear);
}

static void a_newton_stage_converges_quadratically_with_new_tangents(void** state) {
	(void)state;
	Rig rig;
	ModelCase c;
	swinging_case(&c, "stable_neo_hookean");
	c.sim.newton = (JnNewtonDef){.tolerance = 1e-12, .max_iterations = 60, .reuse = REUSE_NEVER};
	case_method(&c, row_named(&jn_integrator_list, "backward_euler"));
	rig_create(&rig, &c, 1);
	assert_int_equal(rig_attempt(&rig, 1.0 / 64), JN_OK);
	// from zero: errors of 1, 1e-2, 1e-4, 1e-8, 1e-16 of the step, so that 5 iterations do; 6 with slack
	if (rig.report.newton > 6) fail_msg("%d iterations, expected at most 6", rig.report.newton);
	rig_destroy(&rig);
}

static void a_kept_tangent_saves_factorizations(void** state) {
	(void)state;
	ModelCase c;
	int factorizations[2] = {0, 0};
	for (int reuse = REUSE_AUTO; reuse <= REUSE_NEVER; ++reuse) {
		Rig rig;
		swinging_case(&c, "stable_neo_hookean");
		c.sim.newton = (JnNewtonDef){.tolerance = 1e-8, .max_iterations = 60, .reuse = reuse, .guess = GUESS_LINEAR};
		rig_create(&rig, &c, 1);
		for (int i = 0; i < 16; ++i) {
			rig_step(&rig, 1.0 / 64);
			factorizations[reuse] += rig.report.factorizations;
		}
		rig_destroy(&rig);
	}
	if (factorizations[REUSE_AUTO] * 4 > factorizations[REUSE_NEVER])
		fail_msg("%d factorisations, expected at most a quarter of %d", factorizations[0], factorizations[1]);
}

// A clamped beam pushed together by 15 % in a step: buckling modes make M + kx K indefinite.
static void an_indefinite_newton_matrix_is_replaced_and_the_step_succeeds(void** state) {
	(void)state;
	ModelCase c;
	Rig rig;
	case_box(&c, JN_HEX8, "stable_neo_hookean");
	c.box = (JnBoxDef){.size = {0.05, 0.05, 0.8}, .cells = {1, 1, 16}, .element = JN_HEX8};
	c.material.young = 1e6;
	case_gravity(&c, 0, -9.81, 0);
	case_drive(&c, FACE_Z_HIGH, -0.12, 2.5); // a quarter of a period is 0.1 s
	c.drive.motion[2] = c.drive.motion[0];
	c.drive.motion[0] = (JnVariant){0};
	rig_create(&rig, &c, 1);
	int indefinite = 0;
	for (int i = 0; i < 4; ++i) {
		rig_step(&rig, 0.025);
		indefinite += rig.report.indefinite;
		expect_near(rig.report.residual, 0, 1e-10, "residual"); // the tolerance asked for
	}
	if (indefinite == 0) fail_msg("no indefinite matrix, expected some");
	rig_destroy(&rig);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_start_beyond_full_steps_is_solved_by_the_line_search),
		cmocka_unit_test(the_line_search_comes_back_from_forces_that_are_not_numbers),
		cmocka_unit_test(a_first_force_that_is_not_a_number_is_reported),
		cmocka_unit_test(too_few_iterations_are_reported),
		cmocka_unit_test(mode_linear_is_exact_for_a_linear_force),
		cmocka_unit_test(a_solved_start_costs_one_force_and_no_solve),
		cmocka_unit_test(without_typical_forces_the_first_residual_is_the_measure),
		cmocka_unit_test(without_any_force_there_is_nothing_to_solve),
		cmocka_unit_test(modes_of_reuse_and_guesses_agree),
		cmocka_unit_test(root_and_linear_agree_for_linear_laws),
		cmocka_unit_test(mode_linear_is_not_the_solution_of_a_nonlinear_law),
		cmocka_unit_test(a_newton_stage_converges_quadratically_with_new_tangents),
		cmocka_unit_test(a_kept_tangent_saves_factorizations),
		cmocka_unit_test(an_indefinite_newton_matrix_is_replaced_and_the_step_succeeds),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
