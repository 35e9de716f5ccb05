/// @file volume.h
/// The volume of a tetrahedron, V = d_0 . (d_1 x d_2)/6 with the edges d from node 3, and V_0 at rest, of either sign:
///
///   E = k/2 (V - V_0)^2 + k_nl/2 V_0^2 b(r),   r = V/V_0,
///
///   b(r) = (1 - r)^2 (-ln r) for r_c <= r < 1, 0 above, and below r_c its Taylor polynomial of second order at r_c.
///
/// b is convex and C^2, is flat at r = 1 and pushes back ever harder as a cell collapses and turns inside out: for
/// r <= 0 too, and finitely. It stands for the nonlinear spring of the paper on threads (math: EX), whose formula is lost.
///
///   K = E'' g g^T + E' H,   g_0 = d_1 x d_2/6 and so on in turn,   E' = dE/dV;   the definite form is E'' g g^T.
#ifndef JN_FORCE_CONSTRAINT_VOLUME_H
#define JN_FORCE_CONSTRAINT_VOLUME_H

#include "force/constraint/columns.h"
#include "math/wide_logarithm.h"

enum { VOLUME_NODES = 4, VOLUME_REST = 0, VOLUME_STIFFNESS = 1, VOLUME_NONLINEAR = 2, VOLUME_REALS = 3 };

static const double VOLUME_BEND = 0.05; // r_c

/// b and its derivatives by r.
typedef struct Barrier {
	Wide value, slope, curvature;
} Barrier;

JN_INLINE Barrier volume_barrier(Wide r) {
	const Wide x = wide_min(wide_max(r, wide_set(VOLUME_BEND)), wide_set(1)), below = wide_min(r - x, wide_set(0));
	const Wide open = 1.0 - x, log = wide_logarithm(x), ratio = open / x;
	const Wide value = -(open * open * log), slope = open * wide_minor(wide_set(2), log, wide_set(1), ratio);
	const Wide curvature = wide_fma(ratio, ratio, wide_minor(wide_set(4), ratio, wide_set(2), log));
	return (Barrier){.value = wide_fma(below, wide_fma(0.5 * below, curvature, slope), value),
					 .slope = wide_fma(below, curvature, slope),
					 .curvature = curvature};
}

typedef struct Volume {
	Wide d[3][3], g[3][3]; // edges, 6 dV/dx
	Wide energy, slope, curvature;
} Volume;

JN_INLINE void volume_load(const double* rest, Wide edges[][3], Volume* v) {
	JN_UNROLL for (int i = 0; i < 3; i++) {
		wide_cross(edges[(i + 1) % 3], edges[(i + 2) % 3], v->g[i]); // cppcheck-suppress uninitvar // is written here
		JN_UNROLL for (int a = 0; a < 3; a++) v->d[i][a] = edges[i][a];
	}
	const Wide rest_volume = wide_load(rest + VOLUME_REST * JN_WIDE);
	const Wide k = wide_load(rest + VOLUME_STIFFNESS * JN_WIDE), more = wide_load(rest + VOLUME_NONLINEAR * JN_WIDE);
	const Wide V = wide_dot(edges[0], v->g[0]) * (1.0 / 6), change = V - rest_volume;
	v->energy = 0.5 * k * change * change;
	v->slope = k * change;
	v->curvature = k;
	if (!wide_any((change * rest_volume < 0.0) & (more > 0.0))) return;
	const Wide r = V / rest_volume;
	const Barrier b = volume_barrier(r);
	v->energy = wide_fma(0.5 * more * rest_volume * rest_volume, b.value, v->energy);
	v->slope = wide_fma(0.5 * more * rest_volume, b.slope, v->slope);
	v->curvature = wide_fma(0.5 * more, b.curvature, v->curvature);
}

JN_INLINE Wide volume_energy(const double* rest, Wide edges[][3]) {
	Volume v;
	volume_load(rest, edges, &v);
	return v.energy;
}

JN_INLINE void volume_force(const double* rest, Wide edges[][3], Wide force[][3]) {
	Volume v;
	volume_load(rest, edges, &v);
	const Wide pull = v.slope * (-1.0 / 6);
	JN_UNROLL for (int k = 0; k < 9; k++) force[k / 3][k % 3] = pull * v.g[k / 3][k % 3];
}

JN_INLINE void volume_multiply(const void* state, bool definite, Wide p[][3], Wide out[][3]) {
	const Volume* v = state;
	const Wide change = wide_dot(v->g[0], p[0]) + wide_dot(v->g[1], p[1]) + wide_dot(v->g[2], p[2]);
	const Wide along = v->curvature * change * (1.0 / 36), turn = v->slope * (1.0 / 6);
	JN_UNROLL for (int i = 0; i < 3; i++) {
		const int j = (i + 1) % 3, k = (i + 2) % 3;
		Wide a[3], b[3];
		JN_UNROLL for (int c = 0; c < 3; c++) out[i][c] = along * v->g[i][c];
		if (definite) continue;
		wide_cross(p[j], v->d[k], a);
		wide_cross(v->d[j], p[k], b);
		JN_UNROLL for (int c = 0; c < 3; c++) out[i][c] = wide_fma(turn, a[c] + b[c], out[i][c]);
	}
}

JN_INLINE void volume_tangent(const double* rest, Wide edges[][3], bool definite, double* blocks) {
	Volume v;
	volume_load(rest, edges, &v);
	columns_of(&v, definite, VOLUME_NODES - 1, volume_multiply, blocks);
}

JN_INLINE void volume_product(const double* rest, Wide edges[][3], bool definite, Wide p[][3], Wide out[][3]) {
	Volume v;
	volume_load(rest, edges, &v);
	volume_multiply(&v, definite, p, out);
}

#endif
