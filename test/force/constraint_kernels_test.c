// Every kernel of constraints by itself: derivatives, products, definiteness, invariance, widths.
#include "constraint_sample.h"
#include "math/wide_angle.h"

// Elements measure 0.1 m: truncation (h/0.1)^2 = 1e-10 times factors of order 10, rounding 1e-16 * 0.1/h = 1e-11.
static const double STEP = 1e-6, TOLERANCE = 1e-6;

static void shift(ConstraintSample* s, int k, double by) {
	for (int e = 0; e < SAMPLE_ELEMENTS; e++) s->x[e * s->reals + k] += by;
}

static void check_force(ConstraintSample* s, JnConstraintKernel which, ClothState state) {
	(void)which;
	double force[SAMPLE_ELEMENTS][SAMPLE_MOST_REALS], plus[SAMPLE_ELEMENTS], minus[SAMPLE_ELEMENTS];
	const Sample view = cloth_view(s);
	sample_force(&view, force);
	for (int k = 0; k < s->reals; k++) {
		shift(s, k, STEP);
		sample_energy(&view, plus);
		shift(s, k, -2 * STEP);
		sample_energy(&view, minus);
		shift(s, k, STEP);
		for (int e = 0; e < SAMPLE_ELEMENTS; e++)
			cloth_expect(force[e][k], -(plus[e] - minus[e]) / (2 * STEP), TOLERANCE * largest(force[e], s->reals),
						 "force", s, state);
	}
}

static void force_is_minus_the_gradient_of_energy(void** unused) {
	(void)unused;
	for_all_cloth(check_force);
}

static double scale_of(SampleMatrix K, int reals) {
	double scale = 0;
	for (int row = 0; row < reals; row++) scale = fmax(scale, largest(K[row], reals));
	return scale;
}

static void check_tangent(ConstraintSample* s, JnConstraintKernel which, ClothState state) {
	(void)which;
	static SampleMatrix K[SAMPLE_ELEMENTS];
	double plus[SAMPLE_ELEMENTS][SAMPLE_MOST_REALS], minus[SAMPLE_ELEMENTS][SAMPLE_MOST_REALS];
	const Sample view = cloth_view(s);
	sample_tangent(&view, false, K);
	for (int k = 0; k < s->reals; k++) {
		shift(s, k, STEP);
		sample_force(&view, plus);
		shift(s, k, -2 * STEP);
		sample_force(&view, minus);
		shift(s, k, STEP);
		for (int e = 0; e < SAMPLE_ELEMENTS; e++)
			for (int row = 0; row < s->reals; row++)
				cloth_expect(K[e][row][k], -(plus[e][row] - minus[e][row]) / (2 * STEP),
							 TOLERANCE * scale_of(K[e], s->reals), "tangent", s, state);
	}
}

static void tangent_is_minus_the_gradient_of_force(void** unused) {
	(void)unused;
	for_all_cloth(check_tangent);
}

static void check_product(ConstraintSample* s, JnConstraintKernel which, ClothState state) {
	static SampleMatrix K[SAMPLE_ELEMENTS];
	double p[SAMPLE_ELEMENTS * 18], out[SAMPLE_ELEMENTS][SAMPLE_MOST_REALS];
	uint64_t seed = 17 + (uint64_t)which;
	const Sample view = cloth_view(s);
	for (int k = 0; k < SAMPLE_ELEMENTS * s->reals; k++) p[k] = random_real(&seed);
	for (int definite = 0; definite < 2; definite++) {
		sample_tangent(&view, definite == 1, K);
		cloth_product(s, definite == 1, p, out);
		for (int e = 0; e < SAMPLE_ELEMENTS; e++)
			for (int row = 0; row < s->reals; row++) {
				double expected = 0;
				for (int k = 0; k < s->reals; k++) expected += K[e][row][k] * p[e * s->reals + k];
				// rounding of some 12 terms
				cloth_expect(out[e][row], expected, 1e-13 * scale_of(K[e], s->reals), "product", s, state);
			}
	}
}

static void product_is_that_of_the_assembled_tangent(void** unused) {
	(void)unused;
	for_all_cloth(check_product);
}

static int indefinite_count;

