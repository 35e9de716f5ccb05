// Adaptive quadrature (McKeeman 1962, as AD section 4 compares): a step is done once as a whole and once in two halves from
// the same start. Where the two ends differ by more than the tolerance, the step is refused, and its halves are tried in the
// same way, down to dt_min; then the run goes on with the next step of the size before. The sizes are dt / 2^k.
//
// An attempt costs three steps of the method, all of which are counted. The halves are the integrator's alone: where a pass
// has edited the end, the whole step is done once more to compare like with like, and the edited end is kept.
#include "control/step_doubling.h"

#include <math.h>
#include <stdio.h>

#include "base/log.h"
#include "base/report.h"
#include "base/space.h"
#include "control/halving.h"
#include "control/limits.h"

enum { MIDDLE, HALVES, WHOLE, STATES, VECTORS = 2 * STATES };
enum { KEEP_WHOLE, KEEP_HALVES };

typedef struct DoublingDef {
	double tolerance;
	int keep;
	JnStepLimits limits;
} DoublingDef;

typedef struct DoublingMemory {
	JnHalving halving;
	double error; // of the last attempt [m]; NAN: it failed
} DoublingMemory;

static JnStatus check(const JnController* self) {
	const JnIntegratorType* method = self->integrator->type;
	JN_TRY(jn_limits_check(self, &((const DoublingDef*)self->options)->limits));
	if (method->commit == NULL) return JN_OK;
	return jn_error(
		JN_BAD_INPUT,
		"%s.controller: step_doubling cannot serve %s, which continues the steps before it and has no halves "
		"of its own; choose force_error, or a one-step method such as newmark",
		self->path, method->row.name);
}

static double first(JnController* self) {
	return ((const DoublingDef*)self->options)->limits.dt;
}

static JnState state_at(JnController* self, int which) {
	return (JnState){.x = self->vectors[2 * which], .v = self->vectors[2 * which + 1]};
}

// One step of the method for the sake of comparison.
static JnStatus probe(JnController* self, const JnStep* step, const JnState* start, double dt, JnState* end) {
	JnReport* report = step->sys->report;
	JnStep part = {.sys = step->sys, .start = start, .end = end, .dt = dt, .wanted = dt, .method = step->method};
	const JnStatus status = self->integrator->type->step(self->integrator, &part);
	step->sys->report = report;
	jn_report_add(report, &part.report);
	return status;
}

static JnStatus do_halves(JnController* self, const JnStep* step, JnState* middle, JnState* end) {
	JnSystem* sys = step->sys;
	JN_TRY(probe(self, step, step->start, 0.5 * step->dt, middle));
	JN_TRY(sys->ops->begin(sys, middle));
	const JnStatus status = probe(self, step, middle, 0.5 * step->dt, end);
	const JnStatus back = sys->ops->begin(sys, step->start);
	return status != JN_OK ? status : back;
}

static JnStatus measure(JnController* self, JnStep* step, double* error) {
	JnSpace* space = step->sys->space;
	JnState middle = state_at(self, MIDDLE), halves = state_at(self, HALVES), whole = state_at(self, WHOLE);
	const bool is_edited = step->is_edited;
	if (is_edited) JN_TRY(probe(self, step, step->start, step->dt, &whole));
	JN_TRY(do_halves(self, step, &middle, &halves));
	const double* compared = is_edited ? whole.x : step->end->x;
	space->ops->combine(space, middle.x, 2, (JnTerm[]){{1, halves.x}, {-1, compared}});
	*error = space->ops->longest(space, middle.x);
	if (((const DoublingDef*)self->options)->keep == KEEP_HALVES && !is_edited) {
		const double t = step->end->t; // two halves may round to another sum
		jn_state_copy(space, &halves, step->end);
		step->end->t = t;
		jn_state_touch(space, step->end);
	}
	return isfinite(*error) ? JN_OK : JN_NOT_FINITE;
}

static double size_at(const DoublingDef* def, const DoublingMemory* memory) {
	return ldexp(def->limits.dt, -memory->halving.level);
}

static JnStatus judge(JnController* self, JnStep* step, JnStatus outcome, JnVerdict* verdict) {
	const DoublingDef* def = self->options;
	DoublingMemory* memory = self->memory;
	memory->error = NAN;
	if (outcome == JN_OK) outcome = measure(self, step, &memory->error);
	if (outcome < JN_OK) return outcome;
	verdict->accepted = outcome == JN_OK && memory->error <= def->tolerance;
	if (verdict->accepted) {
		jn_halving_go_on(&memory->halving, 1);
	} else {
		do { // a clipped step is shorter than its level
			if (0.5 * size_at(def, memory) < def->limits.dt_min) return JN_RUN_FAILED;
			jn_halving_cut(&memory->halving);
		} while (size_at(def, memory) >= step->dt);
	}
	verdict->dt = size_at(def, memory);
	return JN_OK;
}

static void explain(const JnController* self, JnComplaint* complaint) {
	const DoublingDef* def = self->options;
	const DoublingMemory* memory = self->memory;
	jn_limits_explain(self, &def->limits, "difference of one step and two halves", memory->error, def->tolerance,
					  complaint);
}

static const char* const kept[] = {"whole", "halves", NULL};

static const JnKey keys[] = {
	JN_TOLERANCE_ROW(DoublingDef, "use the largest error in the position of a node that you can accept in a step",
					 "largest distance between the ends of one step and of two halves"),
	{.name = "keep",
	 .kind = JN_CHOICE,
	 .field = offsetof(DoublingDef, keep),
	 .names = kept,
	 .meaning = "which end goes on, where no pass has edited it"},
	JN_STEP_SIZE_ROWS(DoublingDef),
	{0},
};

const JnControllerType jn_controller_step_doubling = {
	.row = {.name = "step_doubling",
			.doc = "one step against two halves, and the halves in the same way, until they agree: adaptive "
				   "quadrature; three "
				   "steps' work an attempt",
			.keys = keys,
			.options_size = sizeof(DoublingDef)},
	.memory_size = sizeof(DoublingMemory),
	.vectors = VECTORS,
	.check = check,
	.first = first,
	.judge = judge,
	.explain = explain,
};
