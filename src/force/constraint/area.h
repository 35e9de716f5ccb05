/// @file area.h
/// The area of a triangle: E = k/2 (A - A_0)^2, with the edges d from node 2 and n = d_0 x d_1, A = |n|/2:
///
///   g_0 = d_1 x m/2,   g_1 = m x d_0/2,   m = n/|n|,   K = k (g g^T + (A - A_0) H).
///
/// H p has the change of n across m, (I - m m^T) dn/(2 |n|), and the change of the edges. The definite form is k g g^T.
#ifndef JN_FORCE_CONSTRAINT_AREA_H
#define JN_FORCE_CONSTRAINT_AREA_H

#include "force/constraint/columns.h"

enum { AREA_NODES = 3, AREA_REST = 0, AREA_STIFFNESS = 1, AREA_REALS = 2 };

typedef struct Area {
	Wide d[2][3], m[3], g[2][3], length; // |n|
	Wide k, change;                      // A - A_0
} Area;

/// The forces on the ends of both edges that a vector w does to n: w . dn.
JN_INLINE void area_turn(const Area* s, const Wide w[3], Wide out[2][3]) {
	wide_cross(s->d[1], w, out[0]);
	wide_cross(w, s->d[0], out[1]);
}

JN_INLINE void area_load(const double* rest, Wide edges[][3], Area* s) {
	Wide n[3];
	JN_UNROLL for (int k = 0; k < 6; k++) s->d[k / 3][k % 3] = edges[k / 3][k % 3];
	wide_cross(edges[0], edges[1], n);
	s->length = strain_length(n, s->m);
	area_turn(s, s->m, s->g);
	JN_UNROLL for (int k = 0; k < 6; k++) s->g[k / 3][k % 3] *= 0.5;
	s->k = wide_load(rest + AREA_STIFFNESS * JN_WIDE);
	s->change = 0.5 * s->length - wide_load(rest + AREA_REST * JN_WIDE);
}

JN_INLINE Wide area_energy(const double* rest, Wide edges[][3]) {
	Area s;
	area_load(rest, edges, &s);
	return 0.5 * s.k * s.change * s.change;
}

JN_INLINE void area_force(const double* rest, Wide edges[][3], Wide force[][3]) {
	Area s;
	area_load(rest, edges, &s);
	const Wide pull = -s.k * s.change;
	JN_UNROLL for (int k = 0; k < 6; k++) force[k / 3][k % 3] = pull * s.g[k / 3][k % 3];
}

JN_INLINE void area_multiply(const void* state, bool definite, Wide p[][3], Wide out[][3]) {
	const Area* s = state;
	const Wide along = s->k * (wide_dot(s->g[0], p[0]) + wide_dot(s->g[1], p[1]));
	JN_UNROLL for (int k = 0; k < 6; k++) out[k / 3][k % 3] = along * s->g[k / 3][k % 3];
	if (definite) return;
	Wide dn[3], other[3], turned[2][3], ends[2][3];
	wide_cross(p[0], s->d[1], dn);
	wide_cross(s->d[0], p[1], other);
	JN_UNROLL for (int a = 0; a < 3; a++) dn[a] += other[a];
	const Wide on = wide_dot(s->m, dn);
	JN_UNROLL for (int a = 0; a < 3; a++) dn[a] = (dn[a] - on * s->m[a]) / s->length;
	area_turn(s, dn, turned);
	wide_cross(p[1], s->m, ends[0]);
	wide_cross(s->m, p[0], ends[1]);
	const Wide half = 0.5 * s->k * s->change;
	JN_UNROLL for (int k = 0; k < 6; k++) {
		const int i = k / 3, a = k % 3;
		out[i][a] = wide_fma(half, turned[i][a] + ends[i][a], out[i][a]);
	}
}

JN_INLINE void area_tangent(const double* rest, Wide edges[][3], bool definite, double* blocks) {
	Area s;
	area_load(rest, edges, &s);
	columns_of(&s, definite, AREA_NODES - 1, area_multiply, blocks);
}

JN_INLINE void area_product(const double* rest, Wide edges[][3], bool definite, Wide p[][3], Wide out[][3]) {
	Area s;
	area_load(rest, edges, &s);
	area_multiply(&s, definite, p, out);
}

#endif
