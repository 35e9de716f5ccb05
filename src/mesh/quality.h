/// @file quality.h
/// How well-shaped the cells of a mesh are.
#ifndef JN_MESH_QUALITY_H
#define JN_MESH_QUALITY_H

#include "mesh/mesh.h"

/// tet4, tet10: mean ratio 12 (3 V)^(2/3) / sum of squared edges (Liu, Joe 1994). hex8: smallest scaled Jacobian at the
/// corners. 1 for a regular cell, 0 for a flat one, negative for an inverted one.
typedef struct JnQuality {
	const char* measure; ///< "mean ratio" or "scaled Jacobian"
	double min, median;
	int worst; ///< cell that has the minimum
} JnQuality;

double jn_cell_quality(const JnMesh* mesh, int cell);

/// Of all cells; `worst` is -1 and the numbers are 0 when there are none. JN_OUT_OF_MEMORY.
JnStatus jn_mesh_quality(const JnMesh* mesh, JnQuality* quality);

#endif
