/// @file qp_cone.h
/// Coulomb's law at one contact, in its frame: normal, tangent, tangent. Multipliers lie in the cone |l_t| <= mu l_n.
#ifndef JN_SOLVE_QP_CONE_H
#define JN_SOLVE_QP_CONE_H

#include <math.h>

/// Move (a, b) to the nearest point of the disk of that radius (negative: 0) about 0.
static inline void jn_disk_project(double radius, double* a, double* b) {
	const double length = hypot(*a, *b);
	if (length <= radius) return;
	const double scale = radius > 0 ? radius / length : 0;
	*a *= scale;
	*b *= scale;
}

/// Move z to the nearest point of the dual cone z_n >= mu |z_t|: what u_n + mu |u_t| and u_t obey (De Saxce and Feng 1998).
static inline void jn_dual_cone_project(double mu, double z[3]) {
	const double length = hypot(z[1], z[2]);
	if (z[0] >= mu * length) return;
	// on the ray (mu, 1) / sqrt(1 + mu^2) of (normal, tangent), or at the tip
	const double along = (mu * z[0] + length) / (1 + mu * mu);
	const double scale = along > 0 ? along / length : 0;
	z[0] = along > 0 ? mu * along : 0;
	z[1] *= scale;
	z[2] *= scale;
}

/// The natural map of Coulomb's law: what is left of the multiplier l when l - rho w is brought back to the set that l
/// must lie in, w being the relative velocity with its bound taken off. 0 exactly where the law holds.
static inline void jn_coulomb_residual(double mu, double rho, const double w[3], const double l[3], double out[3]) {
	out[0] = l[0] - fmax(0, l[0] - rho * w[0]);
	if (mu <= 0) {
		out[1] = out[2] = 0;
		return;
	}
	double a = l[1] - rho * w[1], b = l[2] - rho * w[2];
	jn_disk_project(mu * l[0], &a, &b);
	out[1] = l[1] - a;
	out[2] = l[2] - b;
}

#endif
