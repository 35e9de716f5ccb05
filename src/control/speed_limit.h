/// @file speed_limit.h
/// Steps by the largest speed.
#ifndef JN_CONTROL_SPEED_LIMIT_H
#define JN_CONTROL_SPEED_LIMIT_H

#include "jounce/extend.h"

extern const JnControllerType jn_controller_speed_limit;

#endif
