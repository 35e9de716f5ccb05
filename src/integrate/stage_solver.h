/// @file stage_solver.h
/// What the ways to solve a stage share: the state of a solve, its residual, its Newton matrix and the loop around both.
#ifndef JN_INTEGRATE_STAGE_SOLVER_H
#define JN_INTEGRATE_STAGE_SOLVER_H

#include "integrate/integrator.h"
#include "integrate/stage.h"

enum { JN_MODE_ROOT, JN_MODE_LINEAR, JN_MODE_MINIMIZE, JN_MODE_AUTO };
enum { JN_REUSE_AUTO, JN_REUSE_NEVER };
enum { JN_GUESS_ZERO, JN_GUESS_LAST, JN_GUESS_LINEAR, JN_GUESS_PARALLEL, JN_GUESS_AUTO };

typedef struct JnStageSolver {
	JnIntegrator* self;
	JnSystem* sys;
	const JnStage* problem;
	JnState* s; ///< of the point evaluated last
	JnVec a;
	JnReport* report;
	JnVec *work, residual, step, origin; ///< residual at a; step goes from origin
	JnMatrix* mass;
	double norm, tolerance; ///< of the residual [N]
	int secants;            ///< steps remembered since the last refresh
	bool is_fresh;          ///< the tangent was made at the present a
	bool is_careful;        ///< a new tangent at every iteration, whatever the options say
	bool is_exact;          ///< directions by full solves: approximate ones did not serve
	bool is_inexact; ///< the solver iterates: every direction has its own tangent, and the accuracy that it is worth
	double forcing;  ///< of the last direction, if inexact: |r - A step| is at most forcing |r|
	bool gives_up_early; ///< a residual that stalls ends the loop: something else takes over

	bool wants_energy;    ///< jn_stage_evaluate fills the two below
	double energy;        ///< sum over points of w E / kx; NAN when there is none
	double damping_slope; ///< sum over points of w v . D step, where D step stands in work[JN_STAGE_DAMPING]
	double lowest;        ///< smallest norm met
} JnStageSolver;

/// r and its norm at a: load + sum of weighted forces - M a. JN_NOT_FINITE when the norm is not. Leaves M a in
/// work[JN_STAGE_MASS].
JnStatus jn_stage_evaluate(JnStageSolver* stage);

/// a = origin, and its residual.
JnStatus jn_stage_return(JnStageSolver* stage);

/// The matrix -dr/da, with the tangent of one state for all points, and only a `share` of K.
JnStatus jn_stage_matrix(JnStageSolver* stage, double share, JnMatrix** out);

/// a = the first guess.
void jn_stage_guess(JnStageSolver* stage);

/// a solves the stage: later guesses learn from it.
void jn_stage_keep(JnStageSolver* stage);

/// The tangent of a first direction: a new one, or one kept from earlier.
JnStatus jn_stage_first_tangent(JnStageSolver* stage);

/// That of the next direction, after an iteration that began with a residual of norm `before`. failed: it found no way on
/// with the direction that it had.
JnStatus jn_stage_next_tangent(JnStageSolver* stage, bool failed, double before);

/// That of the only direction that there will be: a new one.
JnStatus jn_stage_only_tangent(JnStageSolver* stage);

/// step = Newton's, from the present tangent and, if that is kept, the secants since it was made; origin = a. Counts an
/// iteration.
JnStatus jn_stage_direction(JnStageSolver* stage);

/// step = A^-1 r with a matrix of the stage: exactly, or to six digits by a solver that iterates, where these are enough.
JnStatus jn_stage_thorough(JnStageSolver* stage, JnMatrix* matrix);

/// A full step was taken: the next direction by the same tangent learns from it.
void jn_stage_remember(JnStageSolver* stage);

/// What an iteration from a residual of norm `before` tells about the accuracy that directions are worth.
void jn_stage_learn(JnStageSolver* stage, double before);

/// The stage took so many iterations: how old has the kept tangent become?
void jn_stage_judge_age(JnStageSolver* stage, int iterations);

/// A new tangent at s.
JnStatus jn_stage_refresh(JnStageSolver* stage);

/// The search found nothing better: rounding if the residual is that small, else JN_NOT_CONVERGED.
JnStatus jn_stage_arrive(JnStageSolver* stage);

/// One iteration: moves a, or tells that the direction failed, or both.
typedef JnStatus JnStageIterate(JnStageSolver* stage, bool* failed);

/// Iterate until the residual is below the tolerance, with a new tangent whenever that pays.
JnStatus jn_stage_loop(JnStageSolver* stage, JnStageIterate* iterate);

JnStageIterate jn_stage_iterate_root, jn_stage_iterate_minimize;
JnStatus jn_stage_linear(JnStageSolver* stage);

#endif
