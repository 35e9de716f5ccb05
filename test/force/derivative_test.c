// Forces and tangents against central differences; the linearisation at rest against Hooke's law.
#include "sample.h"

// Elements measure 0.1 m: the truncation error of a central difference is (h/0.1)^2 = 1e-10 times factors of order 10,
// its rounding error 1e-16 * 0.1/h = 1e-11 over strains of 0.02.
static const double STEP = 1e-6, TOLERANCE = 1e-6;

static void shift(Sample* s, int k, double by) {
	for (int e = 0; e < SAMPLE_ELEMENTS; e++) s->x[e * s->reals + k] += by;
}

static void check_force(Sample* s, State state) {
	double force[SAMPLE_ELEMENTS][SAMPLE_MOST_REALS], plus[SAMPLE_ELEMENTS], minus[SAMPLE_ELEMENTS];
	sample_force(s, force);
	for (int k = 0; k < s->reals; k++) {
		shift(s, k, STEP);
		sample_energy(s, plus);
		shift(s, k, -2 * STEP);
		sample_energy(s, minus);
		shift(s, k, STEP);
		for (int e = 0; e < SAMPLE_ELEMENTS; e++) {
			const double expected = -(plus[e] - minus[e]) / (2 * STEP);
			expect_near(force[e][k], expected, TOLERANCE * largest(force[e], s->reals), "force", s, state);
		}
	}
}

static void force_is_minus_the_gradient_of_energy(void** unused) {
	(void)unused;
	for_all_samples(check_force);
}

static void check_tangent(Sample* s, State state) {
	static SampleMatrix K[SAMPLE_ELEMENTS];
	double plus[SAMPLE_ELEMENTS][SAMPLE_MOST_REALS], minus[SAMPLE_ELEMENTS][SAMPLE_MOST_REALS];
	sample_tangent(s, false, K);
	for (int k = 0; k < s->reals; k++) {
		shift(s, k, STEP);
		sample_force(s, plus);
		shift(s, k, -2 * STEP);
		sample_force(s, minus);
		shift(s, k, STEP);
		for (int e = 0; e < SAMPLE_ELEMENTS; e++) {
			double scale = 0;
			for (int row = 0; row < s->reals; row++) scale = fmax(scale, largest(K[e][row], s->reals));
			for (int row = 0; row < s->reals; row++) {
				const double expected = -(plus[e][row] - minus[e][row]) / (2 * STEP);
				expect_near(K[e][row][k], expected, TOLERANCE * scale, "tangent", s, state);
			}
		}
	}
}

static void tangent_is_minus_the_gradient_of_force(void** unused) {
	(void)unused;
	for_all_samples(check_tangent);
}

static void rest_sample(Sample* s, JnShape shape, const JnLaw* law) {
	uint64_t seed = 7;
	*s = (Sample){.reals = 3 * jn_shape_info[shape].nodes};
	sample_mesh(s, shape, 0.05, &seed);
	s->x = s->mesh.nodes;
	sample_group(s, law, 0);
}

static void all_laws_have_the_stiffness_of_hooke_at_rest(void** unused) {
	(void)unused;
	static SampleMatrix hooke[SAMPLE_ELEMENTS], K[SAMPLE_ELEMENTS];
	for (int shape = 0; shape < JN_SOLID_SHAPE_COUNT; shape++) {
		Sample s;
		for (int row = 0; row < JN_SOLID_LAW_COUNT; row++) {
			rest_sample(&s, shape, (const JnLaw*)jn_law_list.rows[row]);
			sample_tangent(&s, false, row == 0 ? hooke : K);
			for (int k = 0; k < s.reals * s.reals && row > 0; k++) {
				const int i = k / s.reals, j = k % s.reals;
				// F at rest differs from I by 1e-15
				expect_near(K[1][i][j], hooke[1][i][j], 1e-12 * hooke[1][0][0], "K at rest", &s, NEAR_REST);
			}
			jn_arena_free(&s.arena);
		}
	}
	assert_string_equal(jn_law_list.rows[0]->name, "linear");
}

static void all_laws_have_no_energy_and_no_force_at_rest(void** unused) {
	(void)unused;
	for (int shape = 0; shape < JN_SOLID_SHAPE_COUNT; shape++) {
		for (int row = 0; row < JN_SOLID_LAW_COUNT; row++) {
			Sample s;
			rest_sample(&s, shape, (const JnLaw*)jn_law_list.rows[row]);
			double energy[SAMPLE_ELEMENTS], force[SAMPLE_ELEMENTS][SAMPLE_MOST_REALS];
			sample_energy(&s, energy);
			sample_force(&s, force);
			// E = 1e5 Pa times 1e-3 m^3, and 1e-2 m^2, times the rounding of F
			expect_near(largest(energy, SAMPLE_ELEMENTS), 0, 1e2 * 1e-14, "energy at rest", &s, NEAR_REST);
			expect_near(largest(force[0], s.reals), 0, 1e3 * 1e-13, "force at rest", &s, NEAR_REST);
			jn_arena_free(&s.arena);
		}
	}
}

static void neo_hookean_energy_is_infinite_when_inverted(void** unused) {
	(void)unused;
	for (int row = 0; row < JN_SOLID_LAW_COUNT; row++) {
		const JnLaw* law = (const JnLaw*)jn_law_list.rows[row];
		if (is_defined(law, INVERTED)) continue;
		Sample s = sample_create(JN_TET4, law, 0, INVERTED, 3);
		double energy[SAMPLE_ELEMENTS], force[SAMPLE_ELEMENTS][SAMPLE_MOST_REALS];
		sample_energy(&s, energy);
		sample_force(&s, force);
		for (int e = 0; e < SAMPLE_ELEMENTS; e++) assert_true(isinf(energy[e]) && energy[e] > 0 && isnan(force[e][0]));
		jn_arena_free(&s.arena);
		return;
	}
	fail_msg("no law was found that is undefined for inverted elements");
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(force_is_minus_the_gradient_of_energy),
		cmocka_unit_test(tangent_is_minus_the_gradient_of_force),
		cmocka_unit_test(all_laws_have_the_stiffness_of_hooke_at_rest),
		cmocka_unit_test(all_laws_have_no_energy_and_no_force_at_rest),
		cmocka_unit_test(neo_hookean_energy_is_infinite_when_inverted),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
