/// @file incomplete.h
/// Incomplete Cholesky factor of a block matrix, L L^T near A where L has the pattern of A and no more (IC(0), Meijerink and
/// van der Vorst 1977), in single precision.
#ifndef JN_SOLVE_INCOMPLETE_H
#define JN_SOLVE_INCOMPLETE_H

#include "math/pattern.h"

typedef struct JnIncomplete {
	const JnPattern* pattern;
	const bool* held; ///< held[3 * node + axis]: rows and columns that are left out
	float* L;         ///< JN_SINGLE_INVERSE a stored block; of the diagonal the inverse of its factor
	float* y;         ///< 4 a node
} JnIncomplete;

/// Free with jn_incomplete_destroy, also after a failure.
JnStatus jn_incomplete_create(JnIncomplete* factor, const JnPattern* pattern, const bool* held);
void jn_incomplete_destroy(JnIncomplete* factor);

/// From blocks[9 * block]. Where a pivot is lost, which may happen although A is positive definite, the diagonal is raised
/// until none is. JN_INDEFINITE: a diagonal block of A itself has none.
JnStatus jn_incomplete_factor(JnIncomplete* factor, const double* blocks);

/// z = (L L^T)^-1 r, vectors of 4 numbers a node.
void jn_incomplete_solve(const JnIncomplete* factor, const float* r, float* z);

#endif
