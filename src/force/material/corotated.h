// Corotated linear elasticity with the rotation followed: F = R S = U diag(s) V^T, R = U V^T (det R = +1),
//   Psi = mu |F - R|^2 + lambda/2 tr(S - I)^2,  P = 2 mu (F - R) + lambda tr(S - I) R.
// dR = sum over i < j of 2/(s_i + s_j) t_ij (t_ij : dF), t_ij = (u_i v_j^T - u_j v_i^T)/sqrt(2): R jumps where
// s_i + s_j = 0 (an inverted element with two equal stretches), where the tangent is kept finite by a floor.
#ifndef JN_FORCE_MATERIAL_COROTATED_H
#define JN_FORCE_MATERIAL_COROTATED_H

#include "force/material/law.h"
#include "math/svd3.h"

/// Least s_i + s_j in the tangent; stretches are pure numbers near 1.
#define COROTATED_FLOOR 1e-6

JN_INLINE Wide stretch_trace(const WideSvd3* svd) {
	return (svd->s[0] - 1.0) + (svd->s[1] - 1.0) + (svd->s[2] - 1.0);
}

JN_INLINE Wide corotated_energy(const double* constants, const double* frozen, const WideMat3* F) {
	(void)frozen;
	WideSvd3 svd;
	wide_svd3(F, &svd);
	const Wide e0 = svd.s[0] - 1.0, e1 = svd.s[1] - 1.0, e2 = svd.s[2] - 1.0, trace = e0 + e1 + e2;
	return constants[JN_LAW_MU] * wide_dot3(e0, e0, e1, e1, e2, e2) + 0.5 * constants[JN_LAW_LAMBDA] * trace * trace;
}

JN_INLINE void corotated_stress(const double* constants, const double* frozen, const WideMat3* F, WideMat3* P) {
	(void)frozen;
	WideSvd3 svd;
	wide_svd3(F, &svd);
	const WideMat3 R = wide_polar_rotation(&svd);
	const Wide twice_mu = wide_set(2.0 * constants[JN_LAW_MU]);
	const Wide pressure = constants[JN_LAW_LAMBDA] * stretch_trace(&svd);
	JN_UNROLL for (int i = 0; i < 9; i++) {
		const Wide r = R.at[i / 3][i % 3];
		P->at[i / 3][i % 3] = wide_fma(twice_mu, F->at[i / 3][i % 3] - r, pressure * r);
	}
}

enum { corotated_STORED = 15 };

/// R and G = sum over k of (lambda tr(S - I) - 2 mu)/(s_i + s_j) v_k v_k^T.
JN_INLINE void corotated_linearize(const double* constants, const double* frozen, const WideMat3* F, Wide stored[]) {
	(void)frozen;
	WideSvd3 svd;
	wide_svd3(F, &svd);
	const WideMat3 R = wide_polar_rotation(&svd), *V = &svd.V;
	const Wide of_turn = constants[JN_LAW_LAMBDA] * stretch_trace(&svd) - wide_set(2.0 * constants[JN_LAW_MU]);
	WideMat3 G, scaled;
	JN_UNROLL for (int k = 0; k < 3; k++) {
		const Wide scale = of_turn / wide_max(svd.s[(k + 1) % 3] + svd.s[(k + 2) % 3], wide_set(COROTATED_FLOOR));
		JN_UNROLL for (int a = 0; a < 3; a++) scaled.at[a][k] = scale * V->at[a][k];
	}
	G = wide_mat3_multiply_transposed(&scaled, V);
	store_mat3(&R, stored);
	store_symmetric(&G, stored + 9);
}

/// A = 2 mu I + lambda R (x) R + (lambda tr(S - I) - 2 mu) dR/dF.
JN_INLINE void corotated_tangent(const double* constants, const double* frozen, const WideMat3* F, WideTangent* A) {
	(void)frozen;
	WideSvd3 svd;
	wide_svd3(F, &svd);
	const WideMat3 R = wide_polar_rotation(&svd), *U = &svd.U, *V = &svd.V;
	const Wide twice_mu = wide_set(2.0 * constants[JN_LAW_MU]), lambda = wide_set(constants[JN_LAW_LAMBDA]);
	const Wide of_turn = lambda * stretch_trace(&svd) - twice_mu;
	Wide turn[3][9], scaled[3][9];
	JN_UNROLL for (int k = 0; k < 3; k++) {
		const int i = (k + 1) % 3, j = (k + 2) % 3;
		const Wide scale = of_turn / wide_max(svd.s[i] + svd.s[j], wide_set(COROTATED_FLOOR));
		JN_UNROLL for (int ac = 0; ac < 9; ac++) {
			turn[k][ac] = wide_minor(U->at[ac / 3][i], V->at[ac % 3][j], U->at[ac / 3][j], V->at[ac % 3][i]);
			scaled[k][ac] = scale * turn[k][ac];
		}
	}
	JN_EACH_TANGENT_ENTRY({
		const Wide turns =
			wide_dot3(scaled[0][ac], turn[0][bd], scaled[1][ac], turn[1][bd], scaled[2][ac], turn[2][bd]);
		const Wide entry = wide_fma(lambda, R.at[a][c] * R.at[b][d], turns);
		A->at[ac][bd] = a == b && c == d ? entry + twice_mu : entry;
	})
}

#endif
