// Inverse diagonal blocks, and what is kept of the matrix of a slot.
#include <math.h>
#include <string.h>

#include "math/mat3.h"
#include "solve/multigrid.h"

enum { MODES = JN_GRID_MODES };

// A becomes its inverse by symmetric sweeps; unknowns without a pivot are left out, their rows and columns 0.
static void invert(double A[MODES][MODES], int size) {
	bool is_swept[MODES];
	for (int k = 0; k < size; ++k) {
		const double pivot = A[k][k];
		is_swept[k] = pivot > 0;
		for (int i = 0; i < size && is_swept[k]; ++i)
			for (int j = 0; j < size; ++j)
				if (i != k && j != k) A[i][j] -= A[i][k] * A[k][j] / pivot;
		for (int i = 0; i < size && is_swept[k]; ++i)
			if (i != k) {
				A[i][k] /= pivot;
				A[k][i] = A[i][k];
			}
		if (is_swept[k]) A[k][k] = -1 / pivot;
	}
	for (int i = 0; i < size; ++i)
		for (int j = 0; j < size; ++j) A[i][j] = is_swept[i] && is_swept[j] ? -A[i][j] : 0;
}

// A pivot of which rounding in single precision leaves less than this is none.
static const double least_pivot = 1e-6;

void jn_grid_invert(JnGridLevel* level) {
	for (int node = 0; node < level->nodes; ++node) {
		const float* block = level->blocks + JN_GRID_BLOCK * jn_grid_diagonal(level, node);
		float* out = level->inverse + JN_GRID_BLOCK * (size_t)node;
		double A[MODES][MODES];
		for (int a = 0; a < MODES; ++a)
			for (int c = 0; c < MODES; ++c)
				A[a][c] = (double)block[JN_GRID_LANES * c + a] * (a == c ? 1 + least_pivot : 1);
		invert(A, MODES);
		for (int a = 0; a < MODES; ++a)
			for (int c = 0; c < MODES; ++c) out[JN_GRID_LANES * a + c] = (float)A[a][c];
	}
}

// The minors that Cholesky's pivots are made of.
static bool is_positive(double A[MODES][MODES]) {
	double B[3][3];
	for (int a = 0; a < 3; ++a) memcpy(B[a], A[a], sizeof B[a]);
	return B[0][0] > 0 && B[0][0] * B[1][1] - B[1][0] * B[0][1] > 0 && mat3_determinant(B) > 0;
}

static JnStatus invert_finest(JnMultigrid* grid, int slot) {
	const double* diagonal = grid->matrices->diagonal(grid->matrices->user, slot);
	JnGridSlot* out = &grid->slots[slot];
	out->size = 0;
	for (int node = 0; node < grid->pattern->nodes; ++node) {
		const bool* held = grid->held + 3 * (size_t)node;
		double A[MODES][MODES];
		for (int e = 0; e < 9; ++e)
			A[e / 3][e % 3] = held[e / 3] || held[e % 3] ? e % 4 == 0 : diagonal[9 * (size_t)node + (size_t)e];
		if (!is_positive(A)) return JN_INDEFINITE;
		for (int a = 0; a < 3; ++a) out->size += held[a] ? 0 : A[a][a];
		invert(A, 3);
		for (int a = 0; a < 3; ++a)
			for (int c = 0; c < 3; ++c)
				out->inverse[12 * (size_t)node + 4 * (size_t)a + (size_t)c] = held[a] || held[c] ? 0 : (float)A[a][c];
	}
	return JN_OK;
}

static JnStatus copy_blocks(JnMultigrid* grid, int slot) {
	const size_t count = 9 * (size_t)grid->pattern->blocks;
	JnGridSlot* out = &grid->slots[slot];
	if (out->blocks == NULL) JN_NEW(&grid->arena, out->blocks, count + 1);
	const double* blocks = grid->matrices->blocks(grid->matrices->user, slot);
	for (size_t k = 0; k < count; ++k) out->blocks[k] = (float)blocks[k];
	return JN_OK;
}

JnStatus jn_grid_renew_slot(JnMultigrid* grid, int slot) {
	JnGridSlot* out = &grid->slots[slot];
	if (out->inverse == NULL) JN_NEW(&grid->arena, out->inverse, 12 * (size_t)grid->pattern->nodes + 1);
	JN_TRY(invert_finest(grid, slot));
	if (grid->matrices->apply_single == NULL) JN_TRY(copy_blocks(grid, slot));
	grid->levels[0].inverse = out->inverse;
	jn_grid_estimate(grid, slot, 0);
	out->eigenvalue = grid->levels[0].eigenvalue;
	return JN_OK;
}
