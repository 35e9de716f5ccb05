/// @file voxels.h
/// Cubes around a closed surface: a coarse model that carries the surface along.
#ifndef JN_MESH_VOXELS_H
#define JN_MESH_VOXELS_H

#include "mesh/mesh.h"
#include "mesh/surface.h"

/// The hex8 cells of edge `size` [m], on a grid aligned with the axes and centred on the bounding box, that touch the
/// surface or lie inside it. The surface becomes the mesh's embedding. JN_BAD_INPUT, after a message that begins with
/// `what`, when that were too many cells.
JnStatus jn_voxels_fill(const JnSurface* surface, double size, const char* what, JnArena* arena, JnMesh* mesh);

#endif
