// Whole steps, as `jounce run` makes them but without recording: each sample is a run from the start of the scene, or the
// steps that follow some way into the run. Beside the time of a step stand what it counted: Newton iterations, forces,
// iterations of the linear solver, factorisations.
//
// Rows `lumped` are with lumped masses, rows `rough` with these and newton.tolerance 1e-4, which is ample for pictures.
// Group `headline`: seconds a simulated second of backward Euler at 0.05 ms over those of sdirk2 at 5 ms, which the paper
// of cloth.yaml and jello.yaml finds to be as free of damping, and 17 and 55 times faster. As is, with the solver that is
// chosen; `full`, with a factorisation at every Newton iteration, as in the paper.
#include <stdlib.h>
#include <string.h>

#include "bench.h"

#define LUMPED "bodies[0].mass=lumped"
#define ROUGH LUMPED, "newton.tolerance=1e-4"

typedef struct Case {
	const char *size, *method, *dt;
	int warm_up, steps, repeats; ///< warm_up 0: samples are whole runs
	bool one_thread_only;        ///< too long to be run twice
	const char* variant;         ///< part of the name; NULL: none
	const char* sets[5];         ///< NULL behind the last
} Case;

static const Case cases[] = {
	{"beam", "sdirk2", "5ms", 0, 200, 7, false, NULL, {NULL}},
	{"beam", "sdirk2", "33ms", 0, 60, 7, false, NULL, {NULL}},
	{"beam", "backward_euler", "5ms", 0, 200, 7, false, NULL, {NULL}},
	{"beam", "tr_bdf2", "5ms", 0, 200, 7, false, NULL, {NULL}},
	{"beam", "sdirk2", "5ms", 0, 200, 7, false, "rough", {ROUGH}},
	{"beam", "verlet", "1ms", 0, 1000, 7, false, "lumped", {LUMPED}},
	{"block16", "sdirk2", "5ms", 0, 40, 3, false, NULL, {NULL}},
	{"block32", "sdirk2", "5ms", 0, 4, 1, true, NULL, {NULL}},
	{"cloth", "sdirk2", "5ms", 10, 10, 1, false, "rough", {ROUGH}},
	{"cloth", "backward_euler", "5ms", 10, 10, 1, true, "rough", {ROUGH}},
	{"cloth", "sdirk2", "5ms", 5, 5, 1, true, "rough_stiff", {ROUGH, "bodies[0].material.young=3e7"}},
	{"cloth", "verlet", "0.25ms", 100, 400, 3, false, "lumped", {LUMPED}},
	{"jello", "sdirk2", "5ms", 20, 30, 1, false, NULL, {NULL}},
	{"jello", "sdirk2", "5ms", 20, 30, 1, false, "rough", {ROUGH}},
	{"jello", "backward_euler", "5ms", 20, 30, 1, true, NULL, {NULL}},
	{"ball", "sdirk2", "5ms", 150, 60, 1, true, NULL, {NULL}},
	{"flag", "sdirk2", "5ms", 10, 30, 1, true, NULL, {NULL}},
	{"pudding", "sdirk2", "4ms", 30, 60, 1, true, NULL, {NULL}},
	{"spinning_bar", "sdirk2", "5ms", 5, 20, 1, true, NULL, {NULL}},
	{"squeeze", "sdirk2", "5ms", 5, 20, 1, true, NULL, {NULL}},
	{"stack", "sdirk2", "5ms", 5, 5, 1, true, NULL, {NULL}},
};

#define FULL "solver.method=direct", "newton.reuse=never"

static const struct {
	const char* name;
	Case of[2];
} headlines[] = {
	{"sdirk2",
	 {{"cloth", "sdirk2", "5ms", 10, 10, 1, true, NULL, {ROUGH}},
	  {"cloth", "backward_euler", "0.05ms", 10, 30, 1, true, NULL, {ROUGH}}}},
	{"sdirk2",
	 {{"jello", "sdirk2", "5ms", 20, 20, 1, true, NULL, {ROUGH}},
	  {"jello", "backward_euler", "0.05ms", 20, 60, 1, true, NULL, {ROUGH}}}},
	{"sdirk2.full",
	 {{"cloth", "sdirk2", "5ms", 2, 3, 1, true, NULL, {ROUGH, FULL}},
	  {"cloth", "backward_euler", "0.05ms", 2, 6, 1, true, NULL, {ROUGH, FULL}}}},
	{"sdirk2.full",
	 {{"jello", "sdirk2", "5ms", 5, 10, 1, true, NULL, {ROUGH, FULL}},
	  {"jello", "backward_euler", "0.05ms", 5, 20, 1, true, NULL, {ROUGH, FULL}}}},
};

enum { MOST_REPEATS = 9, MOST_SETS = 9 };

/// What the steps of a run came to, per step.
typedef struct Sample {
	double seconds, simulated, newton, forces, iterations, factorizations;
} Sample;

static void count(const JnReport* report, int steps, Sample* sample) {
	sample->newton += (double)report->newton / steps;
	sample->forces += (double)report->forces / steps;
	sample->iterations += (double)report->iterations / steps;
	sample->factorizations += (double)report->factorizations / steps;
}

