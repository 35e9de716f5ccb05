// inverse of each node's block as xx yx yy zx zy zz.
#include "solve/block_jacobi.h"

#include <string.h>

#include "base/parallel.h"
#include "math/mat3.h"

enum { GRAIN = 16384 }; // nodes a thread should have before it is worth waking

// The minors that Cholesky's pivots are made of.
static bool is_positive(double A[3][3]) {
	return A[0][0] > 0 && A[0][0] * A[1][1] - A[1][0] * A[0][1] > 0 && mat3_determinant(A) > 0;
}

JnStatus jn_block_jacobi_factor(const JnPattern* pattern, const bool* held, const double* blocks, double* inverse) {
	for (int node = 0; node < pattern->nodes; ++node) {
		double A[3][3], B[3][3];
		memcpy(A, blocks + 9 * (size_t)pattern->column_start[node], sizeof A);
		for (int k = 0; k < 9; ++k) // the row and column of a held entry are those of the identity
			if (held[3 * (size_t)node + (size_t)k / 3] || held[3 * (size_t)node + (size_t)k % 3])
				A[k / 3][k % 3] = k % 4 == 0;
		if (!is_positive(A)) return JN_INDEFINITE;
		mat3_invert(A, B);
		const double lower[JN_BLOCK_JACOBI_REALS] = {B[0][0], B[1][0], B[1][1], B[2][0], B[2][1], B[2][2]};
		memcpy(inverse + JN_BLOCK_JACOBI_REALS * (size_t)node, lower, sizeof lower);
	}
	return JN_OK;
}

void jn_block_jacobi_apply(int nodes, const double* inverse, const double* r, double* z, int threads) {
	const int team = jn_threads_for((size_t)nodes, GRAIN, threads);
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1)
	for (int node = 0; node < nodes; ++node) {
		const double *b = inverse + JN_BLOCK_JACOBI_REALS * (size_t)node, *in = r + 3 * (size_t)node;
		double* out = z + 3 * (size_t)node;
		out[0] = b[0] * in[0] + b[1] * in[1] + b[3] * in[2];
		out[1] = b[1] * in[0] + b[2] * in[1] + b[4] * in[2];
		out[2] = b[3] * in[0] + b[4] * in[1] + b[5] * in[2];
	}
}
