/// @file load.h
/// Forces on chosen nodes that stay as they are: `loads` of a body.
#ifndef JN_MODEL_LOAD_H
#define JN_MODEL_LOAD_H

#include "model/model.h"

/// Add up the loads of all bodies into model->loads, once masses are known; left NULL when there are none.
JnStatus jn_loads_build(const JnItems* bodies, JnModel* model, JnArena* scratch);

/// Potential of the loads, 0 at the rest positions: -sum F . (x - X) [J].
double jn_loads_potential(const JnModel* model, const double* x);

extern const JnKey jn_load_keys[]; ///< of JnLoadDef

#endif
