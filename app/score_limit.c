// The largest stable step: up or down from the scene's step until stable and unstable ones are found, bisection between
// them, and a look below: an unstable step there is the limit instead, so that no island of stability above it counts.
#include <math.h>

#include "base/log.h"
#include "score_trial.h"

enum { MOST_HALVINGS = 30, MOST_REFERENCES = 10 };

static const double stride = 1.25;    // between steps tried on the way up
static const double precision = 1.01; // of stable and unstable steps at the end
static const double agreement = 0.1;  // of energies in motion with a step and with half of it
static const double least = 1e-9;     // [s] of a scene's step.dt
static const double below[] = {0.95, 0.9, 0.8, 0.7, 0.6, 0.5};

// ---- the reference ----

static JnStatus refuse_rest(const Score* score) {
	return jn_error(
		JN_BAD_INPUT,
		"%s: nothing moves within %g s, so that no energy can grow; give the scene a start that moves, or a "
		"longer --time",
		score->options->scene, score->time);
}

static JnStatus refuse_unsettled(const Score* score, const ScoreMethod* method, double dt) {
	return jn_error(
		JN_RUN_FAILED,
		"%s: the energies of %s with steps down to %.3g s do not settle%s%s; give the scene a smaller step.dt, "
		"or a shorter --time",
		score->options->scene, score->reference->row.name, dt, method->failure[0] != '\0' ? ": " : "", method->failure);
}

JnStatus score_find_reference(Score* score) {
	ScoreMethod method = {.type = score->reference};
	ScoreTrial trial;
	double dt = fmin(score->dt, score->cap), last = NAN;
	for (int i = 0; i < MOST_REFERENCES; ++i, dt /= 2) {
		JN_TRY(score_try(score, &method, dt, INFINITY, &trial));
		if (score_is_stopped(score)) return JN_OK;
		const double scale = trial.is_stable ? trial.kinetic_range + trial.potential_range : NAN;
		if (scale <= trial.least) return refuse_rest(score);
		const bool agrees = fabs(scale - last) <= agreement * scale;
		last = scale;
		if (!agrees) continue;
		score->reference_dt = dt;
		score->scale = scale;
		score->start_energy = trial.start;
		score->end_energy = trial.end;
		return JN_OK;
	}
	return refuse_unsettled(score, &method, 2 * dt);
}

// ---- the limit ----

/// Steps that are stable, and not.
typedef struct Bracket {
	double stable, unstable; // 0 and INFINITY: not found
} Bracket;

static JnStatus narrow(Score* score, ScoreMethod* method, double dt, Bracket* bracket) {
	ScoreTrial trial = {.is_stable = false};
	if (dt >= least) JN_TRY(score_try(score, method, dt, score->options->factor * score->scale, &trial));
	if (trial.is_stable)
		bracket->stable = fmax(bracket->stable, dt);
	else
		bracket->unstable = fmin(bracket->unstable, dt);
	return JN_OK;
}

static JnStatus climb(Score* score, ScoreMethod* method, Bracket* bracket) {
	while (isinf(bracket->unstable) && bracket->stable < score->cap && !score_is_stopped(score))
		JN_TRY(narrow(score, method, fmin(stride * bracket->stable, score->cap), bracket));
	return JN_OK;
}

static JnStatus descend(Score* score, ScoreMethod* method, Bracket* bracket) {
	for (int i = 0; i < MOST_HALVINGS && bracket->unstable > least && bracket->stable == 0 && !score_is_stopped(score);
		 ++i)
		JN_TRY(narrow(score, method, bracket->unstable / 2, bracket));
	return JN_OK;
}

static JnStatus bisect(Score* score, ScoreMethod* method, Bracket* bracket) {
	if (bracket->stable == 0 || isinf(bracket->unstable)) return JN_OK;
	while (bracket->unstable > precision * bracket->stable && !score_is_stopped(score))
		JN_TRY(narrow(score, method, sqrt(bracket->stable * bracket->unstable), bracket));
	return JN_OK;
}

// Whether all steps looked at below are stable; else *bracket begins anew under the first that is not.
static JnStatus look_below(Score* score, ScoreMethod* method, Bracket* bracket, bool* is_sound) {
	*is_sound = true;
	for (size_t i = 0; i < sizeof below / sizeof *below && *is_sound && bracket->stable > 0; ++i) {
		Bracket here = {.unstable = INFINITY};
		JN_TRY(narrow(score, method, below[i] * bracket->stable, &here));
		if (score_is_stopped(score)) return JN_OK;
		*is_sound = here.stable > 0;
		if (!*is_sound) *bracket = here;
	}
	return JN_OK;
}

JnStatus score_find_limit(Score* score, ScoreMethod* method) {
	Bracket bracket = {.unstable = INFINITY};
	bool is_sound = false;
	method->limit = NAN;
	JN_TRY(narrow(score, method, fmin(score->dt, score->cap), &bracket));
	if (bracket.stable > 0) JN_TRY(climb(score, method, &bracket));
	while (!is_sound && !score_is_stopped(score)) {
		JN_TRY(descend(score, method, &bracket));
		JN_TRY(bisect(score, method, &bracket));
		JN_TRY(look_below(score, method, &bracket, &is_sound));
	}
	if (score_is_stopped(score)) return JN_OK;
	method->limit = bracket.stable;
	method->is_capped = isinf(bracket.unstable);
	return JN_OK;
}
