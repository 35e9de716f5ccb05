/// @file exponential_test.c
/// The exponential Rosenbrock-Euler method: phi functions against series; exact where forces are linear; order 2 on Stable
/// Neo-Hookean hexahedra; energy of a swinging beam; what happens when the Krylov space is too small.
#include "support/model_case.h"

#include "integrate/exponential.h"
#include "integrate/properties.h"

// The largest frequency of the mesh at rest is 166 rad/s by power iteration, that is 0.16 rad a step at 64 steps.
enum { REFERENCE_STEPS = 1024, COARSEST = 64, LEVELS = 3, MOST_REALS = 512, MOST_ORDER = 12 };

static const double duration = 1.0 / 16;

// ---- phi functions ----

// phi_k(A) e_1 = sum_j A^j e_1 / (j + k)!, in extended precision.
static void series(int n, const double* A, int k, double* out) {
	long double term[MOST_ORDER] = {1}, next[MOST_ORDER], sum[MOST_ORDER] = {0};
	for (int i = 1; i <= k; ++i) term[0] /= i;
	for (int j = 1; j < 400; ++j) {
		for (int i = 0; i < n; ++i) {
			sum[i] += term[i];
			next[i] = 0;
			for (int l = 0; l < n; ++l) next[i] += (long double)A[i * n + l] * term[l] / (j + k);
		}
		memcpy(term, next, sizeof term);
	}
	for (int i = 0; i < n; ++i) out[i] = (double)sum[i];
}

static void check_phi(int n, double size, uint64_t seed) {
	double A[MOST_ORDER * MOST_ORDER], phi1[MOST_ORDER], phi2[MOST_ORDER], expected1[MOST_ORDER], expected2[MOST_ORDER];
	fill_random(&seed, size, n * n, A);
	jn_phi_columns(n, A, phi1, phi2);
	series(n, A, 1, expected1);
	series(n, A, 2, expected2);
	// 1e-12: a hundred times the rounding of matrices of norm 10, relative to the largest entry; series in 64 bits
	const double most1 = largest_size(expected1, n), most2 = largest_size(expected2, n);
	expect_near(largest_difference(phi1, expected1, n), 0, 1e-12 * most1, "phi1, n = %d, entries %g", n, size);
	expect_near(largest_difference(phi2, expected2, n), 0, 1e-12 * most2, "phi2, n = %d, entries %g", n, size);
}

static void phi_functions_are_their_series(void** state) {
	(void)state;
	const double sizes[] = {0, 1e-8, 1e-3, 0.1, 1, 2};
	for (int i = 0; i < 6; ++i)
		for (int n = 1; n <= MOST_ORDER; ++n) check_phi(n, sizes[i], (uint64_t)(100 * i + n));
}

static void phi_functions_of_a_rotation_are_sines(void** state) {
	(void)state;
	const double angles[] = {0.01, 1, 30, 500};
	for (int i = 0; i < 4; ++i) {
		const double w = angles[i], A[] = {0, w, -w, 0};
		double phi1[2], phi2[2];
		jn_phi_columns(2, A, phi1, phi2);
		// 1e-12: squaring multiplies rounding (1e-16) by the angle, at most 500; a factor 20 for the sums
		expect_near(phi1[0], sin(w) / w, 1e-12, "phi1[0] of %g", w);
		expect_near(phi1[1], -2 * sin(w / 2) * sin(w / 2) / w, 1e-12, "phi1[1] of %g", w);
		expect_near(phi2[0], 2 * sin(w / 2) * sin(w / 2) / (w * w), 1e-12, "phi2[0] of %g", w);
		// w - sin w loses digits in the expected value, not in phi2: 1e-16 / 0.01 at the smallest angle
		expect_near(phi2[1], -(w - sin(w)) / (w * w), 1e-12, "phi2[1] of %g", w);
	}
}

// ---- linear forces ----

// Two masses on springs k, 2k and 100k: modes of different frequencies; a load that grows with the time.
enum { MASSES = 2 };

static const double spring_stiffness[4] = {102, -100, -100, 101}, spring_mass[4] = {2, 0.5, 0.5, 1};

static int spring_force(void* user, double t, const double* x, const double* v, double* f) {
	const double* ramp = user;
	(void)v;
	for (int i = 0; i < MASSES; ++i)
		f[i] = (i + 1) * *ramp * t - spring_stiffness[2 * i] * x[0] - spring_stiffness[2 * i + 1] * x[1];
	return 0;
}

