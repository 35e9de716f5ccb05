/// @file advance.h
/// Kicks and drifts of explicit methods, in one pass over the vectors.
#ifndef JN_MODEL_ADVANCE_H
#define JN_MODEL_ADVANCE_H

#include "model/system.h"

/// The verb `advance` of a model.
JnStatus jn_model_advance(JnSystem* base, const JnState* from, double kick, double drift, JnState* to);

#endif
