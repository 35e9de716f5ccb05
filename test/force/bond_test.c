// The kernel of bonds: derivatives, products, invariance, breaking, and the same bits at every vector width.
#include "force/bond.h"

#include "sample.h"

enum { BONDS = 11, REALS = 6, PAIR_REALS = 27 };

// Bonds without common points, about 0.1 m long, with a last batch that is padded at every width.
typedef struct Case {
	JnArena arena;
	JnGroup group;
	double x[BONDS * REALS];
} Case;

// The group for vectors of another width.
static void remake(Case* c, int width) {
	const JnKernel* kernel = jn_bond_kernel(width);
	JnGroup made = {.kernel = kernel, .count = BONDS, .batches = (BONDS + width - 1) / width};
	const size_t slots = (size_t)made.batches * (size_t)width;
	made.nodes = jn_arena_take(&c->arena, 2 * slots, sizeof(int));
	made.rest = jn_arena_take(&c->arena, JN_BOND_REALS * slots, sizeof(double));
	for (int b = 0; b < BONDS; b++) {
		const JnBond bond = jn_bond_get(&c->group, b);
		jn_bond_set(&made, b, &bond);
	}
	jn_bonds_pad(&made);
	c->group = made;
}

// `stretch` 0.3: lengths between 0.7 and 1.3 of those at rest.
static void make_case(Case* c, double stretch, uint64_t seed) {
	*c = (Case){0};
	assert_int_equal(jn_bonds_create(BONDS, &c->arena, &c->group), JN_OK);
	for (int b = 0; b < BONDS; b++) {
		double R[3][3], *x = c->x + REALS * b;
		random_rotation(&seed, R);
		const double length = 0.1 + 0.05 * random_real(&seed), now = length * (1 + stretch * random_real(&seed));
		for (int a = 0; a < 3; a++) {
			x[a] = 0.3 * random_real(&seed);
			x[3 + a] = x[a] + now * R[a][0];
		}
		const JnBond bond = {
			.nodes = {2 * b, 2 * b + 1}, .length = length, .force = 50 + 20 * random_real(&seed), .stretch = 0.1};
		jn_bond_set(&c->group, b, &bond);
	}
	jn_bonds_pad(&c->group);
}

static void energies(const Case* c, double out[BONDS]) {
	double lanes[16];
	c->group.kernel->energy(&c->group, 0, c->group.batches, c->x, lanes);
	memcpy(out, lanes, BONDS * sizeof *out);
}

static double entry(const Case* c, const double* from, int reals, int bond, int k) {
	const int width = c->group.kernel->width;
	return from[((ptrdiff_t)(bond / width) * reals + k) * width + bond % width];
}

static void forces(const Case* c, double out[BONDS][REALS]) {
	double lanes[16 * REALS];
	c->group.kernel->force(&c->group, 0, c->group.batches, c->x, lanes);
	for (int k = 0; k < BONDS * REALS; k++) out[k / REALS][k % REALS] = entry(c, lanes, REALS, k / REALS, k % REALS);
}

static void tangents(const Case* c, bool definite, double out[BONDS][REALS][REALS]) {
	double lanes[16 * PAIR_REALS];
	c->group.kernel->tangent(&c->group, 0, c->group.batches, c->x, definite, lanes);
	for (int b = 0; b < BONDS; b++)
		for (int k = 0; k < 36; k++) {
			const int i = k / 18, j = k % 6 / 3, r = k / 6 % 3, s = k % 3, pair = i > j ? 1 : 2 * i; // (0,1) is (1,0)^T
			const int place = i < j ? 9 + 3 * s + r : 9 * pair + 3 * r + s;
			out[b][k / 6][k % 6] = entry(c, lanes, PAIR_REALS, b, place);
		}
}

static void near_to(double value, double expected, double tolerance, const char* what) {
	if (!(fabs(value - expected) <= tolerance))
		fail_msg("%s: %.17g, expected %.17g, tolerance %.3g", what, value, expected, tolerance);
}

// As in derivative_test: bonds of 0.1 m, strains of 0.3; central differences over 1e-6 m are right to 1e-9.
static const double STEP = 1e-6, TOLERANCE = 1e-6;

