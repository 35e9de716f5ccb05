/// @file contact_friction_test.c
/// Coulomb friction on a slope of 26.565 degrees, tan 0.5: what sticks does not creep, what slides has the acceleration
/// g (sin - mu cos), and friction takes mu N times the path, for any step. Axes are those of the slope: gravity is tilted.
#include "pass/pass_case.h"

static const double g = 9.81, sine = 0.4472135955, cosine = 0.894427191; // of the slope
static const double height = 0.2, density = 1000, volume = 0.4 * 0.2 * 0.4;

static const struct {
	const char* method;
	double dt, duration; ///< [s]
} steppings[] = {
	{"sdirk2", 1e-3, 0.8},         {"sdirk2", 5e-3, 2},         {"sdirk2", 25e-3, 2},
	{"backward_euler", 1e-3, 0.8}, {"backward_euler", 5e-3, 2}, {"backward_euler", 25e-3, 2},
};
enum { STEPPINGS = sizeof steppings / sizeof *steppings };
static const char* const predictions[] = {"carried", "free"};

/// A material, by the speed at which it comes to rest.
typedef struct Stiffness {
	double young, beta; ///< [Pa], [s]
} Stiffness;

static const Stiffness stiff = {1e7, 5e-3}, soft = {1e6, 2e-3};

static void open_slope(Run* run, int i, const char* prediction, double mu, const Stiffness* material) {
	run_open(run, 1,
			 "duration: 10 s\ngravity: [4.38716537, -8.77433074, 0]\nintegrator: {method: %s}\nstep: {dt: %.17g s}\n"
			 "bodies:\n"
			 "  - name: block\n"
			 "    shape: {type: box, size: [0.4, 0.2, 0.4], cells: [4, 2, 4]}\n"
			 "    material: {law: stable_neo_hookean, density: 1000, young: %g, poisson: 0.3}\n"
			 "    damping: {beta: %g s}\n    contact: {surface: rubber}\n"
			 "obstacles: [{name: slope, shape: plane, surface: wood}]\n"
			 "contact: {prediction: %s, pairs: [{first: wood, second: rubber, friction: %g}]}\n",
			 steppings[i].method, steppings[i].dt, material->young, material->beta, prediction, mu);
}

// The block drops onto its underside at first, and slides while it still swings. What comes after that is creep.
static void check_sticking(int i, const char* prediction, const Stiffness* material) {
	Run run;
	open_slope(&run, i, prediction, 0.51, material);
	run_until(&run, 0.5);
	const double settled = body_mean(&run, 0, run_state(&run)->x, 0);
	run_until(&run, steppings[i].duration);
	const double end = body_mean(&run, 0, run_state(&run)->x, 0), per_second = 1 / (steppings[i].duration - 0.5);
	print_message("%s, dt %g ms, %s: %g m in all, now %g m/s\n", steppings[i].method, 1e3 * steppings[i].dt, prediction,
				  end - 0.2, body_mean(&run, 0, run_state(&run)->v, 0));
	// A thousandth of its height in 2 s.
	expect_at_most(fabs(end - settled) * fmin(2 * per_second, 1.5), 1e-3 * height, "creep in 2 s [m]");
	run_close(&run);
}

static void a_block_sticks_while_mu_exceeds_the_slope(void** state) {
	(void)state;
	for (int i = 0; i < STEPPINGS; ++i)
		for (int p = 0; p < 2; ++p) check_sticking(i, predictions[p], &stiff);
}

// Soft and hardly damped, it swings for longer. Carried forces are late by a step and feed that in SDIRK2: there it slides
// by 27 mm at steps of 5 ms before it sticks, which is not asked for here.
static void a_soft_block_sticks_too(void** state) {
	(void)state;
	for (int i = 0; i < STEPPINGS; ++i) {
		if (steppings[i].dt < 2e-3) continue; // for time
		check_sticking(i, "free", &soft);
		check_sticking(i, "iterated", &soft);
	}
}

