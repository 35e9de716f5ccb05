/// @file mat3.h
/// 3x3 matrices, row by row: WideMat3 holds one matrix a lane; the plain double forms serve meshes and set-up.
#ifndef JN_MATH_MAT3_H
#define JN_MATH_MAT3_H

#include "math/wide.h"

typedef struct WideMat3 {
	Wide at[3][3];
} WideMat3;

/// a0 b0 + a1 b1 + a2 b2.
JN_INLINE Wide wide_dot3(Wide a0, Wide b0, Wide a1, Wide b1, Wide a2, Wide b2) {
	return wide_fma(a0, b0, wide_fma(a1, b1, a2 * b2));
}

/// a b - c d.
JN_INLINE Wide wide_minor(Wide a, Wide b, Wide c, Wide d) {
	return wide_fma(a, b, -(c * d));
}

JN_INLINE WideMat3 wide_mat3_diagonal(Wide a, Wide b, Wide c) {
	const Wide zero = wide_set(0);
	return (WideMat3){{{a, zero, zero}, {zero, b, zero}, {zero, zero, c}}};
}

/// A B.
JN_INLINE WideMat3 wide_mat3_multiply(const WideMat3* A, const WideMat3* B) {
	WideMat3 C;
	JN_UNROLL for (int i = 0; i < 9; i++) {
		const int r = i / 3, c = i % 3;
		C.at[r][c] = wide_dot3(A->at[r][0], B->at[0][c], A->at[r][1], B->at[1][c], A->at[r][2], B->at[2][c]);
	}
	return C;
}

/// A B^T.
JN_INLINE WideMat3 wide_mat3_multiply_transposed(const WideMat3* A, const WideMat3* B) {
	WideMat3 C;
	JN_UNROLL for (int i = 0; i < 9; i++) {
		const int r = i / 3, c = i % 3;
		C.at[r][c] = wide_dot3(A->at[r][0], B->at[c][0], A->at[r][1], B->at[c][1], A->at[r][2], B->at[c][2]);
	}
	return C;
}

/// A^T B.
JN_INLINE WideMat3 wide_mat3_transposed_multiply(const WideMat3* A, const WideMat3* B) {
	WideMat3 C;
	JN_UNROLL for (int i = 0; i < 9; i++) {
		const int r = i / 3, c = i % 3;
		C.at[r][c] = wide_dot3(A->at[0][r], B->at[0][c], A->at[1][r], B->at[1][c], A->at[2][r], B->at[2][c]);
	}
	return C;
}

/// A : B, the sum of products of entries.
JN_INLINE Wide wide_mat3_dot(const WideMat3* A, const WideMat3* B) {
	Wide sum = A->at[0][0] * B->at[0][0];
	JN_UNROLL for (int i = 1; i < 9; i++) sum = wide_fma(A->at[i / 3][i % 3], B->at[i / 3][i % 3], sum);
	return sum;
}

JN_INLINE Wide wide_mat3_trace(const WideMat3* A) {
	return A->at[0][0] + A->at[1][1] + A->at[2][2];
}

/// cof A = det(A) A^-T, which is also the derivative of det A.
JN_INLINE WideMat3 wide_mat3_cofactor(const WideMat3* A) {
	WideMat3 C;
	JN_UNROLL for (int i = 0; i < 9; i++) {
		const int r1 = (i / 3 + 1) % 3, r2 = (i / 3 + 2) % 3, c1 = (i % 3 + 1) % 3, c2 = (i % 3 + 2) % 3;
		C.at[i / 3][i % 3] = wide_minor(A->at[r1][c1], A->at[r2][c2], A->at[r1][c2], A->at[r2][c1]);
	}
	return C;
}

/// det A, given C = cof A.
JN_INLINE Wide wide_mat3_determinant(const WideMat3* A, const WideMat3* C) {
	return wide_dot3(A->at[0][0], C->at[0][0], A->at[0][1], C->at[0][1], A->at[0][2], C->at[0][2]);
}

// A is read only; C17 does not let a double[3][3] pass as const.

/// Entry (r, c) of cof A.
static inline double mat3_cofactor(double A[3][3], int r, int c) {
	const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
	return A[r1][c1] * A[r2][c2] - A[r1][c2] * A[r2][c1];
}

static inline double mat3_determinant(double A[3][3]) {
	return A[0][0] * mat3_cofactor(A, 0, 0) + A[0][1] * mat3_cofactor(A, 0, 1) + A[0][2] * mat3_cofactor(A, 0, 2);
}

/// B = A^-1; infinite or NAN when A is singular. Returns det A.
static inline double mat3_invert(double A[3][3], double B[3][3]) {
	const double determinant = mat3_determinant(A);
	for (int r = 0; r < 3; r++)
		for (int c = 0; c < 3; c++) B[r][c] = mat3_cofactor(A, c, r) / determinant;
	return determinant;
}

#endif