static void check_definite(ConstraintSample* s, JnConstraintKernel which, ClothState state) {
	(void)which;
	static SampleMatrix K[SAMPLE_ELEMENTS], V;
	double values[SAMPLE_MOST_REALS];
	const Sample view = cloth_view(s);
	for (int definite = 0; definite < 2; definite++) {
		sample_tangent(&view, definite == 1, K);
		for (int e = 0; e < SAMPLE_ELEMENTS; e++) {
			eigenvalues(s->reals, K[e], values, V);
			const double least = fmin(0, smallest(values, s->reals)), most = largest(values, s->reals);
			if (definite == 1)
				cloth_expect(least, 0, 1e-13 * most, "least eigenvalue", s, state); // rounding
			else
				indefinite_count += least < -1e-6 * most;
		}
	}
}

static void definite_tangent_has_no_negative_eigenvalue(void** unused) {
	(void)unused;
	for_all_cloth(check_definite);
	print_message("%d exact tangents were indefinite\n", indefinite_count);
	assert_true(indefinite_count > 50);
}

// Shear: the definite form is the exact one with its spectrum in w clamped, so on an element whose B is the identity the
// blocks of nodes 0 and 1 are that spectrum.
static void definite_shear_clamps_the_spectrum_of_the_exact_one(void** unused) {
	(void)unused;
	static SampleMatrix K[SAMPLE_ELEMENTS], D[SAMPLE_ELEMENTS], V;
	for (int state = 0; state < CLOTH_STATES; state++) {
		ConstraintSample s = constraint_sample(JN_CONSTRAINT_shear, 0, state, 3);
		const int width = s.group.kernel->width;
		for (int k = 0; k < 4 * width * s.group.batches; k++) {
			const int batch = k / (4 * width), at = k % (4 * width);
			s.group.rest[(ptrdiff_t)batch * s.group.kernel->rest_reals * width + at] = at / width % 3 == 0;
		}
		const Sample view = cloth_view(&s);
		sample_tangent(&view, false, K);
		sample_tangent(&view, true, D);
		for (int e = 0; e < SAMPLE_ELEMENTS; e++) {
			double values[6];
			eigenvalues(6, K[e], values, V);
			for (int k = 0; k < 36; k++) {
				double expected = 0;
				for (int m = 0; m < 6; m++) expected += fmax(0, values[m]) * V[k / 6][m] * V[k % 6][m];
				cloth_expect(D[e][k / 6][k % 6], expected, 1e-13 * largest(values, 6), "clamped block", &s, state);
			}
		}
		jn_arena_free(&s.arena);
	}
}

static void check_motion(ConstraintSample* s, JnConstraintKernel which, ClothState state) {
	(void)which;
	double before[SAMPLE_ELEMENTS][SAMPLE_MOST_REALS], after[SAMPLE_ELEMENTS][SAMPLE_MOST_REALS], R[3][3];
	uint64_t seed = 5;
	const Sample view = cloth_view(s);
	random_rotation(&seed, R);
	sample_force(&view, before);
	for (int i = 0; i < SAMPLE_ELEMENTS * s->reals / 3; i++) {
		double* x = s->x + 3 * i;
		const double old[3] = {x[0], x[1], x[2]};
		for (int a = 0; a < 3; a++) x[a] = R[a][0] * old[0] + R[a][1] * old[1] + R[a][2] * old[2] + 3 * a - 7;
	}
	sample_force(&view, after);
	for (int e = 0; e < SAMPLE_ELEMENTS; e++)
		for (int k = 0; k < s->reals; k++) {
			const double* f = before[e] + k / 3 * 3;
			const double expected = R[k % 3][0] * f[0] + R[k % 3][1] * f[1] + R[k % 3][2] * f[2];
			// positions of 7 m with elements of 0.1 m lose two digits
			cloth_expect(after[e][k], expected, 1e-11 * largest(before[e], s->reals), "moved force", s, state);
		}
}

static void forces_turn_with_the_body_and_ignore_its_place(void** unused) {
	(void)unused;
	for_all_cloth(check_motion);
}

