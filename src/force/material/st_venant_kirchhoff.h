// St Venant-Kirchhoff: E = (F^T F - I)/2, Psi = mu E:E + lambda/2 tr(E)^2, P = F S with S = 2 mu E + lambda tr(E) I.
// Large rotations, small strains; softens and collapses under strong compression.
#ifndef JN_FORCE_MATERIAL_ST_VENANT_KIRCHHOFF_H
#define JN_FORCE_MATERIAL_ST_VENANT_KIRCHHOFF_H

#include "force/material/hooke.h"

JN_INLINE WideMat3 green_strain(const WideMat3* F) {
	WideMat3 E = wide_mat3_transposed_multiply(F, F);
	JN_UNROLL for (int i = 0; i < 9; i++) {
		E.at[i / 3][i % 3] = i % 4 == 0 ? 0.5 * (E.at[i / 3][i % 3] - 1.0) : 0.5 * E.at[i / 3][i % 3];
	}
	return E;
}

JN_INLINE Wide st_venant_kirchhoff_energy(const double* constants, const double* frozen, const WideMat3* F) {
	(void)frozen;
	const WideMat3 E = green_strain(F);
	return hooke_energy(constants, &E);
}

JN_INLINE void st_venant_kirchhoff_stress(const double* constants, const double* frozen, const WideMat3* F,
										  WideMat3* P) {
	(void)frozen;
	const WideMat3 E = green_strain(F), S = hooke_stress(constants, &E);
	*P = wide_mat3_multiply(F, &S);
}

enum { st_venant_kirchhoff_STORED = 15 };

JN_INLINE void st_venant_kirchhoff_linearize(const double* constants, const double* frozen, const WideMat3* F,
											 Wide stored[]) {
	(void)frozen;
	const WideMat3 E = green_strain(F), S = hooke_stress(constants, &E);
	store_mat3(F, stored);
	store_symmetric(&S, stored + 9);
}

/// A[ac][bd] = d_ab S_cd + mu ((F F^T)_ab d_cd + F_ad F_bc) + lambda F_ac F_bd.
JN_INLINE void st_venant_kirchhoff_tangent(const double* constants, const double* frozen, const WideMat3* F,
										   WideTangent* A) {
	(void)frozen;
	const Wide mu = wide_set(constants[JN_LAW_MU]), lambda = wide_set(constants[JN_LAW_LAMBDA]);
	const WideMat3 E = green_strain(F), S = hooke_stress(constants, &E), FFt = wide_mat3_multiply_transposed(F, F);
	JN_EACH_TANGENT_ENTRY({
		Wide entry = wide_fma(mu, F->at[a][d] * F->at[b][c], lambda * F->at[a][c] * F->at[b][d]);
		if (a == b) entry += S.at[c][d];
		if (c == d) entry = wide_fma(mu, FFt.at[a][b], entry);
		A->at[ac][bd] = entry;
	})
}

#endif
