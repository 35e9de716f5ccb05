// Stable Neo-Hookean solid (Smith, de Goes, Kim 2018), finite for inverted and flat elements:
//   Psi = m/2 (I_C - 3) + l/2 (J - alpha)^2 - m/2 ln(I_C + 1) - Psi_0,   I_C = F:F,  J = det F,  Psi(I) = 0
//   P = m (1 - 1/(I_C + 1)) F + l (J - alpha) cof F
// with m = 4/3 mu, l = lambda + 5/6 mu, alpha = 1 + 3/4 m/l, so that it linearises to Hooke with mu and lambda.
#ifndef JN_FORCE_MATERIAL_STABLE_NEO_HOOKEAN_H
#define JN_FORCE_MATERIAL_STABLE_NEO_HOOKEAN_H

#include "force/material/law.h"
#include "math/wide_logarithm.h"

enum { STABLE_M = JN_LAW_OWN, STABLE_L, STABLE_ALPHA };

JN_INLINE Wide stable_neo_hookean_energy(const double* constants, const double* frozen, const WideMat3* F) {
	(void)frozen;
	const double m = constants[STABLE_M], l = constants[STABLE_L], alpha = constants[STABLE_ALPHA];
	const WideMat3 C = wide_mat3_cofactor(F);
	const Wide J = wide_mat3_determinant(F, &C), I_C = wide_mat3_dot(F, F);
	// (J - alpha)^2 - (1 - alpha)^2 = (J - 1)(J + 1 - 2 alpha), and ln(I_C + 1) - ln 4: Psi_0 without cancellation
	return 0.5 * m * ((I_C - 3.0) - wide_logarithm(0.25 * (I_C + 1.0))) +
		   0.5 * l * (J - 1.0) * (J + (1.0 - 2.0 * alpha));
}

JN_INLINE void stable_neo_hookean_stress(const double* constants, const double* frozen, const WideMat3* F,
										 WideMat3* P) {
	(void)frozen;
	const double m = constants[STABLE_M], l = constants[STABLE_L], alpha = constants[STABLE_ALPHA];
	const WideMat3 C = wide_mat3_cofactor(F);
	const Wide of_F = m - m / (wide_mat3_dot(F, F) + 1.0);
	const Wide of_cofactor = l * (wide_mat3_determinant(F, &C) - alpha);
	JN_UNROLL for (int i = 0; i < 9; i++) {
		P->at[i / 3][i % 3] = wide_fma(of_F, F->at[i / 3][i % 3], of_cofactor * C.at[i / 3][i % 3]);
	}
}

enum { stable_neo_hookean_STORED = 12 };

JN_INLINE void stable_neo_hookean_linearize(const double* constants, const double* frozen, const WideMat3* F,
											Wide stored[]) {
	(void)frozen;
	const double m = constants[STABLE_M], l = constants[STABLE_L], alpha = constants[STABLE_ALPHA];
	const WideMat3 C = wide_mat3_cofactor(F);
	const Wide inverse = 1.0 / (wide_mat3_dot(F, F) + 1.0);
	store_mat3(F, stored);
	stored[9] = m - m * inverse;
	stored[10] = 2.0 * m * inverse * inverse;
	stored[11] = l * (wide_mat3_determinant(F, &C) - alpha);
}

/// A[ac][bd] = m (1 - 1/(I_C + 1)) d_ab d_cd + 2 m/(I_C + 1)^2 F_ac F_bd + l C_ac C_bd + l (J - alpha) dC_ac/dF_bd,
/// where C = cof F and dC_ac/dF_bd = e_abk e_cdn F_kn.
JN_INLINE void stable_neo_hookean_tangent(const double* constants, const double* frozen, const WideMat3* F,
										  WideTangent* A) {
	(void)frozen;
	const double m = constants[STABLE_M], l = constants[STABLE_L], alpha = constants[STABLE_ALPHA];
	const WideMat3 C = wide_mat3_cofactor(F);
	const Wide inverse = 1.0 / (wide_mat3_dot(F, F) + 1.0);
	const Wide of_identity = m - m * inverse, of_F = 2.0 * m * inverse * inverse;
	const Wide of_cofactor = l * (wide_mat3_determinant(F, &C) - alpha);
	WideMat3 scaled_F, scaled_C, cross;
	JN_UNROLL for (int i = 0; i < 9; i++) {
		scaled_F.at[i / 3][i % 3] = of_F * F->at[i / 3][i % 3];
		scaled_C.at[i / 3][i % 3] = l * C.at[i / 3][i % 3];
		cross.at[i / 3][i % 3] = of_cofactor * F->at[i / 3][i % 3];
	}
	JN_EACH_TANGENT_ENTRY({
		Wide entry = wide_fma(scaled_F.at[a][c], F->at[b][d], scaled_C.at[a][c] * C.at[b][d]);
		if (a == b && c == d) entry += of_identity;
		if (a != b && c != d) {
			const Wide last = cross.at[3 - a - b][3 - c - d];
			entry = ((b - a + 3) % 3 == 1) == ((d - c + 3) % 3 == 1) ? entry + last : entry - last;
		}
		A->at[ac][bd] = entry;
	})
}

#endif
