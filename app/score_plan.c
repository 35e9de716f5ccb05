// Names into methods, and the scene built once for each: what it refuses is refused before any run.
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "app.h"
#include "base/key.h"
#include "base/log.h"
#include "integrate/integrator.h"
#include "score_trial.h"

static const char nine[] =
	"explicit_euler,midpoint,modified_midpoint,half_step,modified_half_step,symplectic_euler,verlet,"
	"forest_ruth,rk4";
static const char first_name[] = "explicit_euler"; // scores are relative to it where it is among the methods
static const double steps_least = 50;              // of a run with the largest step that is tried

static const char* method_name(void* context, int index) {
	(void)context;
	return index < jn_integrator_list.count ? jn_integrator_list.rows[index]->name : NULL;
}

static const JnIntegratorType* type_named(const char* name) {
	return (const JnIntegratorType*)jn_row_find(&jn_integrator_list, name);
}

static int add_method(Score* score, const char* name) {
	const JnIntegratorType* type = type_named(name);
	if (type == NULL) {
		const char* near = jn_suggest(name, method_name, NULL);
		if (near != NULL)
			return app_usage_error("score", "--methods: there is no integrator '%s'; did you mean '%s'?", name, near);
		return app_usage_error("score", "--methods: there is no integrator '%s'; 'jounce list integrators' shows all",
							   name);
	}
	if (score_find(score, name) != NULL) return app_usage_error("score", "--methods: '%s' comes twice", name);
	if (strcmp(name, first_name) == 0) score->first = score->count;
	score->list[score->count++] =
		(ScoreMethod){.type = type, .limit = NAN, .seconds = NAN, .forces = NAN, .error_half = NAN, .error_scene = NAN};
	return EXIT_DONE;
}

static int add_methods(Score* score) {
	const char* names = score->options->methods != NULL ? score->options->methods : nine;
	const bool is_all = strcmp(names, "all") == 0;
	score->list = jn_arena_take(&score->arena, (size_t)jn_integrator_list.count, sizeof *score->list);
	if (score->list == NULL) return EXIT_RUN_FAILED;
	for (int i = 0; i < jn_integrator_list.count && is_all; ++i) add_method(score, jn_integrator_list.rows[i]->name);
	while (!is_all) {
		char name[64];
		const size_t length = strcspn(names, ",");
		snprintf(name, sizeof name, "%.*s", (int)length, names);
		const int status = add_method(score, name);
		if (status != EXIT_DONE) return status;
		if (names[length] == '\0') break;
		names += length + 1;
	}
	return EXIT_DONE;
}

// The scene's own words: its name, its duration, its step.
static JnStatus read_scene(Score* score) {
	const ScoreOptions* options = score->options;
	JnScene* scene = NULL;
	JnSim* sim = NULL;
	char directory[128];
	JN_TRY(jn_scene_load(options->scene, options->sets.count, options->sets.words, &scene));
	const JnSceneDef* def = jn_scene_def(scene);
	snprintf(directory, sizeof directory, "out/%s_score", def->name);
	score->name = jn_arena_text(&score->arena, def->name);
	score->directory = options->directory != NULL ? options->directory : jn_arena_text(&score->arena, directory);
	score->time = options->time > 0 ? options->time : def->sim.duration;
	score->cap = options->cap > 0 ? options->cap : score->time / steps_least;
	JnStatus status = score->name == NULL || score->directory == NULL ? JN_OUT_OF_MEMORY : JN_OK;
	if (status == JN_OK && score->cap > score->time)
		status = jn_error(JN_BAD_INPUT,
						  "--cap: no step of %g s fits into a run of %g s; give a longer --time, or a smaller cap",
						  score->cap, score->time);
	if (status == JN_OK) status = jn_scene_build(scene, options->threads, &sim);
	if (status == JN_OK) score->dt = jn_sim_next_dt(sim);
	jn_sim_destroy(sim);
	jn_scene_destroy(scene);
	return status;
}

static JnStatus check_method(const Score* score, const JnIntegratorType* type) {
	ScoreSim run;
	const JnStatus status = score_sim_open(score->options, type, fmin(score->dt, score->cap), score->time, &run);
	score_sim_close(&run);
	return status;
}

static void say_nothing(void* user, JnLogLevel level, const char* message) {
	(void)user;
	(void)level;
	(void)message;
}

// RK4 is cheap and exact where masses are lumped; elsewhere an implicit method of second order must do.
static void choose_reference(Score* score) {
	const JnLog before = jn_log_swap((JnLog){say_nothing, NULL});
	score->reference = type_named("rk4");
	if (check_method(score, score->reference) != JN_OK) score->reference = type_named("sdirk2");
	jn_log_swap(before);
}

int score_plan(const ScoreOptions* options, Score* score) {
	*score = (Score){.options = options, .is_terminal = isatty(STDOUT_FILENO) != 0};
	const int status = add_methods(score);
	if (status != EXIT_DONE) return status;
	JnStatus checked = read_scene(score);
	for (int i = 0; i < score->count && checked == JN_OK; ++i) checked = check_method(score, score->list[i].type);
	if (checked == JN_OK) choose_reference(score);
	return app_exit_status(checked);
}

void score_free(Score* score) {
	jn_arena_free(&score->arena);
}

const ScoreMethod* score_find(const Score* score, const char* name) {
	for (int i = 0; i < score->count; ++i)
		if (strcmp(score->list[i].type->row.name, name) == 0) return &score->list[i];
	return NULL;
}
