/// @file combined.h
/// Several controllers at once.
#ifndef JN_CONTROL_COMBINED_H
#define JN_CONTROL_COMBINED_H

#include "jounce/extend.h"

extern const JnControllerType jn_controller_combined;

#endif
