/// @file remesh.h
/// Make the triangles of a surface equally large and well shaped, in place (Botsch, Kobbelt: A remeshing approach to
/// multiresolution modeling, SGP 2004): split long edges, collapse short ones, flip and move nodes along the surface.
#ifndef JN_MESH_FILL_REMESH_H
#define JN_MESH_FILL_REMESH_H

#include "mesh/fill/half_edges.h"

/// The surface on which the nodes shall lie, and how long edges shall be there.
typedef struct JnGuide {
	void (*project)(const void* shape, double point[3]);      ///< move a near point onto it
	double (*size)(const void* shape, const double point[3]); ///< of edges near a point [m]; NULL: the same everywhere
	const void* shape;
} JnGuide;

/// Triangles of edge `size` [m], or of guide->size where that is smaller. Creases stay: their nodes move nowhere, save that some go and new ones come in the
/// middle of crease edges. The same input gives the same surface; it stays closed, but may cross itself where it is
/// folded more closely than `size`.
JnStatus jn_remesh(JnHalfEdges* mesh, double size, const JnGuide* guide);

/// 4 sqrt(3) A / sum of squared edges: 1 for an equilateral triangle, 0 for a flat one.
double jn_triangle_quality(const double a[3], const double b[3], const double c[3]);

#endif
