/// @file stable_test.c
/// The largest frequency of chains and boxes, and steps at the limit that follows from it.
#include "control/stable.h"
#include "support/model_case.h"

enum { LINKS = 12 };

typedef struct Chain {
	double stiffness, damping;
} Chain;

// Equal masses and springs in a row, both ends tied to walls.
static int chain_force(void* user, double t, const double* x, const double* v, double* f) {
	const Chain* chain = user;
	(void)t;
	for (int i = 0; i < LINKS; ++i) {
		const double left = i > 0 ? x[i - 1] : 0, right = i + 1 < LINKS ? x[i + 1] : 0;
		const double left_v = i > 0 ? v[i - 1] : 0, right_v = i + 1 < LINKS ? v[i + 1] : 0;
		f[i] = chain->stiffness * (left - 2 * x[i] + right) + chain->damping * (left_v - 2 * v[i] + right_v);
	}
	return 0;
}

static const double mass_of_link = 0.25;

static JnSystem* new_chain(Chain* chain) {
	double mass[LINKS * LINKS] = {0};
	for (int i = 0; i < LINKS; ++i) mass[i * (LINKS + 1)] = mass_of_link;
	const JnUserSystemDef def = {.count = LINKS, .user = chain, .force = chain_force, .mass = mass};
	JnSystem* sys = NULL;
	assert_int_equal(jn_user_system_create(&def, &sys), JN_OK);
	return sys;
}

// omega_max = 2 sqrt(k / m) cos(pi / (2 (n + 1)))
static double largest_of_chain(const Chain* chain) {
	return 2 * sqrt(chain->stiffness / mass_of_link) * cos(3.14159265358979323846 / (2 * (LINKS + 1)));
}

static void the_frequency_of_a_chain_is_found(void** state) {
	(void)state;
	Chain chain = {.stiffness = 400, .damping = 0.5};
	JnSystem* sys = new_chain(&chain);
	JnState s;
	JnReport report = {0};
	double omega, xi, p[LINKS] = {0}, work[2][LINKS];
	sys->report = &report;
	assert_int_equal(jn_state_create(sys->space, &s), JN_OK);
	jn_state_touch(sys->space, &s);
	for (int i = 0; i < 20; ++i) // each call goes on where the one before ended
		assert_int_equal(jn_largest_frequency(sys, &s, 100, p, (JnVec[]){work[0], work[1]}, &omega, &xi), JN_OK);
	const double expected = largest_of_chain(&chain);
	// from below, and ended when omega^2 settles to 1e-4 a product
	assert_true(omega <= expected * (1 + 1e-6));
	expect_near(omega / expected, 1, 5e-3, "largest frequency");
	expect_near(xi, 0.5 * chain.damping / chain.stiffness * omega, 1e-4, "damping ratio of stiffness damping");
	jn_state_destroy(sys->space, &s);
	jn_user_system_destroy(sys);
}

static double size_after(const char* settings, double safety, bool* is_stable) {
	Chain chain = {.stiffness = 400};
	JnSystem* sys = new_chain(&chain);
	JnSim* sim = NULL;
	double x[LINKS] = {0}, v[LINKS] = {0};
	char text[256];
	for (int i = 0; i < LINKS; ++i) x[i] = 0.01 * cos(2.5 * i); // the highest mode is in it
	snprintf(text, sizeof text, "{duration: 100 s, %s, step: {controller: stable, dt: 1e-4, safety: %g}}", settings,
			 safety);
	assert_int_equal(jn_sim_create_for(sys, text, x, v, &sim), JN_OK);
	for (int i = 0; i < 2000; ++i) assert_int_equal(jn_sim_step(sim), JN_OK);
	*is_stable = largest_size(jn_sim_state(sim)->x, LINKS) < 0.1;
	const double dt = jn_sim_last_dt(sim);
	jn_sim_destroy(sim);
	jn_user_system_destroy(sys);
	return dt * largest_of_chain(&chain);
}

static void steps_are_a_share_of_the_limit(void** state) {
	(void)state;
	static const struct {
		const char* settings;
		double limit; // omega dt
	} methods[] = {{"integrator: {method: verlet}", 2}, {"integrator: {method: rk4}", 2.8284271247461903}};
	for (int m = 0; m < 2; ++m) {
		bool is_stable;
		const double size = size_after(methods[m].settings, 0.9, &is_stable);
		assert_true(is_stable);
		expect_near(size / methods[m].limit, 0.9, 0.01, "%s: omega dt over the limit", methods[m].settings);
	}
}

