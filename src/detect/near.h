/// @file near.h
/// The point of a moving triangle nearest to a vertex, and on which side of the surface that vertex is. Inside detect/ only.
#ifndef JN_DETECT_NEAR_H
#define JN_DETECT_NEAR_H

#include "detect/meeting.h"

/// Fill in everything but `triangle` and `rank` for a vertex at p, the triangle being where it is at share `when` of the
/// step. `facing` is 0 until jn_near_face.
void jn_near_find(const JnMover* other, const double p[3], double when, JnNear* near);

/// Compute `facing` and return the pseudonormal at the nearest point: the normal of a face, the sum of the unit normals at
/// an edge, and at a vertex that of the normals round it, each times its angle. Not of length 1; triangles without area
/// add nothing to it.
void jn_near_face(const JnMover* other, double when, JnNear* near, double pseudonormal[3]);

/// Unit normal of the contact, as documented in detector.h: along the offset, or along the pseudonormal for faces and
/// where the offset is too short to have a direction. False where neither has one.
bool jn_near_normal(const JnMover* other, double when, JnNear* near, double normal[3]);

/// Whether the distance to the surface has a local minimum here: no triangle that holds the nearest point is nearer.
bool jn_near_is_local_minimum(const JnMover* other, const double p[3], const JnNear* near);

#endif
