/// @file jacobian.h
/// From nodes to the Jacobians J = sum_i x_i (x) dN_i/dxi at all points of an element, and back, with fewer operations than
/// there are pairs of nodes and points. Column r of J is written once for all points that share it:
///
///   tet4   one point: differences from node 0
///   tet10  gradients at the points differ from a common part by one node each
///   hex8   column r does not depend on xi_r: 4 columns for 8 points, by sums and differences along one axis at a time
///
/// Element and point are compile-time constants, or the point is a variable of a short loop.
#ifndef JN_FORCE_JACOBIAN_H
#define JN_FORCE_JACOBIAN_H

#include "force/element.h"
#include "force/real.h"

enum { JN_COLUMNS = 4 }; ///< different values of a column of J in an element, at most

typedef struct Jacobians {
	Real column[3][JN_COLUMNS][3]; ///< [r][place][component]
} Jacobians;

/// Where column r of point p stands.
JN_INLINE int jacobian_place(JnShape shape, int r, int p) {
	if (shape != JN_HEX8) return p;
	return r == 0 ? p >> 1 : r == 1 ? (p & 1) | (p >> 2 << 1) : p & 3;
}

JN_INLINE void jacobian_at(JnShape shape, const Jacobians* jacobians, int p, Real J[3][3]) {
	JN_UNROLL for (int r = 0; r < 3; ++r) {
		JN_UNROLL for (int a = 0; a < 3; ++a) J[a][r] = jacobians->column[r][jacobian_place(shape, r, p)][a];
	}
}

/// Add G, row by row the factor of dJ at point p in some sum.
JN_INLINE void jacobian_add(JnShape shape, Jacobians* jacobians, int p, Real G[3][3]) {
	JN_UNROLL for (int r = 0; r < 3; ++r) {
		JN_UNROLL for (int a = 0; a < 3; ++a) jacobians->column[r][jacobian_place(shape, r, p)][a] += G[a][r];
	}
}

/// Columns that an element has.
JN_INLINE int jacobian_columns(JnShape shape) {
	return shape == JN_TET4 ? 1 : 4;
}

JN_INLINE void jacobians_clear(JnShape shape, Jacobians* jacobians) {
	for (int r = 0; r < 3; ++r)
		for (int place = 0; place < jacobian_columns(shape); ++place)
			JN_UNROLL for (int a = 0; a < 3; ++a) jacobians->column[r][place][a] = real_set(0);
}

// ---- tet4 ----

/// `x`: nodes without the last, from which they are measured.
JN_INLINE void tet4_jacobians(Real x[][3], Jacobians* out) {
	JN_UNROLL for (int a = 0; a < 3; ++a) {
		out->column[0][0][a] = x[1][a] - x[0][a];
		out->column[1][0][a] = x[2][a] - x[0][a];
		out->column[2][0][a] = -x[0][a];
	}
}

/// The derivatives for all nodes of what the columns are factors in: the transpose of tet4_jacobians.
JN_INLINE void tet4_nodes(const Jacobians* in, Real f[][3]) {
	JN_UNROLL for (int a = 0; a < 3; ++a) {
		const Real g0 = in->column[0][0][a], g1 = in->column[1][0][a], g2 = in->column[2][0][a];
		f[0][a] = -(g0 + g1 + g2);
		f[1][a] = g0;
		f[2][a] = g1;
		f[3][a] = g2;
	}
}

// ---- tet10 ----
// dx/dL_i at the points, barycentric coordinates taken as independent, with `near` at corner p and `far` elsewhere:
//   g_i(p) = (4 far - 1) x_i + 4 far (sum of the mid-edge nodes at i) + 4 (near - far) x_ip,   x_ii = x_i.

static const int tet10_edge[4][4] = {{0, 4, 6, 7}, {4, 1, 5, 8}, {6, 5, 2, 9}, {7, 8, 9, 3}}; // node of corners i, j

#define TET10_FAR (4 * JN_TET10_FAR)
#define TET10_STEP (4 * (JN_TET10_NEAR - JN_TET10_FAR))

