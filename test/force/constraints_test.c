// The law `constraints` on whole bodies: what its keys mean, whatever the mesh, and what it refuses.
#include "thread_case.h"

static const double YOUNG = 5e4, PI = 3.14159265358979323846;

static ThreadCase box(int cells, JnShape element, const Setting* settings) {
	ThreadCase c = {0};
	const JnBoxDef def = {.size = {0.2, 0.3, 0.4}, .cells = {2 * cells, 3 * cells, 4 * cells}, .element = (int)element};
	assert_int_equal(jn_generate_box(&def, &c.arena, &c.mesh), JN_OK);
	c.reals = 3 * c.mesh.node_count;
	c.x = jn_arena_take(&c.arena, (size_t)c.reals, sizeof(double));
	memcpy(c.x, c.mesh.nodes, (size_t)c.reals * sizeof(double));
	assert_int_equal(thread_build(&c, "constraints", settings), JN_OK);
	return c;
}

static void expect(double value, double expected, double tolerance, const char* what) {
	print_message("%s: %.10g, expected %.10g, relative tolerance %.2g\n", what, value, expected, tolerance);
	assert_true(fabs(value - expected) <= tolerance * fabs(expected));
}

static void stretch(ThreadCase* c, double x, double y, double z) {
	const double factor[3] = {x, y, z};
	for (int k = 0; k < c->reals; ++k) c->x[k] = factor[k % 3] * c->mesh.nodes[k];
}

// Strain e in all directions: springs have E e^2 3 V, which is that of lambda = mu = 0.4 E; volume terms K/2 (J - 1)^2 V.
static void swelling_has_the_energy_of_the_moduli_on_any_mesh(void** unused) {
	(void)unused;
	const double e = 1e-3, V = 0.2 * 0.3 * 0.4, J = pow(1 + e, 3);
	const Setting settings[] = {{"density", 1000}, {"stiffness", YOUNG}, {"volume", 2e5}, {0}};
	for (int cells = 1; cells <= 3; ++cells) {
		ThreadCase c = box(cells, JN_TET4, settings);
		stretch(&c, 1 + e, 1 + e, 1 + e);
		expect(thread_energy(&c), V * (3 * YOUNG * e * e + 0.5 * 2e5 * (J - 1) * (J - 1)), 1e-9,
			   "energy [J]"); // rounding
		jn_arena_free(&c.arena);
	}
}

// A strain e along one axis with the others held: (lambda/2 + mu) e^2 = 0.6 E e^2, if edges went in all directions alike. The
// cubes of six tetrahedra have more along the axes.
static void pulling_has_about_the_energy_of_youngs_modulus(void** unused) {
	(void)unused;
	const double e = 1e-4, V = 0.2 * 0.3 * 0.4;
	const Setting settings[] = {{"density", 1000}, {"stiffness", YOUNG}, {0}};
	double last = 0;
	for (int cells = 1; cells <= 2; ++cells) {
		ThreadCase c = box(cells, JN_TET4, settings);
		stretch(&c, 1 + e, 1, 1);
		const double energy = thread_energy(&c);
		expect(energy, 0.6 * YOUNG * e * e * V, 0.3, "energy [J]");
		if (cells == 2) expect(energy, last, 1e-9, "that of the finer mesh [J]");
		last = energy;
		jn_arena_free(&c.arena);
	}
}

// Each triangle of the skin has stiffness/2 (dA/A)^2 A.
static void a_skin_has_the_energy_of_its_area(void** unused) {
	(void)unused;
	const Setting with[] = {{"density", 1000}, {"stiffness", YOUNG}, {"area", 40}, {0}};
	const Setting without[] = {{"density", 1000}, {"stiffness", YOUNG}, {0}};
	ThreadCase skin = box(1, JN_TET4, with), bare = box(1, JN_TET4, without);
	stretch(&skin, 1.1, 1.1, 1.1);
	stretch(&bare, 1.1, 1.1, 1.1);
	const double A = 2 * (0.2 * 0.3 + 0.3 * 0.4 + 0.4 * 0.2);
	expect(thread_energy(&skin) - thread_energy(&bare), 0.5 * 40 * 0.21 * 0.21 * A, 1e-9, "energy [J]");
	jn_arena_free(&skin.arena);
	jn_arena_free(&bare.arena);
}

static const double line[] = {0, 0, 0, 0.1, 0, 0};
static const double R = 2e-3;

/// Add a third of a force on each node of the last frame; and the mean of a displacement there.
static void push_end(const ThreadCase* c, int axis, double force, double* f) {
	for (int i = 0; i < 3; ++i) f[c->reals - 9 + 3 * i + axis] += force / 3;
}

static double moved_end(const ThreadCase* c, int axis, const double* u) {
	return (u[c->reals - 9 + axis] + u[c->reals - 6 + axis] + u[c->reals - 3 + axis]) / 3;
}

static void a_pulled_thread_has_stiffness_pi_r2_at_any_number_of_links(void** unused) {
	(void)unused;
	const Setting settings[] = {{"density", 1000}, {"stiffness", YOUNG}, {0}};
	for (int links = 5; links <= 20; links *= 2)
		for (int section = 0; section < 2; ++section) {
			double f[9 * 21] = {0}, u[9 * 21];
			ThreadCase c = thread_case(2, line, R, links, section);
			assert_int_equal(thread_build(&c, "constraints", settings), JN_OK);
			push_end(&c, 0, 1, f);
			thread_bend(&c, f, u);
			expect(moved_end(&c, 0, u), 0.1 / (YOUNG * PI * R * R), 1e-9, "stretch [m]"); // rounding
			jn_arena_free(&c.arena);
		}
}

