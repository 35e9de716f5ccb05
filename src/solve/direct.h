/// @file direct.h
/// What preconditioners ask of the direct solver, beside its verbs. It must have been made with precision mixed.
#ifndef JN_SOLVE_DIRECT_H
#define JN_SOLVE_DIRECT_H

#include "solve/solver.h"

enum { JN_DIRECT_SLOTS = JN_SOLVER_SLOTS + 1 }; ///< one more, for a preconditioner

/// z = A^-1 r in single precision with the factor of `slot`; vectors of 4 numbers a node, whose held entries become 0.
void jn_direct_solve_nodes(JnSolver* direct, int slot, const float* r, float* z);

/// From now on the factor of `slot` serves jn_direct_solve_nodes and approximate() alone: the one in double precision, two
/// thirds of the memory, is freed. The next factor() makes both again.
void jn_direct_keep_single(JnSolver* direct, int slot);

#endif
