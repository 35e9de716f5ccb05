// The stage problem  r(a) = f(t, x + kx a, v + kv a) - M a = 0,  with  -dr/da = A = M + kv D + kx K  (with several
// points: the weighted sum of their forces, and of their kv and kx).
//
// root     Newton on the residual with a backtracking line search on its norm. A tangent and its factor are kept, over
//          iterations, stages and steps, while they serve: between refreshes the iteration is Broyden's (good) method in
//          the limited-memory form of Kelley (Iterative Methods for Linear and Nonlinear Equations, 1995, section 7.3),
//          which stores only the steps and asks for one solve an iteration. A refresh comes when the iterations that the
//          observed contraction predicts would cost more than a new factor.
// linear   one Newton step from a = 0 with a new tangent.
#include <math.h>

#include "integrate/integrator.h"
#include "integrate/stage.h"

enum { ROOT, LINEAR };
enum { REUSE_AUTO, REUSE_NEVER };
enum { GUESS_ZERO, GUESS_LAST, GUESS_LINEAR };
enum { MOST_HALVINGS = 12 };
enum { ROUNDING_SLACK = 100 }; // multiples of the estimated rounding at which a search that finds no fall has arrived

typedef struct Stage {
	JnIntegrator* self;
	JnSystem* sys;
	const JnStage* problem;
	JnState* s;
	JnVec a;
	JnReport* report;
	JnVec *work, residual, step, origin;
	JnMatrix* mass;
	double norm, tolerance; // of the residual [N]
	int secants;            // steps remembered since the last refresh
	bool is_fresh;          // the tangent was made at the present a
	bool is_careful;        // a new tangent at every iteration, whatever the options say
	bool is_exact;          // directions by full solves: approximate ones did not serve
} Stage;

static JnSpace* space_of(const Stage* stage) {
	return stage->sys->space;
}

static double weight_of(const JnStage* point) {
	return point->weight != 0 ? point->weight : 1;
}

// s = (t, x + kx a, v + kv a) with driven nodes where they belong; f = its force.
static JnStatus evaluate_point(Stage* stage, const JnStage* point, JnVec f) {
	JnSpace* space = space_of(stage);
	JnState* s = stage->s;
	s->t = point->t;
	space->ops->combine(space, s->x, 2, (JnTerm[]){{1, point->x}, {point->kx, stage->a}});
	space->ops->combine(space, s->v, 2, (JnTerm[]){{1, point->v}, {point->kv, stage->a}});
	stage->sys->ops->prescribe(stage->sys, s, stage->problem->held == NULL ? stage->a : NULL);
	jn_state_touch(space, s);
	return stage->sys->ops->force(stage->sys, s, f);
}

// r = load + sum of weighted forces - M a, and its norm.
static JnStatus evaluate(Stage* stage, double* norm) {
	JnSpace* space = space_of(stage);
	const JnStage* first = stage->problem;
	JnVec r = stage->residual, work = stage->work[JN_STAGE_MASS];
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
	*norm = sqrt(space->ops->dot(space, r, r));
	return isfinite(*norm) ? JN_OK : JN_NOT_FINITE;
}

// The matrix -dr/da, with the tangent of one state for all points.
static JnStatus stage_matrix(Stage* stage, JnMatrix** out) {
	JnShift shift = {.mass = 1};
	for (const JnStage* point = stage->problem; point != NULL; point = point->next) {
		shift.damping += weight_of(point) * point->kv;
		shift.stiffness += weight_of(point) * point->kx;
	}
	return stage->sys->ops->matrix(stage->sys, shift, out);
}

static JnStatus refresh(Stage* stage) {
	JN_TRY(stage->sys->ops->linearize(stage->sys, stage->s));
	stage->self->linearized = stage->s->stamp;
	stage->secants = 0;
	stage->is_fresh = true;
	stage->self->base_iterations = 0;
	stage->self->excess = 0;
	return JN_OK;
}

