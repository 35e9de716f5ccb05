/// @file obstacle.h
/// Bodies that never move, such as a floor: one row a shape, known by its signed distance.
#ifndef JN_DETECT_OBSTACLE_H
#define JN_DETECT_OBSTACLE_H

#include "jounce/extend.h"
#include "mesh/triangle_tree.h"

// What the rows know of their shapes. Scenes say some of it in other words: obstacle_create.h.

/// The half space behind a plane.
typedef struct JnPlaneDef {
	double point[3];  ///< any point of the plane [m]
	double normal[3]; ///< out of the obstacle, of any length > 0
} JnPlaneDef;

typedef struct JnSphereDef {
	double center[3]; ///< [m]
	double radius;    ///< > 0 [m]
	bool inside;      ///< true: bodies are kept inside the sphere, all around it is solid
} JnSphereDef;

/// A block turned as one likes.
typedef struct JnBlockDef {
	double center[3]; ///< [m]
	double half[3];   ///< half its edges, each > 0 [m]
	double axes[9];   ///< orthonormal rows: directions of its first, second and third edge
} JnBlockDef;

/// All points no farther from the line between two ends than the radius; a ball when the ends are the same.
typedef struct JnCapsuleDef {
	double ends[2][3]; ///< [m]
	double radius;     ///< > 0 [m]
} JnCapsuleDef;

/// What a closed surface bounds.
typedef struct JnMeshDef {
	const JnTriangleTree* tree; ///< borrowed; of a closed surface that faces outward
} JnMeshDef;

/// A row. The distance is exact, negative inside, and Lipschitz: between two points it changes by no more than their
/// distance, so that a point at distance d is d away from any touch. The normal is a unit vector out of the obstacle, the
/// gradient of the distance; where that jumps (centre of a sphere, edges inside a block) one of its sides is taken. It is
/// never NAN for finite points.
typedef struct JnObstacleType {
	JnRow row; ///< its options are as a scene file says them
	/// From options that a scene filled to the geometry struct named with the rows below: `*geometry` is made in the arena,
	/// or the options themselves. JN_BAD_INPUT for what their keys cannot refuse, and files that cannot be used; `what` is
	/// the key path of the shape, for messages.
	JnStatus (*create)(const void* options, const char* what, JnArena* arena, const void** geometry);
	/// Signed distance of `point` [m], and the normal at the nearest point of the surface.
	double (*distance)(const void* geometry, const double point[3], double normal[3]);
	/// Triangles to look at: see obstacle_surface.h.
	JnStatus (*surface)(const void* geometry, const JnTreeBox* around, JnArena* arena, JnSurface* out);
} JnObstacleType;

extern const JnRowList jn_obstacle_list;         ///< rows are &JnObstacleType.row
extern const JnObstacleType jn_obstacle_plane;   ///< JnPlaneDef
extern const JnObstacleType jn_obstacle_sphere;  ///< JnSphereDef
extern const JnObstacleType jn_obstacle_block;   ///< JnBlockDef
extern const JnObstacleType jn_obstacle_capsule; ///< JnCapsuleDef
extern const JnObstacleType jn_obstacle_mesh;    ///< JnMeshDef

typedef struct JnObstacle {
	const JnObstacleType* type;
	const void* geometry; ///< borrowed; the struct named with the row
} JnObstacle;

/// Signed distance of a point [m] and the normal there.
static inline double jn_obstacle_distance(const JnObstacle* obstacle, const double point[3], double normal[3]) {
	return obstacle->type->distance(obstacle->geometry, point, normal);
}

#endif
