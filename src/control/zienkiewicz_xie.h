/// @file zienkiewicz_xie.h
/// Steps by the error estimate of Zienkiewicz and Xie, for Newmark's family.
#ifndef JN_CONTROL_ZIENKIEWICZ_XIE_H
#define JN_CONTROL_ZIENKIEWICZ_XIE_H

#include "jounce/extend.h"

extern const JnControllerType jn_controller_zienkiewicz_xie;

#endif
