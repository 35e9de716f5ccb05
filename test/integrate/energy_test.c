/// @file energy_test.c
/// What average_vector_field promises about energy, what a spinning stiff bar loses, and the relations among the
/// methods of structural dynamics: which equal which, and which order is left with steps that vary.
#include "support/model_case.h"

// A beam of 2 x 2 x 4 cells, clamped below and bent by its first velocities; Newton to the end of its digits.
static void beam_case(ModelCase* c, const char* law, const char* method) {
	case_box(c, JN_HEX8, law);
	case_method(c, row_named(&jn_integrator_list, method));
	c->sim.newton = (JnNewtonDef){.tolerance = 1e-13, .max_iterations = 60};
}

static void set_real(ModelCase* c, const char* key, double value) {
	*(double*)option(c->sim.integrator.row, c->method, key) = value;
}

static void set_integer(ModelCase* c, const char* key, int value) {
	*(int*)option(c->sim.integrator.row, c->method, key) = value;
}

// A bend and a twist that grow from the clamped end; the beam then deforms by about a tenth of its length.
static void set_in_motion(Rig* rig) {
	const double* rest = jn_model_rest(rig->model);
	for (int node = 0; node < rig->nodes; ++node) {
		const double *X = rest + 3 * (size_t)node, height = X[2] * X[2] / 0.16;
		rig->start.v[3 * node] = height * (0.8 - 6 * (X[1] - 0.1));
		rig->start.v[3 * node + 1] = height * (0.5 + 6 * (X[0] - 0.1));
		rig->start.v[3 * node + 2] = 0.4 * X[2];
	}
	rig_begin(rig);
}

// ---- energy

static double total(const Rig* rig) {
	const JnEnergies e = jn_model_energies(rig->model, &rig->start);
	return e.kinetic + e.elastic + e.gravity;
}

// Largest energy error in 100 steps of 1/64 s over the kinetic energy of the start.
static double energy_error(const ModelCase* c) {
	Rig rig;
	double most = 0, most_elastic = 0;
	rig_create(&rig, c, 1);
	set_in_motion(&rig);
	const double start = total(&rig);
	assert_true(start > 0.1); // all kinetic
	for (int step = 0; step < 100; ++step) {
		rig_step(&rig, 1.0 / 64);
		most = fmax(most, fabs(total(&rig) - start));
		most_elastic = fmax(most_elastic, jn_model_energies(rig.model, &rig.start).elastic);
	}
	assert_true(most_elastic > 0.3 * start); // energy does change hands
	rig_destroy(&rig);
	print_message("%s, %s: energy error %.2e\n", c->sim.integrator.row->name, c->body.material.row->name, most / start);
	return most / start;
}

static void averaged_forces_keep_the_energy_of_a_quartic_law_with_two_nodes(void** state) {
	(void)state;
	ModelCase c;
	beam_case(&c, "st_venant_kirchhoff", "average_vector_field");
	set_integer(&c, "nodes", 2);
	// 100 steps, each with a residual of 1e-13 of the forces over displacements of 1e-2 m
	expect_near(energy_error(&c), 0, 1e-10, "two nodes");
	set_integer(&c, "nodes", 1); // the midpoint rule: exact for quadratic energies alone
	assert_true(energy_error(&c) > 1e-5);
}

static void averaged_forces_keep_the_energy_of_stable_neo_hooke(void** state) {
	(void)state;
	ModelCase c;
	beam_case(&c, "stable_neo_hookean", "average_vector_field");
	set_integer(&c, "nodes", 8);
	expect_near(energy_error(&c), 0, 1e-10, "eight nodes"); // as above
	beam_case(&c, "stable_neo_hookean", "sdirk2");
	assert_true(energy_error(&c) > 1e-3); // so that the above says something
}

// ---- a stiff bar that spins

