// The stage problem  r(a) = f(t, x + kx a, v + kv a) - M a = 0,  with  -dr/da = A = M + kv D + kx K  (with several
// points: the weighted sum of their forces, and of their kv and kx).
//
// Where directions come from: stage_direction.c. Where iterations begin: stage_guess.c. What counts as progress is told by
// the iteration: stage_root.c, stage_minimize.c.
#include <math.h>

#include "integrate/stage_solver.h"

enum { ROUNDING_SLACK = 100 }; // multiples of the estimated rounding at which a search that finds no fall has arrived
enum { STALL = 10 };           // iterations without half of the residual after which something else takes over

static JnSpace* space_of(const JnStageSolver* stage) {
	return stage->sys->space;
}

static double weight_of(const JnStage* point) {
	return point->weight != 0 ? point->weight : 1;
}

// s = (t, x + kx a, v + kv a) with driven nodes where they belong; f = its force.
static JnStatus evaluate_point(JnStageSolver* stage, const JnStage* point, JnVec f) {
	JnSpace* space = space_of(stage);
	JnState* s = stage->s;
	s->t = point->t;
	space->ops->combine(space, s->x, 2, (JnTerm[]){{1, point->x}, {point->kx, stage->a}});
	space->ops->combine(space, s->v, 2, (JnTerm[]){{1, point->v}, {point->kv, stage->a}});
	stage->sys->ops->prescribe(stage->sys, s, stage->problem->held == NULL ? stage->a : NULL);
	jn_state_touch(space, s);
	JN_TRY(stage->sys->ops->force(stage->sys, s, f));
	if (!stage->wants_energy) return JN_OK;
	const double weight = weight_of(point), energy = stage->sys->ops->energy(stage->sys, s);
	stage->energy += point->kx > 0 ? weight * energy / point->kx : NAN;
	stage->damping_slope += weight * space->ops->dot(space, s->v, stage->work[JN_STAGE_DAMPING]);
	return JN_OK;
}

JnStatus jn_stage_evaluate(JnStageSolver* stage) {
	JnSpace* space = space_of(stage);
	const JnStage* first = stage->problem;
	JnVec r = stage->residual, work = stage->work[JN_STAGE_MASS];
	stage->energy = stage->wants_energy ? 0 : NAN;
	stage->damping_slope = 0;
	JN_TRY(evaluate_point(stage, first, r));
	if (weight_of(first) != 1) space->ops->combine(space, r, 1, (JnTerm[]){{weight_of(first), r}});
	for (const JnStage* point = first->next; point != NULL; point = point->next) {
		JN_TRY(evaluate_point(stage, point, work));
		space->ops->combine(space, r, 2, (JnTerm[]){{1, r}, {weight_of(point), work}});
	}
	stage->mass->ops->apply(stage->mass, stage->a, work);
	const JnTerm terms[] = {{1, r}, {-1, work}, {1, first->load}};
	space->ops->combine(space, r, first->load != NULL ? 3 : 2, terms);
	stage->sys->ops->hold(stage->sys, r);
	stage->norm = sqrt(space->ops->dot(space, r, r));
	return isfinite(stage->norm) ? JN_OK : JN_NOT_FINITE;
}

JnStatus jn_stage_return(JnStageSolver* stage) {
	JnSpace* space = space_of(stage);
	space->ops->combine(space, stage->a, 1, (JnTerm[]){{1, stage->origin}});
	return jn_stage_evaluate(stage);
}

JnStatus jn_stage_matrix(JnStageSolver* stage, double share, JnMatrix** out) {
	JnShift shift = {.mass = 1};
	for (const JnStage* point = stage->problem; point != NULL; point = point->next) {
		shift.damping += weight_of(point) * point->kv;
		shift.stiffness += share * (weight_of(point) * point->kx);
	}
	return stage->sys->ops->matrix(stage->sys, shift, out);
}

JnStatus jn_stage_arrive(JnStageSolver* stage) {
	if (stage->norm > ROUNDING_SLACK * stage->sys->force_floor) return JN_NOT_CONVERGED;
	stage->tolerance = stage->norm; // nothing better is to be had
	return JN_OK;
}

