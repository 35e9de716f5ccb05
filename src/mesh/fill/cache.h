/// @file cache.h
/// Meshes that took long to make, kept by content: the same surface and size are meshed once on a machine.
///
/// They lie in $JOUNCE_CACHE, else $XDG_CACHE_HOME/jounce, else ~/.cache/jounce, as .vtu files that any viewer opens;
/// JOUNCE_CACHE=off keeps none. The folder may be deleted at any time.
#ifndef JN_MESH_FILL_CACHE_H
#define JN_MESH_FILL_CACHE_H

#include "mesh/mesh.h"
#include "mesh/surface.h"

/// jn_tetrahedra_fill, or the mesh that it gave for the same surface and size before; *was_kept says which, and may be
/// NULL. A cache that cannot be read or written costs time, and nothing else.
JnStatus jn_cache_tetrahedra(const JnSurface* surface, double size, const char* what, JnArena* arena, JnMesh* mesh,
							 bool* was_kept);

#endif
