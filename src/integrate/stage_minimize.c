// Iterations on the function whose gradient is M a - f, the residual with its sign turned:
//
//   phi(a) = 1/2 a' M a - load . a + sum over points of w [E(x) / kx + v' D v / (2 kv)],   x = x~ + kx a,  v = v~ + kv a
//
// D being constant over a step. Newton's direction p comes from a positive definite matrix, so that phi' = -r . p < 0.
// A length l is accepted when
//   quick    the residual is half of the smallest met so far: phi need not be known, and this can happen only
//            log2(first / tolerance) times;
//   Armijo   phi(l) - phi(0) <= d l phi'(0), the energy's change beside the exact change of the quadratic terms;
//   Wolfe    where the difference of energies is lost in rounding, or where forces have no potential:
//            phi'(l) <= (2 d - 1) phi'(0), which is Armijo for a quadratic phi (Hager, Zhang 2005, equation 4.1).
// phi' = -r . p is exact whatever the forces: those without potential are seen by the Wolfe test alone.
#include <float.h>
#include <math.h>

#include "integrate/stage_solver.h"

enum { MOST_TRIALS = 40, MOST_REFINEMENTS = 6 };
enum { LEAST_PART = 4 };                 // of K: 8^-4
static const double least_fall = 0.1;    // d
static const double still_steep = 0.5;   // a slope above this share of the first asks for a longer step
static const double rounding = 1e-13;    // of phi, relative to the sum of its terms
static const double least_slope = 1e-10; // cosine between direction and residual below which it counts as none

/// A line from origin along step, and what is known at its start.
typedef struct Line {
	double slope; // phi'(0) < 0
	double energy, mass_slope, damping_slope, load_slope;
	double length, end_slope; // of the present trial
	double low, low_slope;    // the longest length accepted so far, 0 at first
	double high, high_slope;  // the shortest one refused, INFINITY at first
} Line;

static double dot(const JnStageSolver* stage, const double* a, const double* b) {
	JnSpace* space = stage->sys->space;
	return space->ops->dot(space, a, b);
}

static bool descends(const JnStageSolver* stage) {
	const double size = sqrt(dot(stage, stage->step, stage->step));
	return dot(stage, stage->residual, stage->step) > least_slope * stage->norm * size;
}

static bool is_quick(const JnStageSolver* stage) {
	return stage->norm <= 0.5 * stage->lowest || stage->norm <= stage->tolerance;
}

// phi(length) - phi(0), and below which size it is rounding.
static double change_of(const JnStageSolver* stage, const Line* line, double* slack) {
	const double mass_slope = dot(stage, stage->work[JN_STAGE_MASS], stage->step);
	const double quadratic = 0.5 * (line->mass_slope + mass_slope + line->damping_slope + stage->damping_slope);
	*slack = rounding * (fabs(line->energy) + fabs(stage->energy) + fabs(line->length * quadratic));
	return stage->energy - line->energy + line->length * (quadratic - line->load_slope);
}

static bool is_accepted(const JnStageSolver* stage, const Line* line) {
	if (is_quick(stage)) return true;
	double slack = 0;
	const bool is_flat = line->end_slope <= (2 * least_fall - 1) * line->slope;
	const double change = change_of(stage, line, &slack);
	if (isnan(change)) return is_flat;
	return change <= least_fall * line->length * line->slope || (fabs(change) <= slack && is_flat);
}

// a = origin + length * step; a state that is not finite is none to accept.
static JnStatus try_length(JnStageSolver* stage, Line* line, bool* accepted) {
	JnSpace* space = stage->sys->space;
	space->ops->combine(space, stage->a, 2, (JnTerm[]){{1, stage->origin}, {line->length, stage->step}});
	const JnStatus status = jn_stage_evaluate(stage);
	line->end_slope = NAN;
	if (status == JN_NOT_FINITE) return JN_OK;
	JN_TRY(status);
	line->end_slope = -dot(stage, stage->residual, stage->step);
	*accepted = is_accepted(stage, line);
	return JN_OK;
}

// A system keeps few matrices at once: after others have been asked for, that of the mass may be elsewhere.
static JnStatus find_mass(JnStageSolver* stage) {
	return stage->sys->ops->matrix(stage->sys, (JnShift){.mass = 1}, &stage->mass);
}

static JnStatus damp_step(JnStageSolver* stage) {
	JnMatrix* damping = NULL;
	JN_TRY(stage->sys->ops->matrix(stage->sys, (JnShift){.damping = 1}, &damping));
	damping->ops->apply(damping, stage->step, stage->work[JN_STAGE_DAMPING]);
	return find_mass(stage);
}

// Energy and slopes at the origin, where the residual stands.
static JnStatus begin_line(JnStageSolver* stage, Line* line) {
	stage->wants_energy = stage->sys->has_potential;
	if (stage->wants_energy) JN_TRY(damp_step(stage));
	JN_TRY(jn_stage_return(stage));
	*line = (Line){.slope = -dot(stage, stage->residual, stage->step),
				   .energy = stage->energy,
				   .mass_slope = dot(stage, stage->work[JN_STAGE_MASS], stage->step),
				   .damping_slope = stage->damping_slope,
				   .length = 1,
				   .high = INFINITY};
	line->low_slope = line->slope;
	if (stage->problem->load != NULL) line->load_slope = dot(stage, stage->problem->load, stage->step);
	return JN_OK;
}

