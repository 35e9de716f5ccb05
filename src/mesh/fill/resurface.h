/// @file resurface.h
/// A closed surface anew, with triangles of a given size.
#ifndef JN_MESH_FILL_RESURFACE_H
#define JN_MESH_FILL_RESURFACE_H

#include "mesh/surface.h"

/// Triangles of edge `size` [m] whose nodes lie on the given surface. Edges that bend it by more than 40 degrees and form
/// chains of several sizes stay. Where parts of the surface are nearer to each other than `size`, so that triangles would
/// cross, they become smaller. JN_BAD_INPUT, after a message that begins with `what`, when that does not help.
JnStatus jn_resurface_along(const JnSurface* surface, double size, const char* what, JnArena* arena, JnSurface* out);

/// Triangles of edge `size` [m] on the zero set of the surface's signed distance: parts thinner than that go, edges are
/// rounded, and it does not fail for folds. JN_BAD_INPUT when nothing is left.
JnStatus jn_resurface_around(const JnSurface* surface, double size, const char* what, JnArena* arena, JnSurface* out);

#endif
