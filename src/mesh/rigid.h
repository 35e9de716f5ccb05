/// @file rigid.h
/// A rigid thing that moves without turning: all that is within `radius` of a rectangle about its node. A ball has a
/// rectangle of no size, a plate one of no thickness.
///
///   y = x - nearest point of the rectangle,   inside where |y| < radius
#ifndef JN_MESH_RIGID_H
#define JN_MESH_RIGID_H

#include <math.h>
#include <stdbool.h>

#include "mesh/mesh.h"

typedef struct JnRigid {
	double axes[3][3]; ///< unit vectors, at right angles
	double half[3];    ///< of the rectangle along them [m]; may be INFINITY
	double radius;     ///< [m]
} JnRigid;

/// Has it no end along some axis?
static inline bool jn_rigid_is_endless(const JnRigid* rigid) {
	return isinf(rigid->half[0]) || isinf(rigid->half[1]) || isinf(rigid->half[2]);
}

/// The mesh of one node at `center`, with a surface to look at; INFINITY in `half` is shown as `shown`.
JnStatus jn_rigid_mesh(const JnRigid* rigid, const double center[3], double shown, JnArena* arena, JnMesh* mesh);

#endif
