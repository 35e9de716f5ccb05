/// @file diagonal.h
/// g . dP/dF . g of each law, the diagonal block of a node with gradient g, from what <law>_linearize has left of F: sums of
/// few squares, where the whole of dP/dF has 45 numbers. Each adds `weight` times it to the lower triangle `block`, by rows.
#ifndef JN_FORCE_MATERIAL_DIAGONAL_H
#define JN_FORCE_MATERIAL_DIAGONAL_H

#include "force/material/differential.h"

typedef void WideDiagonal(const double* constants, const Wide stored[], Wide weight, const Wide g[3], Wide block[6]);

JN_INLINE Wide square3(const Wide g[3]) {
	return wide_dot3(g[0], g[0], g[1], g[1], g[2], g[2]);
}

/// A g.
JN_INLINE void times_vector(const Wide A[9], const Wide g[3], Wide out[3]) {
	JN_UNROLL for (int r = 0; r < 3; r++) out[r] = wide_dot3(A[3 * r], g[0], A[3 * r + 1], g[1], A[3 * r + 2], g[2]);
}

/// block += scale v v^T.
JN_INLINE void add_square(Wide scale, const Wide v[3], Wide block[6]) {
	JN_UNROLL for (int r = 0, k = 0; r < 3; r++) {
		const Wide scaled = scale * v[r];
		JN_UNROLL for (int c = 0; c <= r; c++, k++) block[k] = wide_fma(scaled, v[c], block[k]);
	}
}

JN_INLINE void add_identity(Wide scale, Wide block[6]) {
	block[0] += scale;
	block[2] += scale;
	block[5] += scale;
}

/// a |g|^2 I + l (H g)(H g)^T.
JN_INLINE void turned_diagonal(Wide a, Wide l, const Wide H[9], Wide weight, const Wide g[3], Wide block[6]) {
	Wide Hg[3];
	times_vector(H, g, Hg);
	add_identity(weight * a * square3(g), block);
	add_square(weight * l, Hg, block);
}

JN_INLINE void corotated_frozen_diagonal(const double* constants, const Wide stored[], Wide weight, const Wide g[3],
										 Wide block[6]) {
	const double mu = constants[JN_LAW_MU], lambda = constants[JN_LAW_LAMBDA];
	turned_diagonal(wide_set(mu), wide_set(mu + lambda), stored, weight, g, block);
}

#define linear_diagonal corotated_frozen_diagonal

JN_INLINE void neo_hookean_diagonal(const double* constants, const Wide stored[], Wide weight, const Wide g[3],
									Wide block[6]) {
	const double mu = constants[JN_LAW_MU], lambda = constants[JN_LAW_LAMBDA];
	turned_diagonal(wide_set(mu), stored[9] + lambda, stored, weight, g, block);
}

/// (g . S g) I + mu |g|^2 F F^T + (mu + lambda)(F g)(F g)^T.
JN_INLINE void st_venant_kirchhoff_diagonal(const double* constants, const Wide stored[], Wide weight, const Wide g[3],
											Wide block[6]) {
	const double mu = constants[JN_LAW_MU], lambda = constants[JN_LAW_LAMBDA];
	const Wide *S = stored + 9, of_FFt = mu * weight * square3(g);
	Wide Fg[3];
	times_vector(stored, g, Fg);
	const Wide pulled =
		wide_dot3(g[0], wide_dot3(S[0], g[0], S[1], g[1], S[3], g[2]), g[1],
				  wide_dot3(S[1], g[0], S[2], g[1], S[4], g[2]), g[2], wide_dot3(S[3], g[0], S[4], g[1], S[5], g[2]));
	add_identity(weight * pulled, block);
	add_square(weight * (mu + lambda), Fg, block);
	JN_UNROLL for (int r = 0, k = 0; r < 3; r++) {
		JN_UNROLL for (int c = 0; c <= r; c++, k++) {
			const Wide *a = stored + 3 * r, *b = stored + 3 * c;
			block[k] = wide_fma(of_FFt, wide_dot3(a[0], b[0], a[1], b[1], a[2], b[2]), block[k]);
		}
	}
}

/// a |g|^2 I + b (F g)(F g)^T + l (C g)(C g)^T: the derivative of cof F along e g^T has no part along g.
JN_INLINE void stable_neo_hookean_diagonal(const double* constants, const Wide stored[], Wide weight, const Wide g[3],
										   Wide block[6]) {
	Wide C[9], Fg[3], Cg[3];
	real_cofactor(stored, C);
	times_vector(stored, g, Fg);
	times_vector(C, g, Cg);
	add_identity(weight * stored[9] * square3(g), block);
	add_square(weight * stored[10], Fg, block);
	add_square(weight * constants[STABLE_L], Cg, block);
}

/// 2 mu |g|^2 I + lambda (R g)(R g)^T + W G W^T, the rows of W being g x (row of R).
JN_INLINE void corotated_diagonal(const double* constants, const Wide stored[], Wide weight, const Wide g[3],
								  Wide block[6]) {
	const Wide *R = stored, *G = stored + 9;
	Wide Rg[3];
	times_vector(R, g, Rg);
	add_identity(2.0 * constants[JN_LAW_MU] * weight * square3(g), block);
	add_square(weight * constants[JN_LAW_LAMBDA], Rg, block);
	Wide W[3][3];
	JN_UNROLL for (int a = 0; a < 3; a++) {
		JN_UNROLL for (int i = 0; i < 3; i++) {
			const int j = (i + 1) % 3, k = (i + 2) % 3;
			W[a][i] = wide_minor(g[j], R[3 * a + k], g[k], R[3 * a + j]);
		}
	}
	JN_UNROLL for (int r = 0, k = 0; r < 3; r++) {
		const Wide *v = W[r], x = weight * wide_dot3(G[0], v[0], G[1], v[1], G[3], v[2]),
				   y = weight * wide_dot3(G[1], v[0], G[2], v[1], G[4], v[2]),
				   z = weight * wide_dot3(G[3], v[0], G[4], v[1], G[5], v[2]);
		JN_UNROLL for (int c = 0; c <= r; c++, k++) {
			block[k] = wide_fma(x, W[c][0], wide_fma(y, W[c][1], wide_fma(z, W[c][2], block[k])));
		}
	}
}

/// Any law, from the lower triangle of dP/dF by rows.
JN_INLINE void whole_diagonal(const double* constants, const Wide A[], Wide weight, const Wide g[3], Wide block[6]) {
	(void)constants;
	JN_UNROLL for (int a = 0, k = 0; a < 3; a++) {
		JN_UNROLL for (int b = 0; b <= a; b++, k++) {
			Wide sum = wide_set(0);
			JN_UNROLL for (int cd = 0; cd < 9; cd++) {
				const int ac = 3 * a + cd / 3, bd = 3 * b + cd % 3;
				const int at = bd <= ac ? ac * (ac + 1) / 2 + bd : bd * (bd + 1) / 2 + ac;
				sum = wide_fma(A[at], g[cd / 3] * g[cd % 3], sum);
			}
			block[k] = wide_fma(weight, sum, block[k]);
		}
	}
}

#endif