static int spring_tangent(void* user, double t, const double* x, const double* v, double* K, double* D) {
	(void)user, (void)t, (void)x, (void)v;
	memcpy(K, spring_stiffness, sizeof spring_stiffness);
	memset(D, 0, sizeof spring_stiffness);
	return 0;
}

// x(t) of the springs from (x, v) at 0 and the load t * load: modes of M^-1 K by the quadratic formula.
static void spring_solution(double t, const double x[2], const double v[2], double ramp, double out[2]) {
	const double *K = spring_stiffness, *M = spring_mass;
	const double a = M[0] * M[3] - M[1] * M[2], c = K[0] * K[3] - K[1] * K[2];
	const double b = -(K[0] * M[3] + K[3] * M[0] - 2 * K[1] * M[1]);
	out[0] = out[1] = 0;
	for (int sign = -1; sign <= 1; sign += 2) {
		const double square = (-b + sign * sqrt(b * b - 4 * a * c)) / (2 * a), w = sqrt(square);
		const double u[2] = {-(K[1] - square * M[1]), K[0] - square * M[0]};
		const double Mu[2] = {M[0] * u[0] + M[1] * u[1], M[2] * u[0] + M[3] * u[1]};
		const double size = u[0] * Mu[0] + u[1] * Mu[1];
		const double q = (Mu[0] * x[0] + Mu[1] * x[1]) / size, p = (Mu[0] * v[0] + Mu[1] * v[1]) / size;
		const double load = ramp * (u[0] + 2 * u[1]) / size;
		// q'' + w^2 q = load t
		const double there = q * cos(w * t) + (p - load / square) * sin(w * t) / w + load * t / square;
		for (int i = 0; i < MASSES; ++i) out[i] += there * u[i];
	}
}

static void check_springs(double ramp) {
	const JnUserSystemDef def = {.count = MASSES,
								 .user = &ramp,
								 .force = spring_force,
								 .tangent = spring_tangent,
								 .mass = spring_mass,
								 .depends_on_time = ramp != 0};
	const double x[MASSES] = {0.3, -0.2}, v[MASSES] = {1, 2};
	const JnNewtonDef newton = {.tolerance = 1e-10, .max_iterations = 60};
	double options[8], expected[MASSES];
	JnArena arena = {0};
	JnReport report = {0};
	JnSystem* sys = NULL;
	JnState start = {0}, end = {0};
	assert_int_equal(jn_keys_read(jn_exponential_rosenbrock.row.keys, NULL, "", &arena, options), JN_OK);
	assert_int_equal(jn_user_system_create(&def, &sys), JN_OK);
	JnIntegrator* integrator =
		jn_integrator_create(&(JnVariant){&jn_exponential_rosenbrock.row, options}, &newton, sys->space);
	assert_non_null(integrator);
	assert_int_equal(jn_state_create(sys->space, &start), JN_OK);
	assert_int_equal(jn_state_create(sys->space, &end), JN_OK);
	for (double dt = 0.01; dt < 20; dt *= 7) { // the highest frequency is 13 rad/s: up to 260 rad a step
		sys->report = &report;                 // a step leaves its own there
		memcpy(start.x, x, sizeof x);
		memcpy(start.v, v, sizeof v);
		jn_state_touch(sys->space, &start);
		assert_int_equal(sys->ops->begin(sys, &start), JN_OK);
		JnStep step = {.sys = sys, .start = &start, .end = &end, .dt = dt};
		assert_int_equal(integrator->type->step(integrator, &step), JN_OK);
		spring_solution(dt, x, v, ramp, expected);
		// 1e-8: rounding of the matrix exponential and of f_t by differences (1e-13 f / dt), both far below it
		expect_near(largest_difference(end.x, expected, MASSES), 0, 1e-8, "springs, ramp %g, dt %g", ramp, dt);
	}
	jn_state_destroy(sys->space, &start);
	jn_state_destroy(sys->space, &end);
	jn_integrator_destroy(integrator);
	jn_user_system_destroy(sys);
	jn_arena_free(&arena);
}

static void springs_are_exact_at_any_step(void** state) {
	(void)state;
	check_springs(0);
}

static void springs_under_a_load_that_grows_linearly_are_exact_at_any_step(void** state) {
	(void)state;
	check_springs(3);
}

