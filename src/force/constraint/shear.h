/// @file shear.h
/// Shear of a triangle of area A between the threads (Baraff, Witkin 1998, section 4.3): E = A/2 k s^2, s = w_u . w_v.
///
/// With p = (w_u + w_v)/sqrt 2 and m = (w_u - w_v)/sqrt 2 it is s = (|p|^2 - |m|^2)/2, and in the unit vectors of p and m
///
///   d2E = A k [[(|p|^2 + s) pp + s (I - pp), -|p||m| pm], [-|p||m| mp, (|m|^2 - s) mm - s (I - mm)]]
///
/// Its eigenvalues are s and -s, twice each, and those of [[|p|^2 + s, -|p||m|], [-|p||m|, |m|^2 - s]], whose determinant is
/// -3 s^2: one of them is never positive (Kim 2020 finds the same in another basis). The definite form clamps these.
#ifndef JN_FORCE_CONSTRAINT_SHEAR_H
#define JN_FORCE_CONSTRAINT_SHEAR_H

#include "force/constraint/strain.h"

enum { SHEAR_STIFFNESS = STRAIN_REALS, SHEAR_REALS = SHEAR_STIFFNESS + 1 }; // A k

/// d2E in the basis of p and m: pp, pm and mm blocks.
typedef struct ShearHessian {
	Wide pp[9], pm[9], mm[9];
} ShearHessian;

JN_INLINE Wide shear_load(const double* rest, Wide edges[][3], Strain* strain, Wide* k) {
	strain_load(rest, edges, strain);
	*k = wide_load(rest + SHEAR_STIFFNESS * JN_WIDE);
	return wide_dot(strain->w[0], strain->w[1]);
}

JN_INLINE Wide shear_energy(const double* rest, Wide edges[][3]) {
	Strain strain;
	Wide k;
	const Wide s = shear_load(rest, edges, &strain, &k);
	return 0.5 * k * s * s;
}

JN_INLINE void shear_force(const double* rest, Wide edges[][3], Wide force[][3]) {
	Strain strain;
	Wide k, P[2][3];
	const Wide tension = shear_load(rest, edges, &strain, &k) * k;
	JN_UNROLL for (int a = 0; a < 3; a++) {
		P[0][a] = tension * strain.w[1][a];
		P[1][a] = tension * strain.w[0][a];
	}
	strain_pull(&strain, P, -1, force);
}

/// The larger eigenvalue of [[a, -c], [-c, b]], a b - c^2 <= 0, and the products pp, pm, mm of its unit eigenvector.
JN_INLINE Wide shear_eigen(Wide a, Wide b, Wide c, Wide product[3]) {
	const Wide half = 0.5 * (a - b), middle = 0.5 * (a + b), root = wide_sqrt(wide_fma(half, half, c * c));
	const Wide scale = wide_max(root, wide_set(1e-300)), cosine = half / scale, sine = -c / scale; // of twice its angle
	product[0] = 0.5 * (1.0 + cosine);
	product[1] = 0.5 * sine;
	product[2] = 0.5 * (1.0 - cosine);
	return middle + root;
}

JN_INLINE void shear_hessian(const Strain* strain, Wide s, Wide k, bool definite, ShearHessian* H) {
	const double root_half = 0.70710678118654752440;
	Wide p[3], m[3], product[3], e[3], f[3];
	JN_UNROLL for (int a = 0; a < 3; a++) {
		p[a] = root_half * (strain->w[0][a] + strain->w[1][a]);
		m[a] = root_half * (strain->w[0][a] - strain->w[1][a]);
	}
	const Wide lp = strain_length(p, e), lm = strain_length(m, f);
	Wide app = wide_fma(lp, lp, s), amm = wide_fma(lm, lm, -s), apm = -lp * lm, cross_p = s, cross_m = -s;
	if (definite) {
		const Wide value = shear_eigen(app, amm, lp * lm, product);
		app = value * product[0];
		apm = value * product[1];
		amm = value * product[2];
		cross_p = wide_max(s, wide_set(0));
		cross_m = wide_max(-s, wide_set(0));
	}
	JN_UNROLL for (int ab = 0; ab < 9; ab++) {
		const int a = ab / 3, b = ab % 3;
		H->pp[ab] = k * wide_fma(app - cross_p, e[a] * e[b], a == b ? cross_p : wide_set(0));
		H->pm[ab] = k * apm * e[a] * f[b];
		H->mm[ab] = k * wide_fma(amm - cross_m, f[a] * f[b], a == b ? cross_m : wide_set(0));
	}
}

/// B of node i in the basis of p and m.
JN_INLINE void shear_weights(const Strain* strain, int i, Wide b[2]) {
	const double root_half = 0.70710678118654752440;
	b[0] = root_half * (strain->B[i][0] + strain->B[i][1]);
	b[1] = root_half * (strain->B[i][0] - strain->B[i][1]);
}

JN_INLINE void shear_tangent(const double* rest, Wide edges[][3], bool definite, double* blocks) {
	Strain strain;
	ShearHessian H;
	Wide k, b[2][2];
	const Wide s = shear_load(rest, edges, &strain, &k);
	shear_hessian(&strain, s, k, definite, &H);
	JN_UNROLL for (int i = 0; i < 2; i++) shear_weights(&strain, i, b[i]);
	JN_UNROLL for (int pair = 0; pair < 3; pair++) {
		const Wide *bi = b[pair > 0], *bj = b[pair > 1];
		JN_UNROLL for (int ab = 0; ab < 9; ab++) {
			const int ba = ab % 3 * 3 + ab / 3;
			const Wide same = wide_fma(bi[0] * bj[0], H.pp[ab], bi[1] * bj[1] * H.mm[ab]);
			const Wide mixed = wide_fma(bi[0] * bj[1], H.pm[ab], bi[1] * bj[0] * H.pm[ba]);
			wide_store(blocks + (9 * pair + ab) * JN_WIDE, same + mixed);
		}
	}
}

JN_INLINE void shear_product(const double* rest, Wide edges[][3], bool definite, Wide p[][3], Wide out[][3]) {
	const double root_half = 0.70710678118654752440;
	Strain strain;
	ShearHessian H;
	Wide k, dw[2][3], dp[3], dm[3], dP[2][3];
	const Wide s = shear_load(rest, edges, &strain, &k);
	shear_hessian(&strain, s, k, definite, &H);
	strain_directions(&strain, p, dw);
	JN_UNROLL for (int a = 0; a < 3; a++) {
		dp[a] = root_half * (dw[0][a] + dw[1][a]);
		dm[a] = root_half * (dw[0][a] - dw[1][a]);
	}
	JN_UNROLL for (int a = 0; a < 3; a++) {
		const Wide on_p = wide_dot(H.pp + 3 * a, dp) + wide_dot(H.pm + 3 * a, dm);
		const Wide on_m =
			wide_dot3(H.pm[a], dp[0], H.pm[3 + a], dp[1], H.pm[6 + a], dp[2]) + wide_dot(H.mm + 3 * a, dm);
		dP[0][a] = root_half * (on_p + on_m);
		dP[1][a] = root_half * (on_p - on_m);
	}
	strain_pull(&strain, dP, 1, out);
}

#endif
