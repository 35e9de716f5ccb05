#include "detect/near.h"

#include "math/vec3.h"

static const double NO_DIRECTION = 1e-6; // of the longest edge: shorter offsets are mostly rounding
static const double ON_EDGE = 1e-9;      // weights below it are rounding: the point is on the edge opposite
static const double SAME = 1 + 1e-12;    // distances of the same point, computed from two triangles

static void corners_at(const JnMover* mover, int triangle, double when, double out[3][3]) {
	const int* t = mover->skin->triangles + 3 * (ptrdiff_t)triangle;
	for (int i = 0; i < 3; i++) jn_motion_at(&mover->motion, t[i], when, out[i]);
}

void jn_near_find(const JnMover* other, const double p[3], double when, JnNear* near) {
	double at[3][3];
	corners_at(other, near->triangle, when, at);
	jn_triangle_nearest(at[0], at[1], at[2], p, near->weights);
	const double* w = near->weights;
	for (int a = 0; a < 3; a++) near->offset[a] = p[a] - (w[0] * at[0][a] + w[1] * at[1][a] + w[2] * at[2][a]);
	near->distance = vec3_length(near->offset);
	near->facing = 0;
}

/// out += factor * unit normal of a triangle.
static void add_normal(const JnMover* mover, int triangle, double when, double factor, double out[3]) {
	double at[3][3], normal[3];
	corners_at(mover, triangle, when, at);
	vec3_triangle(at[0], at[1], at[2], normal);
	vec3_normalize(normal);
	for (int a = 0; a < 3; a++) out[a] += factor * normal[a];
}

/// Angle of a triangle at one of its vertices [rad].
static double angle_at(const JnMover* mover, int triangle, int vertex, double when) {
	const int* t = mover->skin->triangles + 3 * (ptrdiff_t)triangle;
	const int i = t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2;
	double at[3][3], one[3], other[3], across[3];
	corners_at(mover, triangle, when, at);
	for (int a = 0; a < 3; a++) {
		one[a] = at[(i + 1) % 3][a] - at[i][a];
		other[a] = at[(i + 2) % 3][a] - at[i][a];
	}
	vec3_cross(one, other, across);
	return atan2(vec3_length(across), vec3_dot(one, other));
}

/// The corner at which the point is, or -1.
static int corner_of(const double weights[3]) {
	for (int i = 0; i < 3; i++)
		if (weights[(i + 1) % 3] <= ON_EDGE && weights[(i + 2) % 3] <= ON_EDGE) return i;
	return -1;
}

/// The corner opposite the edge on which the point is, or -1.
static int edge_of(const double weights[3]) {
	for (int i = 0; i < 3; i++)
		if (weights[i] <= ON_EDGE) return i;
	return -1;
}

void jn_near_face(const JnMover* other, double when, JnNear* near, double pseudonormal[3]) {
	const JnAdjacency* adjacency = &other->adjacency;
	const int corner = corner_of(near->weights), edge = edge_of(near->weights);
	for (int a = 0; a < 3; a++) pseudonormal[a] = 0;
	if (corner >= 0) {
		const int vertex = other->skin->triangles[3 * (ptrdiff_t)near->triangle + corner];
		for (int i = adjacency->round_start[vertex]; i < adjacency->round_start[vertex + 1]; i++) {
			const int triangle = adjacency->round[i];
			add_normal(other, triangle, when, angle_at(other, triangle, vertex, when), pseudonormal);
		}
	} else {
		const int across = edge >= 0 ? adjacency->across[3 * (ptrdiff_t)near->triangle + edge] : -1;
		add_normal(other, near->triangle, when, 1, pseudonormal);
		if (across >= 0) add_normal(other, across, when, 1, pseudonormal);
	}
	near->facing = vec3_dot(near->offset, pseudonormal);
}

static double longest_edge(const JnMover* mover, int triangle, double when) {
	double at[3][3], longest = 0;
	corners_at(mover, triangle, when, at);
	for (int i = 0; i < 3; i++) longest = fmax(longest, vec3_distance(at[i], at[(i + 1) % 3]));
	return longest;
}

bool jn_near_normal(const JnMover* other, double when, JnNear* near, double normal[3]) {
	double pseudonormal[3];
	const double facing = near->facing;
	jn_near_face(other, when, near, pseudonormal);
	if (facing != 0) near->facing = facing; // the caller knows better
	const bool is_face = edge_of(near->weights) < 0 && vec3_length(pseudonormal) > 0;
	const bool is_behind = near->facing < 0, is_closed = other->adjacency.is_closed;
	const bool along_offset = !is_face && near->distance > NO_DIRECTION * longest_edge(other, near->triangle, when);
	const double sign = is_behind && along_offset == is_closed ? -1 : 1;
	for (int a = 0; a < 3; a++) normal[a] = sign * (along_offset ? near->offset[a] : pseudonormal[a]);
	vec3_normalize(normal);
	return vec3_dot(normal, normal) > 0;
}

static bool is_nearer(const JnMover* other, const double p[3], int triangle, double distance) {
	JnNear near = {.triangle = triangle};
	jn_near_find(other, p, 0, &near);
	return near.distance * SAME < distance;
}

bool jn_near_is_local_minimum(const JnMover* other, const double p[3], const JnNear* near) {
	const JnAdjacency* adjacency = &other->adjacency;
	const int corner = corner_of(near->weights), edge = edge_of(near->weights);
	if (edge < 0) return true;
	if (corner < 0) {
		const int across = adjacency->across[3 * (ptrdiff_t)near->triangle + edge];
		return across < 0 || !is_nearer(other, p, across, near->distance);
	}
	const int vertex = other->skin->triangles[3 * (ptrdiff_t)near->triangle + corner];
	for (int i = adjacency->round_start[vertex]; i < adjacency->round_start[vertex + 1]; i++)
		if (is_nearer(other, p, adjacency->round[i], near->distance)) return false;
	return true;
}