static void force_and_tangent_are_derivatives(void** unused) {
	(void)unused;
	Case c;
	double f[BONDS][REALS], K[BONDS][REALS][REALS], high[BONDS], low[BONDS], f_high[BONDS][REALS], f_low[BONDS][REALS];
	make_case(&c, 0.3, 1);
	forces(&c, f);
	tangents(&c, false, K);
	for (int k = 0; k < REALS; k++) {
		for (int b = 0; b < BONDS; b++) c.x[REALS * b + k] += STEP;
		energies(&c, high);
		forces(&c, f_high);
		for (int b = 0; b < BONDS; b++) c.x[REALS * b + k] -= 2 * STEP;
		energies(&c, low);
		forces(&c, f_low);
		for (int b = 0; b < BONDS; b++) c.x[REALS * b + k] += STEP;
		for (int b = 0; b < BONDS; b++) {
			near_to(f[b][k], -(high[b] - low[b]) / (2 * STEP), TOLERANCE * 50, "force");
			for (int r = 0; r < REALS; r++)
				near_to(K[b][r][k], -(f_high[b][r] - f_low[b][r]) / (2 * STEP), TOLERANCE * 1000, "tangent");
		}
	}
	jn_arena_free(&c.arena);
}

static void product_is_the_tangent_times_a_vector(void** unused) {
	(void)unused;
	Case c;
	uint64_t seed = 9;
	double K[BONDS][REALS][REALS], p[BONDS * REALS], lanes[16 * REALS];
	make_case(&c, 0.3, 2);
	for (int k = 0; k < BONDS * REALS; k++) p[k] = random_real(&seed);
	for (int definite = 0; definite < 2; definite++) {
		tangents(&c, definite, K);
		c.group.kernel->product(&c.group, 0, c.group.batches, c.x, definite, p, lanes);
		for (int b = 0; b < BONDS; b++)
			for (int r = 0; r < REALS; r++) {
				double sum = 0;
				for (int k = 0; k < REALS; k++) sum += K[b][r][k] * p[REALS * b + k];
				near_to(entry(&c, lanes, REALS, b, r), sum, 1e-12 * 1000, "product"); // rounding of six terms
			}
	}
	jn_arena_free(&c.arena);
}

// x' K x with the eigenvectors known: along the bond and across it.
static void the_definite_tangent_has_no_negative_eigenvalue(void** unused) {
	(void)unused;
	Case c;
	double exact[BONDS][REALS][REALS], clamped[BONDS][REALS][REALS];
	int compressed = 0;
	make_case(&c, 0.3, 3);
	tangents(&c, false, exact);
	tangents(&c, true, clamped);
	for (int b = 0; b < BONDS; b++) {
		const JnBond bond = jn_bond_get(&c.group, b);
		const double* x = c.x + REALS * b;
		double y[3], square = 0, trace[2] = {0, 0};
		for (int a = 0; a < 3; a++) y[a] = x[3 + a] - x[a], square += y[a] * y[a];
		for (int a = 0; a < 3; a++) trace[0] += exact[b][a][a], trace[1] += clamped[b][a][a];
		const double kappa = bond.force / bond.length, across = kappa * (1 - bond.length / sqrt(square));
		near_to(trace[0], kappa + 2 * across, 1e-9 * kappa, "trace");
		near_to(trace[1], kappa + 2 * fmax(across, 0), 1e-9 * kappa, "clamped trace");
		compressed += across < 0;
	}
	assert_in_range(compressed, 2, BONDS - 2);
	jn_arena_free(&c.arena);
}

