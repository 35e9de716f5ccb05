// A step that fails is halved, up to `cuts` times. A step of level k is dt / 2^k, and the level falls by one when an even
// number of its halves is done and the last few have worked.
#include "control/fixed.h"

#include <math.h>
#include <stdio.h>

#include "control/halving.h"

typedef struct FixedDef {
	double dt;
	int cuts, recovery;
} FixedDef;

static double size_at(const FixedDef* def, int level) {
	return ldexp(def->dt, -level);
}

static double first(JnController* controller) {
	return ((const FixedDef*)controller->options)->dt;
}

static JnStatus judge(JnController* controller, JnStep* step, JnStatus outcome, JnVerdict* verdict) {
	const FixedDef* def = controller->options;
	JnHalving* halving = controller->memory;
	verdict->accepted = outcome == JN_OK;
	if (verdict->accepted) {
		jn_halving_go_on(halving, def->recovery);
	} else {
		do { // the last step of a run may be shorter than its level: go below what has failed
			if (halving->level >= def->cuts) return JN_RUN_FAILED;
			jn_halving_cut(halving);
		} while (size_at(def, halving->level) >= step->dt);
	}
	verdict->dt = size_at(def, halving->level);
	return JN_OK;
}

static void explain(const JnController* controller, JnComplaint* out) {
	snprintf(out->remedy, sizeof out->remedy, "a smaller %s.dt, a more robust method (backward_euler), or more %s.cuts",
			 controller->path, controller->path);
}

static const JnKey keys[] = {
	{.name = "dt",
	 .kind = JN_REAL,
	 .field = offsetof(FixedDef, dt),
	 .value = {1e-3},
	 .low = 1e-9,
	 .high = 10,
	 .unit = "s",
	 .meaning = "time step"},
	{.name = "cuts",
	 .kind = JN_INTEGER,
	 .field = offsetof(FixedDef, cuts),
	 .value = {10},
	 .low = 0,
	 .high = 30,
	 .meaning = "times that a failing step may be halved before the run ends"},
	{.name = "recovery",
	 .kind = JN_INTEGER,
	 .field = offsetof(FixedDef, recovery),
	 .value = {4},
	 .low = 1,
	 .high = 1000000,
	 .meaning = "steps that must work before the size is doubled again, up to dt"},
	{0},
};

const JnControllerType jn_controller_fixed = {
	.row = {.name = "fixed",
			.doc = "steps of one size; a step that fails is halved, and doubled again after some that work",
			.keys = keys,
			.options_size = sizeof(FixedDef)},
	.memory_size = sizeof(JnHalving),
	.first = first,
	.judge = judge,
	.explain = explain,
};
