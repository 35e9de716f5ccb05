// The stage problem  r(a) = f(t, x + kx a, v + kv a) - M a = 0,  with  -dr/da = A = M + kv D + kx K  (with several
// points: the weighted sum of their forces, and of their kv and kx).
//
// A tangent and its factor are kept, over iterations, stages and steps, while they serve: between refreshes the iteration
// is Broyden's (good) method in the limited-memory form of Kelley (Iterative Methods for Linear and Nonlinear Equations,
// 1995, section 7.3), which stores only the steps and asks for one solve an iteration. A refresh comes when the iterations
// that the observed contraction predicts would cost more than a new factor. What counts as progress is told by the
// iteration: stage_root.c, stage_minimize.c.
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

JnStatus jn_stage_refresh(JnStageSolver* stage) {
	JN_TRY(stage->sys->ops->linearize(stage->sys, stage->s));
	stage->self->linearized = stage->s->stamp;
	stage->secants = 0;
	stage->is_fresh = true;
	stage->self->base_iterations = 0;
	stage->self->excess = 0;
	return JN_OK;
}

// z <- B^-1 r from z = A^-1 r, where B is A with the secant updates of the remembered steps.
static void apply_secants(JnStageSolver* stage, JnVec z) {
	JnSpace* space = space_of(stage);
	JnVec* s = stage->work + JN_STAGE_SECANT;
	for (int j = 0; j + 1 < stage->secants; ++j) {
		const double scale = space->ops->dot(space, s[j], z) / space->ops->dot(space, s[j], s[j]);
		space->ops->combine(space, z, 2, (JnTerm[]){{1, z}, {scale, s[j + 1]}});
	}
	if (stage->secants == 0) return;
	const JnVec last = s[stage->secants - 1];
	const double share = space->ops->dot(space, last, z) / space->ops->dot(space, last, last);
	if (share < 0.9) space->ops->combine(space, z, 1, (JnTerm[]){{1 / (1 - share), z}});
}

JnStatus jn_stage_direction(JnStageSolver* stage) {
	JnSpace* space = space_of(stage);
	JnMatrix* matrix = NULL;
	++stage->report->newton;
	space->ops->combine(space, stage->origin, 1, (JnTerm[]){{1, stage->a}});
	JN_TRY(jn_stage_matrix(stage, 1, &matrix));
	const bool is_exact = stage->is_exact || matrix->ops->approximate == NULL;
	JN_TRY((is_exact ? matrix->ops->solve : matrix->ops->approximate)(matrix, stage->residual, stage->step));
	apply_secants(stage, stage->step);
	return JN_OK;
}

void jn_stage_remember(JnStageSolver* stage) {
	JnSpace* space = space_of(stage);
	if (stage->secants == JN_STAGE_SECANTS) return;
	space->ops->combine(space, stage->work[JN_STAGE_SECANT + stage->secants], 1, (JnTerm[]){{1, stage->step}});
	++stage->secants;
}

JnStatus jn_stage_arrive(JnStageSolver* stage) {
	if (stage->norm > ROUNDING_SLACK * stage->sys->force_floor) return JN_NOT_CONVERGED;
	stage->tolerance = stage->norm; // nothing better is to be had
	return JN_OK;
}

// Would the iterations that are left with this contraction cost more than a new factor and two iterations with it?
static bool refresh_pays(JnStageSolver* stage, double contraction) {
	if (stage->is_careful || contraction >= 0.9 || stage->secants >= JN_STAGE_SECANTS) return true;
	JnMatrix* matrix = NULL;
	if (jn_stage_matrix(stage, 1, &matrix) != JN_OK) return true;
	const double left = log(stage->tolerance / stage->norm) / log(contraction);
	return left > 2 + matrix->refresh_cost;
}

// A tangent from an earlier step serves as long as its factor for this shift exists (making a factor from an old tangent
// would waste it), and until the iterations that its age has cost add up to the price of a new one: the rule that is
// never twice as dear as the best possible.
static JnStatus first_tangent(JnStageSolver* stage) {
	JnIntegrator* self = stage->self;
	stage->is_exact = stage->is_careful;
	if (self->linearized == 0 || stage->is_careful) return jn_stage_refresh(stage);
	if (self->linearized > self->step_stamp) return JN_OK;
	JnMatrix* matrix = NULL;
	JN_TRY(jn_stage_matrix(stage, 1, &matrix));
	return matrix->is_factored && self->excess < matrix->refresh_cost ? JN_OK : jn_stage_refresh(stage);
}

static void judge_age(JnIntegrator* self, int iterations) {
	if (self->base_iterations == 0 || iterations < self->base_iterations) self->base_iterations = iterations;
	self->excess += iterations - self->base_iterations;
}

JnStatus jn_stage_loop(JnStageSolver* stage, JnStageIterate* iterate) {
	double half = 0.5 * stage->norm; // of the residual, when it last fell that far
	int stalled = 0;
	if (stage->norm <= stage->tolerance) return JN_OK;
	JN_TRY(first_tangent(stage));
	for (int iteration = 0; iteration < stage->self->newton.max_iterations; ++iteration) {
		bool must_refresh = false;
		const double before = stage->norm;
		JN_TRY(iterate(stage, &must_refresh));
		if (stage->norm <= stage->tolerance) {
			judge_age(stage->self, iteration + 1);
			return JN_OK;
		}
		stalled = stage->norm > half ? stalled + 1 : 0;
		if (stage->norm <= half) half = 0.5 * stage->norm;
		if (stage->gives_up_early && stalled >= STALL) return JN_NOT_CONVERGED;
		if (!must_refresh && !refresh_pays(stage, stage->norm / before)) continue;
		stage->is_exact |= must_refresh || stage->norm > 0.5 * before; // slow: no more approximate directions either
		JN_TRY(jn_stage_refresh(stage));
	}
	return JN_NOT_CONVERGED;
}

