/// @file stiffness.h
/// K of a model at the positions of the last linearize(): as blocks, as diagonal blocks, as products. Each is made when it
/// is first asked for, so that a solver which needs products alone never pays for a matrix.
#ifndef JN_MODEL_STIFFNESS_H
#define JN_MODEL_STIFFNESS_H

#include "model/system.h"

/// Room, and whether products can stand for blocks.
JnStatus jn_stiffness_create(JnModelSystem* sys);

void jn_stiffness_destroy(JnModelSystem* sys);

/// K is now that at x.
void jn_stiffness_set(JnModelSystem* sys, const double* x);

/// Blocks of K, 9 a block of the pattern; exact, or (definite) with eigenvalues clamped, which stand in sys->scratch.
const double* jn_stiffness_blocks(JnModelSystem* sys, JnDefinite definite);

/// Diagonal blocks of K, 9 a node.
const double* jn_stiffness_diagonal(JnModelSystem* sys, JnDefinite definite);

/// What products in single precision need of K; NULL where memory is short.
const JnStored* jn_stiffness_single(JnModelSystem* sys, JnDefinite definite);

/// out += scale * K in.
void jn_stiffness_apply(JnModelSystem* sys, JnDefinite definite, double scale, const double* in, double* out);

#endif
