/// @file space.h
/// The host space: vectors of doubles in memory, with reductions in a fixed order.
#ifndef JN_BASE_SPACE_H
#define JN_BASE_SPACE_H

#include "jounce/extend.h"

/// A space of vectors of `length` doubles that may use `threads` threads; NULL when memory is out.
/// Free with jn_host_space_destroy, after all vectors.
JnSpace* jn_host_space_create(size_t length, int threads);
void jn_host_space_destroy(JnSpace* space);

/// Give a state vectors of the space (zeroed). JN_OUT_OF_MEMORY leaves it without any.
JnStatus jn_state_create(JnSpace* space, JnState* state);
void jn_state_destroy(JnSpace* space, JnState* state);

/// Copy time, positions, velocities and stamp.
void jn_state_copy(JnSpace* space, const JnState* from, JnState* to);

#endif
