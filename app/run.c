// jounce run: simulate a scene and record it, with a progress bar on a terminal and plain lines elsewhere.
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "app.h"
#include "base/timer.h"
#include "jounce/scene.h"
#include "options.h"

static const char help[] = "usage: jounce run SCENE [-o DIR] [--set key=value ...] [--threads N] [--quiet]\n\n"
						   "  -o DIR           where results go; default out/<scene name>\n"
						   "  --set key=value  override any key: --set integrator.method=sdirk2 --set step.dt=33ms\n"
						   "  --threads N      threads; default: all\n"
						   "  --quiet          no progress, no summary\n\n"
						   "Writes run.h5, run.xdmf (ParaView), series.csv, summary.json and plots/. Ctrl-C finishes "
						   "the step and writes what\n"
						   "there is.";

static volatile sig_atomic_t interrupted = 0;

static void on_interrupt(int signal_number) {
	(void)signal_number;
	interrupted = 1;
}

typedef struct Display {
	bool is_quiet, is_terminal;
	double last; // time of the last line [s]
} Display;

static void format_duration(double seconds, char* out, size_t size) {
	if (!isfinite(seconds) || seconds > 359999)
		snprintf(out, size, "--:--");
	else if (seconds >= 3600)
		snprintf(out, size, "%d:%02d:%02d", (int)seconds / 3600, (int)seconds / 60 % 60, (int)seconds % 60);
	else
		snprintf(out, size, "%d:%02d", (int)seconds / 60, (int)seconds % 60);
}

static void print_progress(const Display* display, const JnProgress* p) {
	enum { BAR = 20 };
	char bar[BAR + 1], left[24];
	const double share = p->t_end > 0 ? p->t / p->t_end : 1;
	const double pace = p->t > 0 ? p->wall_seconds / p->t : 0;
	const int full = (int)(share * BAR + 0.5);
	for (int i = 0; i < BAR; ++i) bar[i] = i < full ? '#' : '.';
	bar[BAR] = '\0';
	format_duration(pace * (p->t_end - p->t), left, sizeof left);
	if (display->is_terminal)
		printf("\r[%s] %3.0f%%  t %.4g/%g s  pace %.3g s/s  dt %.3g s  newton %d  drift %.2e J/kg  left %s \033[K", bar,
			   100 * share, p->t, p->t_end, pace, p->dt, p->newton, p->specific_error, left);
	else
		printf("t %.6g of %g s, step %ld, pace %.3g s/s, dt %.3g s, newton %d, drift %.3e J/kg, left %s\n", p->t,
			   p->t_end, p->steps, pace, p->dt, p->newton, p->specific_error, left);
	fflush(stdout);
}

static bool on_progress(void* user, const JnProgress* p) {
	Display* display = user;
	const double pause = display->is_terminal ? 0.1 : 5, now = jn_seconds();
	if (!display->is_quiet && now - display->last >= pause) {
		print_progress(display, p);
		display->last = now;
	}
	return !interrupted;
}

static void print_summary(const Display* display, const JnRunResult* r, double t_end, const char* directory) {
	if (display->is_terminal) printf("\r\033[K");
	if (r->was_stopped) printf("stopped at t = %.6g of %g s, as asked\n", r->t, t_end);
	printf("%ld steps to t = %g s in %.3g s of wall time (%.3g s per simulated s)\n", r->steps, r->t, r->wall_seconds,
		   r->t > 0 ? r->wall_seconds / r->t : 0);
	printf("%.2f Newton iterations a step, %ld factorisations, %ld rejected steps\n",
		   r->steps > 0 ? (double)r->newton / (double)r->steps : 0, r->factorizations, r->rejected);
	printf("energy error |e(t) - e(0)|: %.6g J/kg\n", r->specific_error);
	printf("wrote %s: run.h5 (%ld frames), run.xdmf, series.csv, summary.json, plots/\n", directory, r->frames);
}

static JnStatus simulate(const SceneOptions* options, const JnScene* scene) {
	char directory[512];
	const JnSceneDef* def = jn_scene_def(scene);
	Display display = {.is_quiet = options->is_quiet, .is_terminal = isatty(STDOUT_FILENO) != 0, .last = jn_seconds()};
	snprintf(directory, sizeof directory, "out/%s", def->name);
	const JnRunOptions run = {.directory = options->directory != NULL ? options->directory : directory,
							  .threads = options->threads,
							  .progress = on_progress,
							  .user = &display};
	if (!options->is_quiet)
		printf("%s: '%s' with %s over %g s\n", options->scene, def->name, def->sim.integrator.row->name,
			   def->sim.duration);
	fflush(stdout);
	JnRunResult result;
	const JnStatus status = jn_scene_run(scene, &run, &result);
	if (!options->is_quiet && (status == JN_OK || result.steps > 0))
		print_summary(&display, &result, def->sim.duration, run.directory);
	return status;
}

static int run_scene(const SceneOptions* options) {
	JnScene* scene = NULL;
	JnStatus status = jn_scene_load(options->scene, options->set_count, options->sets, &scene);
	if (status != JN_OK) return app_exit_status(status);
	const struct sigaction action = {.sa_handler = on_interrupt, .sa_flags = (int)SA_RESETHAND};
	sigaction(SIGINT, &action, NULL);
	sigaction(SIGTERM, &action, NULL);
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
