/// @file bdf.h
/// Backward differentiation of second order with variable steps.
#ifndef JN_INTEGRATE_BDF_H
#define JN_INTEGRATE_BDF_H

#include "jounce/extend.h"

extern const JnIntegratorType jn_bdf2;

#endif
