/// @file step_doubling.h
/// Steps by the difference of one step and two halves.
#ifndef JN_CONTROL_STEP_DOUBLING_H
#define JN_CONTROL_STEP_DOUBLING_H

#include "jounce/extend.h"

extern const JnControllerType jn_controller_step_doubling;

#endif
