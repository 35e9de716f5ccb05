/// @file embedded.h
/// Steps by the error estimate that comes with a method's coefficients.
#ifndef JN_CONTROL_EMBEDDED_H
#define JN_CONTROL_EMBEDDED_H

#include "jounce/extend.h"

extern const JnControllerType jn_controller_embedded;

#endif
