/// @file ex_accuracy.h
/// Errors of positions of integrators that are given the same time, and their measured orders (study ex-table).
#ifndef JN_APP_REPRODUCE_EX_ACCURACY_H
#define JN_APP_REPRODUCE_EX_ACCURACY_H

#include "score.h"

/// A method on a scene without damping.
typedef struct ExAccuracy {
	double dt;    ///< step at the given cost [s]
	double error; ///< root mean square over the nodes at the end [m]; NAN: not stable with that step
	double order; ///< from the errors of two smaller steps; NAN: they are not stable, or rounding
} ExAccuracy;

/// For each method of `score`, whose costs are known: the step with which a simulated second takes as long as with
/// symplectic Euler at `share` of its largest stable step, and the error with it over `time` [s]. `out`: one a method.
JnStatus ex_accuracy_find(Score* score, double share, double time, ExAccuracy* out);

#endif
