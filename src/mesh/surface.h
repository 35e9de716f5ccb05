/// @file surface.h
/// A triangle surface, and whether it bounds a solid.
#ifndef JN_MESH_SURFACE_H
#define JN_MESH_SURFACE_H

#include "base/arena.h"
#include "jounce/base.h"

typedef struct JnSurface {
	int node_count;
	double* nodes; ///< 3 * node_count coordinates [m]
	int triangle_count;
	int* triangles; ///< 3 * triangle_count node numbers, outward by the right-hand rule
} JnSurface;

double jn_surface_area(const JnSurface* surface); ///< [m^2]

/// Volume inside a closed surface [m^3]; negative when it is inside out.
double jn_surface_volume(const JnSurface* surface);

/// Make a surface of triangles usable: nodes at the same place become one, triangles without area and nodes that no
/// triangle uses go, neighbours are turned to agree and the whole to face outward, part by part. What was changed is
/// said in one warning that begins with `what`. JN_BAD_INPUT when it cannot be done (three triangles at an edge, a
/// Moebius strip): the message names the first offenders.
JnStatus jn_surface_repair(JnSurface* surface, const char* what);

/// Does the surface bound a solid? JN_BAD_INPUT with a message that names the first offenders (numbers, positions, how
/// many in all) for open edges, edges of more than two triangles, and triangles that cross.
JnStatus jn_surface_check_closed(const JnSurface* surface, const char* what);

#endif
