/// @file differential.h
/// dP = dP/dF : D of each law, from the few numbers that <law>_linearize has left of F; D is a change of F. In Reals:
/// double and single precision have one text.
#ifndef JN_FORCE_MATERIAL_DIFFERENTIAL_H
#define JN_FORCE_MATERIAL_DIFFERENTIAL_H

#include "force/material/stable_neo_hookean.h"
#include "force/real.h"

typedef void RealDifferential(const double* constants, const Real stored[], Real D[3][3], Real dP[3][3]);

/// A^T B.
JN_INLINE void real_transposed_multiply(const Real A[9], Real B[3][3], Real C[3][3]) {
	JN_UNROLL for (int i = 0; i < 9; i++) {
		const int r = i / 3, c = i % 3;
		C[r][c] = real_dot3(A[r], B[0][c], A[3 + r], B[1][c], A[6 + r], B[2][c]);
	}
}

/// C += A B.
JN_INLINE void real_add_product(const Real A[9], Real B[3][3], Real C[3][3]) {
	JN_UNROLL for (int i = 0; i < 9; i++) {
		const int r = i / 3, c = i % 3;
		C[r][c] =
			real_fma(A[3 * r], B[0][c], real_fma(A[3 * r + 1], B[1][c], real_fma(A[3 * r + 2], B[2][c], C[r][c])));
	}
}

JN_INLINE Real real_dot9(const Real A[9], Real B[3][3]) {
	Real sum[3];
	JN_UNROLL for (int r = 0; r < 3; r++) {
		sum[r] = real_dot3(A[3 * r], B[r][0], A[3 * r + 1], B[r][1], A[3 * r + 2], B[r][2]);
	}
	return sum[0] + sum[1] + sum[2];
}

/// dP = a D + H (c T^T + l tr(T) I), T = H^T D: what turns with a rotation or an inverse.
JN_INLINE void turned_differential(Real a, Real c, Real l, const Real H[9], Real D[3][3], Real dP[3][3]) {
	Real T[3][3], S[3][3];
	real_transposed_multiply(H, D, T);
	const Real trace = l * (T[0][0] + T[1][1] + T[2][2]);
	JN_UNROLL for (int i = 0; i < 9; i++) {
		const int r = i / 3, k = i % 3;
		S[r][k] = r == k ? real_fma(c, T[r][r], trace) : c * T[k][r];
		dP[r][k] = a * D[r][k];
	}
	real_add_product(H, S, dP);
}

/// R.
JN_INLINE void corotated_frozen_differential(const double* constants, const Real stored[], Real D[3][3],
											 Real dP[3][3]) {
	const Real mu = real_set(constants[JN_LAW_MU]);
	turned_differential(mu, mu, real_set(constants[JN_LAW_LAMBDA]), stored, D, dP);
}

#define linear_differential corotated_frozen_differential

/// H = F^-T and mu - lambda ln J.
JN_INLINE void neo_hookean_differential(const double* constants, const Real stored[], Real D[3][3], Real dP[3][3]) {
	const Real mu = real_set(constants[JN_LAW_MU]);
	turned_differential(mu, stored[9], real_set(constants[JN_LAW_LAMBDA]), stored, D, dP);
}

/// F and S by rows of its lower triangle: dP = D S + F dS, dS = mu (T + T^T) + lambda tr(T) I, T = F^T D.
JN_INLINE void st_venant_kirchhoff_differential(const double* constants, const Real stored[], Real D[3][3],
												Real dP[3][3]) {
	const Real mu = real_set(constants[JN_LAW_MU]), *S = stored + 9;
	Real T[3][3], dS[3][3];
	real_transposed_multiply(stored, D, T);
	const Real trace = real_set(constants[JN_LAW_LAMBDA]) * (T[0][0] + T[1][1] + T[2][2]);
	JN_UNROLL for (int i = 0; i < 9; i++) {
		const int r = i / 3, c = i % 3;
		dS[r][c] = mu * (T[r][c] + T[c][r]);
		if (r == c) dS[r][c] += trace;
	}
	JN_UNROLL for (int r = 0; r < 3; r++) {
		dP[r][0] = real_dot3(D[r][0], S[0], D[r][1], S[1], D[r][2], S[3]);
		dP[r][1] = real_dot3(D[r][0], S[1], D[r][1], S[2], D[r][2], S[4]);
		dP[r][2] = real_dot3(D[r][0], S[3], D[r][1], S[4], D[r][2], S[5]);
	}
	real_add_product(stored, dS, dP);
}

