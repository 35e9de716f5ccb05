/// @file stretch.h
/// Stretch of a triangle of area A along the threads (Baraff, Witkin 1998, equation 10, as an energy):
///
///   E = A/2 (k_u (|w_u| - 1)^2 + k_v (|w_v| - 1)^2)
///
/// d2E/dw_r2 = A k_r ((1 - 1/|w_r|) (I - e e^T) + e e^T), whose definite form leaves out the first term under compression.
#ifndef JN_FORCE_CONSTRAINT_STRETCH_H
#define JN_FORCE_CONSTRAINT_STRETCH_H

#include "force/constraint/strain.h"

enum { STRETCH_STIFFNESS = STRAIN_REALS, STRETCH_REALS = STRETCH_STIFFNESS + 2 }; // A k_u, A k_v

typedef struct Stretch {
	Strain strain;
	Wide k[2], length[2], e[2][3];
} Stretch;

JN_INLINE void stretch_load(const double* rest, Wide edges[][3], Stretch* s) {
	strain_load(rest, edges, &s->strain);
	JN_UNROLL for (int r = 0; r < 2; r++) {
		s->k[r] = wide_load(rest + (STRETCH_STIFFNESS + r) * JN_WIDE);
		s->length[r] = strain_length(s->strain.w[r], s->e[r]);
	}
}

JN_INLINE Wide stretch_energy(const double* rest, Wide edges[][3]) {
	Stretch s;
	stretch_load(rest, edges, &s);
	const Wide u = s.length[0] - 1.0, v = s.length[1] - 1.0;
	return 0.5 * wide_fma(s.k[0] * u, u, s.k[1] * v * v);
}

JN_INLINE void stretch_force(const double* rest, Wide edges[][3], Wide force[][3]) {
	Stretch s;
	Wide P[2][3];
	stretch_load(rest, edges, &s);
	JN_UNROLL for (int r = 0; r < 2; r++) {
		const Wide tension = s.k[r] * (s.length[r] - 1.0);
		JN_UNROLL for (int a = 0; a < 3; a++) P[r][a] = tension * s.e[r][a];
	}
	strain_pull(&s.strain, P, -1, force);
}

/// d2E/dw_r2 = across I + more e e^T.
JN_INLINE void stretch_stiffness(const Stretch* s, int r, bool definite, Wide* across, Wide* more) {
	const Wide tension = 1.0 - 1.0 / s->length[r];
	*across = s->k[r] * (definite ? wide_max(tension, wide_set(0)) : tension);
	*more = s->k[r] - *across;
}

JN_INLINE void stretch_tangent(const double* rest, Wide edges[][3], bool definite, double* blocks) {
	Stretch s;
	Wide H[2][9];
	stretch_load(rest, edges, &s);
	JN_UNROLL for (int r = 0; r < 2; r++) {
		Wide across, more;
		stretch_stiffness(&s, r, definite, &across, &more);
		JN_UNROLL for (int ab = 0; ab < 9; ab++) {
			const Wide entry = more * s.e[r][ab / 3] * s.e[r][ab % 3];
			H[r][ab] = ab % 4 == 0 ? across + entry : entry;
		}
	}
	JN_UNROLL for (int pair = 0; pair < 3; pair++) {
		const int i = pair > 0, j = pair > 1;
		const Wide u = s.strain.B[i][0] * s.strain.B[j][0], v = s.strain.B[i][1] * s.strain.B[j][1];
		JN_UNROLL for (int ab = 0; ab < 9; ab++)
			wide_store(blocks + (9 * pair + ab) * JN_WIDE, wide_fma(u, H[0][ab], v * H[1][ab]));
	}
}

JN_INLINE void stretch_product(const double* rest, Wide edges[][3], bool definite, Wide p[][3], Wide out[][3]) {
	Stretch s;
	Wide dw[2][3], dP[2][3];
	stretch_load(rest, edges, &s);
	strain_directions(&s.strain, p, dw);
	JN_UNROLL for (int r = 0; r < 2; r++) {
		Wide across, more;
		stretch_stiffness(&s, r, definite, &across, &more);
		const Wide along = more * wide_dot(s.e[r], dw[r]);
		JN_UNROLL for (int a = 0; a < 3; a++) dP[r][a] = wide_fma(along, s.e[r][a], across * dw[r][a]);
	}
	strain_pull(&s.strain, dP, 1, out);
}

#endif
