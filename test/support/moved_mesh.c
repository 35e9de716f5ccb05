#include "support/moved_mesh.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST_CELL_NODES = 10 };

/// The nodes of a cell in another order: [mirror] swaps two, [turn] is a rotation of the cell onto itself.
static const int mirror[JN_SHAPE_COUNT][MOST_CELL_NODES] = {[JN_TET4] = {1, 0, 2, 3},
															[JN_TET10] = {1, 0, 2, 3, 4, 6, 5, 8, 7, 9},
															[JN_HEX8] = {4, 5, 6, 7, 0, 1, 2, 3},
															[JN_TRI3] = {1, 0, 2},
															[JN_POINT1] = {0}};
static const int turn[JN_SHAPE_COUNT][MOST_CELL_NODES] = {[JN_TET4] = {1, 2, 0, 3},
														  [JN_TET10] = {1, 2, 0, 3, 5, 6, 4, 8, 9, 7},
														  [JN_HEX8] = {1, 2, 3, 0, 5, 6, 7, 4},
														  [JN_TRI3] = {1, 2, 0},
														  [JN_POINT1] = {0}};

static void reorder_cells(const JnMesh* mesh, const int order[]) {
	const int nodes = jn_shape_info[mesh->shape].nodes;
	for (int cell = 0; cell < mesh->cell_count; ++cell) {
		int* at = mesh->cells + (ptrdiff_t)cell * nodes;
		int old[MOST_CELL_NODES];
		memcpy(old, at, (size_t)nodes * sizeof *at);
		for (int i = 0; i < nodes; ++i) at[i] = old[order[i]];
	}
}

static void make_order(uint64_t seed, int count, int* order) {
	for (int i = 0; i < count; ++i) order[i] = i;
	for (int i = count - 1; seed != 0 && i > 0; --i) {
		seed = seed * 6364136223846793005u + 1442695040888963407u;
		const int other = (int)((seed >> 33) % ((uint64_t)i + 1)), kept = order[i];
		order[i] = order[other];
		order[other] = kept;
	}
}

static int compare_integers(const void* a, const void* b) {
	return *(const int*)a - *(const int*)b;
}

static void shuffle_nodes(const JnMesh* mesh, const int* order) {
	const size_t bytes = 3 * (size_t)mesh->node_count * sizeof *mesh->nodes;
	double* old = malloc(bytes);
	assert_non_null(old);
	memcpy(old, mesh->nodes, bytes);
	for (int i = 0; i < mesh->node_count; ++i)
		memcpy(mesh->nodes + 3 * (ptrdiff_t)order[i], old + 3 * (ptrdiff_t)i, 3 * sizeof *old);
	free(old);
	for (int k = 0; k < mesh->cell_count * jn_shape_info[mesh->shape].nodes; ++k)
		mesh->cells[k] = order[mesh->cells[k]];
	for (int s = 0; s < mesh->set_count; ++s) {
		JnNodeSet* set = &mesh->sets[s];
		for (int k = 0; k < set->count; ++k) set->nodes[k] = order[set->nodes[k]];
		qsort(set->nodes, (size_t)set->count, sizeof *set->nodes, compare_integers);
	}
}

static void shuffle_cells(uint64_t seed, const JnMesh* mesh) {
	const size_t nodes = (size_t)jn_shape_info[mesh->shape].nodes, count = (size_t)mesh->cell_count;
	int *old = malloc(count * nodes * sizeof *old), *order = malloc(count * sizeof *order);
	assert_true(old != NULL && order != NULL);
	memcpy(old, mesh->cells, count * nodes * sizeof *old);
	make_order(seed, mesh->cell_count, order);
	for (size_t c = 0; c < count; ++c)
		memcpy(mesh->cells + nodes * (size_t)order[c], old + nodes * c, nodes * sizeof *old);
	free(old);
	free(order);
}

void mirror_cells(const JnMesh* mesh) {
	reorder_cells(mesh, mirror[mesh->shape]);
}

void turn_cells(const JnMesh* mesh) {
	reorder_cells(mesh, turn[mesh->shape]);
}

void shuffle_mesh(const JnMesh* mesh, uint64_t seed, int* order) {
	make_order(seed, mesh->node_count, order);
	if (seed == 0) return;
	shuffle_nodes(mesh, order);
	shuffle_cells(seed + 1, mesh);
}
