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
