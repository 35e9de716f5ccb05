// A V-cycle with a polynomial of D^-1 A before and after the coarser levels: the optimal ones of the fourth kind (Lottes 2022,
// Optimal polynomial smoothers for multigrid V-cycles, table 1), which need no lower bound of the eigenvalues. The same
// polynomial on both sides keeps B symmetric, and B is positive definite as long as the eigenvalues stay below the estimate,
// whichever matrix the coarser levels were made of.
#include <math.h>
#include <string.h>

#include "solve/multigrid.h"

enum { DEGREE = 2, FIRST_ESTIMATE = 12, NEXT_ESTIMATE = 3 };

static const double beta[DEGREE] = {1.02387287570313, 1.26408905371085};

// The power method ends somewhat below the largest eigenvalue.
static const double margin = 1.1;

void jn_grid_multiply(const JnMultigrid* grid, int slot, int at, const float* x, float* y) {
	const JnOperator* matrices = grid->matrices;
	if (at > 0)
		// cppcheck-suppress arrayIndexOutOfBoundsCond // is below grid->used
		grid->kernels->multiply(&grid->levels[at], x, y, grid->threads);
	else if (matrices->apply_single != NULL)
		matrices->apply_single(matrices->user, slot, x, y);
	else
		grid->kernels->multiply_finest(grid->pattern, grid->slots[slot].blocks, x, y, grid->threads);
}

// x = p(D^-1 A) D^-1 b, or with q = A x another one for what is left of b.
static void relax(const JnMultigrid* grid, int slot, int at, const float* b, const float* q, float* x) {
	const JnGridLevel* level = &grid->levels[at];
	for (int k = 1; k <= DEGREE; ++k) {
		const double scale = level->eigenvalue * (2 * k + 1);
		const JnGridRelax with = {.keep = (float)((2 * k - 3.0) / (2 * k + 1)) * (k > 1),
								  .c = (float)((8 * k - 4) / scale),
								  .beta = (float)beta[k - 1]};
		grid->kernels->relax(level, with, k == 1 ? b : level->r, q, x, grid->threads);
		if (k == DEGREE) break;
		jn_grid_multiply(grid, slot, at, level->d, level->q);
		q = level->q;
	}
}

// x = A^-1 b on the last level. Rows have one order of sums each.
static void solve_directly(const JnMultigrid* grid, const JnGridLevel* level, const float* b, float* x) {
	const int n = JN_GRID_MODES * level->nodes;
	for (int i = 0; i < n; ++i) {
		const float* row = grid->inverse + (size_t)i * (size_t)level->nodes * JN_GRID_LANES;
		float sum[JN_GRID_LANES] = {0};
		for (int k = 0; k < level->nodes * JN_GRID_LANES; k += JN_GRID_LANES)
			for (int l = 0; l < JN_GRID_LANES; ++l) sum[l] += row[k + l] * b[k + l];
		x[i / JN_GRID_MODES * JN_GRID_LANES + i % JN_GRID_MODES] = sum[0] + sum[1] + sum[2] + sum[3] + sum[4] + sum[5];
	}
}

void jn_grid_cycle(const JnMultigrid* grid, int slot, int at, const float* b, float* x) {
	const JnGridLevel* level = &grid->levels[at];
	const bool is_last = at + 1 == grid->used;
	if (is_last && grid->is_direct && at > 0) {
		solve_directly(grid, level, b, x);
		return;
	}
	relax(grid, slot, at, b, NULL, x);
	if (!is_last) {
		const JnGridLevel* coarse = level + 1;
		const float scale = at == 0 ? (float)(grid->size / grid->slots[slot].size) : 1;
		jn_grid_multiply(grid, slot, at, x, level->q);
		grid->kernels->restrict_to(level, b, level->q, coarse->b, coarse->nodes, grid->threads);
		jn_grid_cycle(grid, slot, at + 1, coarse->b, coarse->x);
		grid->kernels->prolong(level, coarse->x, scale, x, grid->threads);
	}
	jn_grid_multiply(grid, slot, at, x, level->q);
	relax(grid, slot, at, b, level->q, x);
}

static double norm_of(size_t count, const float* vector) {
	double sum = 0;
	for (size_t k = 0; k < count; ++k) sum += (double)vector[k] * (double)vector[k];
	return sqrt(sum);
}

// Numbers without a pattern that a mesh could have.
static void scatter(const JnGridLevel* level) {
	uint32_t seed = 1;
	for (int node = 0; node < level->nodes; ++node)
		for (int a = 0; a < level->size; ++a) {
			seed = seed * 1664525u + 1013904223u;
			level->vector[level->stride * node + a] = (float)(seed >> 8) / (float)(1 << 23) - 1;
		}
}

void jn_grid_estimate(JnMultigrid* grid, int slot, int at) {
	JnGridLevel* level = &grid->levels[at];
	const size_t count = (size_t)level->stride * (size_t)level->nodes;
	double norm = norm_of(count, level->vector);
	const bool is_new = level->eigenvalue == 0 || !(norm > 0) || !isfinite(norm);
	if (is_new) scatter(level);
	for (int i = is_new ? -FIRST_ESTIMATE : -NEXT_ESTIMATE; i <= 0; ++i) { // the first norm is that of the start
		norm = norm_of(count, level->vector);
		if (!(norm > 0) || !isfinite(norm)) break;
		for (size_t k = 0; k < count; ++k) level->vector[k] /= (float)norm;
		if (i == 0) break;
		jn_grid_multiply(grid, slot, at, level->vector, level->q);
		grid->kernels->relax(level, (JnGridRelax){.c = 1, .beta = 1}, level->q, NULL, level->vector, grid->threads);
	}
	const bool is_known = norm > 0 && isfinite(norm); // not where everything is held
	level->eigenvalue = is_known ? margin * norm : 1;
}
