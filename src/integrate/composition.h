/// @file composition.h
/// Methods made of kicks (velocities move) and drifts (positions move): the symplectic ones of paper EX.
#ifndef JN_INTEGRATE_COMPOSITION_H
#define JN_INTEGRATE_COMPOSITION_H

#include "jounce/extend.h"

enum { JN_MAX_SPLITS = 5 };

/// A kick of kick[0] dt, a drift of drift[0] dt, a kick of kick[1] dt, and so on; 0 leaves one out. Both sum to 1.
typedef struct JnComposition {
	int count; ///< pairs
	double kick[JN_MAX_SPLITS], drift[JN_MAX_SPLITS];
} JnComposition;

extern const JnIntegratorType jn_symplectic_euler, jn_modified_midpoint, jn_verlet, jn_ruth3, jn_forest_ruth, jn_pefrl;

#endif