static void oscillator_is_exact_at_any_frequency_and_damping(void** state) {
	(void)state;
	const double frequencies[] = {1e-3, 0.3, 3, 6.283185307179586, 30, 1e3}, damping[] = {0, 0.1, 0.9};
	for (int i = 0; i < 6; ++i)
		for (int j = 0; j < 3; ++j) {
			const double nu = frequencies[i], xi = damping[j], angle = nu * sqrt(1 - xi * xi);
			const JnAmplification found = jn_integrator_amplification(&jn_exponential_rosenbrock, nu, xi);
			// 3e-8: after a whole turn both eigenvalues are 1, and rounding parts them by its root, 1.5e-8
			expect_near(found.radius, exp(-xi * nu), 3e-8, "radius at nu = %g, xi = %g", nu, xi);
			if (xi * nu < 10) expect_near(cos(found.phase), cos(angle), 3e-8, "angle at nu = %g, xi = %g", nu, xi);
		}
}

typedef struct Solution {
	int length;
	double at[MOST_REALS]; // x, then duration * v
} Solution;

typedef void Prepare(ModelCase*);

static void bending(ModelCase* c) {
	case_box(c, JN_HEX8, "stable_neo_hookean");
	case_gravity(c, 1, -9.81, 0.5);
	c->sim.newton = (JnNewtonDef){.tolerance = 1e-12, .max_iterations = 60, .guess = 2};
}

static void bending_lumped(ModelCase* c) {
	bending(c);
	c->body.mass = 1;
}

static void driven(ModelCase* c) {
	bending(c);
	case_drive(c, FACE_Z_HIGH, 0.02, 8);
}

static void damped_by_rest(ModelCase* c) {
	bending(c);
	c->body.damping = (JnDampingDef){.alpha = 2, .beta = 2e-3, .stiffness = 1};
}

static void driven_and_damped(ModelCase* c) {
	damped_by_rest(c);
	case_drive(c, FACE_Z_HIGH, 0.02, 8);
}

static void damped_by_current(ModelCase* c) {
	bending(c);
	c->body.damping = (JnDampingDef){.alpha = 2, .beta = 2e-3, .stiffness = 2};
}

static void linear(ModelCase* c) {
	case_box(c, JN_HEX8, "linear");
	case_gravity(c, 1, -9.81, 0.5);
	c->sim.newton = (JnNewtonDef){.tolerance = 1e-14, .max_iterations = 60, .guess = 2};
	c->body.damping = (JnDampingDef){.alpha = 2, .beta = 2e-4, .stiffness = 1};
}

// A twist and a bend that grow from the clamped end: smooth in space, and large enough that nothing is linear.
static void set_in_motion(Rig* rig) {
	const double* rest = jn_model_rest(rig->model);
	for (int node = 0; node < rig->nodes; ++node) {
		const double *X = rest + 3 * (size_t)node, height = X[2] * X[2] / 0.16;
		double* v = rig->start.v + 3 * (size_t)node;
		v[0] = height * (0.8 - 6 * (X[1] - 0.1));
		v[1] = height * (0.5 + 6 * (X[0] - 0.1));
		v[2] = 0.4 * X[2];
	}
	rig_begin(rig);
}

static void simulate(Prepare* prepare, const JnRow* method, int steps, Solution* out) {
	ModelCase c;
	Rig rig;
	prepare(&c);
	case_method(&c, method);
	rig_create(&rig, &c, 1);
	set_in_motion(&rig);
	for (int i = 0; i < steps; ++i) rig_step(&rig, duration / steps);
	out->length = 2 * rig.length;
	assert_true(out->length <= MOST_REALS);
	for (int k = 0; k < rig.length; ++k) {
		out->at[k] = rig.start.x[k];
		out->at[rig.length + k] = duration * rig.start.v[k];
	}
	rig_destroy(&rig);
}

static void linear_law_is_exact_in_one_step(void** state) {
	(void)state;
	Solution one, many;
	simulate(linear, &jn_exponential_rosenbrock.row, 1, &one); // about 10 rad
	simulate(linear, row_named(&jn_integrator_list, "esdirk436"), 4096, &many);
	// 1e-8 m: tolerance 1e-10 of a change of about 0.1 m; esdirk436 at 0.003 rad a step is better than 1e-9
	expect_near(largest_difference(one.at, many.at, one.length), 0, 1e-8, "one step against 4096 of esdirk436");
}

// ---- order ----

// |scale * (a - reference) - (b - reference)|
static double difference(double scale, const Solution* a, const Solution* b, const Solution* reference) {
	double sum = 0;
	for (int k = 0; k < a->length; ++k) {
		const double whole = scale * (a->at[k] - reference->at[k]) - (b->at[k] - reference->at[k]);
		sum += whole * whole;
	}
	return sqrt(sum);
}

