#include "score_trial.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/log.h"

enum {
	SAMPLES = 2000
}; // energies looked at in a run, so that they cost little beside the steps; growth is exponential

JnStatus score_sim_open(const ScoreOptions* options, const JnIntegratorType* type, double dt, double time,
						ScoreSim* out) {
	char method[96], step[96], duration[64];
	const char** sets = calloc((size_t)options->sets.count + 3, sizeof *sets);
	*out = (ScoreSim){0};
	if (sets == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: no room for overrides");
	int count = options->sets.count;
	if (count > 0) memcpy(sets, options->sets.words, (size_t)count * sizeof *sets);
	snprintf(method, sizeof method, "integrator={method: %s}", type->row.name);
	snprintf(step, sizeof step, "step={controller: fixed, dt: %.17g s, cuts: 0}", dt);
	snprintf(duration, sizeof duration, "duration=%.17g s", time);
	sets[count++] = method;
	sets[count++] = step;
	sets[count++] = duration;
	JnStatus status = jn_scene_load(options->scene, count, sets, &out->scene);
	if (status == JN_OK) status = jn_scene_build(out->scene, options->threads, &out->sim);
	if (status != JN_OK) score_sim_close(out);
	free(sets);
	return status;
}

void score_sim_close(ScoreSim* sim) {
	jn_sim_destroy(sim->sim);
	jn_scene_destroy(sim->scene);
	*sim = (ScoreSim){0};
}

ScoreEnergy score_energy(JnSim* sim) {
	const JnEnergies e = jn_sim_energies(sim);
	return (ScoreEnergy){e.kinetic, e.elastic + e.gravity, e.kinetic + e.elastic + e.gravity};
}

// ---- running ----

typedef struct Range {
	double low, high;
} Range;

static void widen(Range* range, double value) {
	range->low = fmin(range->low, value);
	range->high = fmax(range->high, value);
}

static void keep_failure(void* user, JnLogLevel level, const char* message) {
	ScoreMethod* method = user;
	if (level == JN_LOG_ERROR) snprintf(method->failure, sizeof method->failure, "%s", message);
}

// Of the whole mass, through a billionth of the largest coordinate in the time of a run.
static double least_energy(const Score* score, JnSim* sim) {
	JnSpace* space = jn_sim_system(sim)->space;
	const double speed = 1e-9 * space->ops->max(space, jn_sim_state(sim)->x) / score->time;
	return 0.5 * jn_sim_mass(sim) * speed * speed;
}

static JnStatus follow(Score* score, JnSim* sim, double dt, double bound, ScoreTrial* trial) {
	ScoreEnergy energy = score_energy(sim);
	Range kinetic = {energy.kinetic, energy.kinetic}, potential = {energy.potential, energy.potential};
	const long stride = lround(fmax(1, score->time / dt / SAMPLES));
	trial->start = trial->end = energy.total;
	trial->least = least_energy(score, sim);
	while (!jn_sim_is_done(sim)) {
		const JnStatus status = jn_sim_step(sim);
		if (status == JN_RUN_FAILED || score_is_stopped(score)) return JN_OK;
		if (status != JN_OK) return status;
		if (jn_sim_steps(sim) % stride != 0 && !jn_sim_is_done(sim)) continue;
		energy = score_energy(sim);
		if (!isfinite(energy.total) || fabs(energy.total - trial->start) > bound) return JN_OK;
		widen(&kinetic, energy.kinetic);
		widen(&potential, energy.potential);
	}
	trial->is_stable = true;
	trial->end = energy.total;
	trial->kinetic_range = kinetic.high - kinetic.low;
	trial->potential_range = potential.high - potential.low;
	return JN_OK;
}

JnStatus score_try(Score* score, ScoreMethod* method, double dt, double bound, ScoreTrial* trial) {
	ScoreSim run;
	*trial = (ScoreTrial){0};
	score_show(score, "%s: step %.4g s", method->type->row.name, dt);
	JN_TRY(score_sim_open(score->options, method->type, dt, score->time, &run));
	const JnLog before = jn_log_swap((JnLog){keep_failure, method});
	const JnStatus status = follow(score, run.sim, dt, bound, trial);
	jn_log_swap(before);
	score_sim_close(&run);
	++method->runs;
	return status;
}
