#include "force/deformation.h"

#include <math.h>

#include "force/element.h"
#include "math/mat3.h"

static const JnElement* const elements[JN_SOLID_SHAPE_COUNT] = {
	[JN_TET4] = &jn_element_tet4, [JN_TET10] = &jn_element_tet10, [JN_HEX8] = &jn_element_hex8};

// det of sum_i x_i (x) dN_i/dxi at point p, relative to the last node.
static double determinant(const JnElement* element, const int* nodes, int p, const double* x) {
	const double* origin = x + 3 * (ptrdiff_t)nodes[element->nodes - 1];
	double J[3][3] = {{0}};
	for (int i = 0; i < element->nodes - 1; ++i)
		for (int k = 0; k < 9; ++k)
			J[k / 3][k % 3] += (x[3 * (ptrdiff_t)nodes[i] + k / 3] - origin[k / 3]) * element->gradient[p][i][k % 3];
	return mat3_determinant(J);
}

double jn_cell_volume_ratio(const JnMesh* mesh, int cell, const double* x) {
	double smallest = INFINITY;
	if (mesh->shape >= JN_SOLID_SHAPE_COUNT) return NAN;
	const JnElement* element = elements[mesh->shape];
	const int* nodes = mesh->cells + (ptrdiff_t)cell * element->nodes;
	for (int p = 0; p < element->points; ++p) {
		const double ratio = determinant(element, nodes, p, x) / determinant(element, nodes, p, mesh->nodes);
		if (!(ratio >= smallest)) smallest = ratio; // true for NAN, which then stays
		if (isnan(smallest)) break;
	}
	return smallest;
}

static double distance(const double* x, int i, int j) {
	const double *a = x + 3 * (ptrdiff_t)i, *b = x + 3 * (ptrdiff_t)j;
	return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

double jn_element_stretch(const JnGroup* group, int element, const double* rest, const double* x) {
	double farthest = 1;
	for (int i = 1; i < group->kernel->nodes; ++i)
		for (int j = 0; j < i; ++j) {
			const int a = jn_group_node(group, element, i), b = jn_group_node(group, element, j);
			const double at_rest = distance(rest, a, b), ratio = distance(x, a, b) / at_rest;
			if (at_rest > 0 && fabs(log(ratio)) > fabs(log(farthest))) farthest = ratio;
		}
	return farthest;
}
