/// @file user_system_test.c
/// Systems of the user's own: what is refused and how, what becomes of callbacks that fail, and tangents in three
/// ways.
#include "support/model_case.h"
#include "support/support.h"

// ---- refusals

static int pull(void* user, double t, const double* x, const double* v, double* f) {
	(void)user, (void)t, (void)v;
	f[0] = -x[0];
	return 0;
}

static void a_system_needs_a_sensible_number_of_unknowns(void** state) {
	(void)state;
	const int counts[] = {0, -1, JN_USER_SYSTEM_LIMIT + 1};
	for (int i = 0; i < 3; ++i) {
		JnSystem* sys = (JnSystem*)1;
		log_capture();
		assert_int_equal(jn_user_system_create(&(JnUserSystemDef){.count = counts[i], .force = pull}, &sys),
						 JN_BAD_INPUT);
		assert_null(sys);
		char number[16];
		snprintf(number, sizeof number, " %d ", counts[i]);
		log_expect(number);
		log_expect("2000");
	}
}

static void a_system_needs_a_force(void** state) {
	(void)state;
	JnSystem* sys = NULL;
	assert_int_equal(jn_user_system_create(&(JnUserSystemDef){.count = 1}, &sys), JN_BAD_INPUT);
	assert_null(sys);
	log_expect("force");
}

static void a_mass_must_be_finite(void** state) {
	(void)state;
	JnSystem* sys = NULL;
	const double mass[4] = {1, 0, NAN, 1};
	assert_int_equal(jn_user_system_create(&(JnUserSystemDef){.count = 2, .force = pull, .mass = mass}, &sys),
					 JN_BAD_INPUT);
	assert_null(sys);
	log_expect("mass[1][0]");
}

// jn_sim_create_for on the oscillator x'' = -x.
static JnStatus create_sim(const char* settings, double x, double v) {
	JnSystem* sys = NULL;
	JnSim* sim = NULL;
	assert_int_equal(jn_user_system_create(&(JnUserSystemDef){.count = 1, .force = pull}, &sys), JN_OK);
	const JnStatus status = jn_sim_create_for(sys, settings, &x, &v, &sim);
	if (status == JN_OK)
		assert_non_null(sim);
	else
		assert_null(sim);
	jn_sim_destroy(sim);
	jn_user_system_destroy(sys);
	return status;
}

static void a_start_must_be_finite(void** state) {
	(void)state;
	const double starts[][2] = {{NAN, 0}, {0, NAN}, {INFINITY, 0}};
	for (int i = 0; i < 3; ++i) {
		log_capture();
		assert_int_equal(create_sim("{duration: 1 s, step: {dt: 0.1 s}}", starts[i][0], starts[i][1]), JN_BAD_INPUT);
		log_expect("not finite");
	}
	assert_int_equal(create_sim("{duration: 1 s, step: {dt: 0.1 s}}", 1, 0), JN_OK);
}

static void settings_that_cannot_be_right_are_refused_with_their_place(void** state) {
	(void)state;
	const struct {
		const char *text, *place, *part;
	} wrong[] = {
		{"{duration: 1 s, step: {dt: -1 s}}", "settings:1:", "step.dt"},
		{"duration: 1 s\nstep:\n  dt: 1 kg\n", "settings:3:3", "step.dt"},
		{"duration: 1 s\nstepp: {dt: 1 ms}\n", "settings:2:1", "stepp"},
		{"duration: 1 s\nstep: {dt: 1 ms}\nintegrator: {method: sdirk22}\n", "settings:3:", "sdirk2"},
		{"duration: 1 s\nstep: {dt: 1 ms\n", "settings:", ""},
		{"{step: {dt: 1 ms}}", "settings:1:", "duration"},
	};
	for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
		log_capture();
		assert_int_equal(create_sim(wrong[i].text, 1, 0), JN_BAD_INPUT);
		log_expect(wrong[i].place);
		log_expect(wrong[i].part);
	}
}

