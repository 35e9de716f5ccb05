#include "reproduce/spring_tune.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "jounce/scene.h"

enum { BISECTIONS = 44, MOST_TIMES = 10 }; // a run that costs that many times the target has been too dear for long

static const double lowest = 1e-9, highest = 1; // of the tuned number

typedef struct Run {
	JnScene* scene;
	JnSim* sim;
} Run;

static void close_run(Run* run) {
	jn_sim_destroy(run->sim);
	jn_scene_destroy(run->scene);
}

static JnStatus open_run(const char* scene, const char* method, const char* step, Run* run) {
	char text[64];
	snprintf(text, sizeof text, "integrator={method: %s}", method);
	const char* const sets[] = {text, step};
	*run = (Run){0};
	JnStatus status = jn_scene_load(scene, 2, sets, &run->scene);
	if (status == JN_OK) status = jn_scene_build(run->scene, 1, &run->sim);
	if (status != JN_OK) close_run(run);
	return status;
}

void spring_step_text(const SpringWay* way, double value, int size, char* text) {
	const int used = snprintf(text, (size_t)size, "step=");
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
	snprintf(text + used, (size_t)(size - used), way->step, value);
#pragma GCC diagnostic pop
}

static JnStatus count_run(const char* scene, const char* method, const SpringWay* way, SpringGoal goal, double value,
						  int most, int* count) {
	char step[256];
	Run run;
	spring_step_text(way, value, sizeof step, step);
	JN_TRY(open_run(scene, method, step, &run));
	JnStatus status = JN_OK;
	*count = 0;
	while (status == JN_OK && !jn_sim_is_done(run.sim) && *count < most) {
		status = jn_sim_step(run.sim);
		*count += goal == SPRING_STEPS ? 1 : jn_sim_last_report(run.sim)->factorizations;
	}
	close_run(&run);
	return status;
}

JnStatus spring_tune(const char* scene, const char* method, const SpringWay* way, SpringGoal goal, int target,
					 SpringTuned* tuned) {
	double low = log(lowest), high = log(highest);
	*tuned = (SpringTuned){.value = highest, .count = 0};
	for (int i = 0; i < BISECTIONS && tuned->count != target; ++i) {
		const double value = exp(0.5 * (low + high));
		int count = 0;
		JN_TRY(count_run(scene, method, way, goal, value, MOST_TIMES * target, &count));
		if (abs(count - target) < abs(tuned->count - target)) *tuned = (SpringTuned){value, count};
		*(count > target ? &low : &high) = log(value);
	}
	return JN_OK;
}

JnStatus spring_sample(const char* scene, const char* method, int parts, int count, double* x) {
	Run run;
	char step[64];
	JN_TRY(open_run(scene, method, "step={dt: 1 ms}", &run));
	const double duration = jn_scene_def(run.scene)->sim.duration;
	close_run(&run);
	snprintf(step, sizeof step, "step={dt: %.17g s}", duration / (count - 1) / parts);
	JN_TRY(open_run(scene, method, step, &run));
	JnStatus status = JN_OK;
	x[0] = jn_sim_state(run.sim)->x[0];
	for (int i = 1; i < count && status == JN_OK; ++i) {
		for (int k = 0; k < parts && status == JN_OK; ++k) status = jn_sim_step(run.sim);
		x[i] = jn_sim_state(run.sim)->x[0];
	}
	close_run(&run);
	return status;
}
