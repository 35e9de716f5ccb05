/// @file force_error.h
/// Steps by the error of linearising the forces.
#ifndef JN_CONTROL_FORCE_ERROR_H
#define JN_CONTROL_FORCE_ERROR_H

#include "jounce/extend.h"

extern const JnControllerType jn_controller_force_error;

#endif
