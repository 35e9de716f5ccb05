/// @file bend.h
/// Bending across the edge of two triangles (Grinspun, Hirani, Desbrun, Schroeder 2003): E = k/2 (theta - theta_0)^2 with
/// the angle theta between their normals, positive where the wings rise to the side of the normals.
///
///            2 (wing)         e: unit vector from node 3 to node 2, L: length of that edge
///           / \               for each wing: q L = distance of its foot from node 3 along e, h: height,
///   wing 0 /   \ wing 1                      t: unit vector of the height, n: unit normal
///          \   /              g: gradient of theta,    g_wing = n/h,   g_2 = -sum of q n/h over the wings
///           \ /
///            3
///
/// The second derivatives in closed form (Tamstorf, Grinspun 2013; here from the derivatives of g, node 3 as origin), a sum
/// over the wings of, with S_tn = t n^T + n t^T and S_en likewise,
///
///   T_ww = -S_tn/h^2    T_2w = q S_tn/h^2 - n e^T/(h L)    T_22 = -q^2 S_tn/h^2 + q S_en/(h L) - S_tn/(2 L^2)
///
/// K = k (g g^T + (theta - theta_0) T). The definite form is k g g^T. Nodes: wing, wing, 2, 3 of the drawing.
#ifndef JN_FORCE_CONSTRAINT_BEND_H
#define JN_FORCE_CONSTRAINT_BEND_H

#include "force/constraint/strain.h"
#include "math/wide_angle.h"

enum { BEND_NODES = 4, BEND_SINE = 0, BEND_COSINE = 1, BEND_STIFFNESS = 2, BEND_REALS = 3 }; // of theta_0; k

typedef struct BendWing {
	Wide n[3], t[3];
	Wide q, r; // r = 1/h
} BendWing;

typedef struct Bend {
	Wide e[3], s; // s = 1/L
	BendWing wing[2];
	Wide k, angle; // theta - theta_0 in [-pi, pi]
} Bend;

JN_INLINE void bend_load_wing(const Bend* bend, const Wide d[3], double side, BendWing* wing) {
	const Wide *e = bend->e, along = wide_dot(e, d);
	Wide height[3];
	JN_UNROLL for (int a = 0; a < 3; a++) height[a] = d[a] - along * e[a];
	wing->q = along * bend->s;
	wing->r = 1.0 / strain_length(height, wing->t);
	JN_UNROLL for (int a = 0; a < 3; a++) {
		const int b = (a + 1) % 3, c = (a + 2) % 3;
		wing->n[a] = side * wide_minor(e[b], wing->t[c], e[c], wing->t[b]);
	}
}

/// sin theta = e . (t_0 x t_1) and cos theta = -t_0 . t_1.
JN_INLINE void bend_load(const double* rest, Wide edges[][3], Bend* bend) {
	bend->s = 1.0 / strain_length(edges[2], bend->e);
	bend_load_wing(bend, edges[0], 1, &bend->wing[0]);
	bend_load_wing(bend, edges[1], -1, &bend->wing[1]);
	const Wide sine = wide_dot(bend->wing[0].n, bend->wing[1].t), cosine = -wide_dot(bend->wing[0].t, bend->wing[1].t);
	const Wide sine_0 = wide_load(rest + BEND_SINE * JN_WIDE), cosine_0 = wide_load(rest + BEND_COSINE * JN_WIDE);
	bend->angle = wide_angle(wide_minor(sine, cosine_0, cosine, sine_0), wide_fma(cosine, cosine_0, sine * sine_0));
	bend->k = wide_load(rest + BEND_STIFFNESS * JN_WIDE);
}

JN_INLINE void bend_gradient(const Bend* bend, Wide g[3][3]) {
	const BendWing* w = bend->wing;
	JN_UNROLL for (int a = 0; a < 3; a++) {
		g[0][a] = w[0].r * w[0].n[a];
		g[1][a] = w[1].r * w[1].n[a];
		g[2][a] = -wide_fma(w[0].q, g[0][a], w[1].q * g[1][a]);
	}
}

JN_INLINE Wide bend_energy(const double* rest, Wide edges[][3]) {
	Bend bend;
	bend_load(rest, edges, &bend);
	return 0.5 * bend.k * bend.angle * bend.angle;
}

JN_INLINE void bend_force(const double* rest, Wide edges[][3], Wide force[][3]) {
	Bend bend;
	Wide g[3][3];
	bend_load(rest, edges, &bend);
	bend_gradient(&bend, g);
	const Wide torque = -bend.k * bend.angle;
	JN_UNROLL for (int k = 0; k < 9; k++) force[k / 3][k % 3] = torque * g[k / 3][k % 3];
}