static int coupled(void* user, double t, const double* x, const double* v, double* f) {
	(void)user, (void)t, (void)v;
	f[0] = -x[0];
	f[1] = -4 * x[1];
	return 0;
}

static void explicit_methods_refuse_a_mass_that_is_not_diagonal(void** state) {
	(void)state;
	const double full[4] = {2, 0.5, 0.5, 1}, diagonal[4] = {2, 0, 0, 1}, x[2] = {1, 1}, v[2] = {0, 0};
	for (int i = 0; i < jn_integrator_list.count; ++i) {
		const JnIntegratorType* type = (const JnIntegratorType*)jn_integrator_list.rows[i];
		const bool is_explicit = (type->needs & JN_NEEDS_DIAGONAL_MASS) != 0;
		char settings[128];
		snprintf(settings, sizeof settings, "{duration: 1 s, step: {dt: 1 ms}, integrator: {method: %s}}",
				 type->row.name);
		for (int is_full = 0; is_full < 2; ++is_full) {
			const JnUserSystemDef def = {.count = 2, .force = coupled, .mass = is_full ? full : diagonal};
			JnSystem* sys = NULL;
			JnSim* sim = NULL;
			log_capture();
			assert_int_equal(jn_user_system_create(&def, &sys), JN_OK);
			const JnStatus status = jn_sim_create_for(sys, settings, x, v, &sim);
			assert_int_equal(status, is_full && is_explicit ? JN_BAD_INPUT : JN_OK);
			if (status != JN_OK) log_expect(type->row.name);
			if (status != JN_OK) log_expect("diagonal");
			if (status == JN_OK) assert_int_equal(jn_sim_step(sim), JN_OK);
			jn_sim_destroy(sim);
			jn_user_system_destroy(sys);
		}
	}
}

// ---- callbacks that fail

typedef struct Fault {
	double from;  // the callback fails after this time [s]
	bool says_so; // by its return value; else by NAN
} Fault;

static int faulty(void* user, double t, const double* x, const double* v, double* f) {
	const Fault* fault = user;
	(void)v;
	const bool fails = t > fault->from;
	f[0] = fails && !fault->says_so ? NAN : -x[0];
	return fails && fault->says_so ? 1 : 0;
}

// Steps of 1/8 s, halved twice at most, until the force fails for good. The state is then that of the last step,
// bit for bit.
static void run_into(Fault fault, const char* method) {
	JnSystem* sys = NULL;
	JnSim* sim = NULL;
	const double x = 1, v = 0;
	char settings[128], place[64];
	const JnUserSystemDef def = {.count = 1, .user = &fault, .force = faulty, .depends_on_time = true};
	snprintf(settings, sizeof settings, "{duration: 2 s, step: {dt: 0.125 s, cuts: 2}, integrator: {method: %s}}",
			 method);
	log_capture();
	assert_int_equal(jn_user_system_create(&def, &sys), JN_OK);
	assert_int_equal(jn_sim_create_for(sys, settings, &x, &v, &sim), JN_OK);
	JnStatus status = JN_OK;
	double good[3] = {0};
	while (status == JN_OK && !jn_sim_is_done(sim)) {
		const JnState* s = jn_sim_state(sim);
		memcpy(good, (double[3]){s->t, s->x[0], s->v[0]}, sizeof good);
		status = jn_sim_step(sim);
	}
	assert_int_equal(status, JN_RUN_FAILED);
	const JnState* s = jn_sim_state(sim);
	assert_memory_equal(good, ((double[3]){s->t, s->x[0], s->v[0]}), sizeof good);
	assert_true(s->t <= fault.from && s->t > fault.from - 0.125);
	assert_int_equal(jn_sim_last_report(sim)->rejected >= 1, true); // it tried smaller steps
	snprintf(place, sizeof place, "step %ld at t = %.9g s failed", jn_sim_steps(sim) + 1, s->t);
	log_expect(place);
	log_expect("not finite");
	jn_sim_destroy(sim);
	jn_user_system_destroy(sys);
}

