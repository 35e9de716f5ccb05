// The law `rod` against the theory of beams: small loads on a clamped rod, solved densely.
#include "thread_case.h"

static const double LENGTH = 0.1, RADIUS = 1e-3, YOUNG = 750e6, POISSON = 0.4, PI = 3.14159265358979323846;
enum { LINKS = 20, REALS = 9 * (LINKS + 1), CLAMPED = 9, FREE = REALS - CLAMPED };

typedef struct Beam {
	double EA, EI, GA, GJ;
} Beam;

static Beam beam(void) {
	const double A = PI * RADIUS * RADIUS, I = A * RADIUS * RADIUS / 4, G = YOUNG / (2 * (1 + POISSON));
	return (Beam){.EA = YOUNG * A, .EI = YOUNG * I, .GA = 0.9 * G * A, .GJ = 2 * G * I};
}

static ThreadCase rod(void) {
	static const double ends[] = {0, 0, 0, LENGTH, 0, 0};
	const Setting settings[] = {{"density", 1300}, {"young", YOUNG}, {"poisson", POISSON}, {0}};
	ThreadCase c = thread_case(2, ends, RADIUS, LINKS, 0);
	assert_int_equal(thread_build(&c, "rod", settings), JN_OK);
	assert_int_equal(c.reals, REALS);
	return c;
}

static void push(int frame, int axis, double force, double* f) {
	for (int i = 0; i < 3; ++i) f[9 * frame + 3 * i + axis] += force / 3;
}

static double moved(const double* u, int frame, int axis) {
	return (u[9 * frame + axis] + u[9 * frame + 3 + axis] + u[9 * frame + 6 + axis]) / 3;
}

static void expect(double value, double expected, double tolerance, const char* what) {
	print_message("%s: %.10g, expected %.10g, relative tolerance %.2g\n", what, value, expected, tolerance);
	assert_true(fabs(value - expected) <= tolerance * fabs(expected));
}

// To rounding: the condition of K is that of bending over 20 links, 1e6.
static const double EXACT = 1e-8;

static void a_pulled_rod_stretches_by_force_times_length_over_EA(void** unused) {
	(void)unused;
	ThreadCase c = rod();
	double f[REALS] = {0}, u[REALS];
	push(LINKS, 0, 1, f);
	thread_bend(&c, f, u);
	expect(moved(u, LINKS, 0), LENGTH / beam().EA, EXACT, "stretch [m]");
	jn_arena_free(&c.arena);
}

// Tip deflection of Timoshenko's beam under forces F at x: F (x^2 (3 l - x)/(6 EI) + x/GA) each.
static void a_loaded_rod_bends_as_a_beam_in_all_directions(void** unused) {
	(void)unused;
	ThreadCase c = rod();
	const Beam b = beam();
	for (int direction = 0; direction < 3; ++direction) {
		const double y = cos(0.7 * direction), z = sin(0.7 * direction), w = 1e-3;
		double f[REALS] = {0}, u[REALS], expected = 0;
		for (int k = 1; k <= LINKS; ++k) {
			const double F = w * LENGTH / LINKS * (k < LINKS ? 1 : 0.5), x = LENGTH * k / LINKS;
			push(k, 1, F * y, f);
			push(k, 2, F * z, f);
			expected += F * (x * x * (3 * LENGTH - x) / (6 * b.EI) + x / b.GA);
		}
		thread_bend(&c, f, u);
		const double tip = moved(u, LINKS, 1) * y + moved(u, LINKS, 2) * z;
		expect(tip, expected, EXACT, "deflection [m]");
		// shear adds 4 EI/(GA l^2) = 3e-4, the trapezoidal rule of the load 1e-3
		expect(tip, w * pow(LENGTH, 4) / (8 * b.EI), 2e-3, "deflection of Euler and Bernoulli [m]");
		assert_true(fabs(moved(u, LINKS, 1) * z - moved(u, LINKS, 2) * y) < 1e-8 * tip);
	}
	jn_arena_free(&c.arena);
}

// A force at the middle: what is beyond stays straight.
static void a_rod_loaded_at_its_middle_bends_as_a_beam(void** unused) {
	(void)unused;
	ThreadCase c = rod();
	const Beam b = beam();
	const double x = LENGTH / 2;
	double f[REALS] = {0}, u[REALS];
	push(LINKS / 2, 2, 1e-3, f);
	thread_bend(&c, f, u);
	expect(moved(u, LINKS / 2, 2), 1e-3 * (x * x * x / (3 * b.EI) + x / b.GA), EXACT, "at the load [m]");
	expect(moved(u, LINKS, 2), 1e-3 * (x * x * (3 * LENGTH - x) / (6 * b.EI) + x / b.GA), EXACT, "at the tip [m]");
	jn_arena_free(&c.arena);
}

