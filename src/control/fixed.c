// A step that fails is halved, up to `cuts` times. Halves are counted, so that the run comes back to the full step
// exactly on its grid:  a step of level k is dt / 2^k, and the level falls by one when an even number of its halves is
// done and the last few have worked.
#include "control/fixed.h"

#include <math.h>

typedef struct FixedDef {
	double dt;
	int cuts, recovery;
} FixedDef;

typedef struct FixedMemory {
	int level;            // halvings at present
	int good;             // steps that worked since the last failure
	unsigned long offset; // steps of this level done since the grid point of level 0
} FixedMemory;

static double size_at(const FixedDef* def, int level) {
	return ldexp(def->dt, -level);
}

static double first(JnController* controller) {
	return ((const FixedDef*)controller->options)->dt;
}

static void cut(FixedMemory* memory) {
	++memory->level;
	memory->offset *= 2;
	memory->good = 0;
}

static void go_on(const FixedDef* def, FixedMemory* memory) {
	++memory->good;
	++memory->offset;
	while (memory->level > 0 && memory->offset % 2 == 0 && memory->good >= def->recovery) {
		--memory->level;
		memory->offset /= 2;
	}
	if (memory->level == 0) memory->offset = 0;
}

static JnStatus judge(JnController* controller, const JnStep* step, JnStatus outcome, JnVerdict* verdict) {
	const FixedDef* def = controller->options;
	FixedMemory* memory = controller->memory;
	verdict->accepted = outcome == JN_OK;
	if (verdict->accepted) {
		go_on(def, memory);
	} else {
		do { // the last step of a run may be shorter than its level: go below what has failed
			if (memory->level >= def->cuts) return JN_RUN_FAILED;
			cut(memory);
		} while (size_at(def, memory->level) >= step->dt);
	}
	verdict->dt = size_at(def, memory->level);
	return JN_OK;
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
	.memory_size = sizeof(FixedMemory),
	.first = first,
	.judge = judge,
};
