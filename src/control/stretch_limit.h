/// @file stretch_limit.h
/// Steps by the largest change of a length.
#ifndef JN_CONTROL_STRETCH_LIMIT_H
#define JN_CONTROL_STRETCH_LIMIT_H

#include "jounce/extend.h"

extern const JnControllerType jn_controller_stretch_limit;

#endif