static void check_balance(ConstraintSample* s, JnConstraintKernel which, ClothState state) {
	(void)which;
	double f[SAMPLE_ELEMENTS][SAMPLE_MOST_REALS];
	const Sample view = cloth_view(s);
	sample_force(&view, f);
	for (int e = 0; e < SAMPLE_ELEMENTS; e++) {
		double net[3] = {0}, torque[3] = {0};
		const double scale = largest(f[e], s->reals);
		for (int k = 0; k < s->reals; k++) {
			const int node = k / 3, a = k % 3, b = (a + 1) % 3, c = (a + 2) % 3;
			const double* x = s->x + e * s->reals + 3 * node;
			net[a] += f[e][k];
			torque[a] += x[b] * f[e][3 * node + c] - x[c] * f[e][3 * node + b];
		}
		cloth_expect(largest(net, 3), 0, 1e-14 * 18 * scale, "net force", s, state);
		cloth_expect(largest(torque, 3), 0, 1e-14 * 18 * scale, "net torque", s, state);
	}
}

static void forces_and_torques_balance(void** unused) {
	(void)unused;
	for_all_cloth(check_balance);
}

/// Energies, forces and both tangents one behind the other.
static int collect(ConstraintSample* s, double* out) {
	static SampleMatrix K[SAMPLE_ELEMENTS];
	double f[SAMPLE_ELEMENTS][SAMPLE_MOST_REALS];
	const Sample view = cloth_view(s);
	int count = SAMPLE_ELEMENTS;
	sample_energy(&view, out);
	sample_force(&view, f);
	for (int k = 0; k < SAMPLE_ELEMENTS * s->reals; k++) out[count++] = f[k / s->reals][k % s->reals];
	for (int definite = 0; definite < 2; definite++) {
		sample_tangent(&view, definite == 1, K);
		for (int e = 0; e < SAMPLE_ELEMENTS; e++)
			for (int k = 0; k < s->reals * s->reals; k++) out[count++] = K[e][k / s->reals][k % s->reals];
	}
	return count;
}

static void check_widths(ConstraintSample* s, JnConstraintKernel which, ClothState state) {
	static double reference[4000], other[4000];
	if (s->group.kernel->width != 4) return;
	const int count = collect(s, reference);
	for (int width = 8; width >= 2; width -= 6) {
		if (jn_constraint_kernel(which, width) == NULL) continue;
		ConstraintSample wide = constraint_sample(which, width, state, (uint64_t)(100 * which + state));
		assert_int_equal(collect(&wide, other), count);
		for (int k = 0; k < count; k++) cloth_expect(other[k], reference[k], 0, "another width's number", &wide, state);
		jn_arena_free(&wide.arena);
	}
}

static void all_widths_agree_to_the_bit(void** unused) {
	(void)unused;
	for_all_cloth(check_widths);
}

static void wide_angle_is_that_of_the_c_library(void** unused) {
	(void)unused;
	for (int i = 0; i < 100000; i++) {
		const double angle = -3.14159265358979 + 6.28318530717958 * i / 99999, r = 1e-3 + i % 7;
		const double y = r * sin(angle), x = r * cos(angle), expected = atan2(y, x);
		const Wide found = wide_angle(wide_set(y), wide_set(x));
		if (!(fabs(found[0] - expected) <= 1e-15 * fmax(1e-3, fabs(expected)))) // some units in the last place
			fail_msg("wide_angle(%.17g, %.17g) is %.17g, expected %.17g", y, x, found[0], expected);
	}
	assert_true(wide_angle(wide_set(0), wide_set(0))[0] == 0);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(force_is_minus_the_gradient_of_energy),
		cmocka_unit_test(tangent_is_minus_the_gradient_of_force),
		cmocka_unit_test(product_is_that_of_the_assembled_tangent),
		cmocka_unit_test(definite_tangent_has_no_negative_eigenvalue),
		cmocka_unit_test(definite_shear_clamps_the_spectrum_of_the_exact_one),
		cmocka_unit_test(forces_turn_with_the_body_and_ignore_its_place),
		cmocka_unit_test(forces_and_torques_balance),
		cmocka_unit_test(all_widths_agree_to_the_bit),
		cmocka_unit_test(wide_angle_is_that_of_the_c_library),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