static void forces_balance_and_turn_with_the_bonds(void** unused) {
	(void)unused;
	Case c;
	uint64_t seed = 5;
	double before[BONDS][REALS], after[BONDS][REALS], R[3][3];
	make_case(&c, 0.3, 4);
	forces(&c, before);
	random_rotation(&seed, R);
	for (int i = 0; i < 2 * BONDS; i++) {
		const double old[3] = {c.x[3 * i], c.x[3 * i + 1], c.x[3 * i + 2]};
		for (int a = 0; a < 3; a++) c.x[3 * i + a] = R[a][0] * old[0] + R[a][1] * old[1] + R[a][2] * old[2] + 3 - a;
	}
	forces(&c, after);
	for (int b = 0; b < BONDS; b++)
		for (int a = 0; a < 3; a++) {
			const double* f = before[b];
			assert_true(f[a] == -f[3 + a]); // momentum, to the last bit
			near_to(after[b][a], R[a][0] * f[0] + R[a][1] * f[1] + R[a][2] * f[2], 1e-9 * 50, "turned force");
		}
	jn_arena_free(&c.arena);
}

static void points_at_one_place_have_a_finite_tangent_and_no_force(void** unused) {
	(void)unused;
	Case c;
	double f[BONDS][REALS], K[BONDS][REALS][REALS];
	make_case(&c, 0, 6);
	for (int a = 0; a < 3; a++) c.x[3 + a] = c.x[a];
	forces(&c, f);
	for (int definite = 0; definite < 2; definite++) {
		tangents(&c, definite, K);
		for (int k = 0; k < REALS * REALS; k++) assert_true(isfinite(K[0][k / REALS][k % REALS]));
	}
	for (int k = 0; k < REALS; k++) assert_true(f[0][k] == 0);
	jn_arena_free(&c.arena);
}

static void what_is_stretched_too_far_breaks_and_gives_its_energy(void** unused) {
	(void)unused;
	Case c;
	int broken[BONDS], expected = 0;
	double before[BONDS], after[BONDS], released = 0, sum = 0;
	make_case(&c, 0.3, 8);
	energies(&c, before);
	const int count = c.group.kernel->damage(&c.group, 0, c.group.batches, c.x, NULL, broken, &released);
	energies(&c, after);
	for (int b = 0; b < BONDS; b++) {
		double y[3];
		for (int a = 0; a < 3; a++) y[a] = c.x[REALS * b + 3 + a] - c.x[REALS * b + a];
		const JnBond bond = jn_bond_get(&c.group, b);
		const bool breaks = sqrt(y[0] * y[0] + y[1] * y[1] + y[2] * y[2]) > bond.length * 1.1;
		if (breaks) assert_int_equal(broken[expected++], b);
		assert_true(after[b] == (breaks ? 0 : before[b]));
		assert_true((bond.force == 0) == breaks);
		sum += before[b] - after[b];
	}
	assert_int_equal(count, expected);
	assert_in_range(count, 1, BONDS - 1);
	near_to(released, sum, 1e-14 * sum, "released energy");                                                  // rounding
	assert_int_equal(c.group.kernel->damage(&c.group, 0, c.group.batches, c.x, NULL, broken, &released), 0); // once
	jn_arena_free(&c.arena);
}

static void all_widths_agree(void** unused) {
	(void)unused;
	double f[3][BONDS][REALS], K[3][BONDS][REALS][REALS];
	for (int w = 0; w < 3; w++) {
		Case c;
		if (jn_bond_kernel(2 << w) == NULL) continue;
		make_case(&c, 0.3, 10);
		remake(&c, 2 << w);
		forces(&c, f[w]);
		tangents(&c, false, K[w]);
		jn_arena_free(&c.arena);
		for (int k = 0; k < BONDS * REALS && w > 0; k++)
			near_to(f[w][k / REALS][k % REALS], f[0][k / REALS][k % REALS], 1e-14 * 100, "force of another width");
		if (w == 2) assert_memory_equal(f[1], f[2], sizeof f[1]);
		if (w == 2) assert_memory_equal(K[1], K[2], sizeof K[1]);
	}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(force_and_tangent_are_derivatives),
		cmocka_unit_test(product_is_the_tangent_times_a_vector),
		cmocka_unit_test(the_definite_tangent_has_no_negative_eigenvalue),
		cmocka_unit_test(forces_balance_and_turn_with_the_bonds),
		cmocka_unit_test(points_at_one_place_have_a_finite_tangent_and_no_force),
		cmocka_unit_test(what_is_stretched_too_far_breaks_and_gives_its_energy),
		cmocka_unit_test(all_widths_agree),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