// Accelerations to continue exist from the second or third stage on, and the line reaches only so far.
static bool has_guess(const JnStageSolver* stage, int guess) {
	const JnIntegrator* self = stage->self;
	const double span = self->recent_t[0] - self->recent_t[1], ahead = stage->problem->t - self->recent_t[0];
	if (guess == JN_GUESS_LINEAR) return self->recent_count == 2 && span != 0 && fabs(ahead) <= 4 * fabs(span);
	return guess == JN_GUESS_ZERO || self->recent_count > 0;
}

static void make_guess(JnStageSolver* stage, int guess, JnVec out) {
	const JnIntegrator* self = stage->self;
	JnSpace* space = space_of(stage);
	JnVec* recent = stage->work + JN_STAGE_RECENT;
	const double share = (stage->problem->t - self->recent_t[0]) / (self->recent_t[0] - self->recent_t[1]);
	const double parts[2] = {guess == JN_GUESS_LINEAR ? 1 + share : 1, -share};
	const int counts[] = {[JN_GUESS_ZERO] = 0, [JN_GUESS_LAST] = 1, [JN_GUESS_LINEAR] = 2};
	space->ops->combine(space, out, counts[guess], (JnTerm[]){{parts[0], recent[0]}, {parts[1], recent[1]}});
	if (stage->problem->held == NULL) return;
	stage->sys->ops->hold(stage->sys, out);
	space->ops->combine(space, out, 2, (JnTerm[]){{1, out}, {1, stage->problem->held}});
}

static int choose_guess(const JnStageSolver* stage) {
	const JnIntegrator* self = stage->self;
	if (self->newton.mode == JN_MODE_LINEAR) return JN_GUESS_ZERO;
	const bool chooses = self->newton.guess == JN_GUESS_AUTO;
	int chosen = chooses ? JN_GUESS_LINEAR : self->newton.guess;
	while (!has_guess(stage, chosen)) --chosen;
	for (int guess = chosen - 1; chooses && guess >= JN_GUESS_ZERO; --guess)
		if (self->guess_error[guess] < self->guess_error[chosen]) chosen = guess;
	return chosen;
}

// What each guess would have been worth, as a mean that forgets: smooth motion is continued best by a line, while after
// a jolt the accelerations of before are worse than none.
static void judge_guesses(JnStageSolver* stage) {
	JnSpace* space = space_of(stage);
	double* errors = stage->self->guess_error;
	if (stage->self->newton.guess != JN_GUESS_AUTO) return;
	for (int guess = JN_GUESS_ZERO; guess <= JN_GUESS_LINEAR; ++guess) {
		if (!has_guess(stage, guess)) continue;
		make_guess(stage, guess, stage->step);
		space->ops->combine(space, stage->step, 2, (JnTerm[]){{1, stage->a}, {-1, stage->step}});
		stage->sys->ops->hold(stage->sys, stage->step);
		const double error = sqrt(space->ops->dot(space, stage->step, stage->step));
		errors[guess] = errors[guess] > 0 ? 0.5 * (errors[guess] + error) : error;
	}
}

static void first_guess(JnStageSolver* stage) {
	make_guess(stage, choose_guess(stage), stage->a);
}

// From zero acceleration, whatever was known before.
static JnStatus begin_again(JnStageSolver* stage) {
	stage->self->recent_count = 0;
	first_guess(stage);
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

static void keep_solution(JnStageSolver* stage) {
	JnIntegrator* self = stage->self;
	JnVec* recent = stage->work + JN_STAGE_RECENT;
	const JnVec oldest = recent[1];
	recent[1] = recent[0];
	recent[0] = oldest;
	stage->sys->space->ops->combine(stage->sys->space, recent[0], 1, (JnTerm[]){{1, stage->a}});
	self->recent_t[1] = self->recent_t[0];
	self->recent_t[0] = stage->problem->t;
	self->recent_count = self->recent_count < 2 ? self->recent_count + 1 : 2;
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
	first_guess(&stage);
	JnStatus status = jn_stage_evaluate(&stage);
	if (status == JN_NOT_FINITE && self->recent_count > 0) { // the extrapolation left where forces are defined
		self->recent_count = 0;
		first_guess(&stage);
		status = jn_stage_evaluate(&stage);
	}
	JN_TRY(status);
	const double scale = sys->force_scale > 0 ? sys->force_scale : stage.norm;
	stage.tolerance = fmax(self->newton.tolerance * scale, sys->force_floor);
	stage.is_careful = self->newton.reuse == JN_REUSE_NEVER;
	JN_TRY(solve(&stage));
	judge_guesses(&stage);
	keep_solution(&stage);
	report->residual = scale > 0 ? stage.norm / scale : 0;
	return JN_OK;
}