static void a_force_that_fails_ends_the_run_with_the_last_good_state(void** state) {
	(void)state;
	const char* const methods[] = {"backward_euler", "sdirk2", "tr_bdf2", "ros2", "newmark", "verlet", "rk4"};
	for (size_t i = 0; i < sizeof methods / sizeof *methods; ++i)
		for (int says_so = 0; says_so < 2; ++says_so) run_into((Fault){1.03, says_so}, methods[i]);
}

static void a_force_that_fails_at_the_start_makes_no_simulation(void** state) {
	(void)state;
	Fault fault = {-1, false};
	JnSystem* sys = NULL;
	JnSim* sim = NULL;
	const double x = 1, v = 0;
	assert_int_equal(jn_user_system_create(&(JnUserSystemDef){.count = 1, .user = &fault, .force = faulty}, &sys),
					 JN_OK);
	assert_true(jn_sim_create_for(sys, "{duration: 1 s, step: {dt: 0.1 s}}", &x, &v, &sim) != JN_OK);
	assert_null(sim);
	jn_user_system_destroy(sys);
}

// ---- tangents

// Three coordinates with forces that no symmetric K or D gives.
static int twisted(void* user, double t, const double* x, const double* v, double* f) {
	(void)user;
	f[0] = -4 * sin(x[0]) + x[1] * x[2] - 0.3 * v[0] * v[0] * v[0] + cos(t);
	f[1] = -2 * x[1] - 3 * x[0] + 0.5 * v[2];
	f[2] = -x[2] * x[2] * x[2] + x[0] - 0.2 * v[2] - 0.1 * v[0] * x[1];
	return 0;
}

static int twisted_tangent(void* user, double t, const double* x, const double* v, double* stiffness, double* damping) {
	(void)user, (void)t;
	const double k[9] = {4 * cos(x[0]), -x[2], -x[1], 3, 2, 0, -1, 0.1 * v[0], 3 * x[2] * x[2]};
	const double d[9] = {0.9 * v[0] * v[0], 0, 0, 0, 0, -0.5, 0.1 * x[1], 0, 0.2};
	memcpy(stiffness, k, sizeof k);
	memcpy(damping, d, sizeof d);
	return 0;
}

static int twisted_product(void* user, double t, const double* x, const double* v, const double* p, double* stiffness_p,
						   double* damping_p) {
	double k[9], d[9];
	twisted_tangent(user, t, x, v, k, d);
	for (int i = 0; i < 3; ++i) {
		stiffness_p[i] = damping_p[i] = 0;
		for (int j = 0; j < 3; ++j) {
			stiffness_p[i] += k[3 * i + j] * p[j];
			damping_p[i] += d[3 * i + j] * p[j];
		}
	}
	return 0;
}

// Columns of m M + d D + k K at a state, by the system's own product.
static void matrix_of(const JnUserSystemDef* def, JnShift shift, double out[9]) {
	JnSystem* sys = NULL;
	JnMatrix* matrix = NULL;
	JnReport report = {0};
	double x[3] = {0.4, -0.7, 0.9}, v[3] = {1.1, 0.3, -0.5};
	assert_int_equal(jn_user_system_create(def, &sys), JN_OK);
	sys->report = &report;
	const JnState s = {.t = 0.25, .x = x, .v = v, .stamp = 1};
	assert_int_equal(sys->ops->begin(sys, &s), JN_OK);
	assert_int_equal(sys->ops->linearize(sys, &s), JN_OK);
	assert_int_equal(sys->ops->matrix(sys, shift, &matrix), JN_OK);
	for (int j = 0; j < 3; ++j) {
		double unit[3] = {0, 0, 0}, column[3], back[3];
		unit[j] = 1;
		matrix->ops->apply(matrix, unit, column);
		for (int i = 0; i < 3; ++i) out[3 * i + j] = column[i];
		assert_int_equal(matrix->ops->solve(matrix, column, back), JN_OK);
		expect_near(largest_difference(back, unit, 3), 0, 1e-13, "solve after apply"); // rounding
	}
	jn_user_system_destroy(sys);
}

