// The shapes of obstacles, one row each.
#include "detect/obstacle.h"

#include "math/vec3.h"

/// normal = direction / |direction|, or `fallback` when that has no length. Returns the length.
static double unit(const double direction[3], const double fallback[3], double normal[3]) {
	const double length = vec3_length(direction);
	for (int a = 0; a < 3; a++) normal[a] = length > 0 ? direction[a] / length : fallback[a];
	return length;
}

static const double up[3] = {0, 0, 1};

static double plane_distance(const void* options, const double point[3], double normal[3]) {
	const JnPlaneDef* plane = options;
	const double away[3] = {point[0] - plane->point[0], point[1] - plane->point[1], point[2] - plane->point[2]};
	unit(plane->normal, up, normal);
	return vec3_dot(normal, away);
}

static double sphere_distance(const void* options, const double point[3], double normal[3]) {
	const JnSphereDef* sphere = options;
	double away[3];
	for (int a = 0; a < 3; a++) away[a] = point[a] - sphere->center[a];
	const double distance = unit(away, up, normal) - sphere->radius;
	for (int a = 0; a < 3 && sphere->inside; a++) normal[a] = -normal[a];
	return sphere->inside ? -distance : distance;
}

/// Distance to the box [-half, half], with p in its axes: outside by the offset from the clamped point, inside by the
/// nearest side.
static double upright_block(const double half[3], const double p[3], double normal[3]) {
	double away[3];
	int nearest = 0;
	for (int a = 0; a < 3; a++) {
		away[a] = p[a] - fmax(-half[a], fmin(half[a], p[a]));
		normal[a] = 0;
		if (fabs(p[a]) - half[a] > fabs(p[nearest]) - half[nearest]) nearest = a;
	}
	normal[nearest] = p[nearest] < 0 ? -1 : 1;
	const double outside = vec3_length(away), side[3] = {normal[0], normal[1], normal[2]};
	if (!(outside > 0)) return fabs(p[nearest]) - half[nearest];
	return unit(away, side, normal);
}

static double block_distance(const void* options, const double point[3], double normal[3]) {
	const JnBlockDef* block = options;
	double away[3], p[3], own[3];
	for (int a = 0; a < 3; a++) away[a] = point[a] - block->center[a];
	for (int r = 0; r < 3; r++) p[r] = vec3_dot(block->axes + 3 * (ptrdiff_t)r, away);
	const double distance = upright_block(block->half, p, own);
	for (int a = 0; a < 3; a++)
		normal[a] = block->axes[a] * own[0] + block->axes[3 + a] * own[1] + block->axes[6 + a] * own[2];
	return distance;
}

/// A direction across the axis of a capsule.
static void across(const double axis[3], double out[3]) {
	const int least = fabs(axis[0]) <= fabs(axis[1]) ? (fabs(axis[0]) <= fabs(axis[2]) ? 0 : 2)
													 : (fabs(axis[1]) <= fabs(axis[2]) ? 1 : 2);
	double other[3] = {0, 0, 0};
	other[least] = 1;
	vec3_cross(axis, other, out);
	vec3_normalize(out);
}

static double capsule_distance(const void* options, const double point[3], double normal[3]) {
	const JnCapsuleDef* capsule = options;
	double axis[3], from[3], away[3], side[3];
	for (int a = 0; a < 3; a++) {
		axis[a] = capsule->ends[1][a] - capsule->ends[0][a];
		from[a] = point[a] - capsule->ends[0][a];
	}
	const double square = vec3_dot(axis, axis);
	const double along = square > 0 ? fmax(0, fmin(1, vec3_dot(from, axis) / square)) : 0;
	for (int a = 0; a < 3; a++) away[a] = from[a] - along * axis[a];
	across(axis, side);
	return unit(away, square > 0 ? side : up, normal) - capsule->radius;
}

static void triangle_normal(const JnSurface* surface, int triangle, double normal[3]) {
	const int* t = surface->triangles + 3 * (ptrdiff_t)triangle;
	double area[3];
	vec3_triangle(surface->nodes + 3 * (ptrdiff_t)t[0], surface->nodes + 3 * (ptrdiff_t)t[1],
				  surface->nodes + 3 * (ptrdiff_t)t[2], area);
	unit(area, up, normal);
}

/// On the surface itself the normal is that of the triangle.
static double mesh_distance(const void* options, const double point[3], double normal[3]) {
	const JnMeshDef* mesh = options;
	const JnSurfacePoint nearest = jn_triangle_tree_nearest(mesh->tree, point);
	if (nearest.triangle < 0) {
		for (int a = 0; a < 3; a++) normal[a] = up[a];
		return INFINITY;
	}
	const double sign = jn_triangle_tree_is_inside(mesh->tree, point) ? -1 : 1;
	double away[3], face[3];
	triangle_normal(&mesh->tree->surface, nearest.triangle, face);
	for (int a = 0; a < 3; a++) away[a] = sign * (point[a] - nearest.at[a]);
	unit(away, face, normal);
	return sign * nearest.distance;
}

const JnObstacleType jn_obstacle_plane = {.row = {"plane", "The half space behind a plane.", NULL, sizeof(JnPlaneDef)},
										  .distance = plane_distance};
const JnObstacleType jn_obstacle_sphere = {.row = {"sphere", "A ball, or all around one.", NULL, sizeof(JnSphereDef)},
										   .distance = sphere_distance};
const JnObstacleType jn_obstacle_block = {.row = {"box", "A block, turned as one likes.", NULL, sizeof(JnBlockDef)},
										  .distance = block_distance};
const JnObstacleType jn_obstacle_capsule = {.row = {"capsule", "A rod with round ends.", NULL, sizeof(JnCapsuleDef)},
											.distance = capsule_distance};
const JnObstacleType jn_obstacle_mesh = {.row = {"mesh", "What a closed surface bounds.", NULL, sizeof(JnMeshDef)},
										 .distance = mesh_distance};

static const JnRow* const rows[] = {&jn_obstacle_plane.row, &jn_obstacle_sphere.row, &jn_obstacle_block.row,
									&jn_obstacle_capsule.row, &jn_obstacle_mesh.row};

const JnRowList jn_obstacle_list = {"obstacle", rows, sizeof rows / sizeof rows[0]};
