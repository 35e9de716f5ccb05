/// @file boundary.h
/// The outer faces of a volume mesh, as triangles; those of a surface mesh are its cells, and points have none.
#ifndef JN_MESH_BOUNDARY_H
#define JN_MESH_BOUNDARY_H

#include "mesh/mesh.h"

/// Triangles of the faces that belong to one cell alone, outward, with the mesh's node numbers, in the order of cells
/// and faces: *triangles has 3 * *count numbers, from the arena. A face of hex8 gives two, cut along the diagonal from
/// its lowest node number; one of tet10 gives four, which meet at its mid-edge nodes.
JnStatus jn_mesh_boundary(const JnMesh* mesh, JnArena* arena, int* count, int** triangles);

#endif
