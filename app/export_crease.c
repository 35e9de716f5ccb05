// Corners of triangles that share a vertex are one vertex when they are joined by edges that are not sharp.
#include "export_crease.h"

#include <stdlib.h>

#include "math/vec3.h"

static const double smooth_cosine = 0.6427876096865394; // of 50 degrees: sides of a tube of eight meet at 45

/// An edge as a triangle sees it.
typedef struct Edge {
	int low, high;    // its vertices, the smaller number first
	int corner_of[2]; // the triangle's corners there, 3 * triangle + 0, 1 or 2
} Edge;

static int compare(const void* a, const void* b) {
	const Edge *first = a, *second = b;
	if (first->low != second->low) return first->low < second->low ? -1 : 1;
	if (first->high != second->high) return first->high < second->high ? -1 : 1;
	return (first->corner_of[0] > second->corner_of[0]) - (first->corner_of[0] < second->corner_of[0]);
}

static void list_edges(int triangle_count, const int* triangles, Edge* edges) {
	for (int c = 0; c < 3 * triangle_count; ++c) {
		const int next = c % 3 < 2 ? c + 1 : c - 2;
		const bool is_up = triangles[c] < triangles[next];
		edges[c] =
			(Edge){triangles[is_up ? c : next], triangles[is_up ? next : c], {is_up ? c : next, is_up ? next : c}};
	}
	qsort(edges, 3 * (size_t)triangle_count, sizeof *edges, compare);
}

static int find(int* parent, int corner) {
	while (parent[corner] != corner) corner = parent[corner] = parent[parent[corner]];
	return corner;
}

/// The smaller number stands for both.
static void join(int* parent, int a, int b) {
	const int first = find(parent, a), second = find(parent, b);
	if (first < second)
		parent[second] = first;
	else
		parent[first] = second;
}

static void normal_of(const double* x, const int* triangle, double normal[3]) {
	vec3_triangle(x + 3 * (ptrdiff_t)triangle[0], x + 3 * (ptrdiff_t)triangle[1], x + 3 * (ptrdiff_t)triangle[2],
				  normal);
	vec3_normalize(normal);
}

static void join_smooth_edges(const double* x, int count, const int* triangles, const Edge* edges, int* parent) {
	for (int i = 0; i + 1 < count; ++i) {
		const Edge *a = &edges[i], *b = &edges[i + 1];
		double first[3], second[3];
		if (a->low != b->low || a->high != b->high) continue;
		normal_of(x, triangles + a->corner_of[0] / 3 * 3, first);
		normal_of(x, triangles + b->corner_of[0] / 3 * 3, second);
		if (vec3_dot(first, second) < smooth_cosine) continue;
		for (int k = 0; k < 2; ++k) join(parent, a->corner_of[k], b->corner_of[k]);
	}
}

JnStatus export_crease(int vertex_count, const double* x, int triangle_count, const int* triangles, JnArena* arena,
					   ExportCrease* crease) {
	const int corners = 3 * triangle_count;
	Edge* edges;
	int *parent, *sources, *number, *is_met;
	JN_NEW(arena, edges, corners + 1);
	JN_NEW(arena, parent, corners + 1);
	JN_NEW(arena, number, corners + 1);
	JN_NEW(arena, sources, vertex_count + corners + 1);
	JN_NEW(arena, is_met, vertex_count + 1);
	for (int c = 0; c < corners; ++c) parent[c] = c;
	for (int v = 0; v < vertex_count; ++v) sources[v] = v;
	list_edges(triangle_count, triangles, edges);
	join_smooth_edges(x, corners, triangles, edges, parent);
	crease->vertex_count = vertex_count;
	for (int c = 0; c < corners; ++c) { // a root comes before those whom it stands for
		const int root = find(parent, c), vertex = triangles[c];
		number[c] = root < c ? number[root] : is_met[vertex] ? crease->vertex_count++ : vertex;
		sources[number[c]] = vertex;
		is_met[vertex] = 1;
	}
	crease->sources = sources;
	crease->triangles = number;
	return JN_OK;
}