// Tangential forces at the three lines, at rho = r/sqrt 2.
static void a_twisted_rod_turns_by_torque_times_length_over_GJ(void** unused) {
	(void)unused;
	ThreadCase c = rod();
	double f[REALS] = {0}, u[REALS];
	const double rho = RADIUS / sqrt(2), T = 1e-6;
	for (int i = 0; i < 3; ++i) {
		const double* X = c.x + 9 * LINKS + 3 * i;
		f[9 * LINKS + 3 * i + 1] = -T * X[2] / (3 * rho * rho);
		f[9 * LINKS + 3 * i + 2] = T * X[1] / (3 * rho * rho);
	}
	thread_bend(&c, f, u);
	double turned = 0;
	for (int i = 0; i < 3; ++i) {
		const double *X = c.x + 9 * LINKS + 3 * i, *d = u + 9 * LINKS + 3 * i;
		turned += (X[1] * d[2] - X[2] * d[1]) / (3 * rho * rho);
	}
	expect(turned, T * LENGTH / beam().GJ, EXACT, "twist");
	jn_arena_free(&c.arena);
}

/// Equilibrium under dead loads f by Newton's method, the load in `steps` parts.
static void settle(ThreadCase* c, const double* f, int steps) {
	const double small = 1e-7 * largest(f, REALS);
	double r[REALS], u[REALS];
	for (int step = 1; step <= steps; ++step)
		for (int k = 0; k < 20; ++k) {
			thread_forces(c, r);
			for (int i = 0; i < REALS; ++i) r[i] += f[i] * step / steps;
			if (largest(r + CLAMPED, FREE) < small) break;
			thread_bend(c, r, u);
			for (int i = 0; i < REALS; ++i) c->x[i] += u[i];
		}
	thread_forces(c, r);
	for (int i = CLAMPED; i < REALS; ++i) assert_true(fabs(r[i] + f[i]) < small);
}

// The elastica with a load P l^2/EI = 1 and 10 across its tip (Mattiasson 1981, by elliptic integrals). A link that bends by
// phi is softer by phi^2/12, as lines see 2 sin(phi/2): at the clamp phi is 0.05 and 0.22. Stretch and shear, which the
// elastica leaves out, are of order P/EA = 2.5e-4.
static void a_rod_bends_far_as_the_elastica(void** unused) {
	(void)unused;
	static const double loads[2] = {1, 10}, across[2] = {0.3017208, 0.8106090}, shorter[2] = {0.0564332, 0.5549956};
	static const double tolerance[2] = {3e-3, 1e-2};
	for (int i = 0; i < 2; ++i) {
		ThreadCase c = rod();
		double f[REALS] = {0};
		push(LINKS, 1, -loads[i] * beam().EI / (LENGTH * LENGTH), f);
		settle(&c, f, 5);
		expect(-moved(c.x, LINKS, 1) / LENGTH, across[i], tolerance[i], "deflection over length");
		expect(1 - moved(c.x, LINKS, 0) / LENGTH, shorter[i], tolerance[i], "shortening over length");
		jn_arena_free(&c.arena);
	}
}

// The lowest frequency by inverse iteration, against 3.5160 sqrt(EI/(rho A l^4)) of Euler and Bernoulli. Masses at the frames
// are a trapezoidal rule: of order (1/20)^2; the inertia of sections and shear are of order (r/l)^2 = 1e-4.
static void a_clamped_rod_swings_at_the_frequency_of_a_beam(void** unused) {
	(void)unused;
	ThreadCase c = rod();
	double mass[REALS] = {0}, u[REALS] = {0}, f[REALS], square = 0;
	for (int cell = 0; cell < c.mesh.cell_count; ++cell)
		for (int k = 0; k < 12; ++k)
			mass[3 * c.mesh.cells[4 * cell + k / 3] + k % 3] +=
				0.25 * c.groups.density * jn_mesh_cell_volume(&c.mesh, cell);
	for (int i = CLAMPED; i < REALS; ++i) u[i] = i % 3 == 1;
	for (int turn = 0; turn < 8; ++turn) { // the next frequency is 6 times as high
		double work = 0, size = 0;
		for (int i = 0; i < REALS; ++i) f[i] = mass[i] * u[i];
		thread_bend(&c, f, u);
		for (int i = 0; i < REALS; ++i) {
			work += u[i] * f[i];
			size += u[i] * mass[i] * u[i];
		}
		square = work / size;
		for (int i = 0; i < REALS; ++i) u[i] /= sqrt(size);
	}
	const double line_mass = 1300 * PI * RADIUS * RADIUS;
	expect(sqrt(square), 3.51602 * sqrt(beam().EI / line_mass) / (LENGTH * LENGTH), 2e-3, "frequency [1/s]");
	jn_arena_free(&c.arena);
}

