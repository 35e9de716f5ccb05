/// @file block_jacobi.h
/// The preconditioner that inverts the 3x3 diagonal block of each node, held entries left out.
#ifndef JN_SOLVE_BLOCK_JACOBI_H
#define JN_SOLVE_BLOCK_JACOBI_H

#include "math/pattern.h"

enum { JN_BLOCK_JACOBI_REALS = 6 }; ///< a node: the inverse is symmetric

/// inverse[6 * node] from the diagonal blocks of blocks[9 * block]. JN_INDEFINITE when one of them is not positive
/// definite: then the whole matrix is not.
JnStatus jn_block_jacobi_factor(const JnPattern* pattern, const bool* held, const double* blocks, double* inverse);

/// z = inverse r; 0 at held entries, where r must be 0.
void jn_block_jacobi_apply(int nodes, const double* inverse, const double* r, double* z, int threads);

#endif
