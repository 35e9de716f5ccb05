/// @file motion.h
/// Prescribed motion along one axis: displacement, velocity and acceleration as functions of time.
#ifndef JN_MODEL_MOTION_H
#define JN_MODEL_MOTION_H

#include "jounce/extend.h"

typedef struct JnMotionValue {
	double x, v, a; ///< displacement from rest [m], velocity [m/s], acceleration [m/s^2]
} JnMotionValue;

typedef struct JnMotionType {
	JnRow row;
	JnMotionValue (*at)(const void* options, double t);
	/// What bounds cannot say, such as rising times, of the motion at the key path `what`. NULL: nothing to check.
	JnStatus (*check)(const void* options, const char* what);
} JnMotionType;

extern const JnRowList jn_motion_list; ///< rows are &JnMotionType.row

#endif
