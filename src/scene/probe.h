/// @file probe.h
/// Probes at work: the nodes that one follows, and their mean position.
#ifndef JN_SCENE_PROBE_H
#define JN_SCENE_PROBE_H

#include "base/arena.h"
#include "jounce/scene.h"

typedef struct JnProbe {
	int count;        ///< >= 1
	const int* nodes; ///< of the model
} JnProbe;

extern const JnKey jn_probe_keys[]; ///< of JnProbeDef

/// JN_BAD_INPUT, after a message, unless each probe says in one way what it follows, of a body that exists.
JnStatus jn_probes_check(const JnSceneDef* def);

/// Find the nodes of probe number `index`, whose definition has been checked. JN_BAD_INPUT when there are none.
JnStatus jn_probe_create(const JnProbeDef* def, int index, const JnModel* model, JnArena* arena, JnProbe* probe);

/// Mean of the positions x of its nodes [m].
void jn_probe_position(const JnProbe* probe, const double* x, double position[3]);

#endif
