// The time of a step of all methods by turns, so that what disturbs the machine disturbs all alike; and errors of energy.
// Each step is timed by itself: the median of a turn, and the least of the turns.
#include <math.h>
#include <stdlib.h>

#include "base/log.h"
#include "base/timer.h"
#include "score_trial.h"

enum { TURNS = 7, LEAST_STEPS = 21, MOST_STEPS = 2000 };

static const double turn_seconds = 0.05; // of a method in a turn

/// A simulation that is begun anew when its time is over.
typedef struct Runner {
	ScoreMethod* method;
	ScoreSim run;
} Runner;

static JnStatus start(Score* score, Runner* runner) {
	score_sim_close(&runner->run);
	return score_sim_open(score->options, runner->method->type, runner->method->limit / 2, score->time, &runner->run);
}

// One step; *seconds is its wall time.
static JnStatus step(Score* score, Runner* runner, double* seconds) {
	if (jn_sim_is_done(runner->run.sim)) JN_TRY(start(score, runner));
	const double began = jn_seconds();
	const JnStatus status = jn_sim_step(runner->run.sim);
	*seconds = jn_seconds() - began;
	return status;
}

static int compare(const void* a, const void* b) {
	const double x = *(const double*)a, y = *(const double*)b;
	return (x > y) - (x < y);
}

static JnStatus take_turn(Score* score, Runner* runner) {
	double times[MOST_STEPS], forces = 0;
	int count = 0;
	const double began = jn_seconds(); // where a run has few steps, beginning it anew takes most of the time
	while (count < LEAST_STEPS || (count < MOST_STEPS && jn_seconds() - began < turn_seconds)) {
		JN_TRY(step(score, runner, &times[count++]));
		forces += jn_sim_last_report(runner->run.sim)->forces;
	}
	qsort(times, (size_t)count, sizeof *times, compare);
	runner->method->seconds = fmin(runner->method->seconds, times[count / 2]);
	runner->method->forces = forces / count;
	return JN_OK;
}

static bool has_limit(const ScoreMethod* method) {
	return method->limit > 0;
}

static JnStatus time_methods(Score* score, Runner* runners) {
	int count = 0;
	for (int i = 0; i < score->count; ++i) {
		if (!has_limit(&score->list[i])) continue;
		runners[count].method = &score->list[i];
		runners[count].method->seconds = INFINITY;
		JN_TRY(start(score, &runners[count++]));
	}
	for (int turn = 0; turn < TURNS && !score_is_stopped(score); ++turn)
		for (int i = 0; i < count && !score_is_stopped(score); ++i) {
			score_show(score, "time of a step, turn %d of %d: %s", turn + 1, TURNS, runners[i].method->type->row.name);
			JN_TRY(take_turn(score, &runners[i]));
		}
	for (int i = 0; i < count; ++i)
		if (isinf(runners[i].method->seconds)) runners[i].method->seconds = NAN;
	return JN_OK;
}

static JnStatus find_error(Score* score, ScoreMethod* method, double dt, double* error) {
	ScoreTrial trial;
	JN_TRY(score_try(score, method, dt, score->options->factor * score->scale, &trial));
	*error = trial.is_stable ? (trial.end - score->end_energy) / score->scale : NAN;
	return JN_OK;
}

static JnStatus find_errors(Score* score) {
	for (int i = 0; i < score->count && !score_is_stopped(score); ++i) {
		ScoreMethod* method = &score->list[i];
		if (!has_limit(method)) continue;
		JN_TRY(find_error(score, method, method->limit / 2, &method->error_half));
		if (score->dt <= method->limit) JN_TRY(find_error(score, method, score->dt, &method->error_scene));
	}
	return JN_OK;
}

JnStatus score_find_costs(Score* score) {
	Runner* runners = calloc((size_t)score->count, sizeof *runners);
	if (runners == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: no room for simulations");
	JnStatus status = time_methods(score, runners);
	for (int i = 0; i < score->count; ++i) score_sim_close(&runners[i].run);
	free(runners);
	return status == JN_OK ? find_errors(score) : status;
}

// ---- scores ----

static double relative(double limit, double cost, double first_limit, double first_cost) {
	if (!(limit > 0 && cost > 0 && first_limit > 0 && first_cost > 0)) return NAN;
	return limit / cost / (first_limit / first_cost);
}

double score_value(const Score* score, const ScoreMethod* method) {
	const ScoreMethod* first = &score->list[score->first];
	return relative(method->limit, method->seconds, first->limit, first->seconds);
}

double score_by_forces(const Score* score, const ScoreMethod* method) {
	const ScoreMethod* first = &score->list[score->first];
	return relative(method->limit, method->forces, first->limit, first->forces);
}
