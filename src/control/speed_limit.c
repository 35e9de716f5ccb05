// A CFL condition, as AD section 4 compares: dt = C / |v|, with the largest speed of a node at the end of the step. A step is
// accepted whatever its own speed was; only one that fails is cut.
#include "control/speed_limit.h"

#include <math.h>

#include "control/limits.h"

typedef struct SpeedLimitDef {
	double distance;
	JnStepLimits limits;
} SpeedLimitDef;

static JnStatus check(const JnController* self) {
	return jn_limits_check(self, &((const SpeedLimitDef*)self->options)->limits);
}

static double first(JnController* self) {
	return ((const SpeedLimitDef*)self->options)->limits.dt;
}

static JnStatus judge(JnController* self, JnStep* step, JnStatus outcome, JnVerdict* verdict) {
	const SpeedLimitDef* def = self->options;
	JnSpace* space = step->sys->space;
	if (outcome != JN_OK) return jn_limits_refuse(&def->limits, step, jn_cut, verdict);
	const double speed = space->ops->longest(space, step->end->v);
	jn_limits_accept(&def->limits, step, def->distance / (speed * step->dt), verdict);
	return JN_OK;
}

static void explain(const JnController* self, JnComplaint* complaint) {
	jn_limits_explain(self, &((const SpeedLimitDef*)self->options)->limits, "", NAN, 0, complaint);
}

static const JnKey keys[] = {
	{.name = "distance",
	 .kind = JN_REAL,
	 .field = offsetof(SpeedLimitDef, distance),
	 .value = {1e-2},
	 .low = 0,
	 .high = 1e6,
	 .open = JN_OPEN_LOW,
	 .unit = "m",
	 .remedy = "use the size of an element, or less",
	 .meaning = "distance that the fastest node may go in a step, at the speed with which the step begins"},
	JN_STEP_LIMIT_ROWS(SpeedLimitDef, 1),
	{0},
};

const JnControllerType jn_controller_speed_limit = {
	.row = {.name = "speed_limit",
			.doc = "steps in which the fastest node goes a given distance: dt = distance / speed",
			.keys = keys,
			.options_size = sizeof(SpeedLimitDef)},
	.check = check,
	.first = first,
	.judge = judge,
	.explain = explain,
};
