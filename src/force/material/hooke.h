// Hooke's law of a strain e: Psi = mu e:e + lambda/2 tr(e)^2, stress 2 mu e + lambda tr(e) I.
#ifndef JN_FORCE_MATERIAL_HOOKE_H
#define JN_FORCE_MATERIAL_HOOKE_H

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

#endif
