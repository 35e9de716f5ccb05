// Linear elasticity: e = sym(F - I), Psi = mu e:e + lambda/2 tr(e)^2, P = 2 mu e + lambda tr(e) I.
// For small displacements and rotations only; not invariant under rotation.
#ifndef JN_FORCE_MATERIAL_LINEAR_H
#define JN_FORCE_MATERIAL_LINEAR_H

#include "force/material/law.h"

/// sym(A) - I.
JN_INLINE WideMat3 small_strain(const WideMat3* A) {
	WideMat3 e;
	JN_UNROLL for (int i = 0; i < 9; i++) {
		const int r = i / 3, c = i % 3;
		e.at[r][c] = r == c ? A->at[r][r] - 1.0 : 0.5 * (A->at[r][c] + A->at[c][r]);
	}
	return e;
}

/// mu e:e + lambda/2 tr(e)^2.
JN_INLINE Wide hooke_energy(const double* constants, const WideMat3* e) {
	const Wide trace = wide_mat3_trace(e);
	return constants[JN_LAW_MU] * wide_mat3_dot(e, e) + 0.5 * constants[JN_LAW_LAMBDA] * trace * trace;
}

/// 2 mu e + lambda tr(e) I.
JN_INLINE WideMat3 hooke_stress(const double* constants, const WideMat3* e) {
	const Wide pressure = constants[JN_LAW_LAMBDA] * wide_mat3_trace(e), zero = wide_set(0);
	const Wide twice_mu = wide_set(2.0 * constants[JN_LAW_MU]);
	WideMat3 S;
	JN_UNROLL for (int i = 0; i < 9; i++) {
		S.at[i / 3][i % 3] = wide_fma(twice_mu, e->at[i / 3][i % 3], i % 4 == 0 ? pressure : zero);
	}
	return S;
}

JN_INLINE Wide linear_energy(const double* constants, const double* frozen, const WideMat3* F) {
	(void)frozen;
	const WideMat3 e = small_strain(F);
	return hooke_energy(constants, &e);
}

JN_INLINE void linear_stress(const double* constants, const double* frozen, const WideMat3* F, WideMat3* P) {
	(void)frozen;
	const WideMat3 e = small_strain(F);
	*P = hooke_stress(constants, &e);
}

/// A[ac][bd] = mu (d_ab d_cd + d_ad d_bc) + lambda d_ac d_bd.
JN_INLINE void linear_tangent(const double* constants, const double* frozen, const WideMat3* F, WideTangent* A) {
	(void)frozen, (void)F;
	const double mu = constants[JN_LAW_MU], lambda = constants[JN_LAW_LAMBDA];
	JN_EACH_TANGENT_ENTRY(
		{ A->at[ac][bd] = wide_set(mu * ((a == b && c == d) + (a == d && b == c)) + lambda * (a == c && b == d)); })
}

#endif
