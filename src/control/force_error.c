// Adaptive time-stepping with linearised force error estimation (AD; docs/adaptive.md). With F~ the forces at the end as their
// tangent at the start predicts them,
//   F~ = F(t0, x0, v0) - K dx - D dv + (F(t1, x0, v0) - F(t0, x0, v0)),
//   eps = w dt^2 max_nodes |M^-1 (F(t1, x1, v1) - F~)|                       (AD 7 and 13; w is the method's)
//   accept if eps <= tolerance;  in either case  dt <- dt (alpha tolerance / eps)^(1/q)      (AD 12, where q = 3)
// AD's equation 14 lacks the alpha of 12. The error of F~ is of second order in dt, so that eps ~ dt^4: q = 4 is the default.
//
// K dx + D dv comes from the matrices where the method leaves those of the start behind. Elsewhere they would have to be made
// for this alone, and would take the place of what Newton's method keeps: there it is a difference of forces,
//   K dx + D dv ~ -(F(x0 + h dx, v0 + h dv) - F(x0, v0)) / h,
// whose error is h times the second-order term that eps measures; dividing by 1 - h takes that out. What is left of it is
// h times the third-order term. The rounding of forces counts 1/h times.
#include "control/force_error.h"

#include <math.h>
#include <stdio.h>

#include "base/log.h"
#include "base/space.h"
#include "control/limits.h"

/// Work vectors: F(start), the probe's x and v, a force, the error of F~.
enum { START, PROBE_X, PROBE_V, FORCE, RESIDUAL, VECTORS };

static const double probe = 1.0 / 64;

typedef struct ForceErrorDef {
	double tolerance, safety, exponent;
	JnStepLimits limits;
} ForceErrorDef;

typedef struct ForceErrorMemory {
	double error; // of the last attempt that was measured [m]; NAN: it failed before
} ForceErrorMemory;

static JnStatus check(const JnController* self) {
	const ForceErrorDef* def = self->options;
	const JnIntegratorType* method = self->integrator->type;
	JN_TRY(jn_limits_check(self, &def->limits));
	if (method->force_weight > 0) return JN_OK;
	return jn_error(JN_BAD_INPUT,
					"%s.controller: force_error cannot serve %s, which is explicit and linearises no forces; choose "
					"speed_limit or step_doubling, or an implicit method",
					self->path, method->row.name);
}

static double first(JnController* self) {
	return ((const ForceErrorDef*)self->options)->limits.dt;
}

// The system knows the forces at the end of the last step, which is this start: that costs nothing.
static JnStatus prepare(JnController* self, const JnStep* step) {
	const JnStatus status = step->sys->ops->force(step->sys, step->start, self->vectors[START]);
	return status > JN_OK ? JN_OK : status; // the integrator will meet the same
}

// residual += K dx + D dv
static JnStatus add_products(JnController* self, const JnStep* step) {
	JnSystem* sys = step->sys;
	JnSpace* space = sys->space;
	JnVec change = self->vectors[PROBE_X], product = self->vectors[FORCE], residual = self->vectors[RESIDUAL];
	JnMatrix *stiffness = NULL, *damping = NULL;
	JN_TRY(sys->ops->linearize(sys, step->start));
	JN_TRY(sys->ops->matrix(sys, (JnShift){.stiffness = 1}, &stiffness));
	space->ops->combine(space, change, 2, (JnTerm[]){{1, step->end->x}, {-1, step->start->x}});
	stiffness->ops->apply(stiffness, change, product);
	space->ops->combine(space, residual, 2, (JnTerm[]){{1, residual}, {1, product}});
	JN_TRY(sys->ops->matrix(sys, (JnShift){.damping = 1}, &damping));
	space->ops->combine(space, change, 2, (JnTerm[]){{1, step->end->v}, {-1, step->start->v}});
	damping->ops->apply(damping, change, product);
	space->ops->combine(space, residual, 2, (JnTerm[]){{1, residual}, {1, product}});
	return JN_OK;
}

// force = that at time t, a share of the way from start to end.
static JnStatus probe_force(JnController* self, const JnStep* step, double t, double share) {
	JnSpace* space = step->sys->space;
	JnState s = {.t = t, .x = self->vectors[PROBE_X], .v = self->vectors[PROBE_V]};
	space->ops->combine(space, s.x, 2, (JnTerm[]){{1 - share, step->start->x}, {share, step->end->x}});
	space->ops->combine(space, s.v, 2, (JnTerm[]){{1 - share, step->start->v}, {share, step->end->v}});
	jn_state_touch(space, &s);
	return step->sys->ops->force(step->sys, &s, self->vectors[FORCE]);
}

