/// @file cg_model_test.c
/// Steps with conjugate gradients against those with a factorisation, matrices assembled.
#include "support/model_case.h"

enum { STEPS = 8 };

static const JnCgDef cg = {.tolerance = 1e-12, .max_iterations = 2000};

static const JnSolverType* solver_type = &jn_solver_cg;

static void use_cg(ModelCase* c) {
	c->sim.model.solver = (JnVariant){&solver_type->row, (void*)&cg};
}

// End positions of some steps of a box that sags; the caller frees them.
static double* run(const char* method, int mass, bool with_cg, int threads, Rig* rig, JnReport* total) {
	ModelCase c;
	case_box(&c, JN_HEX8, "stable_neo_hookean");
	case_gravity(&c, 3, 0, -9.81);
	case_method(&c, row_named(&jn_integrator_list, method));
	c.body.mass = mass;
	c.body.damping = (JnDampingDef){.alpha = 0.5, .beta = 0.002};
	c.sim.newton.mode = 3;
	c.sim.newton.guess = 4;
	if (with_cg) use_cg(&c);
	rig_create(rig, &c, threads);
	for (int i = 0; i < STEPS; ++i) {
		rig_step(rig, 1.0 / 128);
		total->iterations += rig->report.iterations;
		total->indefinite += rig->report.indefinite;
		total->tangents += rig->report.tangents;
		total->factorizations += rig->report.factorizations;
	}
	double* x = malloc((size_t)rig->length * sizeof *x);
	memcpy(x, rig->start.x, (size_t)rig->length * sizeof *x);
	rig_destroy(rig);
	return x;
}

static void both_solvers_give_the_same_motion(void** state) {
	(void)state;
	static const char* const methods[] = {"linearized_newmark", "backward_euler", "newmark", "sdirk2", "ros2"};
	for (size_t m = 0; m < sizeof methods / sizeof *methods; ++m)
		for (int mass = 0; mass < 2; ++mass) {
			Rig rig;
			JnReport direct = {0}, iterated = {0};
			double* expected = run(methods[m], mass, false, 1, &rig, &direct);
			double* x = run(methods[m], mass, true, 1, &rig, &iterated);
			assert_int_equal(direct.iterations, 0);
			assert_true(iterated.iterations > 0);
			// newton.tolerance is 1e-10 of the weight, which moves the box by some 0.01 m
			expect_near(largest_difference(x, expected, rig.length), 0, 1e-10, "%s, mass %d", methods[m], mass);
			free(x);
			free(expected);
		}
}

static void the_number_of_threads_changes_no_bit(void** state) {
	(void)state;
	static const JnSolverType* const solvers[] = {&jn_solver_cg, &jn_solver_auto};
	for (int s = 0; s < 2; ++s) {
		Rig rig;
		JnReport report = {0};
		solver_type = solvers[s];
		double* one = run("newmark", 1, true, 1, &rig, &report);
		double* three = run("newmark", 1, true, 3, &rig, &report);
		assert_memory_equal(one, three, (size_t)rig.length * sizeof *one);
		free(one);
		free(three);
	}
	solver_type = &jn_solver_cg;
}

static void a_linearized_step_makes_one_tangent(void** state) {
	(void)state;
	Rig rig;
	JnReport report = {0};
	free(run("linearized_newmark", 1, true, 1, &rig, &report));
	assert_int_equal(report.indefinite, 0);
	assert_int_equal(report.factorizations, STEPS);
	assert_in_range(report.tangents, STEPS, 2 * STEPS); // K, and beta K of a step but the first
}

// A column pressed far beyond buckling by a big step: the exact matrix is indefinite, and the definite form is solved.
static void an_indefinite_matrix_gives_way_to_its_definite_form(void** state) {
	(void)state;
	double* found[2];
	Rig rig;
	for (int with_cg = 0; with_cg < 2; ++with_cg) {
		ModelCase c;
		case_box(&c, JN_HEX8, "stable_neo_hookean");
		case_method(&c, row_named(&jn_integrator_list, "linearized_newmark"));
		if (with_cg) use_cg(&c);
		rig_create(&rig, &c, 1);
		const double* rest = jn_model_rest(rig.model);
		for (int k = 0; k < rig.length; ++k) rig.start.x[k] = rest[k] * (k % 3 == 2 ? 0.4 : 1);
		rig_begin(&rig);
		assert_int_equal(rig_attempt(&rig, 0.5), JN_OK);
		assert_int_equal(rig.report.indefinite, 1);
		found[with_cg] = malloc((size_t)rig.length * sizeof(double));
		memcpy(found[with_cg], rig.end.x, (size_t)rig.length * sizeof(double));
		rig_destroy(&rig);
	}
	// the step moves by some metres, the residual is 1e-12, and the matrix has a condition number of some 1e3
	expect_near(largest_difference(found[0], found[1], rig.length), 0, 1e-8, "after an indefinite matrix");
	free(found[0]);
	free(found[1]);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(both_solvers_give_the_same_motion),
		cmocka_unit_test(the_number_of_threads_changes_no_bit),
		cmocka_unit_test(a_linearized_step_makes_one_tangent),
		cmocka_unit_test(an_indefinite_matrix_gives_way_to_its_definite_form),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