// Share of the energy lost in 40 steps of 0.1 rad, after 10 in which the unstrained start is forgotten. omega dt of
// the slowest axial mode is 1000.
static double spinning_loss(const char* method) {
	ModelCase c;
	Rig rig;
	beam_case(&c, "st_venant_kirchhoff", method);
	c.box = (JnBoxDef){.size = {0.1, 0.1, 1}, .cells = {1, 1, 4}, .element = JN_HEX8};
	c.material.young = 1e10;
	c.body.fix.count = 0;
	c.body.spin[1] = 1;
	c.sim.newton = (JnNewtonDef){.tolerance = 1e-10, .max_iterations = 60, .reuse = 1};
	rig_create(&rig, &c, 1);
	double before = 0;
	for (int step = 0; step < 50; ++step) {
		if (step == 10) before = total(&rig);
		rig_step(&rig, 0.1);
	}
	const double loss = 1 - total(&rig) / before;
	rig_destroy(&rig);
	print_message("%s: a spinning bar loses %.2e of its energy\n", method, loss);
	return loss;
}

// Far apart, whatever the order of the method: docs/rotation.md.
static void stage_order_decides_how_well_a_stiff_bar_spins(void** state) {
	(void)state;
	const char* const one[] = {"backward_euler", "sdirk2", "sdirk3"};
	const char* const two[] = {"tr_bdf2", "tr_bdf2_b", "esdirk324", "esdirk325", "esdirk436"};
	for (int i = 0; i < 3; ++i) assert_true(spinning_loss(one[i]) > 0.2);
	for (int i = 0; i < 5; ++i) assert_true(fabs(spinning_loss(two[i])) < 3e-4);
}

// ---- methods that equal each other

// x, then v / 100 [1/s], after 64 steps of 1/64 s.
static void simulate(const ModelCase* c, int length, double* out) {
	Rig rig;
	rig_create(&rig, c, 1);
	assert_int_equal(2 * rig.length, length);
	set_in_motion(&rig);
	for (int step = 0; step < 64; ++step) rig_step(&rig, 1.0 / 64);
	for (int k = 0; k < rig.length; ++k) {
		out[k] = rig.start.x[k];
		out[rig.length + k] = rig.start.v[k] / 100;
	}
	rig_destroy(&rig);
}

enum { REALS = 2 * 3 * 3 * 3 * 5 }; // positions and velocities of the nodes of the beam

static double difference(const ModelCase* a, const ModelCase* b) {
	double at_a[REALS], at_b[REALS];
	simulate(a, REALS, at_a);
	simulate(b, REALS, at_b);
	return largest_difference(at_a, at_b, REALS);
}

// Constant average acceleration is the trapezoidal rule, whatever the law.
static void newmark_is_the_trapezoidal_rule(void** state) {
	(void)state;
	const char* const laws[] = {"linear", "stable_neo_hookean"};
	for (int i = 0; i < 2; ++i) {
		ModelCase newmark, trapezoid, damped;
		beam_case(&newmark, laws[i], "newmark");
		beam_case(&trapezoid, laws[i], "trapezoid");
		beam_case(&damped, laws[i], "newmark");
		set_real(&damped, "gamma", 0.6);
		expect_near(difference(&newmark, &trapezoid), 0, 1e-10, "%s", laws[i]); // 64 residuals of 1e-13 of the forces
		assert_true(difference(&damped, &trapezoid) > 1e-3);
	}
}

// Both carry their own acceleration, which in exact arithmetic equals M^-1 f when nothing is weighted.
static void hht_without_damping_is_newmark(void** state) {
	(void)state;
	ModelCase newmark, hht, damped;
	beam_case(&newmark, "stable_neo_hookean", "newmark");
	beam_case(&hht, "stable_neo_hookean", "hht_alpha");
	beam_case(&damped, "stable_neo_hookean", "hht_alpha");
	set_real(&hht, "alpha", 0);
	set_real(&damped, "alpha", -0.1);
	expect_near(difference(&hht, &newmark), 0, 1e-10, "hht_alpha"); // as above
	assert_true(difference(&damped, &newmark) > 1e-4);
}

// ---- order

