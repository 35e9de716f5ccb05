// Element shapes, and volumes of cells.
#include "mesh/mesh.h"

#include "math/mat3.h"
#include "math/vec3.h"

static const int tet4_faces[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
static const int tet10_faces[] = {0, 2, 1, 6, 5, 4, 0, 1, 3, 4, 8, 7, 1, 2, 3, 5, 9, 8, 0, 3, 2, 7, 9, 6};
static const int tri3_faces[] = {0, 1, 2};
static const int hex8_faces[] = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7};

const JnShapeInfo jn_shape_info[JN_SHAPE_COUNT] = {
	[JN_TET4] = {"tet4", 4, 10, "Tetrahedron", 4, 3, tet4_faces},
	[JN_TET10] = {"tet10", 10, 24, "Tetrahedron_10", 4, 6, tet10_faces},
	[JN_HEX8] = {"hex8", 8, 12, "Hexahedron", 6, 4, hex8_faces},
	[JN_TRI3] = {"tri3", 3, 5, "Triangle", 1, 3, tri3_faces},
	[JN_POINT1] = {"point1", 1, 1, "Polyvertex", 0, 0, NULL},
};

const int jn_hex_corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
								 {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

static double tet_volume(const JnMesh* mesh, const int* nodes) {
	const double* origin = mesh->nodes + 3 * (ptrdiff_t)nodes[0];
	double edges[3][3];
	for (int i = 0; i < 9; i++) {
		edges[i / 3][i % 3] = mesh->nodes[3 * (ptrdiff_t)nodes[1 + i / 3] + i % 3] - origin[i % 3];
	}
	return mat3_determinant(edges) / 6;
}

static double triangle_area(const JnMesh* mesh, const int* nodes) {
	const double* origin = mesh->nodes + 3 * (ptrdiff_t)nodes[0];
	double edges[2][3], normal[3];
	for (int i = 0; i < 6; i++)
		edges[i / 3][i % 3] = mesh->nodes[3 * (ptrdiff_t)nodes[1 + i / 3] + i % 3] - origin[i % 3];
	vec3_cross(edges[0], edges[1], normal);
	return 0.5 * vec3_length(normal);
}

/// det J has degree 2 in each coordinate: 2x2x2 Gauss points are exact.
static double hex_volume(const JnMesh* mesh, const int* nodes) {
	const double near_weight = 0.5 + 0.5 / sqrt(3.0); // of a corner's own side, at the Gauss point next to it
	double volume = 0;
	for (int point = 0; point < 8; point++) {
		double J[3][3] = {{0}};
		for (int i = 0; i < 8; i++) {
			double factor[3];
			for (int r = 0; r < 3; r++) {
				factor[r] = jn_hex_corner[i][r] == jn_hex_corner[point][r] ? near_weight : 1 - near_weight;
			}
			const double* X = mesh->nodes + 3 * (ptrdiff_t)nodes[i];
			for (int k = 0; k < 9; k++) {
				const int r = k % 3;
				const double slope = (2 * jn_hex_corner[i][r] - 1) * factor[(r + 1) % 3] * factor[(r + 2) % 3];
				J[k / 3][r] += (X[k / 3] - mesh->nodes[3 * (ptrdiff_t)nodes[0] + k / 3]) * slope;
			}
		}
		volume += mat3_determinant(J) / 8;
	}
	return volume;
}

static double point_volume(const JnMesh* mesh, const int* nodes) {
	return mesh->volumes[nodes[0]];
}

double jn_mesh_cell_volume(const JnMesh* mesh, int cell) {
	static double (*const volume[JN_SHAPE_COUNT])(const JnMesh*, const int*) = {[JN_TET4] = tet_volume,
																				[JN_TET10] = tet_volume,
																				[JN_HEX8] = hex_volume,
																				[JN_TRI3] = triangle_area,
																				[JN_POINT1] = point_volume};
	return volume[mesh->shape](mesh, mesh->cells + (ptrdiff_t)cell * jn_shape_info[mesh->shape].nodes);
}
