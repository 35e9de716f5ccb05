/// @file voxels.h
/// Cubes around a closed surface: a coarse model that carries the surface along.
#ifndef JN_MESH_FILL_VOXELS_H
#define JN_MESH_FILL_VOXELS_H

#include "mesh/mesh.h"
#include "mesh/surface.h"

/// The hex8 cells of edge `size` [m], on a grid aligned with the axes and centred on the bounding box, that touch the
/// surface or lie inside it; a cell that only shares a face, an edge or a corner with the surface does not touch it.
/// Cells and nodes are numbered along x, then y, then z. The surface becomes the mesh's embedding; everything is in the
/// arena.
///
/// Parts of the surface that are nearer to each other than a cell, such as two legs, may get cells in common, and then
/// move as one: only a smaller size keeps them apart. Where parts of the mesh hang together by an edge or a corner
/// alone, which bends like a hinge, a warning says how many.
///
/// JN_BAD_INPUT, after a message that begins with `what`, when the surface has no triangles or that were too many cells,
/// which is found out before memory is taken.
JnStatus jn_voxels_fill(const JnSurface* surface, double size, const char* what, JnArena* arena, JnMesh* mesh);

#endif
