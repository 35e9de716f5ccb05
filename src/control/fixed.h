/// @file fixed.h
/// Steps of one size, cut when a step fails.
#ifndef JN_CONTROL_FIXED_H
#define JN_CONTROL_FIXED_H

#include "jounce/extend.h"

extern const JnControllerType jn_controller_fixed;

#endif
