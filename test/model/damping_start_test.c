// Damping that begins at a time: nothing of it before, all of it after.
#include "support/model_case.h"
#include "support/support.h"

static const double dt = 1.0 / 128;
enum { BEFORE = 10, AFTER = 30 };

static void damped_rig(Rig* rig, ModelCase* c, const char* method, double alpha, double beta, int stiffness) {
	case_box(c, JN_HEX8, "stable_neo_hookean");
	case_method(c, row_named(&jn_integrator_list, method));
	c->body.damping = (JnDampingDef){.alpha = alpha, .beta = beta, .stiffness = stiffness, .start = BEFORE * dt};
	rig_create(rig, c, 1);
	rig_shake(rig, 3, 0.004, 0.2);
}

static double mechanical_energy(Rig* rig) {
	const JnEnergies e = jn_model_energies(rig->model, &rig->start);
	return e.kinetic + e.elastic;
}

// Every kind of damping, by a method with one stage at its end, one with two stages, and a linearly implicit one.
static void before_its_start_a_run_equals_the_undamped_one_bit_for_bit(void** state) {
	(void)state;
	static const char* const methods[] = {"average_vector_field", "sdirk2", "ros3p"};
	for (int k = 0; k < 9; ++k) {
		ModelCase damped_case, undamped_case;
		Rig damped, undamped;
		damped_rig(&damped, &damped_case, methods[k / 3], 2, 1e-2, k % 3);
		damped_rig(&undamped, &undamped_case, methods[k / 3], 0, 0, k % 3);
		for (int step = 0; step < BEFORE; ++step) {
			rig_step(&damped, dt);
			rig_step(&undamped, dt);
			assert_memory_equal(damped.start.x, undamped.start.x, (size_t)damped.length * sizeof(double));
			assert_memory_equal(damped.start.v, undamped.start.v, (size_t)damped.length * sizeof(double));
		}
		rig_step(&damped, dt);
		rig_step(&undamped, dt);
		assert_true(largest_difference(damped.start.v, undamped.start.v, damped.length) > 1e-3); // of 0.2 m/s
		rig_destroy(&damped);
		rig_destroy(&undamped);
	}
}

static void energy_stays_before_and_falls_after(void** state) {
	(void)state;
	static const double numbers[2][2] = {{4, 0}, {0, 1e-2}}; // alpha, beta
	for (int k = 0; k < 2; ++k) {
		ModelCase c;
		Rig rig;
		damped_rig(&rig, &c, "average_vector_field", numbers[k][0], numbers[k][1], 0);
		const double at_first = mechanical_energy(&rig);
		for (int step = 0; step < BEFORE; ++step) rig_step(&rig, dt);
		const double at_start = mechanical_energy(&rig);
		// this method keeps the energy up to the quadrature along its step
		expect_near(at_start / at_first, 1, 1e-6, "energy before");
		for (int step = 0; step < AFTER; ++step) rig_step(&rig, dt);
		const double last = mechanical_energy(&rig);
		print_message("energy %g J, %g J when damping begins, %g J %d steps later\n", at_first, at_start, last, AFTER);
		assert_true(last < 0.6 * at_start); // alpha alone makes it exp(-alpha t) = 0.39; beta acts on fast modes most
		rig_destroy(&rig);
	}
}

static void an_attempt_repeated_across_the_start_is_the_same(void** state) {
	(void)state;
	ModelCase c;
	Rig rig;
	damped_rig(&rig, &c, "sdirk2", 2, 1e-2, 0);
	double* first = malloc((size_t)rig.length * sizeof *first);
	for (int step = 0; step < BEFORE + 2; ++step) {
		assert_int_equal(rig_attempt(&rig, 3 * dt), JN_OK); // ends far behind the start of damping, which it ignores
		assert_int_equal(rig_attempt(&rig, dt), JN_OK);
		memcpy(first, rig.end.x, (size_t)rig.length * sizeof *first);
		assert_int_equal(rig_attempt(&rig, dt), JN_OK);
		// kept factors and first guesses move a converged solution by its tolerance of 1e-10 alone
		assert_true(largest_difference(first, rig.end.x, rig.length) < 1e-10);
		rig_accept(&rig, dt);
	}
	free(first);
	rig_destroy(&rig);
}

static void a_step_that_begins_a_rounding_early_is_damped(void** state) {
	(void)state;
	ModelCase c;
	Rig rig;
	damped_rig(&rig, &c, "sdirk2", 1, 0, 0);
	double* f = calloc((size_t)rig.length, sizeof *f);
	double* undamped = calloc((size_t)rig.length, sizeof *undamped);
	assert_int_equal(rig.sys->ops->force(rig.sys, &rig.start, undamped), JN_OK);
	rig.start.t = BEFORE * dt * (1 - 1e-14);
	rig_begin(&rig);
	assert_int_equal(rig.sys->ops->force(rig.sys, &rig.start, f), JN_OK);
	assert_true(largest_difference(f, undamped, rig.length) > 1e-3); // alpha M v of 1/s, some 0.1 kg and 0.2 m/s
	rig.start.t = BEFORE * dt * (1 - 1e-6);
	rig_begin(&rig);
	assert_int_equal(rig.sys->ops->force(rig.sys, &rig.start, f), JN_OK);
	assert_memory_equal(f, undamped, (size_t)rig.length * sizeof *f);
	free(f);
	free(undamped);
	rig_destroy(&rig);
}

static void bodies_that_start_at_different_times_are_refused(void** state) {
	(void)state;
	ModelCase c;
	case_box(&c, JN_HEX8, "stable_neo_hookean");
	JnBodyDef bodies[3] = {c.body, c.body, c.body};
	bodies[1].name = "second";
	bodies[2].name = "third";
	bodies[0].damping = (JnDampingDef){.beta = 1e-3, .start = 1};
	bodies[1].damping = (JnDampingDef){.start = 7}; // no damping at all
	bodies[2].damping = (JnDampingDef){.alpha = 1, .start = 2};
	c.sim.model.bodies = (JnItems){3, bodies};
	JnModel* model = NULL;
	log_capture();
	assert_int_equal(jn_model_create(&c.sim.model, 1, &model), JN_BAD_INPUT);
	assert_non_null(strstr(log_text(), "bodies[2].damping.start: differs"));
	log_release();
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(before_its_start_a_run_equals_the_undamped_one_bit_for_bit),
		cmocka_unit_test(energy_stays_before_and_falls_after),
		cmocka_unit_test(an_attempt_repeated_across_the_start_is_the_same),
		cmocka_unit_test(a_step_that_begins_a_rounding_early_is_damped),
		cmocka_unit_test(bodies_that_start_at_different_times_are_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