/// Add `factor` T of one wing to the blocks (w, w), (2, w) and (2, 2).
JN_INLINE void bend_add_wing(const Bend* bend, const BendWing* wing, Wide factor, double* ww, double* two_w,
							 double* two_two) {
	const Wide *n = wing->n, *t = wing->t, *e = bend->e;
	const Wide square = factor * wing->r * wing->r, mixed = factor * wing->r * bend->s;
	const Wide last = wide_fma(square * wing->q, wing->q, 0.5 * factor * bend->s * bend->s);
	JN_UNROLL for (int ab = 0; ab < 9; ab++) {
		const int a = ab / 3, b = ab % 3, at = ab * JN_WIDE;
		const Wide tn = wide_fma(t[a], n[b], n[a] * t[b]), en = wide_fma(e[a], n[b], n[a] * e[b]);
		wide_store(ww + at, wide_load(ww + at) - square * tn);
		wide_store(two_w + at, wide_load(two_w + at) + wide_minor(square * wing->q, tn, mixed, n[a] * e[b]));
		wide_store(two_two + at, wide_load(two_two + at) + wide_minor(mixed * wing->q, en, last, tn));
	}
}

JN_INLINE void bend_tangent(const double* rest, Wide edges[][3], bool definite, double* blocks) {
	Bend bend;
	Wide g[3][3];
	bend_load(rest, edges, &bend);
	bend_gradient(&bend, g);
	JN_UNROLL for (int i = 0; i < 3; i++) {
		JN_UNROLL for (int j = 0; j <= i; j++) {
			JN_UNROLL for (int ab = 0; ab < 9; ab++)
				wide_store(blocks + (9 * (i * (i + 1) / 2 + j) + ab) * JN_WIDE, bend.k * g[i][ab / 3] * g[j][ab % 3]);
		}
	}
	if (definite) return;
	const Wide factor = bend.k * bend.angle;
	const int block = 9 * JN_WIDE;
	bend_add_wing(&bend, &bend.wing[0], factor, blocks, blocks + 3 * block, blocks + 5 * block);
	bend_add_wing(&bend, &bend.wing[1], factor, blocks + 2 * block, blocks + 4 * block, blocks + 5 * block);
}

/// Add `factor` T p of one wing, p at its own node and at node 2.
JN_INLINE void bend_multiply_wing(const Bend* bend, const BendWing* wing, Wide factor, const Wide p[3],
								  const Wide p_2[3], Wide out[3], Wide out_2[3]) {
	const Wide *n = wing->n, *t = wing->t, *e = bend->e;
	const Wide n_2 = wide_dot(n, p_2), t_2 = wide_dot(t, p_2), e_2 = wide_dot(e, p_2);
	const Wide square = factor * wing->r * wing->r, mixed = factor * wing->r * bend->s;
	const Wide half = 0.5 * factor * bend->s * bend->s;
	const Wide along_n = wide_dot(n, p) - wing->q * n_2, along_t = wide_dot(t, p) - wing->q * t_2;
	const Wide on_n = wing->q * e_2 - wide_dot(e, p);
	JN_UNROLL for (int a = 0; a < 3; a++) {
		const Wide turn = square * wide_fma(t[a], along_n, n[a] * along_t);
		out[a] -= wide_fma(mixed * n_2, e[a], turn);
		out_2[a] += wide_fma(wing->q, turn, mixed * wide_fma(on_n, n[a], wing->q * n_2 * e[a]));
		out_2[a] -= half * wide_fma(t[a], n_2, n[a] * t_2);
	}
}

JN_INLINE void bend_product(const double* rest, Wide edges[][3], bool definite, Wide p[][3], Wide out[][3]) {
	Bend bend;
	Wide g[3][3];
	bend_load(rest, edges, &bend);
	bend_gradient(&bend, g);
	const Wide change = bend.k * (wide_dot(g[0], p[0]) + wide_dot(g[1], p[1]) + wide_dot(g[2], p[2]));
	JN_UNROLL for (int k = 0; k < 9; k++) out[k / 3][k % 3] = change * g[k / 3][k % 3];
	if (definite) return;
	const Wide factor = bend.k * bend.angle;
	bend_multiply_wing(&bend, &bend.wing[0], factor, p[0], p[2], out[0], out[2]);
	bend_multiply_wing(&bend, &bend.wing[1], factor, p[1], p[2], out[1], out[2]);
}

#endif
