/// @file svd3.h
/// Signed singular values F = U diag(s) V^T of 3x3 matrices, with det U = det V = +1 and |s0| >= |s1| >= |s2|, where only
/// s2 may be negative; and eigenvectors of symmetric 3x3 matrices. One-sided and two-sided cyclic Jacobi rotations
/// (Golub, Van Loan, section 8.6). No lane branches: a converged lane turns by the angle 0, which changes no bit, so
/// that leaving early when all lanes have converged does not make a lane depend on its neighbours.
#ifndef JN_MATH_SVD3_H
#define JN_MATH_SVD3_H

#include "math/mat3.h"

typedef struct WideSvd3 {
	WideMat3 U, V;
	Wide s[3];
} WideSvd3;

/// Mostly 3 to 5 sweeps are needed; the rest is a reserve for clustered values.
enum { JN_JACOBI_SWEEPS = 12 };

typedef struct WideTurn {
	Wide c, s; ///< cosine and sine, exactly of length 1 up to rounding
} WideTurn;

/// The turn that makes [[a, g], [g, b]] nearly diagonal, d = b - a; none where `done`. The half angle is g/(2 d), or
/// pi/8 when that is larger (McAdams et al. 2011): an error of third order in the angle, for a single division.
JN_INLINE WideTurn wide_jacobi_turn(Wide d, Wide g, WideMask done) {
	const double cos_pi_8 = 0.92387953251128675613, sin_pi_8 = 0.38268343236508977173;
	Wide ch = 2.0 * wide_abs(d), sh = wide_copy_sign(wide_set(1), d) * g;
	const WideMask is_small = 5.8284271247461900976 * sh * sh < ch * ch; // 1/tan(pi/8)^2
	ch = wide_select(is_small, ch, wide_set(cos_pi_8));
	sh = wide_select(is_small, sh, wide_copy_sign(wide_set(sin_pi_8), sh));
	ch = wide_select(done, wide_set(1), ch);
	sh = wide_select(done, wide_set(0), sh);
	const Wide inverse = 1.0 / wide_fma(ch, ch, sh * sh);
	return (WideTurn){wide_minor(ch, ch, sh, sh) * inverse, 2.0 * ch * sh * inverse};
}

/// Turn columns p and q of A by the angle with cosine c and sine s.
JN_INLINE void wide_turn_columns(WideMat3* A, int p, int q, Wide c, Wide s) {
	JN_UNROLL for (int r = 0; r < 3; r++) {
		const Wide ap = A->at[r][p], aq = A->at[r][q];
		A->at[r][p] = wide_minor(c, ap, s, aq);
		A->at[r][q] = wide_fma(s, ap, c * aq);
	}
}

JN_INLINE Wide wide_column_dot(const WideMat3* A, int p, int q) {
	return wide_dot3(A->at[0][p], A->at[0][q], A->at[1][p], A->at[1][q], A->at[2][p], A->at[2][q]);
}

/// Make columns p and q of B = F V orthogonal to 1e-15 of their lengths. Returns the lanes that had to turn.
JN_INLINE WideMask wide_orthogonalise(WideMat3* B, WideMat3* V, int p, int q) {
	const Wide a = wide_column_dot(B, p, p), b = wide_column_dot(B, q, q), g = wide_column_dot(B, p, q);
	const WideMask done = (g * g <= 1e-30 * a * b) | (a + b < 1e-120); // nothing against the longest entry, 1
	const WideTurn turn = wide_jacobi_turn(b - a, g, done);
	wide_turn_columns(B, p, q, turn.c, turn.s);
	wide_turn_columns(V, p, q, turn.c, turn.s);
	return ~done;
}

/// Exchange columns p and q of A in the lanes of the mask, negating one so that det A stays.
JN_INLINE void wide_exchange_columns(WideMat3* A, int p, int q, WideMask mask) {
	JN_UNROLL for (int r = 0; r < 3; r++) {
		const Wide ap = A->at[r][p], aq = A->at[r][q];
		A->at[r][p] = wide_select(mask, aq, ap);
		A->at[r][q] = wide_select(mask, -ap, aq);
	}
}

JN_INLINE void wide_sort_columns(WideMat3* B, WideMat3* V, int p, int q) {
	const WideMask wrong = wide_column_dot(B, p, p) < wide_column_dot(B, q, q);
	wide_exchange_columns(B, p, q, wrong);
	wide_exchange_columns(V, p, q, wrong);
}

/// Column k of U = `direction` made a unit vector, or `spare` where it vanishes (the longest entry of F counts as 1).
JN_INLINE void wide_normalise_column(WideMat3* U, int k, const Wide direction[3], const Wide spare[3]) {
	const Wide* d = direction;
	const Wide square = wide_dot3(d[0], d[0], d[1], d[1], d[2], d[2]);
	const WideMask vanishes = square < 1e-240;
	const Wide scale = 1.0 / wide_sqrt(square);
	JN_UNROLL for (int r = 0; r < 3; r++) U->at[r][k] = wide_select(vanishes, spare[r], d[r] * scale);
}

/// A unit vector across column 0 of U (Duff et al. 2017, Building an orthonormal basis, revisited).
JN_INLINE void wide_across(const WideMat3* U, Wide across[3]) {
	const Wide x = U->at[0][0], y = U->at[1][0], z = U->at[2][0], sign = wide_copy_sign(wide_set(1), z);
	const Wide a = -1.0 / (sign + z);
	across[0] = 1.0 + sign * x * x * a;
	across[1] = sign * x * y * a;
	across[2] = -sign * x;
}

