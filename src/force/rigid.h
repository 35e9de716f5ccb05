/// @file rigid.h
/// The law of rigid balls and plates: a mass, and how hard they push.
#ifndef JN_FORCE_RIGID_H
#define JN_FORCE_RIGID_H

#include "force/kernel.h"

/// Keys of `material: {law: rigid}`.
typedef struct JnRigidDef {
	double mass;      ///< [kg]; NAN: by density
	double density;   ///< [kg/m^3]; NAN: by mass
	double stiffness; ///< force on a point or another rigid thing that overlaps, a length [N/m]; NAN: by the points
} JnRigidDef;

extern const JnLaw jn_law_rigid;

#endif
