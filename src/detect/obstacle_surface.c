#include "detect/obstacle_surface.h"

#include <math.h>
#include <string.h>

#include "math/vec3.h"

enum { SLICES = 48, QUARTER = 12 }; // around an axis, and from a pole to the equator

JnStatus jn_obstacle_surface(const JnObstacle* obstacle, const JnTreeBox* around, JnArena* arena, JnSurface* out) {
	return obstacle->type->surface(obstacle->geometry, around, arena, out);
}

static JnStatus take(JnArena* arena, int node_count, int triangle_count, JnSurface* out) {
	*out = (JnSurface){.node_count = node_count, .triangle_count = triangle_count};
	JN_NEW(arena, out->nodes, 3 * (size_t)node_count);
	JN_NEW(arena, out->triangles, 3 * (size_t)triangle_count);
	return JN_OK;
}

/// Two unit vectors that make a right-handed frame with a third.
static void frame(const double axis[3], double first[3], double second[3]) {
	const int least = fabs(axis[0]) <= fabs(axis[1]) ? (fabs(axis[0]) <= fabs(axis[2]) ? 0 : 2)
													 : (fabs(axis[1]) <= fabs(axis[2]) ? 1 : 2);
	double other[3] = {0, 0, 0};
	other[least] = 1;
	vec3_cross(other, axis, first);
	vec3_normalize(first);
	vec3_cross(axis, first, second);
}

// ---- plane ----

/// Half the side of the square is the box's diagonal and its height above the plane.
JnStatus jn_obstacle_surface_plane(const void* geometry, const JnTreeBox* around, JnArena* arena, JnSurface* out) {
	const JnPlaneDef* plane = geometry;
	double normal[3], middle[3], first[3], second[3], away[3];
	for (int a = 0; a < 3; a++) {
		normal[a] = plane->normal[a];
		middle[a] = (around->low[a] + around->high[a]) / 2;
		away[a] = middle[a] - plane->point[a];
	}
	vec3_normalize(normal);
	frame(normal, first, second);
	const double height = vec3_dot(normal, away);
	const double half = vec3_distance(around->low, around->high) + fabs(height);
	JN_TRY(take(arena, 4, 2, out));
	for (int i = 0; i < 4; i++) {
		const double u = i == 1 || i == 2 ? half : -half, v = i >= 2 ? half : -half;
		for (int a = 0; a < 3; a++)
			out->nodes[3 * i + a] = middle[a] - height * normal[a] + u * first[a] + v * second[a];
	}
	memcpy(out->triangles, (const int[6]){0, 1, 2, 0, 2, 3}, 6 * sizeof(int));
	return JN_OK;
}

// ---- round ----

/// Rings of nodes from one pole to the other: half of them around each end.
typedef struct Round {
	double ends[2][3];
	double radius;
	bool is_turned; ///< triangles face the axis
} Round;

static void add_triangle(const Round* round, int a, int b, int c, int** triangles) {
	(*triangles)[0] = a;
	(*triangles)[1] = round->is_turned ? c : b;
	(*triangles)[2] = round->is_turned ? b : c;
	*triangles += 3;
}

/// Node 0 is the first pole, the rings follow, then the other pole.
static void connect(const Round* round, int rings, int* triangles) {
	const int last = 1 + rings * SLICES;
	for (int s = 0; s < SLICES; s++) {
		const int next = (s + 1) % SLICES;
		add_triangle(round, 0, 1 + next, 1 + s, &triangles);
		for (int r = 0; r + 1 < rings; r++) {
			const int low = 1 + r * SLICES, high = low + SLICES;
			add_triangle(round, low + s, low + next, high + next, &triangles);
			add_triangle(round, low + s, high + next, high + s, &triangles);
		}
		add_triangle(round, last, last - SLICES + s, last - SLICES + next, &triangles);
	}
}

static JnStatus triangulate(const Round* round, JnArena* arena, JnSurface* out) {
	double axis[3], first[3], second[3];
	for (int a = 0; a < 3; a++) axis[a] = round->ends[1][a] - round->ends[0][a];
	const bool is_ball = !(vec3_length(axis) > 0);
	if (is_ball) axis[1] = 1;
	vec3_normalize(axis);
	frame(axis, first, second);
	const int rings = 2 * QUARTER - is_ball; // a ball has one equator
	JN_TRY(take(arena, 2 + rings * SLICES, 2 * rings * SLICES, out));
	for (int i = 0; i < out->node_count; i++) {
		const int ring = i == 0 ? -1 : (i - 1) / SLICES, slice = (i + SLICES - 1) % SLICES;
		const int end = ring >= QUARTER, step = ring + 1 - (end && !is_ball);
		const double polar = M_PI / 2 * step / QUARTER, turn = 2 * M_PI * slice / SLICES;
		for (int a = 0; a < 3; a++) {
			const double across = sin(polar) * (cos(turn) * first[a] + sin(turn) * second[a]);
			out->nodes[3 * i + a] = round->ends[end][a] + round->radius * (across - cos(polar) * axis[a]);
		}
	}
	connect(round, rings, out->triangles);
	return JN_OK;
}

JnStatus jn_obstacle_surface_sphere(const void* geometry, const JnTreeBox* around, JnArena* arena, JnSurface* out) {
	const JnSphereDef* sphere = geometry;
	const double* c = sphere->center;
	const Round round = {{{c[0], c[1], c[2]}, {c[0], c[1], c[2]}}, sphere->radius, sphere->inside};
	(void)around;
	return triangulate(&round, arena, out);
}

JnStatus jn_obstacle_surface_capsule(const void* geometry, const JnTreeBox* around, JnArena* arena, JnSurface* out) {
	const JnCapsuleDef* capsule = geometry;
	Round round = {.radius = capsule->radius};
	(void)around;
	memcpy(round.ends, capsule->ends, sizeof round.ends);
	return triangulate(&round, arena, out);
}

// ---- the rest ----

JnStatus jn_obstacle_surface_block(const void* geometry, const JnTreeBox* around, JnArena* arena, JnSurface* out) {
	static const int sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
	const JnBlockDef* block = geometry;
	(void)around;
	JN_TRY(take(arena, 8, 12, out));
	for (int k = 0; k < 24; k++) {
		const int corner = k / 3, a = k % 3; // bit r of the corner: high along edge r
		out->nodes[k] = block->center[a];
		for (int r = 0; r < 3; r++)
			out->nodes[k] += (corner >> r & 1 ? 1 : -1) * block->half[r] * block->axes[3 * r + a];
	}
	for (int s = 0; s < 6; s++) {
		const int* n = sides[s];
		memcpy(out->triangles + 6 * (ptrdiff_t)s, (const int[6]){n[0], n[1], n[2], n[0], n[2], n[3]}, 6 * sizeof(int));
	}
	return JN_OK;
}

JnStatus jn_obstacle_surface_mesh(const void* geometry, const JnTreeBox* around, JnArena* arena, JnSurface* out) {
	(void)around, (void)arena;
	*out = ((const JnMeshDef*)geometry)->tree->surface;
	return JN_OK;
}