// The order of the leading term from three step sizes: see dirk_order_test.c.
static void check_order(Prepare* prepare, int order, const char* setting) {
	Solution reference, at[LEVELS];
	simulate(prepare, row_named(&jn_integrator_list, "esdirk436"), REFERENCE_STEPS, &reference);
	for (int level = 0; level < LEVELS; ++level)
		simulate(prepare, &jn_exponential_rosenbrock.row, COARSEST << level, &at[level]);
	const double scale = ldexp(1, order + 1);
	const double coarse = difference(scale, &at[1], &at[0], &reference);
	const double fine = difference(scale, &at[2], &at[1], &reference);
	print_message("%-20s measured %.3f\n", setting, log2(coarse / fine));
	// 0.1: terms of order 4 and above at 0.16 rad a step
	expect_near(log2(coarse / fine), order, 0.1, "%s: order", setting);
}

static void order_is_two_in_bending(void** state) {
	(void)state;
	check_order(bending, 2, "bending");
}

static void order_is_two_with_lumped_mass(void** state) {
	(void)state;
	check_order(bending_lumped, 2, "lumped");
}

static void order_is_two_with_a_driven_end(void** state) {
	(void)state;
	check_order(driven, 2, "driven");
}

static void order_is_two_with_damping_by_the_rest_stiffness(void** state) {
	(void)state;
	check_order(damped_by_rest, 2, "damped by rest");
}

static void order_is_two_with_a_driven_end_and_damping(void** state) {
	(void)state;
	check_order(driven_and_damped, 2, "driven and damped");
}

// J lacks the derivative of D by x.
static void damping_that_follows_the_state_leaves_order_one(void** state) {
	(void)state;
	check_order(damped_by_current, 1, "damped by current");
}

// ---- steps ----

static double total_energy(const Rig* rig) {
	const JnEnergies energies = jn_model_energies(rig->model, &rig->start);
	return energies.kinetic + energies.elastic + energies.gravity;
}

// The largest change of energy in 0.5 s of swinging from rest, in steps of 5 ms.
static double energy_error(Prepare* prepare, const JnRow* method) {
	ModelCase c;
	Rig rig;
	prepare(&c);
	case_method(&c, method);
	rig_create(&rig, &c, 1);
	const double first = total_energy(&rig);
	double most = 0;
	for (int i = 0; i < 100; ++i) {
		rig_step(&rig, 0.005);
		most = fmax(most, fabs(total_energy(&rig) - first));
	}
	rig_destroy(&rig);
	return most;
}

static void energy_error_is_a_small_part_of_backward_eulers(void** state) {
	(void)state;
	Prepare* const cases[] = {bending, bending_lumped};
	for (int i = 0; i < 2; ++i) {
		const double euler = energy_error(cases[i], row_named(&jn_integrator_list, "backward_euler"));
		const double here = energy_error(cases[i], &jn_exponential_rosenbrock.row);
		print_message("mass %d: energy error %.3e J, backward Euler %.3e J\n", i, here, euler);
		// a fifth: order 2 against order 1 at a few steps a radian of the modes that move
		expect_near(here, 0, euler / 5, "mass %d: energy error", i);
	}
}

// As in rosenbrock_step_test.c: 100 steps of 0.1 rad of a free spinning box with frequencies from 80 to 3000 rad/s.
static void stiff_spinning_body_stays_bounded_and_is_damped(void** state) {
	(void)state;
	ModelCase c;
	Rig rig;
	case_box(&c, JN_HEX8, "stable_neo_hookean");
	c.material.young = 1e6;
	c.body.fix.count = 0;
	case_method(&c, &jn_exponential_rosenbrock.row);
	rig_create(&rig, &c, 1);
	const double* rest = jn_model_rest(rig.model);
	for (int node = 0; node < rig.nodes; ++node) {
		const double* X = rest + 3 * (size_t)node;
		rig.start.v[3 * node + 1] = -10 * (X[2] - 0.2);
		rig.start.v[3 * node + 2] = 10 * (X[1] - 0.1);
	}
	rig_begin(&rig);
	const double first = total_energy(&rig);
	double growth = 1;
	for (int i = 0; i < 100; ++i) {
		rig_step(&rig, 0.01);
		growth = fmax(growth, total_energy(&rig) / first);
	}
	const double left = total_energy(&rig) / first;
	print_message("stiff spinning body: energy %.4f of the first, at most %.4f\n", left, growth);
	assert_true(growth < 2); // as in rosenbrock_step_test.c: methods that fail grow by factors above ten
	assert_true(left < 0.9); // the row's text says that it damps
	rig_destroy(&rig);
}