static const double duration = 1.0 / 16;

// The state after `duration` in `pairs` pairs of steps, of which the first takes `share`.
static void solve(const ModelCase* c, int pairs, double share, double out[REALS]) {
	Rig rig;
	rig_create(&rig, c, 1);
	set_in_motion(&rig);
	for (int pair = 0; pair < pairs; ++pair) {
		rig_step(&rig, share * duration / pairs);
		rig_step(&rig, (1 - share) * duration / pairs);
	}
	for (int k = 0; k < rig.length; ++k) {
		out[k] = rig.start.x[k];
		out[rig.length + k] = duration * rig.start.v[k];
	}
	rig_destroy(&rig);
}

// Of the errors with 64 and 128 pairs of steps, against 1024 steps of esdirk436.
static double observed_order(const ModelCase* c, double share) {
	ModelCase exact;
	double reference[REALS], coarse[REALS], fine[REALS];
	beam_case(&exact, "stable_neo_hookean", "esdirk436");
	solve(&exact, 512, 0.5, reference);
	solve(c, 64, share, coarse);
	solve(c, 128, share, fine);
	const double order =
		log2(largest_difference(coarse, reference, REALS) / largest_difference(fine, reference, REALS));
	print_message("%s, steps of %g and %g: order %.3f\n", c->sim.integrator.row->name, share, 1 - share, order);
	return order;
}

static void generalized_alpha_has_order_two_with_and_without_damping(void** state) {
	(void)state;
	const double rho[] = {1, 0.8, 0.3};
	for (int i = 0; i < 3; ++i) {
		ModelCase c;
		beam_case(&c, "stable_neo_hookean", "generalized_alpha");
		set_real(&c, "rho_infinity", rho[i]);
		expect_near(observed_order(&c, 0.5), 2, 0.1, "rho_infinity %g", rho[i]); // terms of the next order
	}
}

// rho = 1 neither damps nor drives: its energy error is that of the midpoint rule's kind and does not grow.
static void generalized_alpha_without_damping_keeps_the_energy_about_as_the_midpoint_rule(void** state) {
	(void)state;
	ModelCase alpha, midpoint, damped;
	beam_case(&alpha, "stable_neo_hookean", "generalized_alpha");
	beam_case(&damped, "stable_neo_hookean", "generalized_alpha");
	beam_case(&midpoint, "stable_neo_hookean", "implicit_midpoint");
	set_real(&alpha, "rho_infinity", 1);
	set_real(&damped, "rho_infinity", 0);
	const double of_alpha = energy_error(&alpha), of_midpoint = energy_error(&midpoint);
	assert_true(of_alpha < 3 * of_midpoint);
	assert_true(energy_error(&damped) > 3 * of_alpha);
}

static void bdf2_keeps_order_two_when_its_steps_vary(void** state) {
	(void)state;
	const double shares[] = {0.5, 0.4, 1.0 / 3}; // ratios 1, 1.5 and 2 in turn with their inverses; the limit is 2.41
	for (int i = 0; i < 3; ++i) {
		ModelCase c;
		beam_case(&c, "stable_neo_hookean", "bdf2");
		expect_near(observed_order(&c, shares[i]), 2, 0.1, "share %g", shares[i]); // terms of the next order
	}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(averaged_forces_keep_the_energy_of_a_quartic_law_with_two_nodes),
		cmocka_unit_test(averaged_forces_keep_the_energy_of_stable_neo_hooke),
		cmocka_unit_test(stage_order_decides_how_well_a_stiff_bar_spins),
		cmocka_unit_test(newmark_is_the_trapezoidal_rule),
		cmocka_unit_test(hht_without_damping_is_newmark),
		cmocka_unit_test(generalized_alpha_has_order_two_with_and_without_damping),
		cmocka_unit_test(generalized_alpha_without_damping_keeps_the_energy_about_as_the_midpoint_rule),
		cmocka_unit_test(bdf2_keeps_order_two_when_its_steps_vary),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
