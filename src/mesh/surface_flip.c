// Flat triangles, whose one node lies on the opposite edge, are common in files from CAD programs. Dropping one would tear
// the surface; instead the edge is flipped, so that its neighbour is cut in two there:
//
//     x----b----y          x----b----y        b lies on xy: the triangle x b y has no area.
//      \  flat /            \  / \  /
//       \ n   /      ->      \ n  t/
//        \   /                \ | /
//          d                    d
#include <math.h>

#include "mesh/surface_edges.h"

enum { MOST_ROUNDS = 16 }; // flat triangles beside each other need one each

/// The corner opposite the longest edge when it is nearer to that edge than `distance` [m]; else -1.
static int flat_corner(const JnSurface* surface, int triangle, double distance) {
	const int* t = surface->triangles + 3 * (ptrdiff_t)triangle;
	double length[3], longest = 0, edge[3][3];
	int corner = -1;
	for (int i = 0; i < 3; i++) {
		const double *from = surface->nodes + 3 * (ptrdiff_t)t[(i + 1) % 3],
					 *to = surface->nodes + 3 * (ptrdiff_t)t[(i + 2) % 3];
		for (int a = 0; a < 3; a++) edge[i][a] = to[a] - from[a];
		length[i] = sqrt(edge[i][0] * edge[i][0] + edge[i][1] * edge[i][1] + edge[i][2] * edge[i][2]);
		if (length[i] <= longest) continue;
		longest = length[i];
		corner = i;
	}
	const double *u = edge[0], *v = edge[1];
	const double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
	const double height = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / longest;
	const bool is_degenerate = t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; // dropped by the caller
	return !is_degenerate && height <= distance ? corner : -1;
}

/// Cut the triangle at `other`'s edge in two at node b, with the flat triangle as the second half.
static void flip(JnSurface* surface, int flat, int corner, int other) {
	int* t = surface->triangles + 3 * (ptrdiff_t)flat;
	int* n = surface->triangles + 3 * (ptrdiff_t)(other / 3);
	const int b = t[corner], y = n[(other % 3 + 1) % 3], d = n[(other % 3 + 2) % 3];
	if (d == b) return; // both cover the same ground: a fold, which the check for crossings names
	n[(other % 3 + 1) % 3] = b;
	t[0] = b;
	t[1] = y;
	t[2] = d;
}

/// Flip each flat triangle whose neighbour has not changed in this round. Returns how many.
static int flip_round(JnSurface* surface, double distance, JnArena* scratch) {
	const int total = 3 * surface->triangle_count;
	JnEdgeSide* sides;
	bool* is_changed;
	int count = 0;
	JN_TRY(jn_surface_edges(surface, scratch, &sides));
	JN_NEW(scratch, is_changed, (size_t)surface->triangle_count + 1);
	for (int i = 0, together = 0; i < total; i += together) {
		together = jn_edge_side_count(sides, i, total);
		for (int k = 0; k < together && together == 2; k++) {
			const int triangle = sides[i + k].place / 3, other = sides[i + 1 - k].place;
			if (triangle == other / 3 || is_changed[triangle] || is_changed[other / 3]) continue;
			const int corner = flat_corner(surface, triangle, distance);
			if (corner < 0 || (sides[i + k].place + 2) % 3 != corner) continue;
			flip(surface, triangle, corner, other);
			is_changed[triangle] = is_changed[other / 3] = true;
			count++;
		}
	}
	return count;
}

static bool has_flat(const JnSurface* surface, double distance) {
	for (int i = 0; i < surface->triangle_count; i++)
		if (flat_corner(surface, i, distance) >= 0) return true;
	return false;
}

int jn_surface_flip_flat(JnSurface* surface, double distance) {
	int sum = 0;
	for (int round = 0; round < MOST_ROUNDS && has_flat(surface, distance); round++) {
		JnArena scratch = {0};
		const int count = flip_round(surface, distance, &scratch);
		jn_arena_free(&scratch);
		if (count <= 0) return count < 0 ? count : sum;
		sum += count;
	}
	return sum;
}
