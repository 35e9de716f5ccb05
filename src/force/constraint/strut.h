/// @file strut.h
/// A spring between two nodes that is damped along itself alone: E = k/2 (l - L)^2 with its length l, and L at rest, and
///
///   K = k ((1 - L/l) (I - e e^T) + e e^T),   e the direction between the nodes.
///
/// The definite form is k e e^T: as damping it leaves the motions of a rigid body alone. (Cloth, whose springs are under
/// tension, keeps that tension in the definite form: spring.h.)
#ifndef JN_FORCE_CONSTRAINT_STRUT_H
#define JN_FORCE_CONSTRAINT_STRUT_H

#include "force/constraint/spring.h"

enum { STRUT_NODES = SPRING_NODES, STRUT_REALS = SPRING_REALS };

/// Of l and 1/l: one square root and one division an element, which is what its force costs.
JN_INLINE Wide strut_length(Wide edges[][3], Wide* inverse) {
	const Wide* d = edges[0];
	const Wide length = wide_max(wide_sqrt(wide_dot3(d[0], d[0], d[1], d[1], d[2], d[2])), wide_set(SPRING_LEAST));
	*inverse = 1.0 / length;
	return length;
}

JN_INLINE Wide strut_energy(const double* rest, Wide edges[][3]) {
	return spring_energy(rest, edges);
}

/// What the edge is multiplied with for the force of node 0; 0 at rest, to the bit.
JN_INLINE Wide strut_pull(const double* rest, Wide edges[][3]) {
	const Wide k = wide_load(rest + SPRING_STIFFNESS * JN_WIDE);
	Wide inverse;
	const Wide length = strut_length(edges, &inverse);
	return k * (wide_load(rest + SPRING_LENGTH * JN_WIDE) - length) * inverse;
}

JN_INLINE void strut_force(const double* rest, Wide edges[][3], Wide force[][3]) {
	const Wide pull = strut_pull(rest, edges);
	JN_UNROLL for (int a = 0; a < 3; a++) force[0][a] = pull * edges[0][a];
}

typedef struct Strut {
	Wide d[3], across, along; // K = across I + along d d^T
} Strut;

JN_INLINE void strut_load(const double* rest, Wide edges[][3], bool definite, Strut* s) {
	const Wide k = wide_load(rest + SPRING_STIFFNESS * JN_WIDE), *d = edges[0];
	JN_UNROLL for (int a = 0; a < 3; a++) s->d[a] = d[a];
	if (definite) {
		const Wide square = wide_dot3(d[0], d[0], d[1], d[1], d[2], d[2]);
		s->across = wide_set(0);
		s->along = k / wide_max(square, wide_set(SPRING_LEAST * SPRING_LEAST));
		return;
	}
	Wide inverse;
	strut_length(edges, &inverse);
	s->across = k * (1.0 - wide_load(rest + SPRING_LENGTH * JN_WIDE) * inverse);
	s->along = (k - s->across) * inverse * inverse;
}

JN_INLINE void strut_multiply(const Strut* s, Wide p[][3], Wide out[][3]) {
	const Wide along = s->along * wide_dot3(s->d[0], p[0][0], s->d[1], p[0][1], s->d[2], p[0][2]);
	JN_UNROLL for (int a = 0; a < 3; a++) out[0][a] = wide_fma(along, s->d[a], s->across * p[0][a]);
}

JN_INLINE void strut_tangent(const double* rest, Wide edges[][3], bool definite, double* blocks) {
	Strut s;
	strut_load(rest, edges, definite, &s);
	JN_UNROLL for (int ab = 0; ab < 9; ab++) {
		const Wide entry = s.along * s.d[ab / 3] * s.d[ab % 3];
		wide_store(blocks + ab * JN_WIDE, ab % 4 == 0 ? s.across + entry : entry);
	}
}

JN_INLINE void strut_product(const double* rest, Wide edges[][3], bool definite, Wide p[][3], Wide out[][3]) {
	Strut s;
	strut_load(rest, edges, definite, &s);
	strut_multiply(&s, p, out);
}

#endif
