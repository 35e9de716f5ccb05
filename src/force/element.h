/// @file element.h
/// Reference elements: weights and gradients of the shape functions at the quadrature points, as constants.
/// tet4 and tet10 live on xi, eta, zeta >= 0 with sum <= 1; hex8 on [-1/8, 1/8]^3, where gradients are sums of node values
/// without factors. Node order is that of VTK.
#ifndef JN_FORCE_ELEMENT_H
#define JN_FORCE_ELEMENT_H

#include "mesh/mesh.h"

enum { JN_ELEMENT_NODES = 10, JN_ELEMENT_POINTS = 8 };

typedef struct JnElement {
	int nodes, points;
	double weight;                                               ///< of every point, in the reference volume
	double gradient[JN_ELEMENT_POINTS][JN_ELEMENT_NODES - 1][3]; ///< dN_i/dxi_r; the last node's is minus the sum
} JnElement;

// Each node's gradient is minus the sum of the others', so the last one is left out everywhere: positions enter as
// differences from the last node, and its force is minus the sum of the others'.

static const JnElement jn_element_tet4 = {
	.nodes = 4,
	.points = 1,
	.weight = 1.0 / 6.0,
	.gradient = {{{-1, -1, -1}, {1, 0, 0}, {0, 1, 0}}},
};

// Gradients at barycentric coordinates (a, b, c, d) of N_i = L_i (2 L_i - 1) and N_ij = 4 L_i L_j.
#define JN_TET10_POINT(a, b, c, d)                                                                                     \
	{                                                                                                                  \
		{1 - 4 * (a), 1 - 4 * (a), 1 - 4 * (a)}, {4 * (b)-1, 0, 0}, {0, 4 * (c)-1, 0}, {0, 0, 4 * (d)-1},              \
			{4 * ((a) - (b)), -4 * (b), -4 * (b)}, {4 * (c), 4 * (b), 0}, {-4 * (c), 4 * ((a) - (c)), -4 * (c)},       \
			{-4 * (d), -4 * (d), 4 * ((a) - (d))}, {                                                                   \
			4 * (d), 0, 4 * (b)                                                                                        \
		}                                                                                                              \
	}
// (5 + 3 sqrt 5)/20 and (5 - sqrt 5)/20: exact for quadratics (Hammer, Stroud 1956).
#define JN_TET10_NEAR 0.58541019662496845446
#define JN_TET10_FAR 0.13819660112501051518

static const JnElement jn_element_tet10 = {
	.nodes = 10,
	.points = 4,
	.weight = 1.0 / 24.0,
	.gradient = {JN_TET10_POINT(JN_TET10_NEAR, JN_TET10_FAR, JN_TET10_FAR, JN_TET10_FAR),
				 JN_TET10_POINT(JN_TET10_FAR, JN_TET10_NEAR, JN_TET10_FAR, JN_TET10_FAR),
				 JN_TET10_POINT(JN_TET10_FAR, JN_TET10_FAR, JN_TET10_NEAR, JN_TET10_FAR),
				 JN_TET10_POINT(JN_TET10_FAR, JN_TET10_FAR, JN_TET10_FAR, JN_TET10_NEAR)},
};

// Gradient at 1/8 (x, y, z) of N = (1 + 8 i xi)(1 + 8 j eta)(1 + 8 k zeta)/8.
#define JN_HEX8_NODE(i, j, k, x, y, z)                                                                                 \
	{                                                                                                                  \
		(i) * (1 + (j) * (y)) * (1 + (k) * (z)), (j) * (1 + (i) * (x)) * (1 + (k) * (z)),                              \
			(k) * (1 + (i) * (x)) * (1 + (j) * (y))                                                                    \
	}
#define JN_HEX8_POINT(x, y, z)                                                                                         \
	{                                                                                                                  \
		JN_HEX8_NODE(-1, -1, -1, x, y, z), JN_HEX8_NODE(1, -1, -1, x, y, z), JN_HEX8_NODE(1, 1, -1, x, y, z),          \
			JN_HEX8_NODE(-1, 1, -1, x, y, z), JN_HEX8_NODE(-1, -1, 1, x, y, z), JN_HEX8_NODE(1, -1, 1, x, y, z),       \
			JN_HEX8_NODE(1, 1, 1, x, y, z)                                                                             \
	}
// 1/sqrt(3).
#define JN_GAUSS 0.57735026918962576451

static const JnElement jn_element_hex8 = {
	.nodes = 8,
	.points = 8,
	.weight = 1.0 / 512.0,
	.gradient = {JN_HEX8_POINT(-JN_GAUSS, -JN_GAUSS, -JN_GAUSS), JN_HEX8_POINT(JN_GAUSS, -JN_GAUSS, -JN_GAUSS),
				 JN_HEX8_POINT(-JN_GAUSS, JN_GAUSS, -JN_GAUSS), JN_HEX8_POINT(JN_GAUSS, JN_GAUSS, -JN_GAUSS),
				 JN_HEX8_POINT(-JN_GAUSS, -JN_GAUSS, JN_GAUSS), JN_HEX8_POINT(JN_GAUSS, -JN_GAUSS, JN_GAUSS),
				 JN_HEX8_POINT(-JN_GAUSS, JN_GAUSS, JN_GAUSS), JN_HEX8_POINT(JN_GAUSS, JN_GAUSS, JN_GAUSS)},
};

#endif