static void tangents_from_callback_products_and_differences_agree(void** state) {
	(void)state;
	const JnUserSystemDef by_callback = {.count = 3, .force = twisted, .tangent = twisted_tangent};
	const JnUserSystemDef by_products = {.count = 3, .force = twisted, .tangent_product = twisted_product};
	const JnUserSystemDef by_differences = {.count = 3, .force = twisted};
	const JnShift shifts[] = {{.stiffness = 1}, {1, 0.5, 0.25}};
	for (int i = 0; i < 2; ++i) {
		double exact[9], products[9], differences[9];
		matrix_of(&by_callback, shifts[i], exact);
		matrix_of(&by_products, shifts[i], products);
		matrix_of(&by_differences, shifts[i], differences);
		assert_true(fabs(exact[1] - exact[3]) > 0.1);                              // not symmetric
		expect_near(largest_difference(products, exact, 9), 0, 1e-15, "products"); // rounding
		// central differences with steps of 6e-6: truncation 4e-11 of third derivatives, rounding 1e-16 / 6e-6
		expect_near(largest_difference(differences, exact, 9), 0, 1e-8, "differences");
	}
}

static int van_der_pol(void* user, double t, const double* x, const double* v, double* f) {
	(void)user, (void)t;
	f[0] = 5 * (1 - x[0] * x[0]) * v[0] - x[0];
	f[1] = x[0] - x[1] - 0.5 * v[1]; // driven by the first, and no force back: K is not symmetric
	return 0;
}

// The limit cycle with mu = 5 has the amplitude 2.02151 and the period 11.61223: RK4 with steps of 0.2 ms, written
// apart.
static void a_tangent_that_is_not_symmetric_finds_the_van_der_pol_cycle(void** state) {
	(void)state;
	JnSystem* sys = NULL;
	JnSim* sim = NULL;
	const double x[2] = {2, 0}, v[2] = {0, 0};
	const char* settings = "{duration: 40 s, step: {dt: 5 ms}, integrator: {method: esdirk436}}";
	assert_int_equal(jn_user_system_create(&(JnUserSystemDef){.count = 2, .force = van_der_pol}, &sys), JN_OK);
	assert_int_equal(jn_sim_create_for(sys, settings, x, v, &sim), JN_OK);
	double most = 0, crossings[2] = {0, 0};
	while (!jn_sim_is_done(sim)) {
		const double t = jn_sim_state(sim)->t, before = jn_sim_state(sim)->x[0];
		assert_int_equal(jn_sim_step(sim), JN_OK);
		const double after = jn_sim_state(sim)->x[0];
		if (jn_sim_state(sim)->t > 15) most = fmax(most, after);
		if (!(before < 0 && after >= 0)) continue;
		crossings[0] = crossings[1];
		crossings[1] = t + 5e-3 * before / (before - after);
	}
	expect_near(most, 2.02151, 1e-4, "amplitude");                      // the peak lies between two steps
	expect_near(crossings[1] - crossings[0], 11.61223, 1e-3, "period"); // crossings by linear interpolation
	jn_sim_destroy(sim);
	jn_user_system_destroy(sys);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_system_needs_a_sensible_number_of_unknowns),
		cmocka_unit_test(a_system_needs_a_force),
		cmocka_unit_test(a_mass_must_be_finite),
		cmocka_unit_test(a_start_must_be_finite),
		cmocka_unit_test(settings_that_cannot_be_right_are_refused_with_their_place),
		cmocka_unit_test(explicit_methods_refuse_a_mass_that_is_not_diagonal),
		cmocka_unit_test(a_force_that_fails_ends_the_run_with_the_last_good_state),
		cmocka_unit_test(a_force_that_fails_at_the_start_makes_no_simulation),
		cmocka_unit_test(tangents_from_callback_products_and_differences_agree),
		cmocka_unit_test(a_tangent_that_is_not_symmetric_finds_the_van_der_pol_cycle),
	};
	return cmocka_run_group_tests(tests, log_set_up, log_tear_down);
}
