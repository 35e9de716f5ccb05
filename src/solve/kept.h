/// @file kept.h
/// The sparse Cholesky solver inside the preconditioner `kept`.
#ifndef JN_SOLVE_KEPT_H
#define JN_SOLVE_KEPT_H

#include "solve/precondition.h"

/// Its slots 0 .. JN_SOLVER_SLOTS - 1 are free for others.
JnSolver* jn_kept_direct(const JnPrecondition* kept);

#endif
