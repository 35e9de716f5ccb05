/// @file strain.h
/// What stretch and shear of a triangle share: where the unit directions u and v of the cloth have gone (Baraff, Witkin
/// 1998, section 4.1). With the edges d_0, d_1 from node 2,
///
///   w_u = d_0 B_00 + d_1 B_10,   w_v = d_0 B_01 + d_1 B_11,   B = (edges at rest in the frame u, v)^-1.
#ifndef JN_FORCE_CONSTRAINT_STRAIN_H
#define JN_FORCE_CONSTRAINT_STRAIN_H

#include "math/mat3.h"

enum { STRAIN_NODES = 3, STRAIN_REALS = 4 }; // B, row by row; what is behind it belongs to the law

static const double STRAIN_LEAST = 1e-150; // of a unit length: a direction that has vanished pulls nowhere

typedef struct Strain {
	Wide B[2][2];
	Wide w[2][3];
} Strain;

/// w_u and w_v of other edges, such as those of a displacement.
JN_INLINE void strain_directions(const Strain* strain, Wide edges[][3], Wide w[2][3]) {
	JN_UNROLL for (int r = 0; r < 2; r++) {
		JN_UNROLL for (int a = 0; a < 3; a++) {
			w[r][a] = wide_fma(edges[0][a], strain->B[0][r], edges[1][a] * strain->B[1][r]);
		}
	}
}

JN_INLINE void strain_load(const double* rest, Wide edges[][3], Strain* strain) {
	JN_UNROLL for (int k = 0; k < 4; k++) strain->B[k / 2][k % 2] = wide_load(rest + k * JN_WIDE);
	strain_directions(strain, edges, strain->w);
}

/// Forces on nodes 0 and 1 of the stress P_r = dE/dw_r, or of its change.
JN_INLINE void strain_pull(const Strain* strain, Wide P[2][3], double sign, Wide out[][3]) {
	JN_UNROLL for (int i = 0; i < 2; i++) {
		JN_UNROLL for (int a = 0; a < 3; a++) {
			out[i][a] = sign * wide_fma(strain->B[i][0], P[0][a], strain->B[i][1] * P[1][a]);
		}
	}
}

JN_INLINE Wide wide_dot(const Wide a[3], const Wide b[3]) {
	return wide_dot3(a[0], b[0], a[1], b[1], a[2], b[2]);
}

/// Length, and the unit vector.
JN_INLINE Wide strain_length(const Wide w[3], Wide unit[3]) {
	const Wide length = wide_max(wide_sqrt(wide_dot(w, w)), wide_set(STRAIN_LEAST));
	JN_UNROLL for (int a = 0; a < 3; a++) unit[a] = w[a] / length;
	return length;
}

#endif
