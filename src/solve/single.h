/// @file single.h
/// Triangular solves with a supernodal factor kept in single precision: half the memory to stream, which is what a solve
/// costs. Good to about six digits: a direction for an iteration that measures its residual in double precision.
#ifndef JN_SOLVE_SINGLE_H
#define JN_SOLVE_SINGLE_H

#include <stddef.h>

enum { JN_SINGLE_LANES = 16 }; ///< panels are padded to a multiple of this many rows

/// A factor L. Supernode s has the columns super[s] .. super[s + 1] - 1 as a dense column-major panel at x + panel[s]; its
/// row numbers are rows[pi[s] .. pi[s + 1]), its own columns first. Panels are padded with zeros to stride
/// jn_single_stride(rows); on and above the diagonal they hold zeros as well, so that every loop runs over whole lanes.
typedef struct JnSingleFactor {
	int supernodes;
	const int *super, *pi, *rows;
	const size_t* panel;
	float* x;
	float* inverse; ///< 1 / diagonal, one a column
} JnSingleFactor;

/// Rows of a panel of `rows` rows with its padding.
static inline int jn_single_stride(int rows) {
	return (rows + JN_SINGLE_LANES - 1) / JN_SINGLE_LANES * JN_SINGLE_LANES;
}

/// x <- (L L^T)^-1 x; work has the stride of the longest panel, 64-byte aligned.
typedef void JnSingleSolve(const JnSingleFactor* factor, float* x, float* work);

/// The one for this processor. All give the same bits.
JnSingleSolve* jn_single_solve(void);

#endif
