// X(xi) = sum_i N_i(xi) X_i, with N = 1 - r - s - t, r, s, t for tet4 and products of r or 1 - r, ... for hex8; Newton's
// method turns it around, in one step for every cell whose opposite edges are parallel.
#include "mesh/cell_map.h"

#include <math.h>

#include "math/mat3.h"

enum { MOST_STEPS = 30 };
static const double PRECISION = 1e-10; // of xi: the slope in the weights takes away what is left
static const double FAR = 1e3;         // cells away from the cell: Newton's method is lost

/// Shape functions N[i] and their slopes G[i][r] = dN_i/dxi_r.
static void shape_functions(JnShape shape, const double xi[3], double N[], double G[][3]) {
	if (shape == JN_TET4) {
		N[0] = 1 - xi[0] - xi[1] - xi[2];
		for (int r = 0; r < 3; ++r) {
			N[1 + r] = xi[r];
			for (int i = 0; i < 4; ++i) G[i][r] = i == 0 ? -1 : i == 1 + r;
		}
		return;
	}
	for (int i = 0; i < 8; ++i) {
		double part[3];
		for (int r = 0; r < 3; ++r) part[r] = jn_hex_corner[i][r] == 1 ? xi[r] : 1 - xi[r];
		N[i] = part[0] * part[1] * part[2];
		for (int r = 0; r < 3; ++r) G[i][r] = (2 * jn_hex_corner[i][r] - 1) * part[(r + 1) % 3] * part[(r + 2) % 3];
	}
}

/// gap = point - X(xi) and J[k][r] = dX_k/dxi_r; seen from node 0, so that far from the origin no digits are lost.
static void map_at(const JnMesh* mesh, int cell, const double point[3], double N[], double G[][3], double gap[3],
				   double J[3][3]) {
	const int count = jn_shape_info[mesh->shape].nodes;
	const int* nodes = mesh->cells + (ptrdiff_t)cell * count;
	const double* origin = mesh->nodes + 3 * (ptrdiff_t)nodes[0];
	for (int k = 0; k < 3; ++k) {
		gap[k] = point[k] - origin[k];
		for (int r = 0; r < 3; ++r) J[k][r] = 0;
		for (int i = 1; i < count; ++i) {
			const double edge = mesh->nodes[3 * (ptrdiff_t)nodes[i] + k] - origin[k];
			gap[k] -= N[i] * edge;
			for (int r = 0; r < 3; ++r) J[k][r] += edge * G[i][r];
		}
	}
}

bool jn_cell_natural(const JnMesh* mesh, int cell, const double point[3], double xi[3]) {
	for (int r = 0; r < 3; ++r) xi[r] = mesh->shape == JN_TET4 ? 0.25 : 0.5;
	for (int step = 0; step < MOST_STEPS; ++step) {
		double N[JN_CELL_MAP_NODES], G[JN_CELL_MAP_NODES][3], gap[3], J[3][3], inverse[3][3], moved = 0;
		shape_functions(mesh->shape, xi, N, G);
		map_at(mesh, cell, point, N, G, gap, J);
		mat3_invert(J, inverse);
		for (int r = 0; r < 3; ++r) {
			const double change = inverse[r][0] * gap[0] + inverse[r][1] * gap[1] + inverse[r][2] * gap[2];
			xi[r] += change;
			moved = fmax(moved, fabs(change));
			if (!(fabs(xi[r]) < FAR)) return false; // nor is NAN
		}
		if (moved < PRECISION) return true;
	}
	return false;
}

/// Inside the tetrahedron of natural coordinates: none negative, a sum of at most 1.
static void clamp_tet(double xi[3]) {
	double sum = 0;
	for (int r = 0; r < 3; ++r) sum += xi[r] = fmax(xi[r], 0);
	for (int r = 0; r < 3 && sum > 1; ++r) xi[r] /= sum;
}

double jn_cell_clamp(JnShape shape, double xi[3]) {
	double outside = shape == JN_TET4 ? fmax(xi[0] + xi[1] + xi[2] - 1, 0) : 0;
	for (int r = 0; r < 3; ++r) {
		outside = fmax(outside, -xi[r]);
		if (shape == JN_HEX8) outside = fmax(outside, xi[r] - 1);
		if (shape == JN_HEX8) xi[r] = fmin(fmax(xi[r], 0), 1);
	}
	if (shape == JN_TET4) clamp_tet(xi);
	return outside;
}

bool jn_cell_weights(const JnMesh* mesh, int cell, const double xi[3], const double point[3],
					 double weights[JN_CELL_MAP_NODES]) {
	double G[JN_CELL_MAP_NODES][3], gap[3], J[3][3], inverse[3][3], step[3];
	shape_functions(mesh->shape, xi, weights, G);
	map_at(mesh, cell, point, weights, G, gap, J);
	mat3_invert(J, inverse);
	for (int r = 0; r < 3; ++r) step[r] = inverse[r][0] * gap[0] + inverse[r][1] * gap[1] + inverse[r][2] * gap[2];
	bool is_finite = true;
	for (int i = 0; i < jn_shape_info[mesh->shape].nodes; ++i) {
		weights[i] += G[i][0] * step[0] + G[i][1] * step[1] + G[i][2] * step[2];
		is_finite = is_finite && isfinite(weights[i]);
	}
	return is_finite;
}