static JnStatus run_steps(const JnSceneDef* def, int threads, int warm_up, int steps, Sample* sample) {
	JnSim* sim = NULL;
	JN_TRY(jn_sim_create(&def->sim, threads, &sim));
	JnStatus status = JN_OK;
	*sample = (Sample){0};
	for (int i = 0; i < warm_up && status == JN_OK; ++i) status = jn_sim_step(sim);
	const double start = clock_for(threads), began = jn_sim_state(sim)->t;
	for (int i = 0; i < steps && status == JN_OK; ++i) {
		status = jn_sim_step(sim);
		count(jn_sim_last_report(sim), steps, sample);
	}
	sample->seconds = (clock_for(threads) - start) / steps;
	sample->simulated = (jn_sim_state(sim)->t - began) / steps;
	jn_sim_destroy(sim);
	return status;
}

static void name_of(const Case* c, size_t size, char* name) {
	snprintf(name, size, "%s.%s%s%s", c->method, c->dt, c->variant != NULL ? "." : "",
			 c->variant != NULL ? c->variant : "");
}

static void report_count(const Bench* bench, Row row, const char* what, double value, const char* unit) {
	char name[120];
	snprintf(name, sizeof name, "%s.%s", row.name, what);
	row.name = name;
	row.value = (Timing){value, value, value};
	row.unit = unit;
	row.rate = 0;
	if (value > 0) bench_report(bench, &row);
}

static void report_case(const Bench* bench, const Case* c, int threads, Timing seconds, const Sample* last) {
	char name[80];
	name_of(c, sizeof name, name);
	Row row = {.group = "step", .name = name, .size = c->size, .threads = threads, .width = jn_kernel_best_width()};
	row.value = timing_in(seconds, 1e-3, 1);
	row.unit = "ms/step";
	row.rate = seconds.median / last->simulated;
	row.rate_unit = "s/s";
	bench_report(bench, &row);
	report_count(bench, row, "newton", last->newton, "/step");
	report_count(bench, row, "forces", last->forces, "/step");
	report_count(bench, row, "iterations", last->iterations, "/step");
	report_count(bench, row, "factorizations", 100 * last->factorizations, "/100 steps");
}

// Each of `repeats` runs in seconds[].
static JnStatus run_case(const Case* c, int threads, double seconds[], Sample* last) {
	char method[80], dt[40];
	SceneOf of = scene_of(c->size);
	snprintf(method, sizeof method, "integrator.method=%s", c->method);
	snprintf(dt, sizeof dt, "step.dt=%s", c->dt);
	const char* sets[MOST_SETS] = {method, dt, "duration=1000s"};
	int set_count = 3;
	if (of.set_count > 0) sets[set_count++] = of.cells;
	for (int i = 0; c->sets[i] != NULL; ++i) sets[set_count++] = c->sets[i];
	JnScene* scene = NULL;
	JN_TRY(jn_scene_load(of.path, set_count, sets, &scene));
	const bool needs_warm_up = c->repeats > 1;
	JnStatus status = needs_warm_up ? run_steps(jn_scene_def(scene), threads, 0, c->steps / 4, last) : JN_OK;
	for (int i = 0; i < c->repeats && status == JN_OK; ++i) {
		status = run_steps(jn_scene_def(scene), threads, c->warm_up, c->steps, last);
		seconds[i] = last->seconds;
	}
	jn_scene_destroy(scene);
	return status;
}

static JnStatus measure_case(const Bench* bench, const Case* c, int threads) {
	double seconds[MOST_REPEATS];
	Sample last = {0};
	JN_TRY(run_case(c, threads, seconds, &last));
	report_case(bench, c, threads, summarize(seconds, c->repeats), &last);
	return JN_OK;
}

static JnStatus measure_headline(const Bench* bench, const char* name, const Case both[2]) {
	double seconds[2], per_second[2];
	for (int i = 0; i < 2; ++i) {
		Sample last = {0};
		JN_TRY(run_case(&both[i], 1, &seconds[i], &last));
		per_second[i] = last.seconds / last.simulated;
	}
	const double ratio = per_second[1] / per_second[0];
	Row row = {.group = "headline", .name = name, .size = both[0].size, .threads = 1};
	row.width = jn_kernel_best_width();
	row.value = (Timing){ratio, ratio, ratio};
	row.unit = "times";
	bench_report(bench, &row);
	return JN_OK;
}

JnStatus bench_steps(const Bench* bench) {
	for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
		const Case* c = &cases[i];
		char name[80];
		name_of(c, sizeof name, name);
		if (!bench_wants(bench, "step", name, c->size)) continue;
		JN_TRY(measure_case(bench, c, 1));
		if (bench->threads > 1 && !c->one_thread_only) JN_TRY(measure_case(bench, c, bench->threads));
	}
	for (size_t i = 0; i < sizeof headlines / sizeof *headlines; ++i)
		if (bench_wants(bench, "headline", headlines[i].name, headlines[i].of[0].size))
			JN_TRY(measure_headline(bench, headlines[i].name, headlines[i].of));
	return JN_OK;
}
