/// @file isosurface.h
/// The zero set of a function as a closed surface: how shapes given by a signed distance become meshes.
#ifndef JN_MESH_FILL_ISOSURFACE_H
#define JN_MESH_FILL_ISOSURFACE_H

#include "mesh/surface.h"

/// A function of space that is negative inside a solid and grows like the distance near its surface.
typedef struct JnField {
	double (*at)(const void* shape, const double point[3]); ///< [m]
	const void* shape;
	double min[3], max[3]; ///< box that holds the solid [m]
} JnField;

/// Triangles of edge length about `size` [m] on the zero set, closed, outward, of good shape. JN_BAD_INPUT, after a
/// message that begins with `what`, when the grid were too fine.
JnStatus jn_isosurface(const JnField* field, double size, const char* what, JnArena* arena, JnSurface* surface);

#endif