static void resting_body_stays_without_a_subspace(void** state) {
	(void)state;
	ModelCase c;
	Rig rig;
	bending(&c);
	case_gravity(&c, 0, 0, 0);
	case_method(&c, &jn_exponential_rosenbrock.row);
	rig_create(&rig, &c, 1);
	rig_step(&rig, 0.1);
	assert_true(rig.report.solves <= 2); // M^-1 f and the scale
	// rounding of positions of 0.4 m alone
	expect_near(largest_difference(rig.start.x, jn_model_rest(rig.model), rig.length), 0, 1e-15, "motion at rest");
	rig_destroy(&rig);
}

static void step_is_pure(void** state) {
	(void)state;
	ModelCase c;
	Rig rig;
	double first[MOST_REALS];
	driven_and_damped(&c);
	case_method(&c, &jn_exponential_rosenbrock.row);
	rig_create(&rig, &c, 1);
	set_in_motion(&rig);
	assert_int_equal(rig_attempt(&rig, 2e-3), JN_OK);
	memcpy(first, rig.end.x, (size_t)rig.length * sizeof *first);
	assert_int_equal(rig_attempt(&rig, 4e-3), JN_OK);
	assert_int_equal(rig_attempt(&rig, 2e-3), JN_OK);
	assert_memory_equal(first, rig.end.x, (size_t)rig.length * sizeof *first);
	rig_destroy(&rig);
}

static void mass_is_factored_once_a_run(void** state) {
	(void)state;
	ModelCase c;
	Rig rig;
	int factorizations = 0;
	damped_by_rest(&c);
	case_method(&c, &jn_exponential_rosenbrock.row);
	rig_create(&rig, &c, 1);
	set_in_motion(&rig);
	for (int i = 0; i < 5; ++i) {
		rig_step(&rig, 2e-3);
		factorizations += rig.report.factorizations;
	}
	assert_int_equal(factorizations, 1);
	rig_destroy(&rig);
}

static void subspace_too_small_is_an_outcome_of_the_step(void** state) {
	(void)state;
	ModelCase c;
	Rig rig;
	bending(&c);
	case_method(&c, &jn_exponential_rosenbrock.row);
	*(int*)option(&jn_exponential_rosenbrock.row, c.method, "subspace") = 12;
	rig_create(&rig, &c, 1);
	set_in_motion(&rig);
	assert_int_equal(rig_attempt(&rig, 0.05), JN_NOT_CONVERGED);
	assert_int_equal(rig_attempt(&rig, 0.001), JN_OK);
	rig_destroy(&rig);
}

static void simulation_cuts_steps_until_the_subspace_suffices(void** state) {
	(void)state;
	ModelCase c;
	JnSim* sim = NULL;
	bending(&c);
	case_method(&c, &jn_exponential_rosenbrock.row);
	*(int*)option(&jn_exponential_rosenbrock.row, c.method, "subspace") = 12;
	*(double*)option(c.sim.step.row, c.control, "dt") = 0.05;
	c.sim.duration = 0.1;
	assert_int_equal(jn_sim_create(&c.sim, 1, &sim), JN_OK);
	while (!jn_sim_is_done(sim)) assert_int_equal(jn_sim_step(sim), JN_OK);
	assert_true(jn_sim_steps(sim) > 2);
	expect_near(jn_sim_state(sim)->t, 0.1, 1e-12, "end of the run"); // rounding of a sum of steps
	jn_sim_destroy(sim);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(phi_functions_are_their_series),
		cmocka_unit_test(phi_functions_of_a_rotation_are_sines),
		cmocka_unit_test(springs_are_exact_at_any_step),
		cmocka_unit_test(springs_under_a_load_that_grows_linearly_are_exact_at_any_step),
		cmocka_unit_test(oscillator_is_exact_at_any_frequency_and_damping),
		cmocka_unit_test(linear_law_is_exact_in_one_step),
		cmocka_unit_test(order_is_two_in_bending),
		cmocka_unit_test(order_is_two_with_lumped_mass),
		cmocka_unit_test(order_is_two_with_a_driven_end),
		cmocka_unit_test(order_is_two_with_damping_by_the_rest_stiffness),
		cmocka_unit_test(order_is_two_with_a_driven_end_and_damping),
		cmocka_unit_test(damping_that_follows_the_state_leaves_order_one),
		cmocka_unit_test(energy_error_is_a_small_part_of_backward_eulers),
		cmocka_unit_test(stiff_spinning_body_stays_bounded_and_is_damped),
		cmocka_unit_test(resting_body_stays_without_a_subspace),
		cmocka_unit_test(step_is_pure),
		cmocka_unit_test(mass_is_factored_once_a_run),
		cmocka_unit_test(subspace_too_small_is_an_outcome_of_the_step),
		cmocka_unit_test(simulation_cuts_steps_until_the_subspace_suffices),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
