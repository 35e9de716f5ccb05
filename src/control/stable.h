/// @file stable.h
/// Steps at the stability limit of explicit methods.
#ifndef JN_CONTROL_STABLE_H
#define JN_CONTROL_STABLE_H

#include "jounce/extend.h"

/// The largest frequency of a system at `s`: omega^2 = p.K p / p.M p after `count` power iterations p <- M^-1 K p. `p`
/// holds the vector to start from, zero for one of pseudo-random numbers, and is left ready for the next call; `work` are
/// two more vectors. *xi is the damping ratio p.D p / (2 omega p.M p) of that mode.
JnStatus jn_largest_frequency(JnSystem* sys, const JnState* s, int count, JnVec p, JnVec work[2], double* omega,
							  double* xi);

extern const JnControllerType jn_controller_stable;

#endif
