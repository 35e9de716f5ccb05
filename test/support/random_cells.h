/// @file random_cells.h
/// Random patterns with random symmetric block matrices, and the same as a dense matrix.
#ifndef JN_TEST_SUPPORT_RANDOM_CELLS_H
#define JN_TEST_SUPPORT_RANDOM_CELLS_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "math/pattern.h"

/// Nodes 0 .. nodes-1 in random cells of four, in two lists with different offsets; some nodes may be in no cell.
typedef struct RandomCells {
	JnArena arena;
	JnPattern pattern;
	JnCellList lists[2];
	bool* joined;   ///< [nodes * nodes]: share a cell, or are the same
	double* blocks; ///< 9 a stored block; diagonal blocks symmetric
	uint64_t seed;
} RandomCells;

enum { RANDOM_CELL_NODES = 4 };

/// Uniform in [-1, 1].
static inline double cells_random(RandomCells* r) {
	r->seed = r->seed * 6364136223846793005u + 1442695040888963407u;
	return (double)(r->seed >> 11) / (double)((uint64_t)1 << 52) - 1;
}

static inline int cells_below(RandomCells* r, int limit) {
	return (int)(0.5 * (cells_random(r) + 1) * limit) % limit;
}

static inline void join_cell(RandomCells* r, int nodes, int* cell, int offset) {
	for (int i = 0; i < RANDOM_CELL_NODES; ++i) cell[i] = cells_below(r, nodes) - offset;
	for (int i = 0; i < RANDOM_CELL_NODES; ++i)
		for (int j = 0; j < RANDOM_CELL_NODES; ++j) r->joined[(cell[i] + offset) * nodes + cell[j] + offset] = true;
}

static inline void cells_create(RandomCells* r, int nodes, int cells, uint64_t seed) {
	*r = (RandomCells){.seed = seed};
	r->joined = jn_arena_take(&r->arena, (size_t)nodes * (size_t)nodes, sizeof *r->joined);
	for (int i = 0; i < nodes; ++i) r->joined[i * nodes + i] = true;
	for (int l = 0; l < 2; ++l) {
		int* list = jn_arena_take(&r->arena, (size_t)cells * RANDOM_CELL_NODES, sizeof *list);
		const int offset = l == 0 ? 0 : 3;
		for (int c = 0; c < cells; ++c) join_cell(r, nodes, list + c * RANDOM_CELL_NODES, offset);
		r->lists[l] = (JnCellList){.count = cells, .nodes = RANDOM_CELL_NODES, .offset = offset, .cells = list};
	}
	assert_int_equal(jn_pattern_create(nodes, 2, r->lists, &r->arena, &r->pattern), JN_OK);
	r->blocks = jn_arena_take(&r->arena, (size_t)r->pattern.blocks, 9 * sizeof *r->blocks);
	for (int k = 0; k < 9 * r->pattern.blocks; ++k) r->blocks[k] = cells_random(r);
	for (int j = 0; j < nodes; ++j) {
		double* d = r->blocks + 9 * r->pattern.column_start[j];
		for (int k = 0; k < 9; ++k) d[k] = k / 3 > k % 3 ? d[k % 3 * 3 + k / 3] : d[k];
	}
}

/// Add `shift` to the diagonal.
static inline void cells_shift(RandomCells* r, double shift) {
	for (int j = 0; j < r->pattern.nodes; ++j)
		for (int a = 0; a < 3; ++a) r->blocks[9 * r->pattern.column_start[j] + 4 * a] += shift;
}

/// The matrix with all its entries, [3 * nodes][3 * nodes]; free with free().
static inline double* cells_dense(const RandomCells* r) {
	const int n = 3 * r->pattern.nodes;
	double* dense = calloc((size_t)n * (size_t)n, sizeof *dense);
	assert_non_null(dense);
	for (int j = 0; j < r->pattern.nodes; ++j)
		for (int k = r->pattern.column_start[j]; k < r->pattern.column_start[j + 1]; ++k)
			for (int e = 0; e < 9; ++e) {
				const int row = 3 * r->pattern.row[k] + e / 3, column = 3 * j + e % 3;
				dense[row * n + column] = dense[column * n + row] = r->blocks[9 * k + e];
			}
	return dense;
}

#endif
