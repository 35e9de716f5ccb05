// jounce score: the largest stable step of each integrator on a scene, over the time of a step.
#include "score.h"

#include <stdio.h>

#include "app.h"
#include "base/folder.h"
#include "interrupt.h"

static const char help[] =
	"usage: jounce score SCENE [--methods a,b,c | --methods all] [--time T] [--cap DT] [--factor F]\n"
	"                    [--set key=value ...] [-o DIR] [--threads N] [--quiet]\n\n"
	"  --methods a,b,c   integrators; default: explicit_euler, midpoint, modified_midpoint, half_step,\n"
	"                    modified_half_step, symplectic_euler, verlet, forest_ruth, rk4\n"
	"  --time T          simulated time that a step must survive; default: the scene's duration\n"
	"  --cap DT          no larger step is tried; default: a fiftieth of that time\n"
	"  --factor F        stable: the total energy stays within F times the energy in motion; default 100\n"
	"  --set key=value   override a key in all runs\n"
	"  -o, --output DIR  where results go; default out/<name of the scene>_score\n"
	"  --threads N       of each run; default 1\n"
	"  -q, --quiet       no progress, no table\n\n"
	"For each integrator the largest stable step, by bisection; the time of a step; and their ratio, relative to that "
	"of\n"
	"explicit Euler. Steps are fixed; contact, relaxation and whatever else the scene has run as they are. Writes "
	"score.txt,\n"
	"score.csv and score.md. Ctrl-C ends the search and writes what is known.\n\n"
	"exit status: 0 done, or stopped by Ctrl-C; 1 a run failed; 2 bad input; 3 files";

static void print_end(const Score* score) {
	if (score->was_stopped) puts("stopped as asked; the table has what was known");
	if (score->scale > 0) putchar('\n');
	if (score->scale > 0) score_table_print(score, stdout);
	if (score->scale > 0) printf("\nwrote %s: score.txt, score.csv, score.md\n", score->directory);
	fflush(stdout);
	clearerr(stdout); // what counts is on disk; a table that nobody reads is no failure
}

static JnStatus measure(Score* score) {
	const ScoreOptions* options = score->options;
	JN_TRY(jn_folder_make(score->directory));
	app_catch_interrupts(SA_RESTART);
	score->stop = &app_interrupted;
	if (!options->is_quiet)
		printf("%s: %d method%s over %g s each\n", options->scene, score->count, score->count == 1 ? "" : "s",
			   score->time);
	fflush(stdout);
	JN_TRY(score_measure(score));
	if (score->scale > 0) JN_TRY(score_tables_write(score));
	if (!options->is_quiet) print_end(score);
	return JN_OK;
}

int app_score(int count, char** arguments) {
	ScoreOptions options;
	Score score = {0};
	int status = score_options_read(count, arguments, &options);
	if (status == EXIT_DONE && options.wants_help)
		puts(help);
	else if (status == EXIT_DONE) {
		status = score_plan(&options, &score);
		if (status == EXIT_DONE) status = app_exit_status(measure(&score));
	}
	score_free(&score);
	score_options_free(&options);
	return status;
}
