// The numbers of all levels, from the finest down, and the levels themselves where they are missing.
#include <string.h>

#include "math/lapack.h"
#include "solve/multigrid.h"

enum { MODES = JN_GRID_MODES, LANES = JN_GRID_LANES };

// Connections are strong from this part of the diagonal blocks' size on; half of it on each coarser level.
static const double strong = 0.04;

// A level whose coarser one would have more than this part of its nodes is the last.
static const double shrinks = 0.6;

// Where translations have this part of the energy of independent nodes, mass outweighs stiffness, and smoothing is enough.
static const double heavy = 0.3;

// ---- is there anything for a coarser level to do? ----

static double diagonal_entry(const JnGridLevel* level, int node, int a, int c) {
	const size_t place = jn_grid_diagonal(level, node);
	if (level->full_block == NULL) return (double)level->blocks[JN_GRID_BLOCK * place + (size_t)(LANES * c + a)];
	return level->source[9 * (size_t)level->full_block[place] + (size_t)(3 * a + c)];
}

// The translation along (1, 1, 1) in the unknowns of a level.
static void translate(const JnGridLevel* level, float* out) {
	for (int i = 0; i < level->nodes; ++i)
		for (int a = 0; a < level->size; ++a) {
			double sum = level->held == NULL || !level->held[3 * (size_t)i + (size_t)a];
			if (level->modes != NULL) {
				const double* mode = level->modes + MODES * (MODES * (size_t)i + (size_t)a);
				sum = mode[0] + mode[1] + mode[2];
			}
			out[(size_t)level->stride * (size_t)i + (size_t)a] = (float)sum;
		}
}

// Whether nearly all nodes feel their mass more than their stiffness: a translation t has t.At > heavy t.Dt there.
static bool is_heavy(const JnMultigrid* grid, int slot, int at) {
	const JnGridLevel* level = &grid->levels[at];
	int count = 0;
	translate(level, level->d);
	jn_grid_multiply(grid, slot, at, level->d, level->q);
	for (int i = 0; i < level->nodes; ++i) {
		const size_t first = (size_t)level->stride * (size_t)i;
		const float *t = level->d + first, *At = level->q + first;
		double whole = 0, own = 0;
		for (int a = 0; a < level->size; ++a) {
			whole += (double)t[a] * (double)At[a];
			for (int c = 0; c < level->size; ++c) own += (double)t[a] * (double)t[c] * diagonal_entry(level, i, a, c);
		}
		count += whole >= heavy * own;
	}
	return count > 0.95 * level->nodes;
}

// ---- the last level ----

static void fill_dense(const JnGridLevel* level, double shift, double* dense) {
	const size_t n = MODES * (size_t)level->nodes;
	memset(dense, 0, n * n * sizeof *dense);
	for (int i = 0; i < level->nodes; ++i)
		for (int k = level->start[i]; k < level->start[i + 1]; ++k)
			for (size_t a = 0; a < MODES; ++a)
				for (size_t c = 0; c < MODES; ++c)
					dense[(MODES * (size_t)i + a) * n + MODES * (size_t)level->column[k] + c] =
						(double)level->blocks[JN_GRID_BLOCK * (size_t)k + LANES * c + a];
	for (size_t k = 0; k < n * n; k += n + 1) dense[k] = dense[k] > 0 ? dense[k] * (1 + shift) : 1;
}

// What rounding in single precision may make indefinite is shifted until it is not.
static bool invert_dense(JnMultigrid* grid, const JnGridLevel* level) {
	const int n = MODES * level->nodes;
	int info = 1;
	for (double shift = 1e-7; info != 0 && shift < 1; shift *= 10) {
		fill_dense(level, shift, grid->dense);
		dpotrf_("L", &n, grid->dense, &n, &info, 1);
		if (info == 0) dpotri_("L", &n, grid->dense, &n, &info, 1);
	}
	for (int i = 0; i < n && info == 0; ++i)
		for (int j = 0; j < n; ++j) {
			const size_t to = (size_t)i * (size_t)level->nodes * LANES + (size_t)(j / MODES * LANES + j % MODES);
			grid->inverse[to] =
				(float)grid->dense[i > j ? (size_t)j * (size_t)n + (size_t)i : (size_t)i * (size_t)n + (size_t)j];
		}
	return info == 0;
}

