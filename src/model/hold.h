/// @file hold.h
/// Where held coordinates are at a time: fixed ones at rest, others on their motions, along curves, or as inputs say.
#ifndef JN_MODEL_HOLD_H
#define JN_MODEL_HOLD_H

#include "model/guide.h"
#include "model/input.h"
#include "model/model.h"

/// Values of all held coordinates: position [m], velocity, acceleration; those of the time asked for last are kept.
typedef struct JnHold {
	double t; ///< NAN: not made yet, or out of date
	JnMotionValue* values;
} JnHold;

JnStatus jn_hold_create(JnModel* model, JnHold* hold);

/// The values at time t.
const JnMotionValue* jn_hold_at(const JnModel* model, JnHold* hold, double t);

#endif
