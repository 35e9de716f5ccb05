/// @file damping.h
/// Stiffness damping D = sum over groups of beta K, K in its definite form and frozen at one state. Kernels with products
/// have D v without a matrix, which is assembled only when one is asked for; of others it is assembled at once.
#ifndef JN_MODEL_DAMPING_H
#define JN_MODEL_DAMPING_H

#include "model/system.h"

/// Room for D, and what the bodies ask of it. JN_BAD_INPUT when they differ in what one D must share.
JnStatus jn_damping_create(JnModelSystem* sys);

/// Rotations and whatever else stays constant over the step that begins at `start`, and D with them.
void jn_damping_begin(JnModelSystem* sys, const JnState* start);

/// D at a state, where damping.stiffness is `current`; else nothing.
void jn_damping_follow(JnModelSystem* sys, const JnState* s);

/// D as 9 numbers a block; NULL when it does not act.
const double* jn_damping_blocks(JnModelSystem* sys);

/// Its diagonal blocks, 9 a node; NULL when it does not act.
const double* jn_damping_diagonal(JnModelSystem* sys);

/// What products in single precision need of D; NULL where it does not act, has no products or memory is short.
const JnStored* jn_damping_single(JnModelSystem* sys);

/// out += scale * D * in.
void jn_damping_apply(const JnModelSystem* sys, double scale, const double* in, double* out);

/// out += scale * (sum over bodies of alpha M) * in, once damping acts.
void jn_damping_apply_mass(const JnModelSystem* sys, double scale, const double* in, double* out);

#endif
