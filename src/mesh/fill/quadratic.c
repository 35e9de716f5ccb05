#include "mesh/fill/quadratic.h"

#include <stdlib.h>
#include <string.h>

enum { EDGES = 6 };

static const int edge_ends[EDGES][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}; // VTK's order of middles

typedef struct Edge {
	int low, high;
} Edge;

static Edge edge_at(const int* cell, int edge) {
	const int a = cell[edge_ends[edge][0]], b = cell[edge_ends[edge][1]];
	return a < b ? (Edge){a, b} : (Edge){b, a};
}

static int by_ends(const void* left, const void* right) {
	const Edge *a = left, *b = right;
	if (a->low != b->low) return a->low < b->low ? -1 : 1;
	return (a->high > b->high) - (a->high < b->high);
}

static int keep_different(Edge* edges, int count) {
	qsort(edges, (size_t)count, sizeof *edges, by_ends);
	int kept = 0;
	for (int i = 0; i < count; ++i)
		if (i == 0 || by_ends(&edges[i], &edges[i - 1]) != 0) edges[kept++] = edges[i];
	return kept;
}

static void put_nodes(const JnMesh* tet4, const Edge* edges, int count, double* nodes) {
	memcpy(nodes, tet4->nodes, 3 * (size_t)tet4->node_count * sizeof *nodes);
	double* middle = nodes + 3 * (size_t)tet4->node_count;
	for (int e = 0; e < count; ++e)
		for (int axis = 0; axis < 3; ++axis)
			*middle++ = 0.5 * (nodes[3 * (size_t)edges[e].low + axis] + nodes[3 * (size_t)edges[e].high + axis]);
}

static void put_cells(const JnMesh* tet4, const Edge* edges, int count, int* cells) {
	for (int c = 0; c < tet4->cell_count; ++c, cells += 4 + EDGES) {
		const int* cell = tet4->cells + 4 * (size_t)c;
		memcpy(cells, cell, 4 * sizeof *cells);
		for (int e = 0; e < EDGES; ++e) {
			const Edge edge = edge_at(cell, e);
			const Edge* found = bsearch(&edge, edges, (size_t)count, sizeof edge, by_ends);
			cells[4 + e] = tet4->node_count + (int)(found - edges);
		}
	}
}

static JnStatus put_set(const JnNodeSet* from, int corner_count, const Edge* edges, int count, JnArena* arena,
						JnNodeSet* set) {
	bool* is_in;
	JN_NEW(arena, is_in, corner_count);
	for (int i = 0; i < from->count; ++i) is_in[from->nodes[i]] = true;
	*set = (JnNodeSet){.name = from->name, .count = from->count};
	for (int e = 0; e < count; ++e) set->count += is_in[edges[e].low] && is_in[edges[e].high];
	JN_NEW(arena, set->nodes, set->count + 1);
	memcpy(set->nodes, from->nodes, (size_t)from->count * sizeof *set->nodes);
	int* next = set->nodes + from->count;
	for (int e = 0; e < count; ++e)
		if (is_in[edges[e].low] && is_in[edges[e].high]) *next++ = corner_count + e;
	return JN_OK;
}

static JnStatus add_middles(const JnMesh* tet4, JnArena* scratch, JnArena* arena, JnMesh* tet10) {
	Edge* edges;
	JN_NEW(scratch, edges, EDGES * (size_t)tet4->cell_count + 1);
	for (int c = 0; c < tet4->cell_count; ++c)
		for (int e = 0; e < EDGES; ++e) edges[EDGES * (size_t)c + e] = edge_at(tet4->cells + 4 * (size_t)c, e);
	const int count = keep_different(edges, EDGES * tet4->cell_count);
	*tet10 = (JnMesh){.shape = JN_TET10,
					  .node_count = tet4->node_count + count,
					  .cell_count = tet4->cell_count,
					  .set_count = tet4->set_count};
	JN_NEW(arena, tet10->nodes, 3 * (size_t)tet10->node_count);
	JN_NEW(arena, tet10->cells, (4 + EDGES) * (size_t)tet10->cell_count);
	JN_NEW(arena, tet10->sets, tet10->set_count + 1);
	put_nodes(tet4, edges, count, tet10->nodes);
	put_cells(tet4, edges, count, tet10->cells);
	for (int s = 0; s < tet4->set_count; ++s)
		JN_TRY(put_set(&tet4->sets[s], tet4->node_count, edges, count, arena, &tet10->sets[s]));
	return JN_OK;
}

JnStatus jn_mesh_add_middles(const JnMesh* tet4, JnArena* arena, JnMesh* tet10) {
	JnArena scratch = {0};
	const JnStatus status = add_middles(tet4, &scratch, arena, tet10);
	jn_arena_free(&scratch);
	return status;
}
