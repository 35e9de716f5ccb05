// Where the iterations of a stage begin: at a combination of the latest solutions a_0, a_1, .. at the times t_0, t_1, ..
//
//   zero      0
//   last      a_0
//   linear    the line through (t_0, a_0) and (t_1, a_1)
//   parallel  a_i + a_0 - a_{i+1},  with i such that t - t_i = t_0 - t_{i+1}: the same stage of the step before, moved as
//             the stage before this one has moved since then
//
// How good each of them would have been follows from the dot products of the solutions, without making it.
#include <math.h>

#include "integrate/stage_solver.h"

enum { GUESSES = JN_GUESS_AUTO };

static JnSpace* space_of(const JnStageSolver* stage) {
	return stage->sys->space;
}

// i as above; 0: there is none.
static int same_stage(const JnIntegrator* self, double t) {
	for (int i = 1; i + 1 < self->recent_count; ++i) {
		const double span = self->recent_t[0] - self->recent_t[i + 1];
		if (span != 0 && fabs(t - self->recent_t[i] - span) <= 1e-6 * fabs(span)) return i;
	}
	return 0;
}

// The line reaches only so far.
static bool has_line(const JnIntegrator* self, double t) {
	const double span = self->recent_t[0] - self->recent_t[1], ahead = t - self->recent_t[0];
	return self->recent_count >= 2 && span != 0 && fabs(ahead) <= 4 * fabs(span);
}

// Of each solution in a guess. False where there is no such guess.
static bool weigh(const JnStageSolver* stage, int guess, double weight[JN_RECENT_COUNT]) {
	const JnIntegrator* self = stage->self;
	const double t = stage->problem->t;
	const int same = guess == JN_GUESS_PARALLEL ? same_stage(self, t) : 0;
	for (int i = 0; i < JN_RECENT_COUNT; ++i) weight[i] = 0;
	if (guess == JN_GUESS_ZERO) return true;
	if (self->recent_count == 0 || (guess == JN_GUESS_LINEAR && !has_line(self, t))) return false;
	if (guess == JN_GUESS_PARALLEL && same == 0) return false;
	weight[0] = 1;
	if (guess == JN_GUESS_LINEAR) {
		const double share = (t - self->recent_t[0]) / (self->recent_t[0] - self->recent_t[1]);
		weight[0] = 1 + share;
		weight[1] = -share;
	} else if (guess == JN_GUESS_PARALLEL) {
		weight[same] = 1;
		weight[same + 1] = -1;
	}
	return true;
}

static void choose(const JnStageSolver* stage, double weight[JN_RECENT_COUNT]) {
	const JnIntegrator* self = stage->self;
	const bool chooses = self->newton.guess == JN_GUESS_AUTO;
	int chosen = chooses ? GUESSES - 1 : self->newton.guess;
	if (self->newton.mode == JN_MODE_LINEAR) chosen = JN_GUESS_ZERO;
	while (!weigh(stage, chosen, weight)) --chosen;
	for (int guess = chosen - 1; chooses && guess >= JN_GUESS_ZERO; --guess)
		if (self->guess_error[guess] < self->guess_error[chosen] && weigh(stage, guess, weight)) chosen = guess;
	weigh(stage, chosen, weight);
}

void jn_stage_guess(JnStageSolver* stage) {
	JnSpace* space = space_of(stage);
	double weight[JN_RECENT_COUNT];
	JnTerm terms[JN_RECENT_COUNT + 1];
	int count = 0;
	choose(stage, weight);
	for (int i = 0; i < JN_RECENT_COUNT; ++i)
		if (weight[i] != 0) terms[count++] = (JnTerm){weight[i], stage->work[JN_STAGE_RECENT + i]};
	if (stage->problem->held != NULL) terms[count++] = (JnTerm){1, stage->problem->held};
	space->ops->combine(space, stage->a, count, terms);
}

// What each guess would have been worth, as a mean that forgets: smooth motion is continued best by a line, while after
// a jolt the accelerations of before are worse than none. with[i]: the new solution times a_i; square: times itself.
static void judge(JnStageSolver* stage, double square, const double with[JN_RECENT_COUNT]) {
	JnIntegrator* self = stage->self;
	double weight[JN_RECENT_COUNT];
	for (int guess = JN_GUESS_ZERO; guess < GUESSES; ++guess) {
		if (!weigh(stage, guess, weight)) continue;
		double distance = square;
		for (int i = 0; i < self->recent_count; ++i) {
			distance -= 2 * weight[i] * with[i];
			for (int j = 0; j < self->recent_count; ++j) distance += weight[i] * weight[j] * self->recent_dot[i][j];
		}
		const double error = sqrt(fmax(distance, 0)), before = self->guess_error[guess];
		self->guess_error[guess] = before > 0 ? 0.5 * (before + error) : error;
	}
}

// Solution `i` moves on to i + 1; the oldest vector takes the new one.
static void shift(JnIntegrator* self, JnVec* recent, double t, double square, const double with[JN_RECENT_COUNT]) {
	const JnVec oldest = recent[JN_RECENT_COUNT - 1];
	for (int i = JN_RECENT_COUNT - 1; i > 0; --i) {
		recent[i] = recent[i - 1];
		self->recent_t[i] = self->recent_t[i - 1];
		for (int j = JN_RECENT_COUNT - 1; j > 0; --j) self->recent_dot[i][j] = self->recent_dot[i - 1][j - 1];
	}
	recent[0] = oldest;
	self->recent_t[0] = t;
	self->recent_dot[0][0] = square;
	for (int i = 1; i < JN_RECENT_COUNT; ++i) self->recent_dot[0][i] = self->recent_dot[i][0] = with[i - 1];
	if (self->recent_count < JN_RECENT_COUNT) ++self->recent_count;
}

void jn_stage_keep(JnStageSolver* stage) {
	JnIntegrator* self = stage->self;
	JnSpace* space = space_of(stage);
	JnVec* recent = stage->work + JN_STAGE_RECENT;
	JnVec a = stage->step; // without what is held
	double with[JN_RECENT_COUNT] = {0}, square = 0;
	space->ops->combine(space, a, 1, (JnTerm[]){{1, stage->a}});
	stage->sys->ops->hold(stage->sys, a);
	if (self->newton.guess == JN_GUESS_AUTO) {
		square = space->ops->dot(space, a, a);
		for (int i = 0; i < self->recent_count; ++i) with[i] = space->ops->dot(space, a, recent[i]);
		judge(stage, square, with);
	}
	shift(self, recent, stage->problem->t, square, with);
	space->ops->combine(space, recent[0], 1, (JnTerm[]){{1, a}});
}
