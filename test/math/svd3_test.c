// Signed singular values, polar rotations and symmetric eigenvectors of 3x3 matrices, lane by lane.
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "math/svd3.h"

static double random_real(uint64_t* seed) {
	*seed = *seed * 6364136223846793005u + 1442695040888963407u;
	return (double)(*seed >> 11) / (double)((uint64_t)1 << 52) - 1;
}

static void lane_of(const WideMat3* A, int lane, double out[3][3]) {
	for (int k = 0; k < 9; k++) out[k / 3][k % 3] = A->at[k / 3][k % 3][lane];
}

/// |A B^T - I|, largest entry.
static double distance_from_rotation(double A[3][3]) {
	double worst = fabs(mat3_determinant(A) - 1);
	for (int k = 0; k < 9; k++) {
		double dot = k % 4 == 0 ? -1 : 0;
		for (int i = 0; i < 3; i++) dot += A[k / 3][i] * A[k % 3][i];
		worst = fmax(worst, fabs(dot));
	}
	return worst;
}

/// Check F = U diag(s) V^T in every lane. 3e-15: some ten rotations, each with rounding 1e-16 of its column.
static void check(const WideMat3* F) {
	WideSvd3 svd;
	wide_svd3(F, &svd);
	for (int lane = 0; lane < JN_WIDE; lane++) {
		double A[3][3], U[3][3], V[3][3], norm = 0;
		const double s[3] = {svd.s[0][lane], svd.s[1][lane], svd.s[2][lane]};
		lane_of(F, lane, A);
		lane_of(&svd.U, lane, U);
		lane_of(&svd.V, lane, V);
		for (int k = 0; k < 9; k++) norm = fmax(norm, fabs(A[k / 3][k % 3]));
		for (int k = 0; k < 9; k++) {
			double sum = 0;
			for (int i = 0; i < 3; i++) sum += U[k / 3][i] * s[i] * V[k % 3][i];
			if (fabs(sum - A[k / 3][k % 3]) <= 6e-15 * norm) continue;
			fail_msg("entry %d is %.17g, expected %.17g, tolerance %.3g", k, sum, A[k / 3][k % 3], 6e-15 * norm);
		}
		assert_true(distance_from_rotation(U) < 6e-15 && distance_from_rotation(V) < 6e-15);
		const double slack = 1e-14 * norm;
		assert_true(s[0] >= s[1] - slack && s[1] >= fabs(s[2]) - slack && s[0] >= 0 && s[1] >= -slack);
		if (fabs(s[2]) > 1e-12 * norm) assert_true((mat3_determinant(A) < 0) == (s[2] < 0));
	}
}

static WideMat3 random_matrix(uint64_t* seed, double scale) {
	WideMat3 F;
	for (int k = 0; k < 9 * JN_WIDE; k++) F.at[k / 3 % 3][k % 3][k / 9] = scale * random_real(seed);
	return F;
}

static void random_matrices_are_taken_apart(void** unused) {
	(void)unused;
	uint64_t seed = 1;
	for (int i = 0; i < 20000; i++) {
		const WideMat3 F = random_matrix(&seed, pow(10, 100 * (i % 3 - 1)));
		check(&F);
	}
}

/// A = G diag(d) H^T with random G, H.
static WideMat3 graded(uint64_t* seed, double d0, double d1, double d2) {
	const WideMat3 G = random_matrix(seed, 1), H = random_matrix(seed, 1);
	const WideMat3 D = wide_mat3_diagonal(wide_set(d0), wide_set(d1), wide_set(d2)), GD = wide_mat3_multiply(&G, &D);
	return wide_mat3_multiply_transposed(&GD, &H);
}

static void graded_and_degenerate_matrices_are_taken_apart(void** unused) {
	(void)unused;
	uint64_t seed = 2;
	static const double d[][3] = {{1, 1, 0},        {1, 0, 0},           {0, 0, 0},
								  {1, 1e-8, 1e-16}, {1, 1e-3, -1e-3},    {1, 1e-20, 1e-30},
								  {1, 1e-150, 0},   {1e-200, 1e-210, 0}, {1, 1, 1e-15}};
	for (int i = 0; i < 9 * 500; i++) {
		const WideMat3 F = graded(&seed, d[i % 9][0], d[i % 9][1], d[i % 9][2]);
		check(&F);
	}
}

static void diagonal_and_repeated_values_are_taken_apart(void** unused) {
	(void)unused;
	static const double d[][3] = {{1, 1, 1}, {-1, -1, -1}, {1, 2, 3}, {0, 0, 5}, {0, -5, 0}, {2, 2, -2}, {-3, 0, 3}};
	for (int i = 0; i < 7; i++) {
		const WideMat3 F = wide_mat3_diagonal(wide_set(d[i][0]), wide_set(d[i][1]), wide_set(d[i][2]));
		check(&F);
		WideMat3 turned = F;
		wide_exchange_columns(&turned, 0, 2, wide_set(0) == wide_set(0));
		check(&turned);
	}
}

/// The polar rotation of S = I + e (symmetric) is I.
static void polar_rotation_of_a_symmetric_stretch_is_the_identity(void** unused) {
	(void)unused;
	uint64_t seed = 3;
	for (int i = 0; i < 3000; i++) {
		WideMat3 S = random_matrix(&seed, pow(10, -(i % 14)) * 0.3);
		for (int k = 0; k < 9; k++) {
			if (k / 3 > k % 3) S.at[k / 3][k % 3] = S.at[k % 3][k / 3];
			if (k % 4 == 0) S.at[k / 3][k / 3] += 1.0;
		}
		WideSvd3 svd;
		wide_svd3(&S, &svd);
		const WideMat3 R = wide_polar_rotation(&svd);
		for (int k = 0; k < 9 * JN_WIDE; k++) {
			// F's rounding 1e-16 turns R by 1e-16 / (s_i + s_j)
			assert_true(fabs(R.at[k / 3 % 3][k % 3][k / 9] - (k % 9 % 4 == 0)) < 1e-14);
		}
	}
}

static void eigenvectors_diagonalise_symmetric_matrices(void** unused) {
	(void)unused;
	uint64_t seed = 4;
	for (int i = 0; i < 10000; i++) {
		WideMat3 M = random_matrix(&seed, 1e6), V;
		for (int k = 0; k < 9; k++) {
			if (k / 3 > k % 3) M.at[k / 3][k % 3] = M.at[k % 3][k / 3];
		}
		Wide values[3];
		wide_eigen3(&M, values, &V);
		for (int lane = 0; lane < JN_WIDE; lane++) {
			double A[3][3], Q[3][3];
			lane_of(&M, lane, A);
			lane_of(&V, lane, Q);
			assert_true(distance_from_rotation(Q) < 6e-15);
			for (int k = 0; k < 9; k++) {
				double sum = -A[k / 3][k % 3];
				for (int m = 0; m < 3; m++) sum += Q[k / 3][m] * values[m][lane] * Q[k % 3][m];
				assert_true(fabs(sum) < 1e-14 * 1e6);
			}
		}
	}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(random_matrices_are_taken_apart),
		cmocka_unit_test(graded_and_degenerate_matrices_are_taken_apart),
		cmocka_unit_test(diagonal_and_repeated_values_are_taken_apart),
		cmocka_unit_test(polar_rotation_of_a_symmetric_stretch_is_the_identity),
		cmocka_unit_test(eigenvectors_diagonalise_symmetric_matrices),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
