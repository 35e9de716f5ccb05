/// @file skew.h
/// Shear of a link against its sections: with the vectors of frame.h, m_u = u_0 + u_1 and m_v = v_0 + v_1,
///
///   E = k/2 ((C_u - C_u0)^2 + (C_v - C_v0)^2),   C_u = t . m_u,   C_v = t . m_v.
///
/// A link of length L whose sections measure |u| = |v| = s has C_u = 6 L s gamma_u for the shear angle gamma_u, so that a
/// shear stiffness GA [N] is k = GA/(36 L s^2). An arc of a circle has none: t makes the same angle with either section.
/// Stretch and twist change neither: it is what a truss with diagonals does, without their share in stretch and bending.
///
/// K = k (g_u g_u^T + (C_u - C_u0) H_u) and alike for v; the definite form leaves the H out. All is polynomial.
#ifndef JN_FORCE_CONSTRAINT_SKEW_H
#define JN_FORCE_CONSTRAINT_SKEW_H

#include "force/constraint/frame.h"

enum { SKEW_NODES = FRAME_PAIR_NODES, SKEW_U = FRAME_REALS, SKEW_V, SKEW_STIFFNESS, SKEW_REALS };

typedef struct Skew {
	FrameSection section;
	Wide t[3], u[3], v[3]; // t, m_u, m_v
	Wide in_u, in_v, k;    // C_u - C_u0, C_v - C_v0
} Skew;

JN_INLINE void skew_vectors(const FrameSection* section, Wide edges[][3], Wide t[3], Wide u[3], Wide v[3]) {
	FramePair f;
	frame_vectors(section, edges, &f);
	JN_UNROLL for (int a = 0; a < 3; a++) {
		t[a] = f.t[a];
		u[a] = f.u[0][a] + f.u[1][a];
		v[a] = f.v[0][a] + f.v[1][a];
	}
}

JN_INLINE void skew_load(const double* rest, Wide edges[][3], Skew* s) {
	s->section = frame_section(rest);
	skew_vectors(&s->section, edges, s->t, s->u, s->v);
	s->in_u = wide_dot(s->t, s->u) - wide_load(rest + SKEW_U * JN_WIDE);
	s->in_v = wide_dot(s->t, s->v) - wide_load(rest + SKEW_V * JN_WIDE);
	s->k = wide_load(rest + SKEW_STIFFNESS * JN_WIDE);
}

/// out = u dC_u + v dC_v by each node, of the vectors t, m_u and m_v.
JN_INLINE void skew_gradient(const FrameSection* section, const Wide t[3], const Wide m_u[3], const Wide m_v[3], Wide u,
							 Wide v, Wide out[][3]) {
	const Wide on_p = wide_fma(section->beta, v, u), on_q = section->gamma * v;
	JN_UNROLL for (int a = 0; a < 3; a++) {
		const Wide on_t = wide_fma(u, m_u[a], v * m_v[a]), p = on_p * t[a], q = on_q * t[a];
		out[0][a] = -(p + q) - on_t;
		out[1][a] = p - on_t;
		out[2][a] = q - on_t;
		out[3][a] = on_t - (p + q);
		out[4][a] = p + on_t;
	}
}

JN_INLINE Wide skew_energy(const double* rest, Wide edges[][3]) {
	Skew s;
	skew_load(rest, edges, &s);
	return 0.5 * s.k * wide_fma(s.in_u, s.in_u, s.in_v * s.in_v);
}

JN_INLINE void skew_force(const double* rest, Wide edges[][3], Wide force[][3]) {
	Skew s;
	skew_load(rest, edges, &s);
	skew_gradient(&s.section, s.t, s.u, s.v, -s.k * s.in_u, -s.k * s.in_v, force);
}

JN_INLINE void skew_multiply(const void* state, bool definite, Wide p[][3], Wide out[][3]) {
	const Skew* s = state;
	Wide t[3], u[3], v[3], moved[FRAME_PAIR_NODES - 1][3];
	skew_vectors(&s->section, p, t, u, v);
	const Wide change_u = wide_dot(t, s->u) + wide_dot(s->t, u), change_v = wide_dot(t, s->v) + wide_dot(s->t, v);
	skew_gradient(&s->section, s->t, s->u, s->v, s->k * change_u, s->k * change_v, out);
	if (definite) return;
	skew_gradient(&s->section, t, u, v, s->k * s->in_u, s->k * s->in_v, moved);
	JN_UNROLL for (int k = 0; k < 3 * (FRAME_PAIR_NODES - 1); k++) out[k / 3][k % 3] += moved[k / 3][k % 3];
}

JN_INLINE void skew_tangent(const double* rest, Wide edges[][3], bool definite, double* blocks) {
	Skew s;
	skew_load(rest, edges, &s);
	columns_of(&s, definite, SKEW_NODES - 1, skew_multiply, blocks);
}

JN_INLINE void skew_product(const double* rest, Wide edges[][3], bool definite, Wide p[][3], Wide out[][3]) {
	Skew s;
	skew_load(rest, edges, &s);
	skew_multiply(&s, definite, p, out);
}

#endif
