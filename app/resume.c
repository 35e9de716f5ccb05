// jounce resume: go on with a run in its folder.
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>

#include "app.h"
#include "interrupt.h"
#include "options.h"
#include "run_display.h"

static const char help[] =
	"usage: jounce resume DIR [--from FILE] [--latest] [--set key=value ...] [--threads N] [--quiet]\n\n"
	"Goes on with the run in DIR after Ctrl-C, a kill, a full disk or a failure, from the newest of DIR/checkpoints, "
	"and with\n"
	"the scene and the overrides that it began with. Its series and frames become those of a run without a break, bit "
	"for bit.\n\n"
	"  --from FILE      the checkpoint to go on from, such as step-0000001200.jnc\n"
	"  --latest         where the run ended, even if the bits of what follows may be others\n"
	"  --set key=value  override more, such as step.dt=1ms or duration=20s; nodes, method and controller must stay.\n"
	"                   Implies --latest: a run that failed goes on from its last good state\n"
	"  --threads N      default: as many as there are processors; the bits do not depend on it\n"
	"  -q, --quiet      no progress, no summary";

static const struct option known[] = {
	{"from", required_argument, NULL, 'f'},
	{"help", no_argument, NULL, 'h'},
	{"latest", no_argument, NULL, 'l'},
	{"quiet", no_argument, NULL, 'q'},
	{"set", required_argument, NULL, 's'},
	{"threads", required_argument, NULL, 't'},
	{0},
};

typedef struct Options {
	JnResumeOptions resume;
	bool is_quiet, wants_help;
	const char** sets;
} Options;

static int read_option(int option, char** arguments, Options* options) {
	JnResumeOptions* resume = &options->resume;
	switch (option) {
	case 'f':
		resume->from = optarg;
		return EXIT_DONE;
	case 'h':
		options->wants_help = true;
		return EXIT_DONE;
	case 'l':
		resume->takes_latest = true;
		return EXIT_DONE;
	case 'q':
		options->is_quiet = true;
		return EXIT_DONE;
	case 's':
		options->sets[resume->set_count++] = optarg;
		resume->takes_latest = true;
		return EXIT_DONE;
	case 't':
		return app_read_count("resume", "threads", &resume->run.threads);
	case ':':
		return app_usage_error("resume", "%s needs a value behind it", arguments[optind - 1]);
	default:
		return app_refuse_option("resume", known, arguments);
	}
}

static int read_options(int count, char** arguments, Options* options) {
	opterr = 0; // the words are ours
	*options = (Options){.sets = calloc((size_t)count + 1, sizeof *options->sets)};
	if (options->sets == NULL) return EXIT_RUN_FAILED;
	options->resume.sets = options->sets;
	for (int option; (option = getopt_long(count, arguments, ":hq", known, NULL)) != -1;) {
		const int status = read_option(option, arguments, options);
		if (status != EXIT_DONE) return status;
	}
	if (options->wants_help) return EXIT_DONE;
	if (optind == count) return app_usage_error("resume", "no folder of a run is given");
	if (optind + 1 < count)
		return app_usage_error("resume", "one run at a time; '%s' is one too many", arguments[optind + 1]);
	options->resume.run.directory = arguments[optind];
	return EXIT_DONE;
}

static int resume(const Options* options) {
	RunDisplay display = run_display_begin(options->is_quiet);
	JnRunResult result;
	JnResumeOptions resumed = options->resume;
	resumed.run.progress = run_display_progress;
	resumed.run.user = &display;
	app_catch_interrupts(SA_RESTART);
	jn_log_set_sink(run_display_message, &display);
	const JnStatus status = jn_scene_resume(&resumed, &result);
	jn_log_set_sink(NULL, NULL);
	if (!options->is_quiet && result.frames > 0) {
		if (status == JN_OK) printf("resumed after step %ld\n", result.resumed_at);
		run_display_end(&display, &result, options->resume.run.directory);
	}
	fflush(stdout);
	clearerr(stdout); // what counts is on disk; progress that nobody reads is no failure
	return app_exit_status(status);
}

int app_resume(int count, char** arguments) {
	Options options;
	int status = read_options(count, arguments, &options);
	if (status == EXIT_DONE && options.wants_help)
		puts(help);
	else if (status == EXIT_DONE)
		status = resume(&options);
	free(options.sets);
	return status;
}
