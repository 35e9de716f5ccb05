/// @file contact_energy_test.c
/// Energy in contact: what bounces never gains, what each choice keeps, and the ledger that tells where it went.
#include "pass/pass_case.h"

// ---- the ledger

// A ball of a linear material falls on a floor: the implicit midpoint rule keeps its energy exactly, and the work of a
// constant load is that over the displacement. So what contact says it did is all that changes the total energy.
static void open_linear(Run* run, const char* prediction, double friction) {
	run_open(run, 1,
			 "duration: 2 s\ngravity: [0, -9.81, 0]\nintegrator: {method: implicit_midpoint}\n"
			 "newton: {tolerance: 1e-12}\nstep: {dt: 4 ms}\n"
			 "bodies:\n"
			 "  - {name: ball, shape: {type: ball, center: [0, 0.12, 0], radius: 0.1, cells: 2, rings: 2},\n"
			 "     material: {law: linear, density: 1000, young: 1e5, poisson: 0.3}, velocity: [0.5, -1, 0]}\n"
			 "obstacles: [{name: floor, shape: plane}]\n"
			 "contact: {prediction: %s, friction: %g}\n",
			 prediction, friction);
}

static double taken(const Run* run) {
	return run_column(run, "contact_work") + run_column(run, "friction_work") + run_column(run, "contact_loss");
}

// Rounding of energies of 5 J, and what Newton leaves: 1e-12 of the weight, 40 N, over centimetres, in each of 100 steps.
static void the_ledger_closes_with_an_integrator_that_keeps_energy(void** state) {
	(void)state;
	static const char* const predictions[] = {"carried", "iterated", "free"};
	for (int p = 0; p < 3; ++p)
		for (int rough = 0; rough < 2; ++rough) {
			Run run;
			double worst = 0, pressed = 0;
			open_linear(&run, predictions[p], 0.4 * rough);
			const double start = run_energy(&run);
			while (run_state(&run)->t < 0.4) {
				run_step(&run);
				worst = fmax(worst, fabs(run_energy(&run) - start - taken(&run)));
				pressed += run_column(&run, "contacts_pressing") > 0;
			}
			print_message("%s, mu %g: %g of %g J, %g by friction, %g else, %g steps in contact\n", predictions[p],
						  0.4 * rough, taken(&run), start, run_column(&run, "friction_work"),
						  run_column(&run, "contact_loss"), pressed);
			expect_at_most(worst, 1e-9, "energy that the ledger does not know [J]");
			assert_true(pressed > 5 && fabs(taken(&run)) > 0.01);
			run_close(&run);
		}
}

// From one start, with and without contact: the difference of the ends is what contact did, whatever the integrator.
static void the_ledger_of_the_first_impact_is_the_correction(void** state) {
	(void)state;
	static const char* const methods[] = {"backward_euler", "sdirk2", "newmark"};
	for (int m = 0; m < 3; ++m) {
		Run with, without;
		for (int i = 0; i < 2; ++i)
			run_open(i == 0 ? &with : &without, 1,
					 "duration: 2 s\ngravity: [0, -9.81, 0]\nintegrator: {method: %s}\nstep: {dt: 4 ms}\n"
					 "bodies:\n"
					 "  - {name: ball, shape: {type: ball, center: [0, 0.12, 0], radius: 0.1, cells: 2, rings: 2},\n"
					 "     material: {law: stable_neo_hookean, density: 1000, young: 1e5, poisson: 0.3},\n"
					 "     velocity: [0.5, -1, 0]}\n"
					 "obstacles: [{name: floor, shape: plane}]\n%s",
					 methods[m], i == 0 ? "contact: {friction: 0.4}\n" : "");
		while (taken(&with) == 0) {
			run_step(&with);
			run_step(&without);
		}
		// Rounding of the sums of energies: 30 J, some tens of them.
		expect_near(taken(&with), run_energy(&with) - run_energy(&without), 1e-13 * 30, "%s: taken by contact [J]",
					methods[m]);
		run_close(&with);
		run_close(&without);
	}
}

// ---- a bounce

typedef struct Bounce {
	double highest; // total energy at any time, relative to that at the start
	double kept;    // total energy after the bounce, over that at the start, both from the floor's point of view
	double rise;    // most that it has grown above an earlier value, the same
} Bounce;

