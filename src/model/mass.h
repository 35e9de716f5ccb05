/// @file mass.h
/// Mass matrices over the model's pattern.
#ifndef JN_MODEL_MASS_H
#define JN_MODEL_MASS_H

#include "model/model.h"

/// Fill model->mass, alpha_mass, nodal_mass, total_mass, mass_is_diagonal from the bodies.
///
/// Lumping is by row sums for tet4 and hex8; for tet10, whose row sums are negative at the corners, by scaling the
/// diagonal to the element's mass (Hinton, Rock, Zienkiewicz 1976).
JnStatus jn_mass_build(JnModel* model);

#endif
