/// @file explicit_runge_kutta.h
/// Explicit one-step methods that are no compositions of kicks and drifts.
#ifndef JN_INTEGRATE_EXPLICIT_RUNGE_KUTTA_H
#define JN_INTEGRATE_EXPLICIT_RUNGE_KUTTA_H

#include "jounce/extend.h"

enum { JN_MAX_EXPLICIT_STAGES = 4 };

/// Coefficients in Nystrom's form, a_j being the acceleration of stage j:
///   x_i = x + c_i dt v + dt^2 sum_{j<i} x[i][j] a_j,   v_i = v + dt sum_{j<i} v[i][j] a_j,   at time t + c_i dt
/// and the end likewise by x_end and v_end. A Runge-Kutta method (A, b, c) has x = A A, v = A, x_end = b A, v_end = b.
typedef struct JnNystrom {
	int stages;
	double c[JN_MAX_EXPLICIT_STAGES];
	double x[JN_MAX_EXPLICIT_STAGES][JN_MAX_EXPLICIT_STAGES], v[JN_MAX_EXPLICIT_STAGES][JN_MAX_EXPLICIT_STAGES];
	double x_end[JN_MAX_EXPLICIT_STAGES], v_end[JN_MAX_EXPLICIT_STAGES];
} JnNystrom;

extern const JnIntegratorType jn_explicit_euler, jn_midpoint, jn_half_step, jn_modified_half_step, jn_rk4;

#endif
