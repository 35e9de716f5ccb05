/// @file obstacle_create.h
/// Obstacles as a scene file says them: their keys, and the geometry that these stand for.
#ifndef JN_DETECT_OBSTACLE_CREATE_H
#define JN_DETECT_OBSTACLE_CREATE_H

#include "base/arena.h"
#include "mesh/shape/placement.h"

/// Keys of `shape: {type: box}` of an obstacle.
typedef struct JnBlockOptions {
	double center[3]; ///< [m]
	double size[3];   ///< edge lengths, each > 0 [m]
	double rotate[3]; ///< turns about x, then y, then z [rad]
} JnBlockOptions;

/// Keys of `shape: {type: mesh}`.
typedef struct JnMeshOptions {
	const char* path;
	JnPlacementDef placement;
} JnMeshOptions;

extern const JnKey jn_obstacle_plane_keys[];   ///< of JnPlaneDef
extern const JnKey jn_obstacle_sphere_keys[];  ///< of JnSphereDef
extern const JnKey jn_obstacle_block_keys[];   ///< of JnBlockOptions
extern const JnKey jn_obstacle_capsule_keys[]; ///< of JnCapsuleDef
extern const JnKey jn_obstacle_mesh_keys[];    ///< of JnMeshOptions

/// The verbs `create` of the rows; see JnObstacleType.
JnStatus jn_obstacle_create_plane(const void* options, const char* what, JnArena* arena, const void** geometry);
JnStatus jn_obstacle_create_block(const void* options, const char* what, JnArena* arena, const void** geometry);
JnStatus jn_obstacle_create_mesh(const void* options, const char* what, JnArena* arena, const void** geometry);

/// For rows whose keys fill the geometry itself.
JnStatus jn_obstacle_create_same(const void* options, const char* what, JnArena* arena, const void** geometry);

#endif