// residual = what F~ leaves out:  F(end) - F~  but for F(end), times `*scale` to come.
static JnStatus predict(JnController* self, const JnStep* step, double* scale) {
	JnSpace* space = step->sys->space;
	JnVec residual = self->vectors[RESIDUAL], force = self->vectors[FORCE];
	const double* start = self->vectors[START];
	const bool has_products = step->method->keeps_tangent && !step->sys->depends_on_time;
	*scale = 1;
	space->ops->combine(space, residual, 1, (JnTerm[]){{-1, start}});
	if (has_products) return add_products(self, step);
	*scale = 1 / (1 - probe);
	JN_TRY(probe_force(self, step, step->start->t, probe));
	const JnTerm terms[] = {{1, residual}, {-1 / probe, force}, {1 / probe, start}};
	space->ops->combine(space, residual, 3, terms);
	if (!step->sys->depends_on_time) return JN_OK;
	JN_TRY(probe_force(self, step, step->end->t, 0));
	space->ops->combine(space, residual, 3, (JnTerm[]){{1, residual}, {-1, force}, {1, start}});
	return JN_OK;
}

// The forces at the end come last, so that the system still knows them when the next step starts there.
static JnStatus measure(JnController* self, const JnStep* step, double* error) {
	JnSystem* sys = step->sys;
	JnSpace* space = sys->space;
	JnVec residual = self->vectors[RESIDUAL], end = self->vectors[FORCE], acceleration = self->vectors[PROBE_X];
	JnMatrix* mass = NULL;
	double scale;
	JN_TRY(predict(self, step, &scale));
	JN_TRY(sys->ops->force(sys, step->end, end));
	space->ops->combine(space, residual, 2, (JnTerm[]){{scale, residual}, {scale, end}});
	sys->ops->hold(sys, residual);
	JN_TRY(sys->ops->matrix(sys, (JnShift){.mass = 1}, &mass));
	JN_TRY(mass->ops->solve(mass, residual, acceleration));
	*error = step->method->force_weight * step->dt * step->dt * space->ops->longest(space, acceleration);
	return isfinite(*error) ? JN_OK : JN_NOT_FINITE;
}

static JnStatus judge(JnController* self, JnStep* step, JnStatus outcome, JnVerdict* verdict) {
	const ForceErrorDef* def = self->options;
	ForceErrorMemory* memory = self->memory;
	memory->error = NAN;
	if (outcome == JN_OK) outcome = measure(self, step, &memory->error);
	if (outcome < JN_OK) return outcome;
	if (outcome > JN_OK) return jn_limits_refuse(&def->limits, step, jn_cut, verdict);
	const double factor = pow(def->safety * def->tolerance / memory->error, 1 / def->exponent);
	if (!(memory->error <= def->tolerance)) return jn_limits_refuse(&def->limits, step, factor, verdict);
	jn_limits_accept(&def->limits, step, factor, verdict);
	return JN_OK;
}

static void explain(const JnController* self, JnComplaint* complaint) {
	const ForceErrorDef* def = self->options;
	jn_limits_explain(self, &def->limits, "force error", ((const ForceErrorMemory*)self->memory)->error, def->tolerance,
					  complaint);
}

static const JnKey keys[] = {
	JN_TOLERANCE_ROW(ForceErrorDef, "use the largest displacement of a node in a step that you can accept as error",
					 "largest displacement, in a step, by the error of the linearised forces"),
	{.name = "safety",
	 .kind = JN_REAL,
	 .field = offsetof(ForceErrorDef, safety),
	 .value = {0.5},
	 .low = 0,
	 .high = 1,
	 .open = JN_OPEN_LOW,
	 .remedy = "use 0.5, as in the paper",
	 .meaning = "share of the tolerance that the next step aims at: alpha"},
	{.name = "exponent",
	 .kind = JN_REAL,
	 .field = offsetof(ForceErrorDef, exponent),
	 .value = {4},
	 .low = 1,
	 .high = 8,
	 .remedy = "use 4, the order of the error, or 3, as in the paper",
	 .meaning = "power q of dt with which the error is taken to grow"},
	JN_STEP_LIMIT_ROWS(ForceErrorDef, 1),
	{0},
};

const JnControllerType jn_controller_force_error = {
	.row = {.name = "force_error",
			.doc =
				"steps whose forces differ little from their linearisation, for implicit methods; blind where forces "
				"are linear",
			.keys = keys,
			.options_size = sizeof(ForceErrorDef)},
	.memory_size = sizeof(ForceErrorMemory),
	.vectors = VECTORS,
	.check = check,
	.first = first,
	.prepare = prepare,
	.judge = judge,
	.explain = explain,
};
