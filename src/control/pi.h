/// @file pi.h
/// Steps by an estimate of their error in position: the controller of Gustafsson (ACM TOMS 20, 1994) in the form of Hairer and
/// Wanner II, section IV.2. With k the power of dt with which the estimate falls and r = error / allowed,
///   accepted (r <= 1):  dt <- dt safety r_n^(-0.7/k) r_(n-1)^(0.4/k),   not above dt after a refusal
///   refused:            dt <- dt safety r^(-1/k)
#ifndef JN_CONTROL_PI_H
#define JN_CONTROL_PI_H

#include "control/limits.h"

typedef struct JnPiDef {
	double tolerance; ///< allowed error of a step [m]
	double relative;  ///< more of it: share of the largest distance that a node moves in the step
	double safety;
	JnStepLimits limits;
} JnPiDef;

extern const JnKey jn_pi_keys[]; ///< of JnPiDef

typedef struct JnPiMemory {
	double error, allowed; ///< of the last attempt [m]; NAN: it failed before
	double previous;       ///< r of the last accepted step; 0: none yet
	int was_refused;       ///< the attempt before; 0: it was not
} JnPiMemory;

/// An error estimate of order `order` decides. `work` is a vector for the distances moved.
JnStatus jn_pi_judge(const JnPiDef* def, JnPiMemory* memory, const JnStep* step, JnStatus outcome, double error,
					 double order, JnVec work, JnVerdict* verdict);

double jn_pi_first(JnController* controller);
JnStatus jn_pi_check(const JnController* controller);
void jn_pi_explain(const JnController* controller, JnComplaint* complaint);

#endif
