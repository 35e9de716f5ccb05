/// @file pendulum.h
/// A pendulum, a mass on a rod without weight: theta'' = -(g/l) sin theta (EX, "Results"). It is shown as one node, whose x is
/// theta in rad and whose y and z stay zero.
#ifndef JN_MODEL_PENDULUM_H
#define JN_MODEL_PENDULUM_H

#include "model/system_list.h"

/// Options of the row.
typedef struct JnPendulumDef {
	double gravity; ///< g [m/s^2]
	double length;  ///< l [m]
	double mass;    ///< [kg]
	double angle;   ///< at the start, from hanging down [rad]
	double speed;   ///< at the start [rad/s]
} JnPendulumDef;

extern const JnSystemType jn_system_pendulum;

#endif
