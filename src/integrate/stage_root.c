// Iterations on the residual alone.
//
// root     the step is halved until the norm of the residual falls
// linear   one Newton step from a = 0 with a new tangent
#include "integrate/stage_solver.h"

enum { MOST_HALVINGS = 12 };

// a = origin + length * step. Accepts when the residual falls; a state that is not finite counts as no fall.
static JnStatus try_length(JnStageSolver* stage, double length, bool* falls) {
	JnSpace* space = stage->sys->space;
	const double before = stage->norm;
	space->ops->combine(space, stage->a, 2, (JnTerm[]){{1, stage->origin}, {length, stage->step}});
	const JnStatus status = jn_stage_evaluate(stage);
	if (status != JN_OK && status != JN_NOT_FINITE) return status;
	*falls = status == JN_OK && (stage->norm <= (1 - 1e-4 * length) * before || stage->norm <= stage->tolerance);
	if (!*falls) stage->norm = before;
	return JN_OK;
}

// A full step that fails with an old tangent, or a rough solve by a factor, asks for better; else the step is halved: an
// inexact Newton step leads down the norm of the residual as an exact one does (Eisenstat, Walker 1994).
JnStatus jn_stage_iterate_root(JnStageSolver* stage, bool* failed) {
	JN_TRY(jn_stage_direction(stage));
	bool falls = false;
	JN_TRY(try_length(stage, 1, &falls));
	if (falls) {
		jn_stage_remember(stage);
		stage->is_fresh = false;
		return JN_OK;
	}
	if (!stage->is_fresh || !(stage->is_exact || stage->is_inexact)) {
		*failed = true;
		return jn_stage_return(stage);
	}
	double length = 1;
	for (int halving = 0; halving < MOST_HALVINGS && !falls; ++halving) {
		length *= 0.5;
		++stage->report->backtracks;
		JN_TRY(try_length(stage, length, &falls));
	}
	stage->is_fresh = false;
	*failed = !falls || !stage->is_inexact;
	if (falls) return JN_OK;
	JN_TRY(jn_stage_return(stage));
	return stage->is_inexact ? JN_OK : jn_stage_arrive(stage);
}

JnStatus jn_stage_linear(JnStageSolver* stage) {
	JnSpace* space = stage->sys->space;
	JN_TRY(jn_stage_only_tangent(stage));
	JN_TRY(jn_stage_direction(stage));
	space->ops->combine(space, stage->a, 2, (JnTerm[]){{1, stage->a}, {1, stage->step}});
	return jn_stage_evaluate(stage);
}
