/// @file cholmod_half.h
/// Halves (half.h) by a supernodal factor of CHOLMOD.
#ifndef JN_SOLVE_CHOLMOD_HALF_H
#define JN_SOLVE_CHOLMOD_HALF_H

#include <cholmod.h>

#include "solve/half.h"

/// Append L^-1 P b of the columns to `out`. position[entry]: place in the order of the factor, or -1 when it is held.
JnStatus jn_cholmod_half(const cholmod_factor* factor, const int* position, const JnColumns* columns, JnHalf* out);

#endif