/// U from the columns of B by Gram-Schmidt, the second column taken twice.
JN_INLINE void wide_complete_rotation(const WideMat3* B, WideMat3* U) {
	const Wide first[3] = {B->at[0][0], B->at[1][0], B->at[2][0]};
	const Wide axis[3] = {wide_set(1), wide_set(0), wide_set(0)};
	wide_normalise_column(U, 0, first, axis);
	Wide across[3], second[3] = {B->at[0][1], B->at[1][1], B->at[2][1]};
	wide_across(U, across);
	JN_UNROLL for (int pass = 0; pass < 2; pass++) {
		const Wide along = wide_dot3(U->at[0][0], second[0], U->at[1][0], second[1], U->at[2][0], second[2]);
		JN_UNROLL for (int r = 0; r < 3; r++) second[r] = wide_fma(-along, U->at[r][0], second[r]);
	}
	wide_normalise_column(U, 1, second, across);
	JN_UNROLL for (int r = 0; r < 3; r++) {
		const int r1 = (r + 1) % 3, r2 = (r + 2) % 3;
		U->at[r][2] = wide_minor(U->at[r1][0], U->at[r2][1], U->at[r2][0], U->at[r1][1]);
	}
}

/// F = U diag(s) V^T. Finite for every finite F below 1e300, the zero matrix included.
JN_SHARED void wide_svd3(const WideMat3* F, WideSvd3* svd) {
	Wide largest = wide_set(0);
	JN_UNROLL for (int i = 0; i < 9; i++) largest = wide_max(largest, wide_abs(F->at[i / 3][i % 3]));
	const Wide scale = 1.0 / wide_max(largest, wide_set(1e-300));
	WideMat3 B, V = wide_mat3_diagonal(wide_set(1), wide_set(1), wide_set(1));
	JN_UNROLL for (int i = 0; i < 9; i++) B.at[i / 3][i % 3] = F->at[i / 3][i % 3] * scale;
	for (int sweep = 0; sweep < JN_JACOBI_SWEEPS; sweep++) {
		WideMask turned = wide_orthogonalise(&B, &V, 0, 1);
		turned |= wide_orthogonalise(&B, &V, 0, 2);
		turned |= wide_orthogonalise(&B, &V, 1, 2);
		if (!wide_any(turned)) break;
	}
	wide_sort_columns(&B, &V, 0, 1);
	wide_sort_columns(&B, &V, 0, 2);
	wide_sort_columns(&B, &V, 1, 2);
	wide_complete_rotation(&B, &svd->U);
	svd->V = V;
	JN_UNROLL for (int k = 0; k < 3; k++) {
		const WideMat3* U = &svd->U;
		svd->s[k] = largest * wide_dot3(U->at[0][k], B.at[0][k], U->at[1][k], B.at[1][k], U->at[2][k], B.at[2][k]);
	}
}

/// The polar rotation R = U V^T, the rotation nearest to F; det R = +1 for inverted F too.
JN_INLINE WideMat3 wide_polar_rotation(const WideSvd3* svd) {
	return wide_mat3_multiply_transposed(&svd->U, &svd->V);
}

/// Turn rows and columns p and q of the symmetric M, with r the third index. Returns the lanes that had to turn.
JN_INLINE WideMask wide_diagonalise(WideMat3* M, WideMat3* V, int p, int q, int r, Wide threshold) {
	const Wide a = M->at[p][p], b = M->at[q][q], g = M->at[q][p], rp = M->at[r][p], rq = M->at[r][q];
	const WideMask done = g * g <= threshold;
	const WideTurn turn = wide_jacobi_turn(b - a, g, done);
	const Wide c = turn.c, s = turn.s, change = wide_fma(s * s, b - a, -2.0 * (c * s) * g);
	M->at[p][p] = a + change;
	M->at[q][q] = b - change;
	M->at[q][p] = M->at[p][q] = wide_minor(wide_minor(c, c, s, s), g, c * s, b - a);
	M->at[r][p] = M->at[p][r] = wide_minor(c, rp, s, rq);
	M->at[r][q] = M->at[q][r] = wide_fma(s, rp, c * rq);
	wide_turn_columns(V, p, q, c, s);
	return ~done;
}

/// Eigenvalues and eigenvectors (columns of V) of the symmetric M, to 1e-16 of its norm.
JN_SHARED void wide_eigen3(const WideMat3* matrix, Wide values[3], WideMat3* V) {
	WideMat3 M = *matrix;
	const Wide threshold = 1e-33 * wide_mat3_dot(&M, &M);
	*V = wide_mat3_diagonal(wide_set(1), wide_set(1), wide_set(1));
	for (int sweep = 0; sweep < JN_JACOBI_SWEEPS; sweep++) {
		WideMask turned = wide_diagonalise(&M, V, 0, 1, 2, threshold);
		turned |= wide_diagonalise(&M, V, 0, 2, 1, threshold);
		turned |= wide_diagonalise(&M, V, 1, 2, 0, threshold);
		if (!wide_any(turned)) break;
	}
	JN_UNROLL for (int k = 0; k < 3; k++) values[k] = M.at[k][k];
}

#endif
