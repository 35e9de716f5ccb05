/// @file constrain.h
/// Fixed and driven coordinates, from the definitions of bodies.
#ifndef JN_MODEL_CONSTRAIN_H
#define JN_MODEL_CONSTRAIN_H

#include "model/model.h"

/// Fill model->held, held_count and held_list from `fix` and `drive` of the bodies (JnBodyDef), whose meshes are there.
/// JN_BAD_INPUT after a message when an entry selects nothing or no node stays free.
JnStatus jn_model_constrain(const JnItems* bodies, JnModel* model, JnArena* scratch);

#endif
