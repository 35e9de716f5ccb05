/// @file tetrahedra.h
/// Tetrahedra inside a closed surface, by Gmsh.
#ifndef JN_MESH_FILL_TETRAHEDRA_H
#define JN_MESH_FILL_TETRAHEDRA_H

#include "mesh/mesh.h"
#include "mesh/surface.h"

/// Mesh the inside of a closed surface with tet4 cells of edge length `size` [m]: the surface is meshed anew at that
/// size as well. The same input gives the same mesh. JN_BAD_INPUT, after a message that begins with `what`, when Gmsh
/// fails or is not there, or when the size asks for too many cells.
JnStatus jn_tetrahedra_fill(const JnSurface* surface, double size, const char* what, JnArena* arena, JnMesh* mesh);

/// The same with the surface's own triangles as outer faces: its nodes keep their numbers, inner ones follow.
JnStatus jn_tetrahedra_inside(const JnSurface* surface, double size, const char* what, JnArena* arena, JnMesh* mesh);

#endif
