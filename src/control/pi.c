#include "control/pi.h"

#include <math.h>

static const double least = 1e-4; // of r that is remembered: a step much too good says nothing about the trend

JnStatus jn_pi_judge(const JnPiDef* def, JnPiMemory* memory, const JnStep* step, JnStatus outcome, double error,
					 double order, JnVec work, JnVerdict* verdict) {
	JnSpace* space = step->sys->space;
	memory->error = memory->allowed = NAN;
	if (outcome == JN_OK) {
		space->ops->combine(space, work, 2, (JnTerm[]){{1, step->end->x}, {-1, step->start->x}});
		memory->error = error;
		memory->allowed = def->tolerance + def->relative * space->ops->longest(space, work);
	}
	const double r = memory->error / memory->allowed;
	if (!(r <= 1)) {
		memory->was_refused = true;
		const double factor = isfinite(r) ? def->safety * pow(r, -1 / order) : jn_cut;
		return jn_limits_refuse(&def->limits, step, factor, verdict);
	}
	if (jn_step_is_clipped(step)) { // its r belongs to another size than those before
		jn_limits_accept(&def->limits, step, def->safety * pow(r, -1 / order), verdict);
		return JN_OK;
	}
	const double before = memory->previous > 0 ? memory->previous : fmax(r, least);
	double factor = def->safety * pow(r, -0.7 / order) * pow(before, 0.4 / order);
	if (memory->was_refused) factor = fmin(factor, 1);
	memory->was_refused = false;
	memory->previous = fmax(r, least);
	jn_limits_accept(&def->limits, step, factor, verdict);
	return JN_OK;
}

double jn_pi_first(JnController* self) {
	return ((const JnPiDef*)self->options)->limits.dt;
}

JnStatus jn_pi_check(const JnController* self) {
	return jn_limits_check(self, &((const JnPiDef*)self->options)->limits);
}

void jn_pi_explain(const JnController* self, JnComplaint* complaint) {
	const JnPiDef* def = self->options;
	const JnPiMemory* memory = self->memory;
	jn_limits_explain(self, &def->limits, "estimated error", memory->error, memory->allowed, complaint);
}

const JnKey jn_pi_keys[] = {
	JN_TOLERANCE_ROW(JnPiDef, "use the largest error in the position of a node that you can accept in a step",
					 "error of a step in position that is allowed, in any coordinate"),
	{.name = "relative",
	 .kind = JN_REAL,
	 .field = offsetof(JnPiDef, relative),
	 .low = 0,
	 .high = 1,
	 .meaning = "error that is allowed besides: a share of the largest distance that a node moves in the step"},
	{.name = "safety",
	 .kind = JN_REAL,
	 .field = offsetof(JnPiDef, safety),
	 .value = {0.9},
	 .low = 0,
	 .high = 1,
	 .open = JN_OPEN_LOW,
	 .remedy = "use 0.9",
	 .meaning = "share of the best size that the next step gets"},
	JN_STEP_LIMIT_ROWS(JnPiDef, 1.2),
	{0},
};
