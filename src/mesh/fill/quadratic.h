/// @file quadratic.h
/// From tetrahedra with straight edges and four nodes to those with ten.
#ifndef JN_MESH_FILL_QUADRATIC_H
#define JN_MESH_FILL_QUADRATIC_H

#include "mesh/mesh.h"

/// Give every edge of a tet4 mesh a node in its middle, shared by all cells around it. Corners keep their numbers, the
/// middles follow in the order of (lower, higher) corner. A node set gains the middles between two of its nodes.
JnStatus jn_mesh_add_middles(const JnMesh* tet4, JnArena* arena, JnMesh* tet10);

#endif
