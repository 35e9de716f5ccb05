// Mean ratio of tetrahedra: A. Liu, B. Joe, Relationship between tetrahedron shape measures, BIT 34 (1994).
// Scaled Jacobian of hexahedra: P. Knupp, Achieving finite element mesh quality via optimization of the Jacobian matrix
// norm and associated quantities, Int. J. Numer. Meth. Eng. 48 (2000).
#include "mesh/quality.h"

#include <math.h>
#include <stdlib.h>

#include "math/mat3.h"

static const double* corner(const JnMesh* mesh, int cell, int local) {
	const int nodes = jn_shape_info[mesh->shape].nodes;
	return mesh->nodes + 3 * (ptrdiff_t)mesh->cells[(ptrdiff_t)cell * nodes + local];
}

static double squared_distance(const double* a, const double* b) {
	double sum = 0;
	for (int k = 0; k < 3; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
	return sum;
}

/// 12 (3 |V|)^(2/3) / sum of squared edges, with the sign of V.
static double mean_ratio(const JnMesh* mesh, int cell) {
	double squares = 0;
	for (int i = 0; i < 4; ++i)
		for (int j = 0; j < i; ++j) squares += squared_distance(corner(mesh, cell, i), corner(mesh, cell, j));
	const double root = cbrt(3 * jn_mesh_cell_volume(mesh, cell));
	return squares > 0 ? copysign(12 * root * root / squares, root) : 0;
}

/// det(edges) / product of their lengths at one corner; the neighbours are in right-handed order.
static double corner_jacobian(const JnMesh* mesh, int cell, int at, const int neighbours[3]) {
	const double* origin = corner(mesh, cell, at);
	double edges[3][3], lengths = 1;
	for (int e = 0; e < 3; ++e) {
		const double* end = corner(mesh, cell, neighbours[e]);
		for (int k = 0; k < 3; ++k) edges[e][k] = end[k] - origin[k];
		lengths *= sqrt(squared_distance(end, origin));
	}
	return lengths > 0 ? mat3_determinant(edges) / lengths : 0;
}

static double scaled_jacobian(const JnMesh* mesh, int cell) {
	static const int neighbours[8][3] = {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7},
										 {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};
	double least = INFINITY;
	for (int i = 0; i < 8; ++i) least = fmin(least, corner_jacobian(mesh, cell, i, neighbours[i]));
	return least;
}

double jn_cell_quality(const JnMesh* mesh, int cell) {
	return mesh->shape == JN_HEX8 ? scaled_jacobian(mesh, cell) : mean_ratio(mesh, cell);
}

static int compare(const void* left, const void* right) {
	const double a = *(const double*)left, b = *(const double*)right;
	return (a > b) - (a < b);
}

JnStatus jn_mesh_quality(const JnMesh* mesh, JnQuality* quality) {
	*quality = (JnQuality){.measure = mesh->shape == JN_HEX8 ? "scaled Jacobian" : "mean ratio", .worst = -1};
	const int count = mesh->cell_count;
	if (count == 0) return JN_OK;
	JnArena scratch = {0};
	double* values;
	JN_NEW(&scratch, values, count);
	for (int cell = 0; cell < count; ++cell) {
		values[cell] = jn_cell_quality(mesh, cell);
		if (quality->worst < 0 || values[cell] < values[quality->worst]) quality->worst = cell;
	}
	quality->min = values[quality->worst];
	qsort(values, (size_t)count, sizeof *values, compare);
	quality->median = (values[(count - 1) / 2] + values[count / 2]) / 2;
	jn_arena_free(&scratch);
	return JN_OK;
}
