/// @file stretch.h
/// How much a model is stretched between two states.
#ifndef JN_MODEL_STRETCH_H
#define JN_MODEL_STRETCH_H

#include "model/model.h"

/// Largest change of distance between two nodes of an element, from positions `from` to `to`, relative to their distance
/// at rest (to 1 m where that is zero).
double jn_model_stretch(const JnModel* model, const double* from, const double* to);

#endif