JN_INLINE void tet10_jacobians(Real x[][3], Jacobians* out) {
	const Real corner = real_set(TET10_FAR - 1), far = real_set(TET10_FAR), step = real_set(TET10_STEP);
	JN_UNROLL for (int a = 0; a < 3; ++a) {
		const Real n[10] = {x[0][a], x[1][a], x[2][a], x[3][a], x[4][a],
							x[5][a], x[6][a], x[7][a], x[8][a], real_set(0)};
		Real base[4];
		base[0] = real_fma(far, n[4] + n[6] + n[7], corner * n[0]);
		base[1] = real_fma(far, n[4] + n[5] + n[8], corner * n[1]);
		base[2] = real_fma(far, n[5] + n[6], corner * n[2]);
		base[3] = real_fma(far, n[7] + n[8], corner * n[3]);
		JN_UNROLL for (int p = 0; p < 4; ++p) {
			const Real zeroth = real_fma(step, n[tet10_edge[0][p]], base[0]);
			JN_UNROLL for (int r = 0; r < 3; ++r) {
				out->column[r][p][a] = real_fma(step, n[tet10_edge[r + 1][p]], base[r + 1]) - zeroth;
			}
		}
	}
}

JN_INLINE void tet10_nodes(const Jacobians* in, Real f[][3]) {
	const Real corner = real_set(TET10_FAR - 1), far = real_set(TET10_FAR), step = real_set(TET10_STEP);
	JN_UNROLL for (int a = 0; a < 3; ++a) {
		Real g[4][4], sum[4]; // [corner][point]
		JN_UNROLL for (int p = 0; p < 4; ++p) {
			JN_UNROLL for (int r = 0; r < 3; ++r) g[r + 1][p] = in->column[r][p][a];
			g[0][p] = -(g[1][p] + g[2][p] + g[3][p]);
		}
		JN_UNROLL for (int i = 0; i < 4; ++i) {
			sum[i] = (g[i][0] + g[i][1]) + (g[i][2] + g[i][3]);
			f[i][a] = real_fma(step, g[i][i], corner * sum[i]);
		}
		JN_UNROLL for (int i = 0; i < 4; ++i) {
			JN_UNROLL for (int j = 0; j < 4; ++j) {
				if (j <= i) continue;
				f[tet10_edge[i][j]][a] = real_fma(step, g[i][j] + g[j][i], far * (sum[i] + sum[j]));
			}
		}
	}
}

// ---- hex8 ----
// Eight node values are eight modes 1, xi, eta, zeta, xi eta, ...; the first has no gradient. Pairs of nodes along xi
// stand at (eta, zeta) = (-,-), (+,-), (-,+), (+,+).

JN_INLINE void hex8_jacobians(Real x[][3], Jacobians* out) {
	const Real gauss = real_set(JN_GAUSS);
	JN_UNROLL for (int a = 0; a < 3; ++a) {
		const Real d0 = x[1][a] - x[0][a], d1 = x[2][a] - x[3][a], d2 = x[5][a] - x[4][a], d3 = x[6][a];
		const Real s0 = x[1][a] + x[0][a], s1 = x[2][a] + x[3][a], s2 = x[5][a] + x[4][a], s3 = x[6][a];
		const Real dd0 = d1 - d0, ds0 = d1 + d0, dd1 = d3 - d2, ds1 = d3 + d2;
		const Real sd0 = s1 - s0, ss0 = s1 + s0, sd1 = s3 - s2, ss1 = s3 + s2;
		const Real xi = ds1 + ds0, xi_zeta = ds1 - ds0, xi_eta = dd1 + dd0, all = dd1 - dd0;
		const Real eta = sd1 + sd0, eta_zeta = sd1 - sd0, zeta = ss1 - ss0;
		JN_UNROLL for (int i = 0; i < 2; ++i) {
			const Real g = i == 0 ? -gauss : gauss;
			const Real xi_line = real_fma(g, xi_zeta, xi), eta_line = real_fma(g, eta_zeta, eta);
			const Real xi_eta_line = real_fma(g, all, xi_eta);
			const Real zeta_line = real_fma(g, eta_zeta, zeta), xi_zeta_line = real_fma(g, all, xi_zeta);
			JN_UNROLL for (int j = 0; j < 2; ++j) {
				const Real h = j == 0 ? -gauss : gauss;
				out->column[0][2 * i + j][a] = real_fma(h, xi_eta_line, xi_line);
				out->column[1][2 * i + j][a] = real_fma(h, xi_eta_line, eta_line);
				out->column[2][2 * i + j][a] = real_fma(h, xi_zeta_line, zeta_line);
			}
		}
	}
}

