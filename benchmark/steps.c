// Whole steps, as `jounce run` makes them but without recording: each sample is a run from the start of the scene.
#include <stdlib.h>

#include "bench.h"

typedef struct Case {
	const char *size, *method, *dt;
	int steps, repeats;
	bool one_thread_only; ///< too long to be run twice
} Case;

static const Case cases[] = {
	{"beam", "sdirk2", "5ms", 200, 7, false},         {"beam", "sdirk2", "33ms", 60, 7, false},
	{"beam", "backward_euler", "5ms", 200, 7, false}, {"beam", "tr_bdf2", "5ms", 200, 7, false},
	{"block16", "sdirk2", "5ms", 40, 3, false},       {"block32", "sdirk2", "5ms", 4, 1, true},
};

enum { MOST_REPEATS = 9 };

/// What the steps of a run came to, per step.
typedef struct Sample {
	double seconds, newton, factorizations, simulated;
} Sample;

static JnStatus run_steps(const JnSceneDef* def, int threads, int steps, Sample* sample) {
	JnSim* sim = NULL;
	JN_TRY(jn_sim_create(&def->sim, threads, &sim));
	JnStatus status = JN_OK;
	*sample = (Sample){0};
	const double start = clock_for(threads);
	for (int i = 0; i < steps && status == JN_OK; ++i) {
		status = jn_sim_step(sim);
		sample->newton += (double)jn_sim_last_report(sim)->newton / steps;
		sample->factorizations += (double)jn_sim_last_report(sim)->factorizations / steps;
	}
	sample->seconds = (clock_for(threads) - start) / steps;
	sample->simulated = jn_sim_state(sim)->t / steps;
	jn_sim_destroy(sim);
	return status;
}

static void report_case(const Bench* bench, const Case* c, int threads, Timing seconds, const Sample* last) {
	char name[64], counts[80];
	snprintf(name, sizeof name, "%s.%s", c->method, c->dt);
	Row row = {.group = "step", .name = name, .size = c->size, .threads = threads, .width = jn_kernel_best_width()};
	row.value = timing_in(seconds, 1e-3, 1);
	row.unit = "ms/step";
	row.rate = seconds.median / last->simulated;
	row.rate_unit = "s/s";
	bench_report(bench, &row);
	row.rate = 0;
	row.name = counts;
	snprintf(counts, sizeof counts, "%s.newton", name);
	row.value = (Timing){last->newton, last->newton, last->newton};
	row.unit = "/step";
	bench_report(bench, &row);
	snprintf(counts, sizeof counts, "%s.factorizations", name);
	const double hundred = 100 * last->factorizations;
	row.value = (Timing){hundred, hundred, hundred};
	row.unit = "/100 steps";
	bench_report(bench, &row);
}

static JnStatus measure_case(const Bench* bench, const Case* c, int threads) {
	char method[80], dt[40];
	SceneOf of = scene_of(c->size);
	snprintf(method, sizeof method, "integrator.method=%s", c->method);
	snprintf(dt, sizeof dt, "step.dt=%s", c->dt);
	const char* const sets[] = {method, dt, "duration=1000s", of.cells};
	JnScene* scene = NULL;
	JN_TRY(jn_scene_load(of.path, 3 + of.set_count, sets, &scene));
	Sample sample = {0};
	double seconds[MOST_REPEATS];
	const bool needs_warm_up = c->repeats > 1;
	JnStatus status = needs_warm_up ? run_steps(jn_scene_def(scene), threads, c->steps / 4, &sample) : JN_OK;
	for (int i = 0; i < c->repeats && status == JN_OK; ++i) {
		status = run_steps(jn_scene_def(scene), threads, c->steps, &sample);
		seconds[i] = sample.seconds;
	}
	if (status == JN_OK) report_case(bench, c, threads, summarize(seconds, c->repeats), &sample);
	jn_scene_destroy(scene);
	return status;
}

JnStatus bench_steps(const Bench* bench) {
	for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
		const Case* c = &cases[i];
		char name[64];
		snprintf(name, sizeof name, "%s.%s", c->method, c->dt);
		if (!bench_wants(bench, "step", name, c->size)) continue;
		JN_TRY(measure_case(bench, c, 1));
		if (bench->threads > 1 && !c->one_thread_only) JN_TRY(measure_case(bench, c, bench->threads));
	}
	return JN_OK;
}
