// Corotated linear elasticity with the rotation R of each point frozen at the start of a step (Mueller, Gross 2004):
//   e = sym(R^T F - I),  Psi = mu e:e + lambda/2 tr(e)^2,  P = R (2 mu e + lambda tr(e) I).
// Linear in F until the next freeze. R is the polar rotation, with det R = +1 for inverted elements too.
#ifndef JN_FORCE_MATERIAL_COROTATED_FROZEN_H
#define JN_FORCE_MATERIAL_COROTATED_FROZEN_H

#include "force/material/hooke.h"
#include "math/svd3.h"

JN_INLINE WideMat3 frozen_rotation(const double* frozen) {
	WideMat3 R;
	JN_UNROLL for (int i = 0; i < 9; i++) R.at[i / 3][i % 3] = wide_load(frozen + i * JN_WIDE);
	return R;
}

JN_INLINE void corotated_frozen_freeze(double* frozen, const WideMat3* F) {
	WideSvd3 svd;
	wide_svd3(F, &svd);
	const WideMat3 R = wide_polar_rotation(&svd);
	JN_UNROLL for (int i = 0; i < 9; i++) wide_store(frozen + i * JN_WIDE, R.at[i / 3][i % 3]);
}

JN_INLINE Wide corotated_frozen_energy(const double* constants, const double* frozen, const WideMat3* F) {
	const WideMat3 R = frozen_rotation(frozen), RtF = wide_mat3_transposed_multiply(&R, F), e = small_strain(&RtF);
	return hooke_energy(constants, &e);
}

JN_INLINE void corotated_frozen_stress(const double* constants, const double* frozen, const WideMat3* F, WideMat3* P) {
	const WideMat3 R = frozen_rotation(frozen), RtF = wide_mat3_transposed_multiply(&R, F), e = small_strain(&RtF);
	const WideMat3 S = hooke_stress(constants, &e);
	*P = wide_mat3_multiply(&R, &S);
}

enum { corotated_frozen_STORED = 9 };

JN_INLINE void corotated_frozen_linearize(const double* constants, const double* frozen, const WideMat3* F,
										  Wide stored[]) {
	(void)constants, (void)F;
	const WideMat3 R = frozen_rotation(frozen);
	store_mat3(&R, stored);
}

/// A[ac][bd] = mu (d_ab d_cd + R_ad R_bc) + lambda R_ac R_bd.
JN_INLINE void corotated_frozen_tangent(const double* constants, const double* frozen, const WideMat3* F,
										WideTangent* A) {
	(void)F;
	const WideMat3 R = frozen_rotation(frozen);
	const Wide mu = wide_set(constants[JN_LAW_MU]), lambda = wide_set(constants[JN_LAW_LAMBDA]);
	JN_EACH_TANGENT_ENTRY({
		const Wide entry = wide_fma(mu, R.at[a][d] * R.at[b][c], lambda * R.at[a][c] * R.at[b][d]);
		A->at[ac][bd] = a == b && c == d ? entry + mu : entry;
	})
}

#endif