// The first size is anybody's guess: beyond the limit it is thrown away, however far.
static void a_first_step_beyond_the_limit_is_refused(void** state) {
	(void)state;
	Chain chain = {.stiffness = 400};
	JnSystem* sys = new_chain(&chain);
	JnSim* sim = NULL;
	double x[LINKS] = {0.01}, v[LINKS] = {0};
	const char* settings =
		"{duration: 1e4 s, integrator: {method: verlet}, step: {controller: stable, dt: 10 s, safety: 0.8}}";
	assert_int_equal(jn_sim_create_for(sys, settings, x, v, &sim), JN_OK);
	assert_int_equal(jn_sim_step(sim), JN_OK);
	const double share = jn_sim_last_dt(sim) * largest_of_chain(&chain);
	print_message("first step: omega dt = %g, refused %d\n", share, jn_sim_last_report(sim)->rejected);
	assert_true(jn_sim_last_report(sim)->rejected > 0);
	assert_true(share < 2); // the limit of Verlet's method
	jn_sim_destroy(sim);
	jn_user_system_destroy(sys);
}

// Free masses have no frequency: the step is as large as it may be.
static void without_stiffness_the_step_grows_to_its_bound(void** state) {
	(void)state;
	Chain chain = {0};
	JnSystem* sys = new_chain(&chain);
	JnSim* sim = NULL;
	double x[LINKS] = {0}, v[LINKS] = {1};
	const char* settings = "{duration: 100 s, integrator: {method: verlet}, step: {controller: stable, dt: 1 ms, "
						   "dt_max: 0.25 s}}";
	assert_int_equal(jn_sim_create_for(sys, settings, x, v, &sim), JN_OK);
	while (!jn_sim_is_done(sim)) assert_int_equal(jn_sim_step(sim), JN_OK);
	expect_near(jn_sim_next_dt(sim), 0.25, 0, "size of a step");
	expect_near(jn_sim_state(sim)->x[0], 100, 1e-10, "distance"); // of 400 sums
	jn_sim_destroy(sim);
	jn_user_system_destroy(sys);
}

static void methods_without_a_limit_are_refused(void** state) {
	(void)state;
	static const char* const methods[] = {"backward_euler", "newmark", "explicit_euler"};
	for (int m = 0; m < 3; ++m) {
		Chain chain = {.stiffness = 400};
		JnSystem* sys = new_chain(&chain);
		JnSim* sim = NULL;
		const double zero[LINKS] = {0};
		char text[128];
		snprintf(text, sizeof text, "{duration: 1 s, integrator: {method: %s}, step: {controller: stable}}",
				 methods[m]);
		assert_int_equal(jn_sim_create_for(sys, text, zero, zero, &sim), JN_BAD_INPUT);
		jn_user_system_destroy(sys);
	}
}

// A solid too: the limit by halving and doubling fixed steps of verlet.
static void the_limit_of_a_box_is_that_of_fixed_steps(void** state) {
	(void)state;
	ModelCase c;
	Rig rig;
	case_box(&c, JN_HEX8, "linear");
	c.body.mass = 1;
	case_method(&c, row_named(&jn_integrator_list, "verlet"));
	rig_create(&rig, &c, 1);
	double omega = 0, xi;
	JnVec p = rig.space->ops->create(rig.space);
	JnVec work[2] = {rig.space->ops->create(rig.space), rig.space->ops->create(rig.space)};
	for (int i = 0; i < 30; ++i)
		assert_int_equal(jn_largest_frequency(rig.sys, &rig.start, 100, p, work, &omega, &xi), JN_OK);
	for (int side = 0; side < 2; ++side) {
		const double dt = (side == 0 ? 0.98 : 1.02) * 2 / omega;
		rig_shake(&rig, 5, 1e-5, 0);
		for (int i = 0; i < 1000 && largest_size(rig.start.v, rig.length) < 1e3; ++i) rig_step(&rig, dt);
		const bool is_stable = largest_size(rig.start.v, rig.length) < 1;
		assert_int_equal(is_stable, side == 0);
	}
	rig.space->ops->destroy(rig.space, p);
	for (int i = 0; i < 2; ++i) rig.space->ops->destroy(rig.space, work[i]);
	rig_destroy(&rig);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(the_frequency_of_a_chain_is_found),
		cmocka_unit_test(steps_are_a_share_of_the_limit),
		cmocka_unit_test(a_first_step_beyond_the_limit_is_refused),
		cmocka_unit_test(without_stiffness_the_step_grows_to_its_bound),
		cmocka_unit_test(methods_without_a_limit_are_refused),
		cmocka_unit_test(the_limit_of_a_box_is_that_of_fixed_steps),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