/// C = cof A.
JN_INLINE void real_cofactor(const Real A[9], Real C[9]) {
	JN_UNROLL for (int i = 0; i < 9; i++) {
		const int r1 = (i / 3 + 1) % 3 * 3, r2 = (i / 3 + 2) % 3 * 3, c1 = (i % 3 + 1) % 3, c2 = (i % 3 + 2) % 3;
		C[i] = real_fma(A[r1 + c1], A[r2 + c2], -(A[r1 + c2] * A[r2 + c1]));
	}
}

/// F, m (1 - 1/(I_C + 1)), 2 m/(I_C + 1)^2 and l (J - alpha); the derivative of cof F along D is a sum of minors.
JN_INLINE void stable_neo_hookean_differential(const double* constants, const Real stored[], Real D[3][3],
											   Real dP[3][3]) {
	Real C[9];
	real_cofactor(stored, C);
	const Real of_F = stored[10] * real_dot9(stored, D), of_C = real_set(constants[STABLE_L]) * real_dot9(C, D);
	JN_UNROLL for (int i = 0; i < 9; i++) {
		const Real own = real_fma(stored[9], D[i / 3][i % 3], of_F * stored[i]);
		dP[i / 3][i % 3] = real_fma(of_C, C[i], own);
	}
	const Real c = stored[11];
	Real E[3][3];
	JN_UNROLL for (int i = 0; i < 9; i++) E[i / 3][i % 3] = c * D[i / 3][i % 3];
	JN_UNROLL for (int i = 0; i < 9; i++) {
		const int r1 = (i / 3 + 1) % 3, r2 = (i / 3 + 2) % 3, c1 = (i % 3 + 1) % 3, c2 = (i % 3 + 2) % 3;
		const Real *F1 = stored + 3 * r1, *F2 = stored + 3 * r2;
		Real sum = real_fma(F1[c1], E[r2][c2], real_fma(F2[c2], E[r1][c1], dP[i / 3][i % 3]));
		sum = real_fma(-F1[c2], E[r2][c1], real_fma(-F2[c1], E[r1][c2], sum));
		dP[i / 3][i % 3] = sum;
	}
}

/// R and G, symmetric: dP = 2 mu D + R (lambda tr(T) I + [G t]x), T = R^T D and t the axis of T - T^T.
JN_INLINE void corotated_differential(const double* constants, const Real stored[], Real D[3][3], Real dP[3][3]) {
	const Real *G = stored + 9, twice_mu = real_set(2.0 * constants[JN_LAW_MU]);
	Real T[3][3];
	real_transposed_multiply(stored, D, T);
	const Real trace = real_set(constants[JN_LAW_LAMBDA]) * (T[0][0] + T[1][1] + T[2][2]);
	const Real t0 = T[2][1] - T[1][2], t1 = T[0][2] - T[2][0], t2 = T[1][0] - T[0][1];
	const Real y0 = real_dot3(G[0], t0, G[1], t1, G[3], t2), y1 = real_dot3(G[1], t0, G[2], t1, G[4], t2),
			   y2 = real_dot3(G[3], t0, G[4], t1, G[5], t2);
	Real S[3][3] = {{trace, -y2, y1}, {y2, trace, -y0}, {-y1, y0, trace}};
	JN_UNROLL for (int i = 0; i < 9; i++) dP[i / 3][i % 3] = twice_mu * D[i / 3][i % 3];
	real_add_product(stored, S, dP);
}

enum { WHOLE_REALS = 45 };

/// Any law: the lower triangle of dP/dF by rows.
JN_INLINE void whole_differential(const double* constants, const Real A[], Real D[3][3], Real dP[3][3]) {
	(void)constants;
	JN_UNROLL for (int ac = 0; ac < 9; ac++) {
		Real sum = A[ac * (ac + 1) / 2] * D[0][0];
		JN_UNROLL for (int bd = 1; bd < 9; bd++) {
			const int at = bd <= ac ? ac * (ac + 1) / 2 + bd : bd * (bd + 1) / 2 + ac;
			sum = real_fma(A[at], D[bd / 3][bd % 3], sum);
		}
		dP[ac / 3][ac % 3] = sum;
	}
}

#endif
