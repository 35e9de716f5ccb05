/// @file torsion.h
/// The twist between two neighbouring frames of a thread: E = k/2 (theta - theta_0)^2 with, of the vectors of frame.h,
///
///   theta = angle of (D, N),   N = v_0 . u_1 - u_0 . v_1,   D = u_0 . u_1 + v_0 . v_1.
///
/// Why that is the twist: let the rotation from one frame to the other be the quaternion (w, x, y, z) in the axes u, v and
/// normal of the first. For vectors of one length, N : D = 4 w z : 2 (w^2 - z^2), so that theta = 2 atan2(z, w). The
/// decomposition into swing and twist reads the same: theta turns about the normal, and what is left is the smallest
/// rotation that takes one normal to the other, which carries the frame along without twist (parallel transport).
///
/// N and D are products of two vectors each: theta needs no square root, and as it changes neither when the link moves nor
/// when it turns, its forces and their torques sum to zero by themselves, reactions on R, P and Q included. With
/// a = D/(N^2 + D^2), b = -N/(N^2 + D^2):
///
///   d theta = a dN + b dD,   K = k (g g^T + (theta - theta_0) dg/dx),   g = a dN/dx + b dD/dx.
///
/// The definite form is k g g^T. Frames whose normals are opposite have no twist: N = D = 0, without force.
#ifndef JN_FORCE_CONSTRAINT_TORSION_H
#define JN_FORCE_CONSTRAINT_TORSION_H

#include "force/constraint/frame.h"
#include "math/wide_angle.h"

enum {
	TORSION_NODES = FRAME_PAIR_NODES,
	TORSION_SINE = FRAME_REALS, // of theta_0
	TORSION_COSINE,
	TORSION_STIFFNESS,
	TORSION_REALS
};

static const double TORSION_LEAST = 1e-200; // [m^4] of N^2 + D^2

typedef struct Torsion {
	FrameSection section;
	FramePair f;
	Wide N, D, a, b, inverse; // 1/(N^2 + D^2)
	Wide k, change;           // theta - theta_0 in [-pi, pi]
} Torsion;

JN_INLINE void torsion_load(const double* rest, Wide edges[][3], Torsion* s) {
	s->section = frame_section(rest);
	FramePair* f = &s->f;
	frame_vectors(&s->section, edges, f);
	s->N = wide_dot(f->v[0], f->u[1]) - wide_dot(f->u[0], f->v[1]);
	s->D = wide_dot(f->u[0], f->u[1]) + wide_dot(f->v[0], f->v[1]);
	s->inverse = 1.0 / wide_max(wide_fma(s->N, s->N, s->D * s->D), wide_set(TORSION_LEAST));
	s->a = s->D * s->inverse;
	s->b = -s->N * s->inverse;
	const Wide sine = wide_load(rest + TORSION_SINE * JN_WIDE), cosine = wide_load(rest + TORSION_COSINE * JN_WIDE);
	s->change = wide_angle(wide_minor(s->N, cosine, s->D, sine), wide_fma(s->D, cosine, s->N * sine));
	s->k = wide_load(rest + TORSION_STIFFNESS * JN_WIDE);
}

/// out = a dN + b dD by each vector, of the vectors `f`.
JN_INLINE void torsion_gradient(const FramePair* f, Wide a, Wide b, FramePair* out) {
	JN_UNROLL for (int i = 0; i < 3; i++) {
		out->u[0][i] = wide_minor(b, f->u[1][i], a, f->v[1][i]);
		out->v[0][i] = wide_fma(a, f->u[1][i], b * f->v[1][i]);
		out->u[1][i] = wide_fma(a, f->v[0][i], b * f->u[0][i]);
		out->v[1][i] = wide_minor(b, f->v[0][i], a, f->u[0][i]);
	}
}

JN_INLINE Wide torsion_energy(const double* rest, Wide edges[][3]) {
	Torsion s;
	torsion_load(rest, edges, &s);
	return 0.5 * s.k * s.change * s.change;
}

JN_INLINE void torsion_force(const double* rest, Wide edges[][3], Wide force[][3]) {
	Torsion s;
	FramePair on;
	torsion_load(rest, edges, &s);
	const Wide pull = -s.k * s.change;
	torsion_gradient(&s.f, pull * s.a, pull * s.b, &on);
	frame_pull(&s.section, &on, force);
}

JN_INLINE void torsion_multiply(const void* state, bool definite, Wide p[][3], Wide out[][3]) {
	const Torsion* s = state;
	FramePair d, on, moved;
	frame_vectors(&s->section, p, &d);
	const Wide dN = wide_dot(d.v[0], s->f.u[1]) + wide_dot(s->f.v[0], d.u[1]) - wide_dot(d.u[0], s->f.v[1]) -
					wide_dot(s->f.u[0], d.v[1]);
	const Wide dD = wide_dot(d.u[0], s->f.u[1]) + wide_dot(s->f.u[0], d.u[1]) + wide_dot(d.v[0], s->f.v[1]) +
					wide_dot(s->f.v[0], d.v[1]);
	const Wide turn = s->k * wide_fma(s->a, dN, s->b * dD);
	if (definite) {
		torsion_gradient(&s->f, turn * s->a, turn * s->b, &on);
		frame_pull(&s->section, &on, out);
		return;
	}
	const Wide torque = s->k * s->change, shrink = 2 * wide_minor(s->a, dD, s->b, dN); // relative, of 1/(N^2 + D^2)
	const Wide da = wide_minor(s->inverse, dD, shrink, s->a), db = -wide_fma(s->inverse, dN, shrink * s->b);
	torsion_gradient(&s->f, wide_fma(turn, s->a, torque * da), wide_fma(turn, s->b, torque * db), &on);
	torsion_gradient(&d, torque * s->a, torque * s->b, &moved);
	JN_UNROLL for (int k = 0; k < 6; k++) {
		on.u[k / 3][k % 3] += moved.u[k / 3][k % 3];
		on.v[k / 3][k % 3] += moved.v[k / 3][k % 3];
	}
	frame_pull(&s->section, &on, out);
}

JN_INLINE void torsion_tangent(const double* rest, Wide edges[][3], bool definite, double* blocks) {
	Torsion s;
	torsion_load(rest, edges, &s);
	columns_of(&s, definite, TORSION_NODES - 1, torsion_multiply, blocks);
}

JN_INLINE void torsion_product(const double* rest, Wide edges[][3], bool definite, Wide p[][3], Wide out[][3]) {
	Torsion s;
	torsion_load(rest, edges, &s);
	torsion_multiply(&s, definite, p, out);
}

#endif
