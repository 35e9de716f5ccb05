/// @file law.h
/// The laws whose elements are constraints, for threads and for any mesh of tetrahedra.
#ifndef JN_FORCE_CONSTRAINT_LAW_H
#define JN_FORCE_CONSTRAINT_LAW_H

#include "force/constraint/constraint.h"

extern const JnLaw jn_law_constraints, jn_law_rod;

#endif
