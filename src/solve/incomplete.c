// Right-looking, column by column: L_jj = chol(A_jj), L_ij = A_ij L_jj^-T, and A_ik -= L_ij L_kj^T for the blocks (i, k) that
// the pattern has. A block is stored as its three columns, each with 0 behind it; in place of L_jj stands its inverse, so
// that solves need no division.
#include "solve/incomplete.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/aligned.h"
#include "base/log.h"
#include "solve/single_algebra.h"

static const float least_pivot = 1e-4f;                  // relative to the entry of A: less is lost in rounding
static const double first_raise = 1e-3, last_raise = 10; // of the diagonal, relative to it

typedef float Node __attribute__((vector_size(4 * sizeof(float)), may_alias));

JnStatus jn_incomplete_create(JnIncomplete* factor, const JnPattern* pattern, const bool* held) {
	*factor = (JnIncomplete){.pattern = pattern, .held = held};
	factor->L = jn_single_vector(JN_SINGLE_INVERSE * (size_t)pattern->blocks);
	factor->y = jn_single_vector(jn_single_length(pattern->nodes));
	if (factor->L != NULL && factor->y != NULL) return JN_OK;
	return jn_error(JN_OUT_OF_MEMORY, "out of memory: an incomplete factor of %d blocks", pattern->blocks);
}

void jn_incomplete_destroy(JnIncomplete* factor) {
	jn_aligned_free(factor->L);
	jn_aligned_free(factor->y);
	*factor = (JnIncomplete){0};
}

static Node* block_at(const JnIncomplete* factor, int k) {
	return (Node*)(factor->L + JN_SINGLE_INVERSE * (size_t)k);
}

// L = A, held rows and columns those of the identity, the diagonal raised.
static void copy(JnIncomplete* factor, const double* blocks, double raise) {
	const JnPattern* pattern = factor->pattern;
	for (int node = 0; node < pattern->nodes; ++node)
		for (int k = pattern->column_start[node]; k < pattern->column_start[node + 1]; ++k) {
			const bool *row_held = factor->held + 3 * (size_t)pattern->row[k],
					   *column_held = factor->held + 3 * (size_t)node;
			const bool is_diagonal = pattern->row[k] == node;
			for (int r = 0; r < 3; ++r)
				for (int c = 0; c < 3; ++c) {
					const bool is_pivot = is_diagonal && r == c, is_held = row_held[r] || column_held[c];
					const double entry = blocks[9 * (size_t)k + 3 * (size_t)r + (size_t)c];
					block_at(factor, k)[c][r] =
						is_held ? (float)is_pivot : (float)(is_pivot ? (1 + raise) * entry : entry);
				}
		}
}

// B <- inverse of the Cholesky factor of B. False: a pivot is lost.
static bool invert_factor(Node B[3]) {
	float l[3][3] = {{0}}, inverse[3][3] = {{0}};
	for (int c = 0; c < 3; ++c) {
		float pivot = B[c][c];
		for (int k = 0; k < c; ++k) pivot -= l[c][k] * l[c][k];
		if (!(pivot > least_pivot * fabsf(B[c][c])) || !isfinite(pivot)) return false;
		l[c][c] = sqrtf(pivot);
		for (int r = c + 1; r < 3; ++r) {
			float sum = B[c][r];
			for (int k = 0; k < c; ++k) sum -= l[r][k] * l[c][k];
			l[r][c] = sum / l[c][c];
		}
	}
	for (int c = 0; c < 3; ++c)
		for (int r = c; r < 3; ++r) {
			float sum = r == c;
			for (int k = c; k < r; ++k) sum -= l[r][k] * inverse[k][c];
			inverse[r][c] = sum / l[r][r];
		}
	for (int c = 0; c < 3; ++c) B[c] = (Node){inverse[0][c], inverse[1][c], inverse[2][c], 0};
	return true;
}

// A <- A - P Q^T.
static void subtract_product(Node A[3], const Node P[3], const Node Q[3]) {
	for (int c = 0; c < 3; ++c) A[c] -= P[0] * Q[0][c] + P[1] * Q[1][c] + P[2] * Q[2][c];
}

// From the blocks (i, k) of column k those of -L_ij L_kj^T, i >= k; both columns have ascending rows.
static void update_column(JnIncomplete* factor, int from, int end) {
	const JnPattern* pattern = factor->pattern;
	const int* row = pattern->row;
	const int k = row[from], last = pattern->column_start[k + 1];
	const Node* Q = block_at(factor, from);
	for (int to = pattern->column_start[k], i = from; i < end; ++i) {
		while (to < last && row[to] < row[i]) ++to;
		if (to < last && row[to] == row[i]) subtract_product(block_at(factor, to), block_at(factor, i), Q);
	}
}

// A_ij L_jj^-T, where L_jj^-1 is known.
static void divide(Node A[3], const Node inverse[3]) {
	const Node a[3] = {A[0], A[1], A[2]};
	for (int c = 0; c < 3; ++c) A[c] = a[0] * inverse[0][c] + a[1] * inverse[1][c] + a[2] * inverse[2][c];
}

static bool eliminate(JnIncomplete* factor) {
	const JnPattern* pattern = factor->pattern;
	for (int node = 0; node < pattern->nodes; ++node) {
		const int first = pattern->column_start[node], end = pattern->column_start[node + 1];
		Node* diagonal = block_at(factor, first);
		if (!invert_factor(diagonal)) return false;
		for (int k = first + 1; k < end; ++k) divide(block_at(factor, k), diagonal);
		for (int k = first + 1; k < end; ++k) update_column(factor, k, end);
	}
	return true;
}

JnStatus jn_incomplete_factor(JnIncomplete* factor, const double* blocks) {
	double raise = 0;
	while (raise <= last_raise) {
		copy(factor, blocks, raise);
		if (eliminate(factor)) return JN_OK;
		raise = raise > 0 ? 10 * raise : first_raise;
	}
	return JN_INDEFINITE;
}

void jn_incomplete_solve(const JnIncomplete* factor, const float* r, float* z) {
	memcpy(factor->y, r, 4 * (size_t)factor->pattern->nodes * sizeof *r);
	jn_single_algebra()->solve_columns(factor->pattern, factor->L, factor->y, z);
}