// Acceleration between 0.3 s and the end, and the balance of work over the same time.
static void check_sliding(int i, const char* prediction) {
	const double mu = 0.45, expected = g * (sine - mu * cosine);
	Run run;
	open_slope(&run, i, prediction, mu, &stiff);
	run_until(&run, 0.3);
	const double t = run_state(&run)->t, v = body_mean(&run, 0, run_state(&run)->v, 0);
	const double x = body_mean(&run, 0, run_state(&run)->x, 0), work = run_column(&run, "friction_work");
	double before = work, largest = 0;
	while (run_state(&run)->t < steppings[i].duration * (1 - 1e-9)) {
		run_step(&run);
		largest = fmax(largest, run_column(&run, "friction_work") - before);
		before = run_column(&run, "friction_work");
	}
	const double dv = body_mean(&run, 0, run_state(&run)->v, 0) - v;
	const double path = body_mean(&run, 0, run_state(&run)->x, 0) - x;
	const double taken = mu * density * volume * g * cosine * path; // mu N times the path
	expect_near(dv / (run_state(&run)->t - t), expected, 0.03 * expected, "%s, dt %g ms, %s: acceleration",
				steppings[i].method, 1e3 * steppings[i].dt, prediction);
	expect_near(run_column(&run, "friction_work") - work, -taken, 0.03 * taken, "  work of friction [J]");
	expect_at_most(largest, 1e-9 * taken, "  largest work of friction in a step [J]"); // of the solver's tolerance
	run_close(&run);
}

static void a_block_slides_as_coulomb_says(void** state) {
	(void)state;
	for (int i = 0; i < STEPPINGS; ++i)
		for (int p = 0; p < 2; ++p) check_sliding(i, predictions[p]);
}

// Three blocks on one slope, each with another surface: the pair decides, in either order of its names, and what no pair
// names has the friction of all.
static void pairs_of_surfaces_choose_the_friction(void** state) {
	(void)state;
	static const double mu[] = {0.2, 0.6, 0.35};
	static const char block[] = "material: {law: stable_neo_hookean, density: 1000, young: 1e6, poisson: 0.3}";
	Run run;
	run_open(&run, 1,
			 "duration: 10 s\ngravity: [4.38716537, -8.77433074, 0]\nintegrator: backward_euler\nstep: {dt: 10 ms}\n"
			 "bodies:\n"
			 "  - {name: a, shape: {type: box, size: [0.2, 0.1, 0.2], cells: [2, 1, 2]}, %s, contact: {surface: ice}}\n"
			 "  - {name: b, shape: {type: box, origin: [0, 0, 1], size: [0.2, 0.1, 0.2], cells: [2, 1, 2]}, %s,\n"
			 "     contact: {surface: rubber}}\n"
			 "  - {name: c, shape: {type: box, origin: [0, 0, 2], size: [0.2, 0.1, 0.2], cells: [2, 1, 2]}, %s}\n"
			 "obstacles: [{name: slope, shape: plane, surface: wood}]\n"
			 "contact: {friction: 0.35, pairs: [{first: wood, second: ice, friction: 0.2},\n"
			 "                                  {first: rubber, second: wood, friction: 0.6}]}\n",
			 block, block, block);
	run_until(&run, 0.2);
	double v[3];
	for (int b = 0; b < 3; ++b) v[b] = body_mean(&run, b, run_state(&run)->v, 0);
	run_until(&run, 0.6);
	for (int b = 0; b < 3; ++b) {
		const double expected = fmax(0, g * (sine - mu[b] * cosine));
		expect_near((body_mean(&run, b, run_state(&run)->v, 0) - v[b]) / 0.4, expected, 0.05, "block %d: acceleration",
					b);
	}
	run_close(&run);
}

// Forces of a sliding block lie on the cone, those of a sticking one within it, and none pulls.
static void forces_lie_in_the_cone(void** state) {
	(void)state;
	static const double mu[] = {0.45, 0.7};
	for (int i = 0; i < 2; ++i) {
		Run run;
		open_slope(&run, 1, "carried", mu[i], &stiff);
		for (int step = 0; step < 60; ++step) {
			run_step(&run);
			const double* f = run_field(&run, "contact_force");
			for (int k = 0; k < run.length; k += 3)
				if (f[k + 1] < 0 || hypot(f[k], f[k + 2]) > mu[i] * f[k + 1] * (1 + 1e-6) + 1e-6) // solver's tolerance
					fail_msg("step %d, node %d: force %g %g %g N", step, k / 3, f[k], f[k + 1], f[k + 2]);
		}
		double along = 0, down = 0;
		const double* f = run_field(&run, "contact_force");
		for (int k = 0; k < run.length; k += 3) along += f[k], down += f[k + 1];
		const double ratio = fmin(mu[i], 0.5); // what sticks needs tan of the slope
		expect_near(-along / down, ratio, 0.01, "mu %g: friction over normal force", mu[i]);
		run_close(&run);
	}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_block_sticks_while_mu_exceeds_the_slope),
		cmocka_unit_test(a_soft_block_sticks_too),
		cmocka_unit_test(a_block_slides_as_coulomb_says),
		cmocka_unit_test(pairs_of_surfaces_choose_the_friction),
		cmocka_unit_test(forces_lie_in_the_cone),
	};
	return cmocka_run_group_tests(tests, case_set_up, case_tear_down);
}
