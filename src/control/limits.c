#include "control/limits.h"

#include <math.h>
#include <stdio.h>

#include "base/log.h"

JnStatus jn_limits_check(const JnController* controller, const JnStepLimits* limits) {
	if (limits->dt_min > limits->dt_max)
		return jn_error(JN_BAD_INPUT, "%s.dt_min: %g s is above dt_max, %g s; lower it or raise dt_max",
						controller->path, limits->dt_min, limits->dt_max);
	if (limits->dt < limits->dt_min || limits->dt > limits->dt_max)
		return jn_error(JN_BAD_INPUT,
						"%s.dt: %g s is outside [dt_min, dt_max] = [%g, %g] s; choose a first step between them",
						controller->path, limits->dt, limits->dt_min, limits->dt_max);
	return JN_OK;
}

static double bound(const JnStepLimits* limits, double dt) {
	return fmin(fmax(dt, limits->dt_min), limits->dt_max);
}

// A clipped step that went well does not enlarge the size wanted before; it lowers it where it tells enough.
void jn_limits_accept(const JnStepLimits* limits, const JnStep* step, double factor, JnVerdict* verdict) {
	const bool tells = factor < limits->highest;
	if (limits->hold > 1 && factor >= jn_hold_low && factor <= limits->hold) factor = 1;
	double dt = step->dt * fmin(fmax(factor, limits->lowest), limits->highest);
	if (jn_step_is_clipped(step)) dt = tells ? fmin(dt, step->wanted) : step->wanted;
	*verdict = (JnVerdict){.accepted = true, .dt = bound(limits, dt)};
}

JnStatus jn_limits_refuse(const JnStepLimits* limits, const JnStep* step, double factor, JnVerdict* verdict) {
	static const double most = 0.9; // of the size refused: an estimate that hardly falls asks for no endless tries
	*verdict = (JnVerdict){0};
	if (step->dt <= limits->dt_min * (1 + 1e-9)) return JN_RUN_FAILED;
	verdict->dt = bound(limits, step->dt * fmin(fmax(factor, limits->lowest), most));
	return JN_OK;
}

void jn_limits_explain(const JnController* controller, const JnStepLimits* limits, const char* what, double error,
					   double tolerance, JnComplaint* out) {
	const char* path = controller->path;
	const bool is_measured = error > tolerance;
	if (is_measured)
		snprintf(out->cause, sizeof out->cause, "the %s of %.3g m is above %s.tolerance, %.3g m", what, error, path,
				 tolerance);
	snprintf(out->limit, sizeof out->limit, "%s.dt_min = %.3g s", path, limits->dt_min);
	snprintf(out->remedy, sizeof out->remedy, "a smaller %s.dt_min, %s%s%sa more robust method (backward_euler)", path,
			 is_measured ? "a larger " : "", is_measured ? path : "", is_measured ? ".tolerance, or " : "or ");
}
