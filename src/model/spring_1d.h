/// @file spring_1d.h
/// A mass on a nonlinear spring, along x: m x'' = -k_x (x + x^3) - k_v (v + v^3), with x in m and v in m/s (AD figure 1). It is
/// shown as one node, whose y and z stay zero.
#ifndef JN_MODEL_SPRING_1D_H
#define JN_MODEL_SPRING_1D_H

#include "model/system_list.h"

/// Options of the row.
typedef struct JnSpringDef {
	double k_x, k_v; ///< [N/m], [N s/m]
	double mass;     ///< [kg]
	double x, v;     ///< at the start [m], [m/s]
} JnSpringDef;

extern const JnSystemType jn_system_spring_1d;

#endif