// Longer by four while nothing is refused; then where the line through the slopes at both ends crosses zero, kept away
// from the ends.
static double next_length(const Line* line) {
	if (isinf(line->high)) return 4 * line->length;
	const double nearest = line->low > 0 ? 0.25 : 0.1, farthest = line->low > 0 ? 0.75 : 0.5;
	const double share = line->high_slope > 0 ? line->low_slope / (line->low_slope - line->high_slope) : 0.5;
	return line->low + (line->high - line->low) * fmin(fmax(share, nearest), farthest);
}

// Trials are cheap beside a factor: some are spent on a step that is accepted but ends on a slope that is still steep.
static JnStatus search(JnStageSolver* stage, bool* found) {
	Line line;
	int refinements = 0;
	JN_TRY(begin_line(stage, &line));
	for (int trial = 0; trial < MOST_TRIALS && refinements <= MOST_REFINEMENTS; ++trial) {
		bool accepted = false;
		if (trial > 0) line.length = next_length(&line);
		JN_TRY(try_length(stage, &line, &accepted));
		*found |= accepted;
		refinements += *found;
		if (accepted) {
			line.low = line.length;
			line.low_slope = line.end_slope;
		} else {
			line.high = line.length;
			line.high_slope = line.end_slope;
			++stage->report->backtracks;
		}
		if (accepted && (line.end_slope >= still_steep * line.slope || is_quick(stage))) break;
	}
	if (*found && line.length != line.low) {
		line.length = line.low;
		JN_TRY(try_length(stage, &line, found));
	}
	stage->wants_energy = false;
	return JN_OK;
}

// A direction along which phi falls when Newton's does not, which happens where matrices are factored without being
// positive definite: with less and less of K, in the end with the mass alone.
static JnStatus definite_direction(JnStageSolver* stage) {
	for (int part = 1; part <= LEAST_PART; ++part) {
		JnMatrix* matrix = NULL;
		JN_TRY(jn_stage_matrix(stage, ldexp(1, -3 * part), &matrix));
		const JnStatus status = jn_stage_thorough(stage, matrix);
		if (status == JN_OK && descends(stage)) return find_mass(stage);
		if (status < JN_OK) return status;
	}
	JN_TRY(find_mass(stage));
	return stage->mass->ops->solve(stage->mass, stage->residual, stage->step);
}

// A full step with whatever tangent there is; what does not serve is taken back.
static JnStatus try_quickly(JnStageSolver* stage, bool* failed) {
	JnSpace* space = stage->sys->space;
	space->ops->combine(space, stage->a, 2, (JnTerm[]){{1, stage->origin}, {1, stage->step}});
	const JnStatus status = jn_stage_evaluate(stage);
	if (status != JN_OK && status != JN_NOT_FINITE) return status;
	*failed = status != JN_OK || !is_quick(stage);
	if (*failed) return jn_stage_return(stage);
	jn_stage_remember(stage);
	return JN_OK;
}

// What Newton's step would still change is less than the rounding of positions.
static bool is_at_rest(const JnStageSolver* stage) {
	JnSpace* space = stage->sys->space;
	const double moved = stage->problem->kx * space->ops->max(space, stage->step);
	return moved <= 4 * DBL_EPSILON * space->ops->max(space, stage->s->x);
}

// A tangent of the present a and full solves: what fails now fails for good. With inexact ones, full solves come next.
static JnStatus try_thoroughly(JnStageSolver* stage, bool falls, bool* failed) {
	bool found = false;
	if (falls && is_at_rest(stage)) {
		stage->tolerance = stage->norm;
		return JN_OK;
	}
	if (!falls) JN_TRY(definite_direction(stage));
	JN_TRY(search(stage, &found));
	*failed = !found || !stage->is_inexact;
	if (found) return JN_OK;
	JN_TRY(jn_stage_return(stage));
	return stage->is_inexact ? JN_OK : jn_stage_arrive(stage);
}

JnStatus jn_stage_iterate_minimize(JnStageSolver* stage, bool* failed) {
	const bool is_thorough = stage->is_fresh && (stage->is_exact || stage->is_inexact);
	const JnStatus status = jn_stage_direction(stage);
	if (status != JN_OK && status != JN_INDEFINITE) return status;
	const bool falls = status == JN_OK && descends(stage);
	stage->is_fresh = false;
	*failed = true;
	if (falls && !(is_thorough && stage->is_exact)) JN_TRY(try_quickly(stage, failed));
	if (is_thorough && *failed) JN_TRY(try_thoroughly(stage, falls, failed));
	stage->lowest = fmin(stage->lowest, stage->norm);
	return JN_OK;
}
