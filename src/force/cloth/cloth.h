/// @file cloth.h
/// The laws of cloth.
#ifndef JN_FORCE_CLOTH_CLOTH_H
#define JN_FORCE_CLOTH_CLOTH_H

#include "force/constraint/constraint.h"

extern const JnLaw jn_law_mass_spring, jn_law_membrane;

#endif
