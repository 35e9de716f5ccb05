// Each combination is loaded and built, the reference first, with which the others must share mesh and duration.
#include "compare_check.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "app.h"
#include "base/log.h"
#include "jounce/scene.h"

// What all runs must share with the reference.
typedef struct Common {
	double duration; // [s]
	int node_count;
	double* rest; // positions [m]; NULL without reference
} Common;

// Every run says the same warnings again when it starts; an error names the combination in front.
static void name_run(void* user, JnLogLevel level, const char* message) {
	const CompareRun* run = user;
	if (level != JN_LOG_ERROR) return;
	fprintf(stderr, "jounce: error: %s: %s\n", run->is_reference ? "the reference" : run->label, message);
}

// Rest positions of a model; a system of equations rests where it starts.
static const double* rest_of(JnSim* sim) {
	JnModel* model = jn_sim_model(sim);
	return model != NULL ? jn_model_rest(model) : jn_sim_state(sim)->x;
}

static int nodes_of(JnSim* sim) {
	return (int)(jn_sim_system(sim)->space->length / 3);
}

static JnStatus keep_common(JnSim* sim, double duration, Common* common) {
	assert(common->rest == NULL); // there is one reference
	common->duration = duration;
	common->node_count = nodes_of(sim);
	const size_t bytes = 3 * (size_t)common->node_count * sizeof(double);
	common->rest = malloc(bytes);
	if (common->rest == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: no room for %zu bytes", bytes);
	memcpy(common->rest, rest_of(sim), bytes);
	return JN_OK;
}

static JnStatus compare_common(JnSim* sim, double duration, const Common* common) {
	if (common->rest == NULL) return JN_OK;
	if (duration != common->duration)
		return jn_error(JN_BAD_INPUT,
						"the run ends at %g s and the reference at %g s, so that their ends cannot be compared; give "
						"both one duration",
						duration, common->duration);
	if (nodes_of(sim) != common->node_count)
		return jn_error(JN_BAD_INPUT,
						"the run has %d nodes and the reference %d, so that they cannot be compared node by node; give "
						"both one mesh",
						nodes_of(sim), common->node_count);
	if (memcmp(rest_of(sim), common->rest, 3 * (size_t)common->node_count * sizeof(double)) != 0)
		return jn_error(JN_BAD_INPUT, "the nodes of the run and of the reference lie elsewhere at rest, so that they "
									  "cannot be compared node by node; give both one mesh");
	return JN_OK;
}

static JnStatus check_scene(const CompareOptions* options, const JnScene* scene, CompareRun* run, Common* common) {
	JnSim* sim = NULL;
	const JnSceneDef* def = jn_scene_def(scene);
	JnStatus status = jn_scene_build(scene, options->threads, &sim);
	if (status == JN_OK) run->work = def->sim.duration / jn_sim_next_dt(sim);
	if (status == JN_OK && run->is_reference)
		status = keep_common(sim, def->sim.duration, common);
	else if (status == JN_OK)
		status = compare_common(sim, def->sim.duration, common);
	jn_sim_destroy(sim);
	return status;
}

// The first scene that is checked names the comparison.
static JnStatus name_comparison(const CompareOptions* options, const JnScene* scene, ComparePlan* plan) {
	char directory[128];
	if (plan->scene_name != NULL) return JN_OK;
	snprintf(directory, sizeof directory, "out/%s_compare", jn_scene_def(scene)->name);
	plan->scene_name = jn_arena_text(&plan->arena, jn_scene_def(scene)->name);
	plan->directory = options->directory != NULL ? options->directory : jn_arena_text(&plan->arena, directory);
	return plan->scene_name != NULL && plan->directory != NULL ? JN_OK : JN_OUT_OF_MEMORY;
}

static JnStatus check_run(const CompareOptions* options, ComparePlan* plan, CompareRun* run, Common* common) {
	JnScene* scene = NULL;
	jn_log_set_sink(name_run, run);
	JnStatus status = jn_scene_load(options->scene, run->set_count, run->sets, &scene);
	if (status == JN_OK) status = check_scene(options, scene, run, common);
	if (status == JN_OK) status = name_comparison(options, scene, plan);
	jn_scene_destroy(scene);
	jn_log_set_sink(NULL, NULL);
	return status;
}

int compare_plan_check(const CompareOptions* options, ComparePlan* plan) {
	Common common = {0};
	JnStatus status = JN_OK;
	if (plan->has_reference) status = check_run(options, plan, &plan->runs[plan->run_count - 1], &common);
	for (int i = 0; i < plan->run_count - plan->has_reference && status == JN_OK; ++i)
		status = check_run(options, plan, &plan->runs[i], &common);
	free(common.rest);
	return app_exit_status(status);
}