// The last frame, folded back over the one before: all lengths and angles are those at rest, and so is the twist. Volumes
// alone know.
static void a_link_that_is_folded_back_is_pushed_out(void** unused) {
	(void)unused;
	ThreadCase c = rod();
	double f[REALS];
	assert_true(thread_energy(&c) == 0);
	for (int i = 0; i < 3; ++i) c.x[9 * LINKS + 3 * i] -= 2 * LENGTH / LINKS;
	thread_forces(&c, f);
	const double out = f[9 * LINKS] + f[9 * LINKS + 3] + f[9 * LINKS + 6], EA = beam().EA;
	print_message("energy %.3g of EA L, force %.3g of EA\n", thread_energy(&c) / (EA * LENGTH / LINKS), out / EA);
	assert_true(out > 0.1 * EA); // of the order of what the lines hold when they are pressed flat, EA
	jn_arena_free(&c.arena);
}

static void a_curved_rod_is_at_rest_as_it_is_laid(void** unused) {
	(void)unused;
	static const double bow[] = {0, 0, 0, 0.05, 0.02, 0, 0.1, 0, 0.03};
	const Setting settings[] = {{"density", 1300}, {"young", YOUNG}, {"poisson", POISSON}, {0}};
	ThreadCase c = thread_case(3, bow, RADIUS, LINKS, 0);
	double f[REALS];
	assert_int_equal(thread_build(&c, "rod", settings), JN_OK);
	thread_forces(&c, f);
	assert_true(largest(f, REALS) < 1e-12 * YOUNG * RADIUS * RADIUS); // rounding of strains
	jn_arena_free(&c.arena);
}

static void a_rod_weighs_what_a_round_one_weighs(void** unused) {
	(void)unused;
	static const double bow[] = {0, 0, 0, 0.05, 0.02, 0, 0.1, 0, 0.03};
	const Setting settings[] = {{"density", 1300}, {"young", YOUNG}, {"poisson", POISSON}, {0}};
	ThreadCase c = thread_case(3, bow, RADIUS, 40, 0);
	double volume = 0, length = 0;
	assert_int_equal(thread_build(&c, "rod", settings), JN_OK);
	for (int cell = 0; cell < c.mesh.cell_count; ++cell) volume += jn_mesh_cell_volume(&c.mesh, cell);
	for (int k = 0; k < 40; ++k) {
		double step = 0;
		for (int a = 0; a < 3; ++a) step += pow(moved(c.x, k + 1, a) - moved(c.x, k, a), 2);
		length += sqrt(step);
	}
	expect(c.groups.density * volume, 1300 * PI * RADIUS * RADIUS * length, 1e-12, "mass [kg]"); // rounding
	jn_arena_free(&c.arena);
}

static void a_rod_on_frames_beside_the_axis_is_refused(void** unused) {
	(void)unused;
	static const double ends[] = {0, 0, 0, LENGTH, 0, 0};
	const Setting settings[] = {{"density", 1300}, {"young", YOUNG}, {"poisson", POISSON}, {0}};
	ThreadCase c = thread_case(2, ends, RADIUS, LINKS, 1);
	log_capture();
	assert_int_equal(thread_build(&c, "rod", settings), JN_BAD_INPUT);
	assert_non_null(strstr(log_text(), "bodies[0].shape.section"));
	assert_non_null(strstr(log_text(), "use centred"));
	log_release();
	jn_arena_free(&c.arena);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_pulled_rod_stretches_by_force_times_length_over_EA),
		cmocka_unit_test(a_loaded_rod_bends_as_a_beam_in_all_directions),
		cmocka_unit_test(a_rod_loaded_at_its_middle_bends_as_a_beam),
		cmocka_unit_test(a_twisted_rod_turns_by_torque_times_length_over_GJ),
		cmocka_unit_test(a_rod_bends_far_as_the_elastica),
		cmocka_unit_test(a_clamped_rod_swings_at_the_frequency_of_a_beam),
		cmocka_unit_test(a_link_that_is_folded_back_is_pushed_out),
		cmocka_unit_test(a_curved_rod_is_at_rest_as_it_is_laid),
		cmocka_unit_test(a_rod_weighs_what_a_round_one_weighs),
		cmocka_unit_test(a_rod_on_frames_beside_the_axis_is_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
