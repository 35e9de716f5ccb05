// The shapes of obstacles, one row each.
#include "detect/obstacle.h"

#include "detect/obstacle_create.h"
#include "detect/obstacle_surface.h"
#include "math/vec3.h"

/// normal = direction / |direction|, or `fallback` when that has no length. Returns the length.
static double unit(const double direction[3], const double fallback[3], double normal[3]) {
	const double length = vec3_length(direction);
	for (int a = 0; a < 3; a++) normal[a] = length > 0 ? direction[a] / length : fallback[a];
	return length;
}

static const double up[3] = {0, 0, 1};

static double plane_distance(const void* geometry, const double point[3], double normal[3]) {
	const JnPlaneDef* plane = geometry;
	const double away[3] = {point[0] - plane->point[0], point[1] - plane->point[1], point[2] - plane->point[2]};
	unit(plane->normal, up, normal);
	return vec3_dot(normal, away);
}

static double sphere_distance(const void* geometry, const double point[3], double normal[3]) {
	const JnSphereDef* sphere = geometry;
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

static double block_distance(const void* geometry, const double point[3], double normal[3]) {
	const JnBlockDef* block = geometry;
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

static double capsule_distance(const void* geometry, const double point[3], double normal[3]) {
	const JnCapsuleDef* capsule = geometry;
	double axis[3], from[3], away[3], side[3] = {up[0], up[1], up[2]};
	for (int a = 0; a < 3; a++) {
		axis[a] = capsule->ends[1][a] - capsule->ends[0][a];
		from[a] = point[a] - capsule->ends[0][a];
	}
	const double square = vec3_dot(axis, axis);
	const double along = square > 0 ? fmax(0, fmin(1, vec3_dot(from, axis) / square)) : 0;
	for (int a = 0; a < 3; a++) away[a] = from[a] - along * axis[a];
	if (square > 0 && !(vec3_dot(away, away) > 0)) across(axis, side);
	return unit(away, side, normal) - capsule->radius;
}

static void triangle_normal(const JnSurface* surface, int triangle, double normal[3]) {
	const int* t = surface->triangles + 3 * (ptrdiff_t)triangle;
	double area[3];
	vec3_triangle(surface->nodes + 3 * (ptrdiff_t)t[0], surface->nodes + 3 * (ptrdiff_t)t[1],
				  surface->nodes + 3 * (ptrdiff_t)t[2], area);
	unit(area, up, normal);
}

static double longest_edge(const JnSurface* surface, int triangle) {
	const int* t = surface->triangles + 3 * (ptrdiff_t)triangle;
	double longest = 0;
	for (int i = 0; i < 3; i++)
		longest = fmax(longest, vec3_distance(surface->nodes + 3 * (ptrdiff_t)t[i],
											  surface->nodes + 3 * (ptrdiff_t)t[(i + 1) % 3]));
	return longest;
}

static const double NO_DIRECTION = 1e-6; // of the longest edge: shorter offsets are mostly rounding

/// On the surface itself the normal is that of the triangle.
static double mesh_distance(const void* geometry, const double point[3], double normal[3]) {
	const JnMeshDef* mesh = geometry;
	const JnSurfacePoint nearest = jn_triangle_tree_nearest(mesh->tree, point);
	if (nearest.triangle < 0) {
		for (int a = 0; a < 3; a++) normal[a] = up[a];
		return INFINITY;
	}
	const double sign = jn_triangle_tree_is_inside(mesh->tree, point) ? -1 : 1;
	double away[3], face[3];
	triangle_normal(&mesh->tree->surface, nearest.triangle, face);
	for (int a = 0; a < 3; a++) away[a] = sign * (point[a] - nearest.at[a]);
	const bool is_on = nearest.distance <= NO_DIRECTION * longest_edge(&mesh->tree->surface, nearest.triangle);
	unit(is_on ? face : away, face, normal);
	return sign * nearest.distance;
}

const JnObstacleType jn_obstacle_plane = {
	.row = {"plane", "The half space behind a plane, such as a floor.", jn_obstacle_plane_keys, sizeof(JnPlaneDef)},
	.create = jn_obstacle_create_plane,
	.distance = plane_distance,
	.surface = jn_obstacle_surface_plane};
const JnObstacleType jn_obstacle_sphere = {
	.row = {"sphere", "A ball, or all around one.", jn_obstacle_sphere_keys, sizeof(JnSphereDef)},
	.create = jn_obstacle_create_same,
	.distance = sphere_distance,
	.surface = jn_obstacle_surface_sphere};
const JnObstacleType jn_obstacle_block = {
	.row = {"box", "A block, turned as one likes.", jn_obstacle_block_keys, sizeof(JnBlockOptions)},
	.create = jn_obstacle_create_block,
	.distance = block_distance,
	.surface = jn_obstacle_surface_block};
const JnObstacleType jn_obstacle_capsule = {
	.row = {"capsule", "A rod with round ends.", jn_obstacle_capsule_keys, sizeof(JnCapsuleDef)},
	.create = jn_obstacle_create_same,
	.distance = capsule_distance,
	.surface = jn_obstacle_surface_capsule};
const JnObstacleType jn_obstacle_mesh = {
	.row = {"mesh", "What a closed surface from a file bounds.", jn_obstacle_mesh_keys, sizeof(JnMeshOptions)},
	.create = jn_obstacle_create_mesh,
	.distance = mesh_distance,
	.surface = jn_obstacle_surface_mesh};

static const JnRow* const rows[] = {&jn_obstacle_plane.row, &jn_obstacle_sphere.row, &jn_obstacle_block.row,
									&jn_obstacle_capsule.row, &jn_obstacle_mesh.row};

const JnRowList jn_obstacle_list = {"obstacle", rows, sizeof rows / sizeof rows[0]};
