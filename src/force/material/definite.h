// The definite tangent of an isotropic law: eigenvalues of dP/dF clamped to zero. In the frame of F = U diag(s) V^T the
// tangent at diag(s) falls apart (Smith, de Goes, Kim 2019) into one 3x3 block for the stretches and, for each pair of
// axes, a 2x2 block [[p, q], [q, p]] with eigenvalues p + q and p - q, so nothing is divided by a difference of stretches.
// Lanes whose tangent is already positive semidefinite keep it, bit for bit.
#ifndef JN_FORCE_MATERIAL_DEFINITE_H
#define JN_FORCE_MATERIAL_DEFINITE_H

#include "force/material/law.h"
#include "math/svd3.h"

/// Lanes whose eigenvalues are all above -1e-12 of the sum of their magnitudes on the diagonal: the Cholesky pivots of
/// the shifted A are positive.
JN_SHARED WideMask is_semidefinite(const WideTangent* A) {
	Wide sum = wide_set(0);
	JN_UNROLL for (int i = 0; i < 9; i++) sum += wide_abs(A->at[i][i]);
	const Wide shift = 1e-12 * sum;
	WideTangent L = *A;
	WideMask positive = sum < INFINITY;
	JN_UNROLL for (int k = 0; k < 9; k++) {
		const Wide pivot = L.at[k][k] + shift;
		positive &= pivot > 0.0;
		const Wide inverse = 1.0 / pivot;
		for (int i = k + 1; i < 9; i++) {
			const Wide factor = -inverse * L.at[i][k];
			for (int j = k + 1; j <= i; j++) L.at[i][j] = wide_fma(factor, L.at[j][k], L.at[i][j]);
		}
	}
	return positive;
}

/// The eigenpairs that live on the stretches: modes sum_i e_i u_i v_i^T with e from the 3x3 block of B.
JN_INLINE void stretch_modes(const WideTangent* B, const WideSvd3* svd, Wide value[3], Wide mode[3][9]) {
	const WideMat3 block = {{{B->at[0][0], B->at[4][0], B->at[8][0]},
							 {B->at[4][0], B->at[4][4], B->at[8][4]},
							 {B->at[8][0], B->at[8][4], B->at[8][8]}}};
	WideMat3 e;
	wide_eigen3(&block, value, &e);
	for (int k = 0; k < 3; k++) {
		for (int a = 0; a < 3; a++) {
			const Wide w0 = e.at[0][k] * svd->U.at[a][0], w1 = e.at[1][k] * svd->U.at[a][1],
					   w2 = e.at[2][k] * svd->U.at[a][2];
			for (int c = 0; c < 3; c++) {
				mode[k][3 * a + c] = wide_dot3(w0, svd->V.at[c][0], w1, svd->V.at[c][1], w2, svd->V.at[c][2]);
			}
		}
	}
}

/// The eigenpairs of axes i and j: modes u_i v_j^T +- u_j v_i^T, whose squared length 2 is taken out of the value.
JN_INLINE void shear_modes(const WideTangent* B, const WideSvd3* svd, int i, int j, Wide value[2], Wide mode[2][9]) {
	const Wide p = B->at[3 * i + j][3 * i + j], q = B->at[3 * j + i][3 * i + j];
	value[0] = 0.5 * (p + q);
	value[1] = 0.5 * (p - q);
	for (int ac = 0; ac < 9; ac++) {
		const Wide ij = svd->U.at[ac / 3][i] * svd->V.at[ac % 3][j], ji = svd->U.at[ac / 3][j] * svd->V.at[ac % 3][i];
		mode[0][ac] = ij + ji;
		mode[1][ac] = ij - ji;
	}
}

/// Replace A, in the lanes that are not `kept`, by the clamped tangent whose principal form is B.
JN_SHARED void clamp_tangent(const WideTangent* B, const WideSvd3* svd, WideMask kept, WideTangent* A) {
	Wide value[9], mode[9][9], scaled[9][9];
	stretch_modes(B, svd, value, mode);
	shear_modes(B, svd, 0, 1, value + 3, mode + 3);
	shear_modes(B, svd, 0, 2, value + 5, mode + 5);
	shear_modes(B, svd, 1, 2, value + 7, mode + 7);
	for (int k = 0; k < 9; k++) {
		const Wide clamped = wide_select(value[k] < 0.0, wide_set(0), value[k]);
		for (int ac = 0; ac < 9; ac++) scaled[k][ac] = clamped * mode[k][ac];
	}
	for (int ac = 0; ac < 9; ac++) {
		for (int bd = 0; bd <= ac; bd++) {
			Wide sum = scaled[0][ac] * mode[0][bd];
			JN_UNROLL for (int k = 1; k < 9; k++) sum = wide_fma(scaled[k][ac], mode[k][bd], sum);
			A->at[ac][bd] = wide_select(kept, A->at[ac][bd], sum);
		}
	}
}

/// The law's tangent with its negative eigenvalues clamped; `tangent` is one compiled function of the law.
JN_INLINE void definite_tangent(const double* constants, const WideMat3* F, WideTangent* A, WideTangentOf* tangent) {
	tangent(constants, NULL, F, A);
	const WideMask kept = is_semidefinite(A);
	if (!wide_any(~kept)) return;
	WideSvd3 svd;
	wide_svd3(F, &svd);
	const WideMat3 stretches = wide_mat3_diagonal(svd.s[0], svd.s[1], svd.s[2]);
	WideTangent B;
	tangent(constants, NULL, &stretches, &B);
	clamp_tangent(&B, &svd, kept, A);
}

#endif
