// Provot 1996, Baraff and Witkin 1998 (AD section 4): a step in which a length changes by more than a share of itself is
// refused and halved; after some that were good the size is doubled.
#include "control/stretch_limit.h"

#include <math.h>
#include <stdio.h>

#include "base/log.h"
#include "control/limits.h"

typedef struct StretchLimitDef {
	double stretch;
	int recovery;
	JnStepLimits limits;
} StretchLimitDef;

typedef struct StretchLimitMemory {
	int good;       // steps accepted since the size changed
	double stretch; // of the last attempt; NAN: it failed
} StretchLimitMemory;

static JnStatus check(const JnController* self) {
	JN_TRY(jn_limits_check(self, &((const StretchLimitDef*)self->options)->limits));
	if (self->sys->ops->stretch != NULL) return JN_OK;
	return jn_error(JN_BAD_INPUT,
					"%s.controller: stretch_limit cannot serve this system, which does not tell how it is stretched; "
					"choose speed_limit",
					self->path);
}

static double first(JnController* self) {
	return ((const StretchLimitDef*)self->options)->limits.dt;
}

static JnStatus judge(JnController* self, JnStep* step, JnStatus outcome, JnVerdict* verdict) {
	const StretchLimitDef* def = self->options;
	StretchLimitMemory* memory = self->memory;
	memory->stretch = outcome == JN_OK ? step->sys->ops->stretch(step->sys, step->start, step->end) : (double)NAN;
	if (!(memory->stretch <= def->stretch)) {
		memory->good = 0;
		return jn_limits_refuse(&def->limits, step, jn_cut, verdict);
	}
	if (!jn_step_is_clipped(step)) ++memory->good;
	const bool doubles = memory->good >= def->recovery;
	if (doubles) memory->good = 0;
	const double dt = fmax(step->dt, step->wanted) * (doubles ? 2 : 1);
	*verdict = (JnVerdict){.accepted = true, .dt = fmin(dt, def->limits.dt_max)};
	return JN_OK;
}

static void explain(const JnController* self, JnComplaint* out) {
	const StretchLimitDef* def = self->options;
	const double stretch = ((const StretchLimitMemory*)self->memory)->stretch;
	jn_limits_explain(self, &def->limits, "", NAN, 0, out);
	if (isnan(stretch)) return;
	snprintf(out->cause, sizeof out->cause, "a length changes by %.3g of itself, more than %s.stretch, %.3g", stretch,
			 self->path, def->stretch);
}

static const JnKey keys[] = {
	{.name = "stretch",
	 .kind = JN_REAL,
	 .field = offsetof(StretchLimitDef, stretch),
	 .value = {0.1},
	 .low = 0,
	 .high = 1e6,
	 .open = JN_OPEN_LOW,
	 .remedy = "use 0.1, as for cloth",
	 .meaning = "largest change, in a step, of the distance between two nodes of an element, relative to that at rest"},
	{.name = "recovery",
	 .kind = JN_INTEGER,
	 .field = offsetof(StretchLimitDef, recovery),
	 .value = {4},
	 .low = 1,
	 .high = 1000000,
	 .meaning = "steps that must work before the size is doubled"},
	JN_STEP_SIZE_ROWS(StretchLimitDef),
	{0},
};

const JnControllerType jn_controller_stretch_limit = {
	.row = {.name = "stretch_limit",
			.doc = "a step that changes a length too much is halved; after some that do not, the size is doubled",
			.keys = keys,
			.options_size = sizeof(StretchLimitDef)},
	.memory_size = sizeof(StretchLimitMemory),
	.check = check,
	.first = first,
	.judge = judge,
	.explain = explain,
};
