/// @file friction.h
/// Coefficients of friction of pairs of contact materials, which bodies and obstacles name as their `surface`.
#ifndef JN_PASS_FRICTION_H
#define JN_PASS_FRICTION_H

#include "base/arena.h"
#include "jounce/sim.h"

typedef struct JnFriction {
	int surface_count;
	double* mu; ///< [surface][surface]
} JnFriction;

/// The table of `pairs` (JnContactPairDef) and, for all others, `mu`. `names` are those of `count` things; surface_of[i]
/// becomes the row of thing i. JN_BAD_INPUT after a message that begins with `path` for a pair of unknown names.
JnStatus jn_friction_create(const JnItems* pairs, double mu, const char* path, int count, const char* const* names,
							JnArena* arena, int* surface_of, JnFriction* out);

static inline double jn_friction_of(const JnFriction* friction, int first, int second) {
	return friction->mu[first * friction->surface_count + second];
}

extern const JnKey jn_friction_pair_keys[]; ///< of JnContactPairDef

#endif