// A soft ball of 0.2 m falls by 0.3 m, bounces once and flies. Energy is counted from where the ball just touches.
static Bounce bounce(const char* method, const char* prediction, double dt) {
	Run run;
	run_open(
		&run, 1,
		"duration: 2 s\ngravity: [0, -9.81, 0]\nintegrator: {method: %s}\nstep: {dt: %.17g s}\n"
		"bodies:\n"
		"  - {name: ball, shape: {type: ball, center: [0, 0.13, 0], radius: 0.1, cells: 3, rings: 2},\n"
		"     material: {law: stable_neo_hookean, density: 1000, young: 1e5, poisson: 0.45}, velocity: [0, -2, 0]}\n"
		"obstacles: [{name: floor, shape: plane}]\n"
		"contact: {prediction: %s}\n",
		method, dt, prediction);
	const double touching = -run.model->gravity[1] * jn_model_mass(run.model) * 0.03; // below the start
	const double start = run_energy(&run) + touching;
	double least = start, now = start;
	Bounce b = {0};
	while (run_state(&run)->t < 0.15) {
		run_step(&run);
		now = run_energy(&run) + touching;
		least = fmin(least, now);
		b.highest = fmax(b.highest, now / start);
		b.rise = fmax(b.rise, (now - least) / start);
	}
	assert_true(run_column(&run, "contacts_pressing") == 0);
	b.kept = now / start;
	print_message("%s, dt %g ms, %s: kept %.4f, highest %.5f, largest rise %.2g\n", method, 1e3 * dt, prediction,
				  b.kept, b.highest, b.rise);
	run_close(&run);
	return b;
}

static const double steps[] = {1e-3, 2e-3, 5e-3, 10e-3};
enum { STEPS = sizeof steps / sizeof *steps };

// A thousandth of the energy at the start may come back at any time.
static void a_bounce_never_gains(void** state) {
	(void)state;
	static const char* const methods[] = {"backward_euler", "sdirk2"};
	static const char* const predictions[] = {"carried", "iterated"};
	for (int m = 0; m < 2; ++m)
		for (int p = 0; p < 2; ++p)
			for (int i = 0; i < STEPS; ++i)
				expect_at_most(bounce(methods[m], predictions[p], steps[i]).rise, 1e-3, "  growth of total energy");
}

// The paper's corrector moves by dt where SDIRK2 moves by half of that: steps of contact give back some hundredths of what
// others took. Below the start it stays.
static void the_corrector_of_the_paper_never_exceeds_the_start(void** state) {
	(void)state;
	for (int i = 0; i < STEPS; ++i) {
		const Bounce euler = bounce("backward_euler", "free", steps[i]), sdirk2 = bounce("sdirk2", "free", steps[i]);
		expect_at_most(euler.rise, 1e-3, "  growth of total energy, Backward Euler");
		expect_at_most(sdirk2.rise, 0.05, "  growth of total energy, SDIRK2");
		expect_at_most(sdirk2.highest, 1.001, "  total energy over the first");
	}
}

static void sdirk2_keeps_more_of_a_bounce_than_backward_euler(void** state) {
	(void)state;
	for (int i = 0; i < STEPS; ++i)
		expect_at_most(bounce("backward_euler", "carried", steps[i]).kept, bounce("sdirk2", "carried", steps[i]).kept,
					   "kept by Backward Euler and by SDIRK2");
}

static void carried_forces_keep_more_of_a_bounce_than_the_corrector_of_the_paper(void** state) {
	(void)state;
	for (int i = 0; i < STEPS; ++i)
		expect_at_most(bounce("sdirk2", "free", steps[i]).kept, bounce("sdirk2", "carried", steps[i]).kept,
					   "kept free and carried");
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(the_ledger_closes_with_an_integrator_that_keeps_energy),
		cmocka_unit_test(the_ledger_of_the_first_impact_is_the_correction),
		cmocka_unit_test(a_bounce_never_gains),
		cmocka_unit_test(the_corrector_of_the_paper_never_exceeds_the_start),
		cmocka_unit_test(sdirk2_keeps_more_of_a_bounce_than_backward_euler),
		cmocka_unit_test(carried_forces_keep_more_of_a_bounce_than_the_corrector_of_the_paper),
	};
	return cmocka_run_group_tests(tests, case_set_up, case_tear_down);
}
