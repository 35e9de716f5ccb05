// Nodes at one place become one: each node is kept in a hash table by the cell of a fine grid that it lies in, and looks
// for an earlier one in the cells, mostly just one, that are within the distance.
#include <math.h>

#include "mesh/surface_edges.h"

typedef struct Cell {
	int64_t at[3];
} Cell;

typedef struct Welder {
	const double* nodes;
	double low[3], distance, size; // corner and edge of the grid's cells [m]
	int* first;                    // by hash: the first node of a chain, -1: none
	int* next;                     // by node: the next one of its chain
	size_t mask;
} Welder;

static void bounds(const JnSurface* surface, double low[3], double high[3]) {
	for (int a = 0; a < 3; a++) {
		low[a] = INFINITY;
		high[a] = -INFINITY;
	}
	for (int i = 0; i < 3 * surface->node_count; i++) {
		low[i % 3] = fmin(low[i % 3], surface->nodes[i]);
		high[i % 3] = fmax(high[i % 3], surface->nodes[i]);
	}
}

double jn_surface_extent(const JnSurface* surface) {
	double low[3], high[3];
	bounds(surface, low, high);
	if (surface->node_count == 0) return 0;
	return fmax(fmax(high[0] - low[0], high[1] - low[1]), high[2] - low[2]);
}

static Cell cell_of(const Welder* welder, const double* node, double shift) {
	Cell cell;
	for (int a = 0; a < 3; a++) cell.at[a] = (int64_t)floor((node[a] - welder->low[a] + shift) / welder->size);
	return cell;
}

static size_t slot_of(const Welder* welder, int64_t i, int64_t j, int64_t k) {
	uint64_t hash =
		(uint64_t)i * 0x9e3779b97f4a7c15 ^ (uint64_t)j * 0xc2b2ae3d27d4eb4f ^ (uint64_t)k * 0x165667b19e3779f9;
	hash = (hash ^ hash >> 32) * 0xd6e8feb86659fd93;
	return (size_t)(hash ^ hash >> 32) & welder->mask;
}

/// The lowest node of a chain that is within the distance; -1: none. Chains begin with their highest node.
static int find_in(const Welder* welder, size_t slot, const double* node) {
	int found = -1;
	for (int i = welder->first[slot]; i >= 0; i = welder->next[i]) {
		const double* other = welder->nodes + 3 * (ptrdiff_t)i;
		double most = 0;
		for (int a = 0; a < 3; a++) most = fmax(most, fabs(node[a] - other[a]));
		if (most <= welder->distance) found = i;
	}
	return found;
}

static int find_node(const Welder* welder, const double* node) {
	const Cell low = cell_of(welder, node, -welder->distance), high = cell_of(welder, node, welder->distance);
	int found = -1;
	for (int64_t i = low.at[0]; i <= high.at[0]; i++)
		for (int64_t j = low.at[1]; j <= high.at[1]; j++)
			for (int64_t k = low.at[2]; k <= high.at[2]; k++) {
				const int node_found = find_in(welder, slot_of(welder, i, j, k), node);
				if (node_found >= 0 && (found < 0 || node_found < found)) found = node_found;
			}
	return found;
}

static void insert(Welder* welder, int number, const double* node) {
	const Cell cell = cell_of(welder, node, 0);
	const size_t slot = slot_of(welder, cell.at[0], cell.at[1], cell.at[2]);
	welder->next[number] = welder->first[slot];
	welder->first[slot] = number;
}

static JnStatus prepare(const JnSurface* surface, double distance, JnArena* scratch, Welder* welder) {
	double high[3];
	*welder = (Welder){.nodes = surface->nodes, .distance = distance, .mask = 1};
	bounds(surface, welder->low, high);
	const double extent = jn_surface_extent(surface);
	welder->size = fmax(16 * distance, extent * 1e-9);
	if (!(welder->size > 0)) welder->size = 1;
	while (welder->mask < (size_t)surface->node_count) welder->mask = 2 * welder->mask + 1;
	JN_NEW(scratch, welder->first, welder->mask + 1);
	JN_NEW(scratch, welder->next, (size_t)surface->node_count + 1);
	for (size_t i = 0; i <= welder->mask; i++) welder->first[i] = -1;
	return JN_OK;
}

static void move_node(JnSurface* surface, int from, int to) {
	for (int a = 0; a < 3; a++) surface->nodes[3 * (ptrdiff_t)to + a] = surface->nodes[3 * (ptrdiff_t)from + a];
}

static void renumber(JnSurface* surface, const int* number, int node_count) {
	for (int i = 0; i < 3 * surface->triangle_count; i++) surface->triangles[i] = number[surface->triangles[i]];
	surface->node_count = node_count;
}

static int weld(JnSurface* surface, double distance, JnArena* scratch) {
	const int before = surface->node_count;
	Welder welder;
	int *number, kept = 0;
	JN_TRY(prepare(surface, distance, scratch, &welder));
	JN_NEW(scratch, number, (size_t)before + 1);
	for (int i = 0; i < before; i++) {
		const int same = find_node(&welder, surface->nodes + 3 * (ptrdiff_t)i);
		number[i] = same >= 0 ? same : kept;
		if (same >= 0) continue;
		move_node(surface, i, kept); // kept <= i: only what has been looked at is overwritten
		insert(&welder, kept, surface->nodes + 3 * (ptrdiff_t)kept);
		kept++;
	}
	renumber(surface, number, kept);
	return before - kept;
}

int jn_surface_weld(JnSurface* surface, double distance) {
	JnArena scratch = {0};
	const int count = weld(surface, distance, &scratch);
	jn_arena_free(&scratch);
	return count;
}

static int drop_unused(JnSurface* surface, JnArena* scratch) {
	const int before = surface->node_count;
	int *number, kept = 0;
	JN_NEW(scratch, number, (size_t)before + 1);
	for (int i = 0; i < 3 * surface->triangle_count; i++) number[surface->triangles[i]] = 1;
	for (int i = 0; i < before; i++) {
		if (number[i] == 0) continue;
		move_node(surface, i, kept);
		number[i] = kept++;
	}
	renumber(surface, number, kept);
	return before - kept;
}

int jn_surface_drop_unused(JnSurface* surface) {
	JnArena scratch = {0};
	const int count = drop_unused(surface, &scratch);
	jn_arena_free(&scratch);
	return count;
}
