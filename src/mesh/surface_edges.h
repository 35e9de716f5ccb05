/// @file surface_edges.h
/// The edges of a surface, with the triangles at them: what its repair and its check are made of.
#ifndef JN_MESH_SURFACE_EDGES_H
#define JN_MESH_SURFACE_EDGES_H

#include "base/arena.h"
#include "mesh/surface.h"

/// An edge as one triangle sees it: from corner place % 3 of triangle place / 3 to the next corner.
typedef struct JnEdgeSide {
	int low, high; ///< its nodes, low < high
	int place;
} JnEdgeSide;

/// All 3 * triangle_count sides, those of one edge beside each other; from the arena.
JnStatus jn_surface_edges(const JnSurface* surface, JnArena* arena, JnEdgeSide** sides);

/// How many sides, from sides[first] on, belong to the edge of sides[first].
int jn_edge_side_count(const JnEdgeSide* sides, int first, int total);

/// Whether a triangle goes along its edge from the low node to the high one.
bool jn_edge_goes_up(const JnSurface* surface, const JnEdgeSide* side);

enum { JN_OFFENDERS_NAMED = 5 };

/// The first offenders of a kind, as text, and how many there are.
typedef struct JnOffenders {
	int count;
	char text[640]; ///< "(0, 0, 0)-(1, 0, 0), ..."
} JnOffenders;

/// Count an edge and name it by the positions of its ends while few are named.
void jn_offenders_add_edge(JnOffenders* offenders, const JnSurface* surface, const JnEdgeSide* side);

/// Count something and name it while few are named.
void jn_offenders_add(JnOffenders* offenders, const char* format, ...) __attribute__((format(printf, 2, 3)));

/// ", and more" when not all are named, else "".
const char* jn_offenders_rest(const JnOffenders* offenders);

/// Make nodes that lie within `distance` [m] of an earlier one, along each axis, that one; the arrays are changed in
/// place and keep their order. Returns how many nodes went, or a negative JnStatus.
int jn_surface_weld(JnSurface* surface, double distance);

/// Flip the longest edges of triangles whose height is at most `distance` [m], so that they get an area and the surface
/// stays as it is; where that fails they stay. Returns how many were, or a negative JnStatus.
int jn_surface_flip_flat(JnSurface* surface, double distance);

/// Remove nodes that no triangle uses, in place. Returns how many, or a negative JnStatus.
int jn_surface_drop_unused(JnSurface* surface);

/// Turn triangles, in place, so that neighbours agree; closed parts face outward, or inward where they lie inside an odd
/// number of others: those are cavities. Parts with holes keep the side that most of their triangles show. *turned is
/// how many were turned. JN_BAD_INPUT, after a message, at edges of more than two triangles and one-sided surfaces.
JnStatus jn_surface_turn(JnSurface* surface, const char* what, int* turned);

/// JN_BAD_INPUT, after a message, for node numbers out of range and coordinates that are not finite or beyond 1e30.
JnStatus jn_surface_check_values(const JnSurface* surface, const char* what);

/// Largest edge of the bounding box [m].
double jn_surface_extent(const JnSurface* surface);

/// Whether two triangles go through each other, or lie in one plane and overlap, by more than rounding. Triangles that
/// only touch, as neighbours do, do not cross. p, q: their corners [m].
bool jn_triangles_cross(const double* const p[3], const double* const q[3]);

#endif
