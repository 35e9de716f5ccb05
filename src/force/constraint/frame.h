/// @file frame.h
/// What the elements between two neighbouring frames R, P, Q of a thread share. Of each frame, the two vectors
///
///   u = P - R,   v = beta (P - R) + gamma (Q - R),
///
/// with constants beta and gamma that make them perpendicular and equally long in the section at rest; and
/// t = (R + P + Q)_1 - (R + P + Q)_0, three times the step from centre to centre. Nodes: R_0 P_0 Q_0 R_1 P_1 Q_1.
#ifndef JN_FORCE_CONSTRAINT_FRAME_H
#define JN_FORCE_CONSTRAINT_FRAME_H

#include "force/constraint/columns.h"

enum { FRAME_PAIR_NODES = 6, FRAME_BETA = 0, FRAME_GAMMA = 1, FRAME_REALS = 2 };

typedef struct FramePair {
	Wide u[2][3], v[2][3], t[3]; // of either frame
} FramePair;

typedef struct FrameSection {
	Wide beta, gamma;
} FrameSection;

JN_INLINE FrameSection frame_section(const double* rest) {
	return (FrameSection){wide_load(rest + FRAME_BETA * JN_WIDE), wide_load(rest + FRAME_GAMMA * JN_WIDE)};
}

/// Linear in the edges, so that it serves displacements too.
JN_INLINE void frame_vectors(const FrameSection* section, Wide edges[][3], FramePair* f) {
	JN_UNROLL for (int a = 0; a < 3; a++) {
		const Wide p_0 = edges[1][a] - edges[0][a], q_0 = edges[2][a] - edges[0][a];
		const Wide p_1 = edges[4][a] - edges[3][a], q_1 = -edges[3][a];
		f->u[0][a] = p_0;
		f->u[1][a] = p_1;
		f->v[0][a] = wide_fma(section->beta, p_0, section->gamma * q_0);
		f->v[1][a] = wide_fma(section->beta, p_1, section->gamma * q_1);
		f->t[a] = (edges[3][a] + edges[4][a]) - (edges[0][a] + edges[1][a] + edges[2][a]);
	}
}

/// Forces on the nodes from those on the vectors, without t's; all add up to zero.
JN_INLINE void frame_pull(const FrameSection* section, const FramePair* on, Wide out[][3]) {
	JN_UNROLL for (int a = 0; a < 3; a++) {
		JN_UNROLL for (int i = 0; i < 2; i++) {
			const Wide p = wide_fma(section->beta, on->v[i][a], on->u[i][a]), q = section->gamma * on->v[i][a];
			out[3 * i][a] = -(p + q);
			out[3 * i + 1][a] = p;
			if (i == 0) out[2][a] = q; // Q_1 is the last node
		}
	}
}

#endif
