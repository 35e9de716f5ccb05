// Compressible Neo-Hookean solid: Psi = mu/2 (I_C - 3) - mu ln J + lambda/2 (ln J)^2, I_C = F:F, J = det F
// (Bonet, Wood 2008, section 6.4.3). P = mu (F - H) + lambda ln J H with H = F^-T = cof F / J.
// Defined for J > 0 only: the energy is infinite and the stress not a number for inverted elements.
#ifndef JN_FORCE_MATERIAL_NEO_HOOKEAN_H
#define JN_FORCE_MATERIAL_NEO_HOOKEAN_H

#include "force/material/law.h"
#include "math/wide_logarithm.h"

JN_INLINE Wide neo_hookean_energy(const double* constants, const double* frozen, const WideMat3* F) {
	(void)frozen;
	const WideMat3 C = wide_mat3_cofactor(F);
	const Wide J = wide_mat3_determinant(F, &C), log_J = wide_log(J);
	const Wide energy = constants[JN_LAW_MU] * (0.5 * (wide_mat3_dot(F, F) - 3.0) - log_J) +
						0.5 * constants[JN_LAW_LAMBDA] * log_J * log_J;
	return wide_select(J <= 0.0, wide_set(INFINITY), energy);
}

JN_INLINE void neo_hookean_stress(const double* constants, const double* frozen, const WideMat3* F, WideMat3* P) {
	(void)frozen;
	const WideMat3 C = wide_mat3_cofactor(F);
	const Wide J = wide_mat3_determinant(F, &C);
	const Wide mu = wide_set(constants[JN_LAW_MU]);
	const Wide of_cofactor = (constants[JN_LAW_LAMBDA] * wide_log(J) - mu) / J;
	JN_UNROLL for (int i = 0; i < 9; i++) {
		P->at[i / 3][i % 3] = wide_fma(of_cofactor, C.at[i / 3][i % 3], mu * F->at[i / 3][i % 3]);
	}
}

enum { neo_hookean_STORED = 10 };

JN_INLINE void neo_hookean_linearize(const double* constants, const double* frozen, const WideMat3* F, Wide stored[]) {
	(void)frozen;
	const WideMat3 C = wide_mat3_cofactor(F);
	const Wide J = wide_mat3_determinant(F, &C), inverse = 1.0 / J;
	JN_UNROLL for (int i = 0; i < 9; i++) stored[i] = C.at[i / 3][i % 3] * inverse;
	stored[9] = constants[JN_LAW_MU] - constants[JN_LAW_LAMBDA] * wide_log(J);
}

/// A[ac][bd] = mu d_ab d_cd + (mu - lambda ln J) H_ad H_bc + lambda H_ac H_bd.
JN_INLINE void neo_hookean_tangent(const double* constants, const double* frozen, const WideMat3* F, WideTangent* A) {
	(void)frozen;
	const WideMat3 C = wide_mat3_cofactor(F);
	const Wide J = wide_mat3_determinant(F, &C), inverse = 1.0 / J;
	const Wide mu = wide_set(constants[JN_LAW_MU]), lambda = wide_set(constants[JN_LAW_LAMBDA]);
	const Wide crossed = mu - lambda * wide_log(J);
	WideMat3 H;
	JN_UNROLL for (int i = 0; i < 9; i++) H.at[i / 3][i % 3] = C.at[i / 3][i % 3] * inverse;
	JN_EACH_TANGENT_ENTRY({
		const Wide entry = wide_fma(crossed, H.at[a][d] * H.at[b][c], lambda * H.at[a][c] * H.at[b][d]);
		A->at[ac][bd] = a == b && c == d ? entry + mu : entry;
	})
}

#endif
