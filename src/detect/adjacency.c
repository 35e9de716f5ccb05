#include "detect/adjacency.h"

/// Triangles round each vertex, by counting.
static void fill_rounds(const JnSkin* skin, JnAdjacency* out) {
	int* start = out->round_start;
	for (int i = 0; i < 3 * skin->triangle_count; i++) start[skin->triangles[i] + 1]++;
	for (int v = 0; v < skin->vertex_count; v++) start[v + 1] += start[v];
	for (int i = 0; i < 3 * skin->triangle_count; i++) out->round[start[skin->triangles[i]]++] = i / 3;
	for (int v = skin->vertex_count; v > 0; v--) start[v] = start[v - 1];
	start[0] = 0;
}

/// +1 when the triangle runs from one vertex to the next, -1 the other way, 0 when it has no such edge.
static int direction(const int* triangle, int from, int to) {
	for (int i = 0; i < 3; i++) {
		if (triangle[i] == from && triangle[(i + 1) % 3] == to) return 1;
		if (triangle[i] == to && triangle[(i + 1) % 3] == from) return -1;
	}
	return 0;
}

/// The only other triangle at the edge opposite a corner, if it runs the other way; else -1.
static int beyond(const JnSkin* skin, const JnAdjacency* adjacency, int triangle, int corner) {
	const int* own = skin->triangles + 3 * (ptrdiff_t)triangle;
	const int from = own[(corner + 1) % 3], to = own[(corner + 2) % 3];
	int found = -1, others = 0;
	for (int i = adjacency->round_start[from]; i < adjacency->round_start[from + 1]; i++) {
		const int other = adjacency->round[i];
		const int runs = other != triangle ? direction(skin->triangles + 3 * (ptrdiff_t)other, from, to) : 0;
		others += runs != 0;
		if (runs == -1) found = other;
	}
	return others == 1 ? found : -1;
}

JnStatus jn_adjacency_create(const JnSkin* skin, JnArena* arena, JnAdjacency* out) {
	*out = (JnAdjacency){.is_closed = skin->triangle_count > 0};
	JN_NEW(arena, out->across, 3 * (size_t)skin->triangle_count);
	JN_NEW(arena, out->round, 3 * (size_t)skin->triangle_count);
	JN_NEW(arena, out->round_start, (size_t)skin->vertex_count + 1);
	fill_rounds(skin, out);
	for (int i = 0; i < 3 * skin->triangle_count; i++) {
		out->across[i] = beyond(skin, out, i / 3, i % 3);
		out->is_closed &= out->across[i] >= 0;
	}
	return JN_OK;
}

static bool share_vertex(const int* one, const int* other) {
	for (int i = 0; i < 9; i++)
		if (one[i / 3] == other[i % 3]) return true;
	return false;
}

bool jn_adjacency_is_near(const JnAdjacency* adjacency, const JnSkin* skin, int vertex, int triangle) {
	const int* other = skin->triangles + 3 * (ptrdiff_t)triangle;
	for (int i = adjacency->round_start[vertex]; i < adjacency->round_start[vertex + 1]; i++)
		if (share_vertex(skin->triangles + 3 * (ptrdiff_t)adjacency->round[i], other)) return true;
	return false;
}
