/// @file angle.h
/// The angle phi by which a line of nodes turns at node 2, from 0 to 2 and on to 1: E = k/2 (phi - phi_0)^2, 0 <= phi < pi.
///
///   0 --- 2         a = (x_2 - x_0)/l_a,  b = (x_1 - x_2)/l_b,  c = a . b = cos phi,  s = sin phi:
///          \ phi    c changes by dc, and d phi = -dc/s
///           1
///
/// With q = (phi - phi_0)/s, which stays finite where a straight line is at rest, the force is k q dc/dx, and
///
///   K = k (h dc dc^T - q d2c),   h = (1 - q c)/s^2.   The definite form is k d phi d phi^T = k dc dc^T/s^2.
///
/// dc/dx_0 = -(b - c a)/l_a and dc/dx_1 = (a - c b)/l_b. Where the line is straight, phi has no gradient: the definite form
/// is 0 there, and a line that is bent at rest knows no direction to bend to, nor does any that is folded back.
#ifndef JN_FORCE_CONSTRAINT_ANGLE_H
#define JN_FORCE_CONSTRAINT_ANGLE_H

#include "force/constraint/columns.h"
#include "math/wide_angle.h"

enum { ANGLE_NODES = 3, ANGLE_REST = 0, ANGLE_STIFFNESS = 1, ANGLE_REALS = 2 };

static const double ANGLE_LEAST = 1e-8; // [rad]: what is bent less is straight, to rounding

typedef struct Angle {
	Wide a[3], b[3], g[2][3]; // directions, dc/dx of nodes 0 and 1
	Wide c, s, q, r_a, r_b;   // 1/l_a, 1/l_b
	Wide k, change;           // phi - phi_0
} Angle;

JN_INLINE void angle_load(const double* rest, Wide edges[][3], Angle* m) {
	Wide back[3], across[3], other[3];
	JN_UNROLL for (int i = 0; i < 3; i++) back[i] = -edges[0][i];
	m->r_a = 1.0 / strain_length(back, m->a);
	m->r_b = 1.0 / strain_length(edges[1], m->b);
	m->c = wide_dot(m->a, m->b);
	wide_axpy(-m->c, m->a, m->b, across);
	wide_axpy(-m->c, m->b, m->a, other);
	JN_UNROLL for (int i = 0; i < 3; i++) {
		m->g[0][i] = -m->r_a * across[i];
		m->g[1][i] = m->r_b * other[i];
	}
	const Wide least = wide_set(ANGLE_LEAST), sine = wide_sqrt(wide_dot(across, across));
	const Wide phi = wide_angle(sine, m->c), phi_0 = wide_load(rest + ANGLE_REST * JN_WIDE);
	m->k = wide_load(rest + ANGLE_STIFFNESS * JN_WIDE);
	m->change = phi - phi_0;
	m->s = wide_max(sine, least);
	m->q = (wide_max(phi, least) - phi_0) / m->s;
}

JN_INLINE Wide angle_energy(const double* rest, Wide edges[][3]) {
	Angle m;
	angle_load(rest, edges, &m);
	return 0.5 * m.k * m.change * m.change;
}

JN_INLINE void angle_force(const double* rest, Wide edges[][3], Wide force[][3]) {
	Angle m;
	angle_load(rest, edges, &m);
	JN_UNROLL for (int k = 0; k < 6; k++) force[k / 3][k % 3] = m.k * m.q * m.g[k / 3][k % 3];
}

/// out += factor d2c p.
JN_INLINE void angle_add_turn(const Angle* m, Wide change, Wide factor, Wide p[][3], Wide out[][3]) {
	const Wide along_a = -wide_dot(m->a, p[0]), along_b = wide_dot(m->b, p[1]); // changes of the lengths
	const Wide stretch_a = along_a * m->r_a, stretch_b = along_b * m->r_b;
	JN_UNROLL for (int i = 0; i < 3; i++) {
		const Wide da = -m->r_a * wide_fma(along_a, m->a[i], p[0][i]);
		const Wide db = m->r_b * wide_fma(-along_b, m->b[i], p[1][i]);
		const Wide at_0 = -m->r_a * (db - change * m->a[i] - m->c * da) - stretch_a * m->g[0][i];
		const Wide at_1 = m->r_b * (da - change * m->b[i] - m->c * db) - stretch_b * m->g[1][i];
		out[0][i] = wide_fma(factor, at_0, out[0][i]);
		out[1][i] = wide_fma(factor, at_1, out[1][i]);
	}
}

JN_INLINE void angle_multiply(const void* state, bool definite, Wide p[][3], Wide out[][3]) {
	const Angle* m = state;
	const Wide change = wide_dot(m->g[0], p[0]) + wide_dot(m->g[1], p[1]); // dc
	const Wide h = m->k * (definite ? wide_set(1) : 1.0 - m->q * m->c) / (m->s * m->s);
	JN_UNROLL for (int k = 0; k < 6; k++) out[k / 3][k % 3] = h * change * m->g[k / 3][k % 3];
	if (!definite) angle_add_turn(m, change, -m->k * m->q, p, out);
}

JN_INLINE void angle_tangent(const double* rest, Wide edges[][3], bool definite, double* blocks) {
	Angle m;
	angle_load(rest, edges, &m);
	columns_of(&m, definite, ANGLE_NODES - 1, angle_multiply, blocks);
}

JN_INLINE void angle_product(const double* rest, Wide edges[][3], bool definite, Wide p[][3], Wide out[][3]) {
	Angle m;
	angle_load(rest, edges, &m);
	angle_multiply(&m, definite, p, out);
}

#endif
