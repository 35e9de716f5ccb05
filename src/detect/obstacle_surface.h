/// @file obstacle_surface.h
/// Triangles of obstacles, to look at: nothing is computed with them.
#ifndef JN_DETECT_OBSTACLE_SURFACE_H
#define JN_DETECT_OBSTACLE_SURFACE_H

#include "detect/obstacle.h"

/// The surface of an obstacle in triangles that face out of it; round ones lie inside the true surface by up to 1/200 of
/// the radius. Of a plane it is a square below the box `around`, wide enough for all that falls out of it. Memory comes
/// from the arena; the surface of a mesh is the mesh's own.
JnStatus jn_obstacle_surface(const JnObstacle* obstacle, const JnTreeBox* around, JnArena* arena, JnSurface* out);

/// The verbs `surface` of the rows; see JnObstacleType.
JnStatus jn_obstacle_surface_plane(const void* geometry, const JnTreeBox* around, JnArena* arena, JnSurface* out);
JnStatus jn_obstacle_surface_sphere(const void* geometry, const JnTreeBox* around, JnArena* arena, JnSurface* out);
JnStatus jn_obstacle_surface_block(const void* geometry, const JnTreeBox* around, JnArena* arena, JnSurface* out);
JnStatus jn_obstacle_surface_capsule(const void* geometry, const JnTreeBox* around, JnArena* arena, JnSurface* out);
JnStatus jn_obstacle_surface_mesh(const void* geometry, const JnTreeBox* around, JnArena* arena, JnSurface* out);

#endif
