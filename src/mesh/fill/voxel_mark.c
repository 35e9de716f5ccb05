// Does a triangle touch a cube? The separating axes of Akenine-Moeller, "Fast 3D triangle-box overlap testing" (2001):
// three faces of the cube, the triangle's normal, and the nine cross products of their edges. Projected to an axis a, a
// cube of half edge h covers h (|a_x| + |a_y| + |a_z|) on both sides of its centre, so that each axis tells how small h
// must be for them to be apart.
#include <math.h>

#include "math/vec3.h"
#include "mesh/fill/voxel_grid.h"

static const double ROUNDING = 1e-9; // of the size: a triangle in the plane of a face does not touch the cube

/// Corners are seen from the cube's centre.
static double gap_along(double corners[3][3], const double axis[3]) {
	const double size = fabs(axis[0]) + fabs(axis[1]) + fabs(axis[2]);
	if (!(size > 0)) return 0;
	const double p[3] = {vec3_dot(corners[0], axis), vec3_dot(corners[1], axis), vec3_dot(corners[2], axis)};
	const double low = fmin(fmin(p[0], p[1]), p[2]), high = fmax(fmax(p[0], p[1]), p[2]);
	return fmax(low, -high) / size;
}

double jn_voxel_distance(double corners[3][3], const double centre[3]) {
	static const double unit[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
	double v[3][3], axis[3], gap = 0;
	for (int i = 0; i < 9; ++i) v[i / 3][i % 3] = corners[i / 3][i % 3] - centre[i % 3];
	for (int a = 0; a < 3; ++a) gap = fmax(gap, gap_along(v, unit[a]));
	vec3_triangle(v[0], v[1], v[2], axis);
	gap = fmax(gap, gap_along(v, axis));
	for (int i = 0; i < 9; ++i) {
		const double *from = corners[i / 3], *to = corners[(i / 3 + 1) % 3];
		const double edge[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
		vec3_cross(unit[i % 3], edge, axis);
		gap = fmax(gap, gap_along(v, axis));
	}
	return gap;
}

/// Cubes along an axis that meet the interval from low to high, or a little more.
static void cubes_along(const JnVoxelGrid* grid, int axis, double low, double high, int range[2]) {
	const int last = grid->counts[axis] - 1;
	range[0] = (int)fmin(fmax(floor((low - grid->low[axis]) / grid->size - 1e-6), 0), last);
	range[1] = (int)fmin(fmax(floor((high - grid->low[axis]) / grid->size + 1e-6), 0), last);
}

static double centre_along(const JnVoxelGrid* grid, int axis, int i) {
	return grid->low[axis] + (i + 0.5) * grid->size;
}

static void mark_cube(JnVoxelGrid* grid, double corners[3][3], const int at[3]) {
	double centre[3];
	for (int a = 0; a < 3; ++a) centre[a] = centre_along(grid, a, at[a]);
	unsigned char* cube = &grid->cubes[((ptrdiff_t)at[2] * grid->counts[1] + at[1]) * grid->counts[0] + at[0]];
	if (*cube == JN_VOXEL_TOUCHED) return;
	const double distance = jn_voxel_distance(corners, centre), half = grid->size / 2;
	if (distance < half * (1 - ROUNDING))
		*cube = JN_VOXEL_TOUCHED;
	else if (distance <= half * (1 + ROUNDING))
		*cube = JN_VOXEL_GRAZED;
}

/// A triangle, its bounding box, and its plane as a height along `axis`, the one along which it is least steep.
typedef struct Facet {
	double corners[3][3], low[3], high[3];
	double normal[3];
	int axis;
	bool has_plane; // not so when it is nearly a line
} Facet;

static Facet facet_of(const JnSurface* surface, int triangle) {
	Facet facet = {.low = {INFINITY, INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY, -INFINITY}};
	double extent = 0;
	for (int i = 0; i < 9; ++i) {
		const int node = surface->triangles[3 * (ptrdiff_t)triangle + i / 3], a = i % 3;
		const double x = facet.corners[i / 3][a] = surface->nodes[3 * (ptrdiff_t)node + a];
		facet.low[a] = fmin(facet.low[a], x), facet.high[a] = fmax(facet.high[a], x);
	}
	vec3_triangle(facet.corners[0], facet.corners[1], facet.corners[2], facet.normal);
	for (int a = 0; a < 3; ++a) {
		extent = fmax(extent, facet.high[a] - facet.low[a]);
		if (fabs(facet.normal[a]) > fabs(facet.normal[facet.axis])) facet.axis = a;
	}
	facet.has_plane = fabs(facet.normal[facet.axis]) > 1e-6 * extent * extent;
	return facet;
}

/// Above and below the square of a column of cubes, the triangle is no higher and lower than its plane.
static void cubes_of_column(const JnVoxelGrid* grid, const Facet* facet, const int at[3], int range[2]) {
	const int d = facet->axis, u = (d + 1) % 3, w = (d + 2) % 3;
	double low = facet->low[d], high = facet->high[d];
	if (facet->has_plane) {
		const double slope_u = facet->normal[u] / facet->normal[d], slope_w = facet->normal[w] / facet->normal[d];
		const double height = facet->corners[0][d] - slope_u * (centre_along(grid, u, at[u]) - facet->corners[0][u]) -
							  slope_w * (centre_along(grid, w, at[w]) - facet->corners[0][w]);
		const double reach = grid->size * (0.5 * (fabs(slope_u) + fabs(slope_w)) + 1e-6);
		low = fmax(low, height - reach), high = fmin(high, height + reach);
	}
	cubes_along(grid, d, low, high, range);
}

void jn_voxel_mark(JnVoxelGrid* grid, const JnSurface* surface) {
	for (int triangle = 0; triangle < surface->triangle_count; ++triangle) {
		Facet facet = facet_of(surface, triangle);
		const int d = facet.axis, u = (d + 1) % 3, w = (d + 2) % 3;
		int ranges[3][2], at[3];
		cubes_along(grid, u, facet.low[u], facet.high[u], ranges[u]);
		cubes_along(grid, w, facet.low[w], facet.high[w], ranges[w]);
		for (at[w] = ranges[w][0]; at[w] <= ranges[w][1]; ++at[w]) {
			for (at[u] = ranges[u][0]; at[u] <= ranges[u][1]; ++at[u]) {
				cubes_of_column(grid, &facet, at, ranges[d]);
				for (at[d] = ranges[d][0]; at[d] <= ranges[d][1]; ++at[d]) mark_cube(grid, facet.corners, at);
			}
		}
	}
}
