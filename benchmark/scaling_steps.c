// Whole steps of blocks of growing size, from rest, with the solver that chooses; the memory of the process after them.
#include <stdio.h>
#include <sys/resource.h>

#include "bench.h"

static void report_memory(const Bench* bench, const char* size, int threads) {
	struct rusage usage;
	if (getrusage(RUSAGE_SELF, &usage) != 0) return;
	const double peak = 1e-3 * 1.024 * (double)usage.ru_maxrss;
	const Row row = {.group = "scaling",
					 .name = "memory.peak",
					 .size = size,
					 .threads = threads,
					 .value = {peak, peak, peak},
					 .unit = "MB"};
	bench_report(bench, &row);
}

static JnStatus measure_steps(const Bench* bench, const char* size, const char* dt, int steps, int threads) {
	char name[64], set_dt[64];
	snprintf(name, sizeof name, "step.%s", dt);
	if (!bench_wants(bench, "scaling", name, size)) return JN_OK;
	const SceneOf of = scene_of(size);
	snprintf(set_dt, sizeof set_dt, "step.dt=%s", dt);
	const char* const sets[] = {"solver.method=auto", set_dt, "duration=1000s", of.cells};
	JnScene* scene = NULL;
	JnSim* sim = NULL;
	JN_TRY(jn_scene_load(of.path, 4, sets, &scene));
	JnStatus status = jn_sim_create(&jn_scene_def(scene)->sim, threads, &sim);
	const double start = clock_for(threads);
	for (int i = 0; i < steps && status == JN_OK; ++i) status = jn_sim_step(sim);
	const double seconds = (clock_for(threads) - start) / steps;
	if (status == JN_OK) {
		const Row row = {.group = "scaling",
						 .name = name,
						 .size = size,
						 .threads = threads,
						 .width = jn_kernel_best_width(),
						 .value = timing_in((Timing){seconds, seconds, seconds}, 1e-3, 1),
						 .unit = "ms/step",
						 .rate = seconds * steps / jn_sim_state(sim)->t,
						 .rate_unit = "s/s"};
		bench_report(bench, &row);
		report_memory(bench, size, threads);
	}
	jn_sim_destroy(sim);
	jn_scene_destroy(scene);
	return status;
}

JnStatus bench_scaling_steps(const Bench* bench, const char* size, int steps, int threads) {
	JN_TRY(measure_steps(bench, size, "5ms", steps, threads));
	return measure_steps(bench, size, "33ms", steps, threads);
}