JnStatus jn_stage_loop(JnStageSolver* stage, JnStageIterate* iterate) {
	double half = 0.5 * stage->norm; // of the residual, when it last fell that far
	int stalled = 0;
	if (stage->norm <= stage->tolerance) return JN_OK;
	JN_TRY(jn_stage_first_tangent(stage));
	for (int iteration = 0; iteration < stage->self->newton.max_iterations; ++iteration) {
		bool failed = false;
		const double before = stage->norm;
		JN_TRY(iterate(stage, &failed));
		jn_stage_learn(stage, before);
		if (stage->norm <= stage->tolerance) {
			jn_stage_judge_age(stage, iteration + 1);
			return JN_OK;
		}
		stalled = stage->norm > half ? stalled + 1 : 0;
		if (stage->norm <= half) half = 0.5 * stage->norm;
		if (stage->gives_up_early && stalled >= STALL) return JN_NOT_CONVERGED;
		JN_TRY(jn_stage_next_tangent(stage, failed, before));
	}
	return JN_NOT_CONVERGED;
}

// From zero acceleration, whatever was known before.
static JnStatus begin_again(JnStageSolver* stage) {
	stage->self->recent_count = 0;
	jn_stage_guess(stage);
	return jn_stage_evaluate(stage);
}

// What saves work on the usual stage may fail on a hard one: from zero acceleration, with a tangent of its own at each
// iteration and full solves, before the controller has to cut the step.
static JnStatus solve_root(JnStageSolver* stage) {
	const JnNewtonDef* newton = &stage->self->newton;
	const JnStatus status = jn_stage_loop(stage, jn_stage_iterate_root);
	const bool took_shortcuts = !stage->is_careful || newton->guess != JN_GUESS_ZERO;
	if (status != JN_NOT_CONVERGED || !took_shortcuts) return status;
	stage->is_careful = true;
	JN_TRY(begin_again(stage));
	return jn_stage_loop(stage, jn_stage_iterate_root);
}

// Accelerations of wild motion, continued, lead anywhere: from a residual above all typical forces, zero may be nearer.
static JnStatus prefer_zero(JnStageSolver* stage) {
	JnSpace* space = space_of(stage);
	const double before = stage->norm;
	if (!(before * stage->self->newton.tolerance > stage->tolerance)) return JN_OK;
	space->ops->combine(space, stage->origin, 1, (JnTerm[]){{1, stage->a}});
	const JnStatus status = begin_again(stage);
	if (status < JN_OK) return status;
	return status == JN_OK && stage->norm < before ? JN_OK : jn_stage_return(stage);
}

static JnStatus solve_minimize(JnStageSolver* stage) {
	JN_TRY(prefer_zero(stage));
	stage->lowest = stage->norm;
	return jn_stage_loop(stage, jn_stage_iterate_minimize);
}

// Minimisation goes on from where the residual stalled.
static JnStatus solve_auto(JnStageSolver* stage) {
	stage->gives_up_early = true;
	const JnStatus status = jn_stage_loop(stage, jn_stage_iterate_root);
	if (status <= JN_OK) return status;
	stage->gives_up_early = false;
	++stage->report->minimized;
	if (!isfinite(stage->norm)) JN_TRY(begin_again(stage));
	return solve_minimize(stage);
}

static JnStatus solve(JnStageSolver* stage) {
	static JnStatus (*const by_mode[])(JnStageSolver*) = {[JN_MODE_ROOT] = solve_root,
														  [JN_MODE_LINEAR] = jn_stage_linear,
														  [JN_MODE_MINIMIZE] = solve_minimize,
														  [JN_MODE_AUTO] = solve_auto};
	return by_mode[stage->self->newton.mode](stage);
}

JnStatus jn_stage_solve(JnIntegrator* self, JnSystem* sys, const JnStage* problem, JnState* s, JnVec a,
						JnReport* report) {
	JnVec* work = self->vectors + self->type->vectors;
	JnStageSolver stage = {
		.self = self, .sys = sys, .problem = problem, .s = s, .a = a, .report = report, .work = work};
	stage.residual = work[JN_STAGE_RESIDUAL];
	stage.step = work[JN_STAGE_STEP];
	stage.origin = work[JN_STAGE_ORIGIN];
	JN_TRY(sys->ops->matrix(sys, (JnShift){.mass = 1}, &stage.mass));
	jn_stage_guess(&stage);
	JnStatus status = jn_stage_evaluate(&stage);
	if (status == JN_NOT_FINITE && self->recent_count > 0) { // the extrapolation left where forces are defined
		status = begin_again(&stage);
	}
	JN_TRY(status);
	const double scale = sys->force_scale > 0 ? sys->force_scale : stage.norm;
	stage.tolerance = fmax(self->newton.tolerance * scale, sys->force_floor);
	stage.is_careful = self->newton.reuse == JN_REUSE_NEVER;
	JN_TRY(solve(&stage));
	jn_stage_keep(&stage);
	report->residual = scale > 0 ? stage.norm / scale : 0;
	return JN_OK;
}
