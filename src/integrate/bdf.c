// BDF2 with variable steps, w = dt / dt_before:
//   y1 = (1 + w)^2 / (1 + 2 w) y0 - w^2 / (1 + 2 w) y_before + k dt f(y1),   k = (1 + w) / (1 + 2 w)
// for y = (x, v): with kv = k dt, x1 = x~ + kv v1 and v1 = v~ + kv a. Zero-stable for w < 1 + sqrt 2. The first step, and
// the first after an edit of the state, is one of Backward Euler (local error of second order: the order stays two).
#include "integrate/bdf.h"

#include "integrate/integrator.h"

/// Work vectors: x~, v~, a, and the state before the start.
enum { X, V, A, BEFORE_X, BEFORE_V, VECTORS };

typedef struct Memory {
	double dt; // step that led to the start; 0: no history
} Memory;

static JnStatus bdf2_step(JnIntegrator* self, JnStep* step) {
	const Memory* memory = self->memory;
	JnSpace* space = self->space;
	const JnState* start = step->start;
	step->sys->report = &step->report;
	self->step_stamp = start->stamp;
	const double w = memory->dt > 0 ? step->dt / memory->dt : 0;
	const double now = (1 + w) * (1 + w) / (1 + 2 * w), before = -w * w / (1 + 2 * w);
	const double kv = (1 + w) / (1 + 2 * w) * step->dt;
	JnVec* vec = self->vectors;
	space->ops->combine(space, vec[V], 2, (JnTerm[]){{now, start->v}, {before, vec[BEFORE_V]}});
	space->ops->combine(space, vec[X], 3, (JnTerm[]){{now, start->x}, {before, vec[BEFORE_X]}, {kv, vec[V]}});
	const JnStage stage = {.t = start->t + step->dt, .kx = kv * kv, .kv = kv, .x = vec[X], .v = vec[V]};
	JN_TRY(jn_stage_solve(self, step->sys, &stage, step->end, vec[A], &step->report));
	return jn_state_check(space, step->end);
}

static void bdf2_commit(JnIntegrator* self, const JnStep* step) {
	JnSpace* space = self->space;
	space->ops->combine(space, self->vectors[BEFORE_X], 1, (JnTerm[]){{1, step->start->x}});
	space->ops->combine(space, self->vectors[BEFORE_V], 1, (JnTerm[]){{1, step->start->v}});
	((Memory*)self->memory)->dt = step->dt;
}

const JnIntegratorType jn_bdf2 = {
	.row = {.name = "bdf2", .doc = "one solve, second order, remembers one step; damps less than Backward Euler"},
	.needs = JN_NEEDS_TANGENT,
	.order = 2,
	.force_weight = 4.0 / 9,
	.vectors = VECTORS,
	.memory_size = sizeof(Memory),
	.step = bdf2_step,
	.commit = bdf2_commit,
};
