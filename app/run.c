// jounce run: simulate a scene and record it.
#include <stdio.h>

#include "app.h"
#include "interrupt.h"
#include "options.h"
#include "run_display.h"

static const char help[] =
	"usage: jounce run SCENE [-o DIR] [--set key=value ...] [--threads N] [--steps N] [--realtime[=SPEED]]\n"
	"                  [--quiet]\n\n"
	"  -o, --output DIR  where results go; default out/<name of the scene>\n"
	"  --set key=value   override any key: --set integrator.method=sdirk2 --set step.dt=33ms\n"
	"  --threads N       default: as many as there are processors\n"
	"  --steps N         stop after N steps, if the duration has not ended the run before\n"
	"  --realtime=SPEED  wait for the clock, SPEED simulated seconds a second (1 by default), and report missed "
	"deadlines\n"
	"  -q, --quiet       no progress, no summary\n\n"
	"Writes run.h5, run.xdmf and surface.xdmf (ParaView; obstacles.xdmf too, if there are any), series.csv,\n"
	"summary.json, plots/ and checkpoints/, over those of an earlier run.\n"
	"Ctrl-C finishes the step and completes the files (exit status 0, outcome \"interrupted\"); a second one ends at "
	"once.\n'jounce resume DIR' goes on.";

static JnStatus simulate(const SceneOptions* options, const JnScene* scene) {
	char directory[128];
	const JnSceneDef* def = jn_scene_def(scene);
	RunDisplay display = run_display_begin(options->is_quiet);
	display.steps = options->steps;
	snprintf(directory, sizeof directory, "out/%s", def->name);
	const JnRunOptions run = {.directory = options->directory != NULL ? options->directory : directory,
							  .threads = options->threads,
							  .speed = options->speed,
							  .progress = run_display_progress,
							  .user = &display};
	if (!options->is_quiet)
		printf("%s: '%s' with %s over %g s\n", options->scene, def->name, def->sim.integrator.row->name,
			   def->sim.duration);
	fflush(stdout);
	JnRunResult result;
	jn_log_set_sink(run_display_message, &display);
	const JnStatus status = jn_scene_run(scene, &run, &result);
	jn_log_set_sink(NULL, NULL);
	if (!options->is_quiet && result.frames > 0) run_display_end(&display, &result, run.directory);
	fflush(stdout);
	clearerr(stdout); // what counts is on disk; progress that nobody reads is no failure
	return status;
}

static int run_scene(const SceneOptions* options) {
	JnScene* scene = NULL;
	JnStatus status = jn_scene_load(options->scene, options->set_count, options->sets, &scene);
	if (status != JN_OK) return app_exit_status(status);
	app_catch_interrupts(SA_RESTART);
	status = simulate(options, scene);
	jn_scene_destroy(scene);
	return app_exit_status(status);
}

int app_run(int count, char** arguments) {
	SceneOptions options;
	int status = scene_options_read("run", count, arguments, &options);
	if (status == EXIT_DONE && options.wants_help)
		puts(help);
	else if (status == EXIT_DONE)
		status = run_scene(&options);
	scene_options_free(&options);
	return status;
}