// Three lines of EA/3 at r/sqrt 2: EA r^2/4. What the diagonals leave to bend besides is below 5 %.
static void a_bent_thread_has_the_stiffness_of_a_round_section(void** unused) {
	(void)unused;
	const Setting settings[] = {{"density", 1000}, {"stiffness", YOUNG}, {0}};
	ThreadCase c = thread_case(2, line, R, 20, 0);
	assert_int_equal(thread_build(&c, "constraints", settings), JN_OK);
	for (int axis = 1; axis < 3; ++axis) {
		double f[9 * 21] = {0}, u[9 * 21];
		push_end(&c, axis, 1, f);
		thread_bend(&c, f, u);
		const double EI = YOUNG * PI * R * R * R * R / 4;
		expect(moved_end(&c, axis, u), 0.1 * 0.1 * 0.1 / (3 * EI), 0.05, "deflection [m]");
	}
	jn_arena_free(&c.arena);
}

/// Frames along an arc of the curvature kappa, twisted by `rate` a length; springs stay as they are for their group's sake.
static void wind(ThreadCase* c, double kappa, double rate) {
	for (int k = 0; k < c->reals; k += 3) {
		const double* X = c->mesh.nodes + k;
		const double cs = cos(rate * X[0]), sn = sin(rate * X[0]), y = cs * X[1] - sn * X[2], z = sn * X[1] + cs * X[2];
		const double along = kappa > 0 ? 1 / kappa - y : 0;
		c->x[k] = kappa > 0 ? along * sin(kappa * X[0]) : X[0];
		c->x[k + 1] = kappa > 0 ? 1 / kappa - along * cos(kappa * X[0]) : y;
		c->x[k + 2] = z;
	}
}

static double energy_difference(const Setting* with, const Setting* without, double kappa, double rate) {
	double energy[2];
	for (int i = 0; i < 2; ++i) {
		ThreadCase c = thread_case(2, line, R, 20, 0);
		assert_int_equal(thread_build(&c, "constraints", i == 0 ? with : without), JN_OK);
		wind(&c, kappa, rate);
		energy[i] = thread_energy(&c);
		jn_arena_free(&c.arena);
	}
	return energy[0] - energy[1];
}

static void torsion_and_bending_are_GJ_and_EI(void** unused) {
	(void)unused;
	const Setting plain[] = {{"density", 1000}, {"stiffness", YOUNG}, {"torsion_damping", NAN}, {0}};
	const Setting torsion[] = {
		{"density", 1000}, {"stiffness", YOUNG}, {"torsion_damping", NAN}, {"torsion", 3e-6}, {0}};
	const Setting bending[] = {
		{"density", 1000}, {"stiffness", YOUNG}, {"torsion_damping", NAN}, {"bending", 2e-6}, {0}};
	// each link turns by rate L exactly
	expect(energy_difference(torsion, plain, 0, 20), 0.5 * 3e-6 * 400 * 0.1, 1e-9, "energy of twist [J]");
	// 19 of 20 angles, and lines whose radius is not that of the axis
	expect(energy_difference(bending, plain, 5, 0), 0.5 * 2e-6 * 25 * 0.1 * 19 / 20, 1e-3, "energy of bending [J]");
	// an arc in a plane has no twist
	assert_true(fabs(energy_difference(torsion, plain, 5, 0)) < 1e-20);
}

static void expect_refusal(ThreadCase* c, const Setting* settings, const char* first, const char* second) {
	log_capture();
	assert_int_equal(thread_build(c, "constraints", settings), JN_BAD_INPUT);
	if (strstr(log_text(), first) == NULL || strstr(log_text(), second) == NULL) fail_msg("it says: %s", log_text());
	log_release();
}

static void what_it_cannot_do_it_refuses(void** unused) {
	(void)unused;
	const Setting plain[] = {{"density", 1000}, {"stiffness", YOUNG}, {0}};
	const Setting torsion[] = {{"density", 1000}, {"stiffness", YOUNG}, {"torsion", 1}, {0}};
	ThreadCase c = box(1, JN_TET4, plain);
	expect_refusal(&c, torsion, "bodies[0].material.torsion", "type: thread");
	c.mesh.shape = JN_HEX8;
	expect_refusal(&c, plain, "hex8", "use tet4");
	c.mesh.shape = JN_TET4;
	c.mesh.cells[0] = c.mesh.cells[1];
	expect_refusal(&c, plain, "cell 0", "must be > 0");
	jn_arena_free(&c.arena);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(swelling_has_the_energy_of_the_moduli_on_any_mesh),
		cmocka_unit_test(pulling_has_about_the_energy_of_youngs_modulus),
		cmocka_unit_test(a_skin_has_the_energy_of_its_area),
		cmocka_unit_test(a_pulled_thread_has_stiffness_pi_r2_at_any_number_of_links),
		cmocka_unit_test(a_bent_thread_has_the_stiffness_of_a_round_section),
		cmocka_unit_test(torsion_and_bending_are_GJ_and_EI),
		cmocka_unit_test(what_it_cannot_do_it_refuses),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
