// Directions of a stage's iterations, and the tangents that they come from.
//
// Where the solver factors, a tangent and its factor are kept, over iterations, stages and steps, while they serve: between
// refreshes the iteration is Broyden's (good) method in the limited-memory form of Kelley (Iterative Methods for Linear and
// Nonlinear Equations, 1995, section 7.3), which stores only the steps and asks for one solve an iteration. A refresh comes
// when the iterations that the observed contraction predicts would cost more than a new factor.
//
// Where it iterates, tangents are nearly free and accuracy is what costs: every direction has a new tangent, and is an
// inexact Newton step, |r - A step| <= eta |r| (Eisenstat, Walker 1996).
#include <math.h>

#include "integrate/stage_solver.h"

static const double rough = 1e-4;        // of a direction by a factor that may be of single precision
static const double first_forcing = 0.1; // eta while the curvature is not known
static const double largest_forcing = 0.5;
static const double least_forcing = 1e-6; // what directions are never asked for
static const double landing = 0.8;        // of the tolerance: where the linear part of the last step leads

static JnSpace* space_of(const JnStageSolver* stage) {
	return stage->sys->space;
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

// Would the iterations that are left with this contraction cost more than a new factor and two iterations with it?
static bool refresh_pays(const JnStageSolver* stage, const JnMatrix* matrix, double contraction) {
	if (stage->is_careful || contraction >= 0.9 || stage->secants >= JN_STAGE_SECANTS) return true;
	const double left = log(stage->tolerance / stage->norm) / log(contraction);
	return left > 2 + matrix->refresh_cost;
}

// A tangent from an earlier step serves as long as its factor for this shift exists (making a factor from an old tangent
// would waste it), and until the iterations that its age has cost add up to the price of a new one: the rule that is
// never twice as dear as the best possible.
JnStatus jn_stage_first_tangent(JnStageSolver* stage) {
	JnIntegrator* self = stage->self;
	JnMatrix* matrix = NULL;
	stage->is_exact = stage->is_careful;
	JN_TRY(jn_stage_matrix(stage, 1, &matrix));
	stage->is_inexact = matrix->is_iterative && !stage->is_exact;
	if (self->linearized == 0 || stage->is_careful || stage->is_inexact) return jn_stage_refresh(stage);
	if (self->linearized > self->step_stamp) return JN_OK;
	return matrix->is_factored && self->excess < matrix->refresh_cost ? JN_OK : jn_stage_refresh(stage);
}

// A direction that failed, and a slow one by a factor, are followed by directions of full solves.
JnStatus jn_stage_next_tangent(JnStageSolver* stage, bool failed, double before) {
	JnMatrix* matrix = NULL;
	JN_TRY(jn_stage_matrix(stage, 1, &matrix));
	stage->is_exact |= failed;
	stage->is_inexact = matrix->is_iterative && !stage->is_exact;
	if (stage->is_inexact) return stage->is_fresh ? JN_OK : jn_stage_refresh(stage);
	if (!failed && !refresh_pays(stage, matrix, stage->norm / before)) return JN_OK;
	stage->is_exact |= stage->norm > 0.5 * before;
	return jn_stage_refresh(stage);
}

// eta whose linear part leads just below the tolerance.
static double enough_for(const JnStageSolver* stage) {
	return fmin(landing * stage->tolerance / stage->norm, largest_forcing);
}

// What a step leaves of a residual r is eta |r| by the linear system and about c |r|^2 by curvature: it is not worth asking
// for more than the latter. This is Eisenstat's and Walker's second choice, with c from all iterations before in place of
// the last two residuals of the stage, so that a first direction is served as well. Nor for more than is enough.
static double forcing_of(const JnStageSolver* stage) {
	const double c = stage->self->curvature, enough = enough_for(stage);
	const bool is_only = stage->sys->is_linear_in_step || stage->self->newton.mode == JN_MODE_LINEAR;
	const double wanted = c > 0 ? fmin(c * stage->norm, largest_forcing) : first_forcing;
	return fmax(is_only ? enough : fmax(wanted, enough), least_forcing);
}

JnStatus jn_stage_only_tangent(JnStageSolver* stage) {
	JnMatrix* matrix = NULL;
	JN_TRY(jn_stage_matrix(stage, 1, &matrix));
	stage->is_inexact = matrix->is_iterative && enough_for(stage) >= least_forcing;
	stage->is_exact = !stage->is_inexact;
	return jn_stage_refresh(stage);
}

// Where the linear system left less than half of what is there, that is c |r|^2; else it is a bound of it.
void jn_stage_learn(JnStageSolver* stage, double before) {
	double* c = &stage->self->curvature;
	if (!stage->is_inexact || !(stage->norm < before)) return;
	const double found = stage->norm / (before * before);
	if (*c == 0 || found < *c || stage->norm > 1.5 * stage->forcing * before) *c = found;
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

// No more than Newton's method needs of a solver that iterates.
JnStatus jn_stage_thorough(JnStageSolver* stage, JnMatrix* matrix) {
	if (matrix->is_iterative && matrix->ops->approximate != NULL && enough_for(stage) >= least_forcing)
		return matrix->ops->approximate(matrix, least_forcing, stage->residual, stage->step);
	return matrix->ops->solve(matrix, stage->residual, stage->step);
}

JnStatus jn_stage_direction(JnStageSolver* stage) {
	JnSpace* space = space_of(stage);
	JnMatrix* matrix = NULL;
	++stage->report->newton;
	space->ops->combine(space, stage->origin, 1, (JnTerm[]){{1, stage->a}});
	JN_TRY(jn_stage_matrix(stage, 1, &matrix));
	stage->forcing = stage->is_inexact ? forcing_of(stage) : rough;
	if (stage->is_exact || matrix->ops->approximate == NULL)
		JN_TRY(jn_stage_thorough(stage, matrix));
	else
		JN_TRY(matrix->ops->approximate(matrix, stage->forcing, stage->residual, stage->step));
	apply_secants(stage, stage->step);
	return JN_OK;
}

void jn_stage_remember(JnStageSolver* stage) {
	JnSpace* space = space_of(stage);
	if (stage->is_inexact || stage->secants == JN_STAGE_SECANTS) return;
	space->ops->combine(space, stage->work[JN_STAGE_SECANT + stage->secants], 1, (JnTerm[]){{1, stage->step}});
	++stage->secants;
}

void jn_stage_judge_age(JnStageSolver* stage, int iterations) {
	JnIntegrator* self = stage->self;
	if (stage->is_inexact) return;
	if (self->base_iterations == 0 || iterations < self->base_iterations) self->base_iterations = iterations;
	self->excess += iterations - self->base_iterations;
}
