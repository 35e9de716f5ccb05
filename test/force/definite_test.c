// The definite tangent: no negative eigenvalue, exactly the clamped spectrum, and no change where none is needed.
#include "eigen.h"

static int indefinite_count;

static void check_definite(Sample* s, State state) {
	static SampleMatrix K[SAMPLE_ELEMENTS], exact[SAMPLE_ELEMENTS], V;
	double values[SAMPLE_MOST_REALS];
	sample_tangent(s, true, K);
	sample_tangent(s, false, exact);
	for (int e = 0; e < SAMPLE_ELEMENTS; e++) {
		eigenvalues(s->reals, K[e], values, V);
		const double most = largest(values, s->reals);
		// rounding leaves 1e-15; the kernel accepts -1e-12 as zero
		expect_near(fmin(0, smallest(values, s->reals)), 0, 1e-10 * most, "least eigenvalue", s, state);
		eigenvalues(s->reals, exact[e], values, V);
		indefinite_count += smallest(values, s->reals) < -1e-6 * most;
	}
}

static void definite_tangent_has_no_negative_eigenvalue(void** unused) {
	(void)unused;
	indefinite_count = 0;
	for_all_samples(check_definite);
	print_message("%d exact tangents were indefinite\n", indefinite_count);
	assert_true(indefinite_count > 100);
}

/// On the unit tetrahedron the blocks of nodes 1 to 3 are dP/dF times the volume: node i + 1 has the gradient e_i.
static void check_spectrum(const JnLaw* law, State state, int width) {
	static SampleMatrix K[SAMPLE_ELEMENTS], D[SAMPLE_ELEMENTS], A, V;
	uint64_t seed = 11 + (uint64_t)state;
	Sample s = {.reals = 12};
	sample_mesh(&s, JN_TET4, 0, &seed);
	double F[3][3], x[SAMPLE_ELEMENTS * 12], values[9];
	for (int i = 0; i < SAMPLE_ELEMENTS * 4; i++) {
		if (i % 4 == 0) random_gradient(state, &seed, F);
		for (int a = 0; a < 3; a++) {
			const double* X = s.mesh.nodes + 3 * i;
			x[3 * i + a] = F[a][0] * X[0] + F[a][1] * X[1] + F[a][2] * X[2];
		}
	}
	s.x = x;
	sample_group(&s, law, width);
	sample_tangent(&s, false, K);
	sample_tangent(&s, true, D);
	for (int e = 0; e < SAMPLE_ELEMENTS; e++) {
		for (int k = 0; k < 81; k++) A[k / 9][k % 9] = K[e][3 + k / 9][3 + k % 9];
		eigenvalues(9, A, values, V);
		for (int k = 0; k < 81; k++) {
			double expected = 0;
			for (int m = 0; m < 9; m++) expected += fmax(0, values[m]) * V[k / 9][m] * V[k % 9][m];
			// eigenvectors to 1e-15, eigenvalues accepted as zero down to 1e-12
			expect_near(D[e][3 + k / 9][3 + k % 9], expected, 1e-11 * largest(values, 9), "clamped dP/dF", &s, state);
		}
	}
	jn_arena_free(&s.arena);
}

static void definite_tangent_clamps_the_spectrum_of_the_exact_one(void** unused) {
	(void)unused;
	for (int row = 0; row < JN_SOLID_LAW_COUNT; row++) {
		const JnLaw* law = (const JnLaw*)jn_law_list.rows[row];
		for (int width = 2; width <= 8; width *= 2) {
			if (jn_kernel_find(JN_TET4, law, width) == NULL) continue;
			for (int state = 0; state < STATE_COUNT; state++) {
				if (is_defined(law, state)) check_spectrum(law, state, width);
			}
		}
	}
}

static void check_unchanged(Sample* s, State state) {
	static SampleMatrix K[SAMPLE_ELEMENTS], D[SAMPLE_ELEMENTS];
	if (state != STRETCHED) return;
	for (int k = 0; k < 3 * s->mesh.node_count; k++) s->x[k] = 1.1 * s->mesh.nodes[k]; // here all laws are convex
	sample_tangent(s, false, K);
	sample_tangent(s, true, D);
	for (int e = 0; e < SAMPLE_ELEMENTS; e++) {
		for (int k = 0; k < s->reals; k++) {
			for (int m = 0; m < s->reals; m++) expect_near(D[e][k][m], K[e][k][m], 0, "definite tangent", s, state);
		}
	}
}

static void definite_tangent_is_the_exact_one_where_that_is_definite(void** unused) {
	(void)unused;
	for_all_samples(check_unchanged);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(definite_tangent_has_no_negative_eigenvalue),
		cmocka_unit_test(definite_tangent_clamps_the_spectrum_of_the_exact_one),
		cmocka_unit_test(definite_tangent_is_the_exact_one_where_that_is_definite),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