JN_INLINE void hex8_nodes(const Jacobians* in, Real f[][3]) {
	const Real gauss = real_set(JN_GAUSS);
	JN_UNROLL for (int a = 0; a < 3; ++a) {
		Real xi_line[2], eta_line[2], zeta_line[2], xi_eta_line[2], xi_zeta_line[2];
		JN_UNROLL for (int i = 0; i < 2; ++i) {
			const Real x0 = in->column[0][2 * i][a], x1 = in->column[0][2 * i + 1][a];
			const Real y0 = in->column[1][2 * i][a], y1 = in->column[1][2 * i + 1][a];
			const Real z0 = in->column[2][2 * i][a], z1 = in->column[2][2 * i + 1][a];
			xi_line[i] = x1 + x0;
			eta_line[i] = y1 + y0;
			zeta_line[i] = z1 + z0;
			xi_eta_line[i] = (x1 - x0) + (y1 - y0);
			xi_zeta_line[i] = z1 - z0;
		}
		const Real xi = xi_line[1] + xi_line[0], eta = eta_line[1] + eta_line[0], zeta = zeta_line[1] + zeta_line[0];
		const Real xi_eta = gauss * (xi_eta_line[1] + xi_eta_line[0]);
		const Real xi_zeta = gauss * ((xi_line[1] - xi_line[0]) + (xi_zeta_line[1] + xi_zeta_line[0]));
		const Real eta_zeta = gauss * ((eta_line[1] - eta_line[0]) + (zeta_line[1] - zeta_line[0]));
		const Real all =
			real_set(JN_GAUSS * JN_GAUSS) * ((xi_eta_line[1] - xi_eta_line[0]) + (xi_zeta_line[1] - xi_zeta_line[0]));
		const Real ds1 = xi + xi_zeta, ds0 = xi - xi_zeta, dd1 = xi_eta + all, dd0 = xi_eta - all;
		const Real sd1 = eta + eta_zeta, sd0 = eta - eta_zeta;
		const Real d0 = ds0 - dd0, d1 = ds0 + dd0, d2 = ds1 - dd1, d3 = ds1 + dd1;
		const Real s0 = -zeta - sd0, s1 = sd0 - zeta, s2 = zeta - sd1, s3 = zeta + sd1;
		f[0][a] = s0 - d0;
		f[1][a] = s0 + d0;
		f[2][a] = s1 + d1;
		f[3][a] = s1 - d1;
		f[4][a] = s2 - d2;
		f[5][a] = s2 + d2;
		f[6][a] = s3 + d3;
		f[7][a] = s3 - d3;
	}
}

JN_INLINE void jacobians_of(JnShape shape, Real x[][3], Jacobians* out) {
	if (shape == JN_TET4)
		tet4_jacobians(x, out);
	else if (shape == JN_TET10)
		tet10_jacobians(x, out);
	else
		hex8_jacobians(x, out);
}

JN_INLINE void nodes_of(JnShape shape, const Jacobians* in, Real f[][3]) {
	if (shape == JN_TET4)
		tet4_nodes(in, f);
	else if (shape == JN_TET10)
		tet10_nodes(in, f);
	else
		hex8_nodes(in, f);
}

// ---- between the reference element and the rest state: L lower triangular, stored by rows ----

/// F = J L.
JN_INLINE void times_lower(Real J[3][3], const Real L[6], Real F[3][3]) {
	JN_UNROLL for (int a = 0; a < 3; ++a) {
		F[a][2] = J[a][2] * L[5];
		F[a][1] = real_fma(J[a][1], L[2], J[a][2] * L[4]);
		F[a][0] = real_dot3(J[a][0], L[0], J[a][1], L[1], J[a][2], L[3]);
	}
}

/// G = P L^T.
JN_INLINE void times_upper(Real P[3][3], const Real L[6], Real G[3][3]) {
	JN_UNROLL for (int a = 0; a < 3; ++a) {
		G[a][0] = P[a][0] * L[0];
		G[a][1] = real_fma(P[a][0], L[1], P[a][1] * L[2]);
		G[a][2] = real_dot3(P[a][0], L[3], P[a][1], L[4], P[a][2], L[5]);
	}
}

#endif