static JnStatus solve_last(JnMultigrid* grid, const JnGridLevel* level) {
	const size_t n = MODES * (size_t)level->nodes;
	if (grid->dense == NULL) JN_NEW(&grid->arena, grid->dense, n * n);
	if (grid->inverse == NULL) JN_NEW(&grid->arena, grid->inverse, n * LANES * (size_t)level->nodes);
	grid->is_direct = invert_dense(grid, level);
	return JN_OK;
}

// ---- levels ----

// Room for the product P' A P of a level. What was there for a finer one serves if it is large enough.
static JnStatus make_work(JnMultigrid* grid, const JnGridLevel* level) {
	const size_t column = (size_t)level->most_support * (size_t)level->size * LANES;
	const size_t row = (size_t)level->most_row * JN_GRID_BLOCK, nodes = (size_t)grid->levels[0].nodes;
	const bool is_first = grid->work == NULL;
	if (is_first) JN_NEW(&grid->arena, grid->work, grid->threads);
	for (int t = 0; t < grid->threads; ++t) {
		JnGridWork* work = &grid->work[t];
		if (is_first) {
			JN_NEW(&grid->arena, work->slot, nodes + 1);
			JN_NEW(&grid->arena, work->support, nodes + 1);
			JN_NEW(&grid->arena, work->where, nodes + 1);
		}
		for (size_t i = 0; is_first && i < nodes; ++i) work->slot[i] = work->where[i] = -1;
		if (column > grid->column_room) JN_NEW(&grid->arena, work->w, column);
		if (row > grid->row_room) JN_NEW(&grid->arena, work->sums, row);
	}
	if (column > grid->column_room) grid->column_room = column;
	if (row > grid->row_room) grid->row_room = row;
	return JN_OK;
}

// One more level below the last one, unless that makes no sense: then the levels are complete.
static JnStatus extend(JnMultigrid* grid) {
	JnGridLevel* level = &grid->levels[grid->count - 1];
	JnArena scratch = {0};
	int count = 0;
	JnStatus status = JN_OK;
	grid->is_complete = grid->count == JN_GRID_MOST_LEVELS;
	if (!grid->is_complete)
		status = jn_grid_aggregate(level, strong / (double)(1 << (grid->count - 1)), &grid->arena, &scratch, &count);
	grid->is_complete |= count == 0 || count > shrinks * level->nodes;
	if (status == JN_OK && !grid->is_complete) {
		status = jn_grid_coarsen(level, count, &grid->arena, &scratch, level + 1);
		if (status == JN_OK) status = make_work(grid, level);
		if (status == JN_OK) ++grid->count;
	}
	jn_arena_free(&scratch);
	return status;
}

static void project(JnMultigrid* grid, int slot, int at) {
	JnGridLevel* level = &grid->levels[at];
	jn_grid_span(level, level + 1);
	grid->kernels->smooth(level, (float)(4 / (3 * level->eigenvalue)), grid->work, grid->threads);
	grid->kernels->project(level, level + 1, grid->work, grid->threads);
	jn_grid_invert(level + 1);
	jn_grid_estimate(grid, slot, at + 1);
}

static JnStatus renew_levels(JnMultigrid* grid, int slot) {
	for (grid->used = 1;; ++grid->used) {
		const int at = grid->used - 1;
		if (at > 0 && grid->levels[at].nodes <= JN_GRID_COARSEST) return solve_last(grid, &grid->levels[at]);
		if (is_heavy(grid, slot, at)) return JN_OK;
		if (grid->used == grid->count && !grid->is_complete) JN_TRY(extend(grid));
		if (grid->used == grid->count) return JN_OK;
		project(grid, slot, at);
	}
}

JnStatus jn_grid_renew(JnMultigrid* grid, int slot) {
	JnGridLevel* finest = &grid->levels[0];
	const JnOperator* matrices = grid->matrices;
	const double* positions = matrices->positions != NULL ? matrices->positions(matrices->user, slot) : matrices->rest;
	if (positions != NULL) memcpy(finest->center, positions, 3 * (size_t)finest->nodes * sizeof *finest->center);
	finest->source = matrices->blocks(matrices->user, slot);
	grid->is_direct = false;
	grid->size = grid->slots[slot].size;
	const JnStatus status = renew_levels(grid, slot);
	finest->source = NULL;
	return status;
}
