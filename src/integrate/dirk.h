/// @file dirk.h
/// The diagonally implicit Runge-Kutta methods; their coefficients stand in dirk_tableau.c.
#ifndef JN_INTEGRATE_DIRK_H
#define JN_INTEGRATE_DIRK_H

#include "jounce/extend.h"

extern const JnIntegratorType jn_backward_euler, jn_implicit_midpoint, jn_trapezoid, jn_sdirk2, jn_tr_bdf2,
	jn_tr_bdf2_b, jn_sdirk3, jn_sdirk_ncs23, jn_sdirk_nc34, jn_sdirk_3345, jn_sdirk_4347, jn_esdirk324, jn_esdirk325,
	jn_esdirk436;

#endif
