/// @file spring.h
/// A spring between two nodes: E = k/2 (l - L)^2 with its length l and its length L at rest. Its stiffness
///
///   K = k ((1 - L/l) (I - e e^T) + e e^T),   e the direction between the nodes,
///
/// is definite where it is stretched; where it is compressed, its definite form leaves the first term out.
#ifndef JN_FORCE_CONSTRAINT_SPRING_H
#define JN_FORCE_CONSTRAINT_SPRING_H

#include "math/mat3.h"

enum { SPRING_NODES = 2, SPRING_LENGTH = 0, SPRING_STIFFNESS = 1, SPRING_REALS = 2 };

static const double SPRING_LEAST = 1e-150; // [m]: two nodes at one place pull in no direction

typedef struct Spring {
	Wide e[3], length, rest, k;
} Spring;

JN_INLINE Spring spring_load(const double* rest, Wide edges[][3]) {
	Spring s = {.rest = wide_load(rest + SPRING_LENGTH * JN_WIDE), .k = wide_load(rest + SPRING_STIFFNESS * JN_WIDE)};
	const Wide* d = edges[0];
	s.length = wide_max(wide_sqrt(wide_dot3(d[0], d[0], d[1], d[1], d[2], d[2])), wide_set(SPRING_LEAST));
	JN_UNROLL for (int a = 0; a < 3; a++) s.e[a] = d[a] / s.length;
	return s;
}

JN_INLINE Wide spring_energy(const double* rest, Wide edges[][3]) {
	const Spring s = spring_load(rest, edges);
	const Wide longer = s.length - s.rest;
	return 0.5 * s.k * longer * longer;
}

JN_INLINE void spring_force(const double* rest, Wide edges[][3], Wide force[][3]) {
	const Spring s = spring_load(rest, edges);
	const Wide pull = s.k * (s.rest - s.length);
	JN_UNROLL for (int a = 0; a < 3; a++) force[0][a] = pull * s.e[a];
}

/// Stiffness across and what it differs from that by along the spring.
JN_INLINE void spring_stiffness(const Spring* s, bool definite, Wide* across, Wide* more) {
	const Wide tension = 1.0 - s->rest / s->length;
	*across = s->k * (definite ? wide_max(tension, wide_set(0)) : tension);
	*more = s->k - *across;
}

JN_INLINE void spring_tangent(const double* rest, Wide edges[][3], bool definite, double* blocks) {
	const Spring s = spring_load(rest, edges);
	Wide across, more;
	spring_stiffness(&s, definite, &across, &more);
	JN_UNROLL for (int ab = 0; ab < 9; ab++) {
		const Wide entry = more * s.e[ab / 3] * s.e[ab % 3];
		wide_store(blocks + ab * JN_WIDE, ab % 4 == 0 ? across + entry : entry);
	}
}

JN_INLINE void spring_product(const double* rest, Wide edges[][3], bool definite, Wide p[][3], Wide out[][3]) {
	const Spring s = spring_load(rest, edges);
	Wide across, more;
	spring_stiffness(&s, definite, &across, &more);
	const Wide along = more * wide_dot3(s.e[0], p[0][0], s.e[1], p[0][1], s.e[2], p[0][2]);
	JN_UNROLL for (int a = 0; a < 3; a++) out[0][a] = wide_fma(along, s.e[a], across * p[0][a]);
}

#endif