// z <- B^-1 r from z = A^-1 r, where B is A with the secant updates of the remembered steps.
static void apply_secants(Stage* stage, JnVec z) {
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

static JnStatus newton_direction(Stage* stage) {
	JnMatrix* matrix = NULL;
	JN_TRY(stage_matrix(stage, &matrix));
	const bool is_exact = stage->is_exact || matrix->ops->approximate == NULL;
	JN_TRY((is_exact ? matrix->ops->solve : matrix->ops->approximate)(matrix, stage->residual, stage->step));
	apply_secants(stage, stage->step);
	return JN_OK;
}

static void remember(Stage* stage) {
	JnSpace* space = space_of(stage);
	space->ops->combine(space, stage->work[JN_STAGE_SECANT + stage->secants], 1, (JnTerm[]){{1, stage->step}});
	++stage->secants;
}

// a = origin + length * step. Accepts when the residual falls; a state that is not finite counts as no fall.
static JnStatus try_length(Stage* stage, double length, bool* falls) {
	JnSpace* space = space_of(stage);
	double norm = INFINITY;
	space->ops->combine(space, stage->a, 2, (JnTerm[]){{1, stage->origin}, {length, stage->step}});
	const JnStatus status = evaluate(stage, &norm);
	if (status != JN_OK && status != JN_NOT_FINITE) return status;
	*falls = status == JN_OK && (norm <= (1 - 1e-4 * length) * stage->norm || norm <= stage->tolerance);
	if (*falls) stage->norm = norm;
	return JN_OK;
}

static JnStatus back_to_origin(Stage* stage) {
	JnSpace* space = space_of(stage);
	space->ops->combine(space, stage->a, 1, (JnTerm[]){{1, stage->origin}});
	return evaluate(stage, &stage->norm);
}

// One iteration. A full step that fails with an old tangent asks for a new one; with a new one, the step is halved.
static JnStatus iterate(Stage* stage, bool* must_refresh) {
	JnSpace* space = space_of(stage);
	JN_TRY(newton_direction(stage));
	++stage->report->newton;
	space->ops->combine(space, stage->origin, 1, (JnTerm[]){{1, stage->a}});
	bool falls = false;
	JN_TRY(try_length(stage, 1, &falls));
	if (falls) {
		if (stage->secants < JN_STAGE_SECANTS) remember(stage);
		stage->is_fresh = false;
		return JN_OK;
	}
	if (!stage->is_fresh || !stage->is_exact) {
		*must_refresh = true;
		return back_to_origin(stage);
	}
	double length = 1;
	for (int halving = 0; halving < MOST_HALVINGS && !falls; ++halving) {
		length *= 0.5;
		++stage->report->backtracks;
		JN_TRY(try_length(stage, length, &falls));
	}
	stage->is_fresh = false;
	*must_refresh = true;
	if (falls) return JN_OK;
	JN_TRY(back_to_origin(stage));
	const bool is_rounding = stage->norm <= ROUNDING_SLACK * stage->sys->force_floor;
	if (is_rounding) stage->tolerance = stage->norm; // nothing better is to be had
	return is_rounding ? JN_OK : JN_NOT_CONVERGED;
}

// Would the iterations that are left with this contraction cost more than a new factor and two iterations with it?
static bool refresh_pays(Stage* stage, double contraction) {
	if (stage->is_careful || contraction >= 0.9 || stage->secants >= JN_STAGE_SECANTS) return true;
	JnMatrix* matrix = NULL;
	if (stage_matrix(stage, &matrix) != JN_OK) return true;
	const double left = log(stage->tolerance / stage->norm) / log(contraction);
	return left > 2 + matrix->refresh_cost;
}

// A tangent from an earlier step serves as long as its factor for this shift exists (making a factor from an old tangent
// would waste it), and until the iterations that its age has cost add up to the price of a new one: the rule that is
// never twice as dear as the best possible.
static JnStatus first_tangent(Stage* stage) {
	JnIntegrator* self = stage->self;
	stage->is_exact = stage->is_careful;
	if (self->linearized == 0 || stage->is_careful) return refresh(stage);
	if (self->linearized > self->step_stamp) return JN_OK;
	JnMatrix* matrix = NULL;
	JN_TRY(stage_matrix(stage, &matrix));
	return matrix->is_factored && self->excess < matrix->refresh_cost ? JN_OK : refresh(stage);
}

static void judge_age(JnIntegrator* self, int iterations) {
	if (self->base_iterations == 0 || iterations < self->base_iterations) self->base_iterations = iterations;
	self->excess += iterations - self->base_iterations;
}

static JnStatus solve_root(Stage* stage) {
	const JnNewtonDef* newton = &stage->self->newton;
	if (stage->norm <= stage->tolerance) return JN_OK;
	JN_TRY(first_tangent(stage));
	for (int iteration = 0; iteration < newton->max_iterations; ++iteration) {
		bool must_refresh = false;
		const double before = stage->norm;
		JN_TRY(iterate(stage, &must_refresh));
		if (stage->norm <= stage->tolerance) {
			judge_age(stage->self, iteration + 1);
			return JN_OK;
		}
		if (!must_refresh && !refresh_pays(stage, stage->norm / before)) continue;
		stage->is_exact |= must_refresh || stage->norm > 0.5 * before; // slow: no more approximate directions either
		JN_TRY(refresh(stage));
	}
	return JN_NOT_CONVERGED;
}

static JnStatus solve_linear(Stage* stage) {
	JnSpace* space = space_of(stage);
	stage->is_exact = true;
	JN_TRY(refresh(stage));
	JN_TRY(newton_direction(stage));
	++stage->report->newton;
	space->ops->combine(space, stage->a, 2, (JnTerm[]){{1, stage->a}, {1, stage->step}});
	return evaluate(stage, &stage->norm);
}

static void first_guess(Stage* stage) {
	const JnIntegrator* self = stage->self;
	JnSpace* space = space_of(stage);
	JnVec* recent = stage->work + JN_STAGE_RECENT;
	const bool use_guess = self->newton.mode == ROOT && self->newton.guess != GUESS_ZERO && self->recent_count > 0;
	const double span = self->recent_t[0] - self->recent_t[1];
	const double ahead = stage->problem->t - self->recent_t[0];
	if (!use_guess) {
		space->ops->combine(space, stage->a, 0, NULL);
	} else if (self->newton.guess == GUESS_LINEAR && self->recent_count == 2 && fabs(ahead) <= 4 * fabs(span)) {
		const double share = ahead / span;
		space->ops->combine(space, stage->a, 2, (JnTerm[]){{1 + share, recent[0]}, {-share, recent[1]}});
	} else {
		space->ops->combine(space, stage->a, 1, (JnTerm[]){{1, recent[0]}});
	}
	if (stage->problem->held == NULL) return;
	stage->sys->ops->hold(stage->sys, stage->a);
	space->ops->combine(space, stage->a, 2, (JnTerm[]){{1, stage->a}, {1, stage->problem->held}});
}

// What saves work on the usual stage may fail on a hard one: from zero acceleration, with a tangent of its own at each
// iteration and full solves, before the controller has to cut the step.
static JnStatus solve_carefully(Stage* stage) {
	stage->self->recent_count = 0;
	stage->is_careful = true;
	first_guess(stage);
	JN_TRY(evaluate(stage, &stage->norm));
	return solve_root(stage);
}

static void keep_solution(Stage* stage) {
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
	Stage stage = {.self = self, .sys = sys, .problem = problem, .s = s, .a = a, .report = report, .work = work};
	stage.residual = work[JN_STAGE_RESIDUAL];
	stage.step = work[JN_STAGE_STEP];
	stage.origin = work[JN_STAGE_ORIGIN];
	JN_TRY(sys->ops->matrix(sys, (JnShift){.mass = 1}, &stage.mass));
	first_guess(&stage);
	JnStatus status = evaluate(&stage, &stage.norm);
	if (status == JN_NOT_FINITE && self->recent_count > 0) { // the extrapolation left where forces are defined
		self->recent_count = 0;
		first_guess(&stage);
		status = evaluate(&stage, &stage.norm);
	}
	JN_TRY(status);
	const double scale = sys->force_scale > 0 ? sys->force_scale : stage.norm;
	stage.tolerance = fmax(self->newton.tolerance * scale, sys->force_floor);
	stage.is_careful = self->newton.reuse == REUSE_NEVER;
	status = self->newton.mode == LINEAR ? solve_linear(&stage) : solve_root(&stage);
	const bool took_shortcuts = self->newton.mode == ROOT && (!stage.is_careful || self->newton.guess != GUESS_ZERO);
	if (status == JN_NOT_CONVERGED && took_shortcuts) status = solve_carefully(&stage);
	JN_TRY(status);
	keep_solution(&stage);
	report->residual = scale > 0 ? stage.norm / scale : 0;
	return JN_OK;
}
