// jounce reproduce: make figures and tables of the papers again, each as a page with pictures beside the paper's
// numbers.
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "app.h"
#include "base/key.h"
#include "base/log.h"
#include "options.h"
#include "reproduce/study.h"

static const char help[] =
	"usage: jounce reproduce NAME ... [--quick] [-o DIR] [--scenes DIR] [--jobs N] [--threads N] [--quiet]\n"
	"       jounce reproduce list\n\n"
	"  --quick           coarser meshes and shorter runs: under two minutes each on two processors\n"
	"  -o, --output DIR  where results go; default out/reproduce, and there a folder for each name\n"
	"  --scenes DIR      where the scene files are; default scenes\n"
	"  --jobs N          runs at a time; default: as many as keep the processors busy, and one where time is measured\n"
	"  --threads N       of each run; default 1\n"
	"  -q, --quiet       no progress\n\n"
	"Writes index.html, page.md, tables as CSV and pictures with their gnuplot scripts. Each run is a folder in "
	"runs/;\n"
	"one that is done is not run again unless its scene or settings have changed, so that the same command goes on "
	"after\n"
	"Ctrl-C. Runs that fail are shown as such on the page.\n\n"
	"exit status: 0 all done, or stopped by Ctrl-C; 1 a run failed; 2 bad input; 3 files";

static const struct option known[] = {
	{"help", no_argument, NULL, 'h'},          {"jobs", required_argument, NULL, 'j'},
	{"output", required_argument, NULL, 'o'},  {"quick", no_argument, NULL, 'k'},
	{"quiet", no_argument, NULL, 'q'},         {"scenes", required_argument, NULL, 's'},
	{"threads", required_argument, NULL, 't'}, {0},
};

static int read_option(int option, char** arguments, ReproduceOptions* options) {
	switch (option) {
	case 'h':
		options->wants_help = true;
		return EXIT_DONE;
	case 'j':
		return app_read_count("reproduce", "jobs", &options->jobs);
	case 'k':
		options->is_quick = true;
		return EXIT_DONE;
	case 'o':
		options->directory = optarg;
		return EXIT_DONE;
	case 'q':
		options->is_quiet = true;
		return EXIT_DONE;
	case 's':
		options->scenes = optarg;
		return EXIT_DONE;
	case 't':
		return app_read_count("reproduce", "threads", &options->threads);
	case ':':
		return app_usage_error("reproduce", "%s needs a value behind it", arguments[optind - 1]);
	default:
		return app_refuse_option("reproduce", known, arguments);
	}
}

static const char* study_name(void* context, int index) {
	(void)context;
	return study_list[index] != NULL ? study_list[index]->name : NULL;
}

static const Study* find(const char* name) {
	for (int i = 0; study_list[i] != NULL; ++i)
		if (strcmp(study_list[i]->name, name) == 0) return study_list[i];
	return NULL;
}

static int check_names(const ReproduceOptions* options) {
	for (int i = 0; i < options->name_count; ++i) {
		const char* name = options->names[i];
		if (find(name) != NULL) continue;
		const char* near = jn_suggest(name, study_name, NULL);
		if (near != NULL)
			return app_usage_error("reproduce", "there is nothing called '%s'; did you mean '%s'?", name, near);
		return app_usage_error("reproduce", "there is nothing called '%s'; 'jounce reproduce list' shows all", name);
	}
	return EXIT_DONE;
}

static int read_options(int count, char** arguments, ReproduceOptions* options) {
	opterr = 0; // the words are ours
	*options = (ReproduceOptions){.directory = "out/reproduce", .scenes = "scenes", .threads = 1};
	for (int option; (option = getopt_long(count, arguments, ":ho:q", known, NULL)) != -1;) {
		const int status = read_option(option, arguments, options);
		if (status != EXIT_DONE) return status;
	}
	options->name_count = count - optind;
	options->names = (const char**)arguments + optind;
	return EXIT_DONE;
}

static void print_list(void) {
	for (int i = 0; study_list[i] != NULL; ++i) printf("%-12s %s\n", study_list[i]->name, study_list[i]->doc);
}

static int reproduce(const ReproduceOptions* options) {
	int exit_status = EXIT_DONE;
	bool was_stopped = false;
	for (int i = 0; i < options->name_count && !was_stopped; ++i) {
		int failed = 0;
		const JnStatus status = study_carry_out(find(options->names[i]), options, &failed, &was_stopped);
		if (status != JN_OK) return app_exit_status(status);
		if (failed > 0) exit_status = EXIT_RUN_FAILED;
	}
	clearerr(stdout); // what counts is on disk; progress that nobody reads is no failure
	return exit_status;
}

int app_reproduce(int count, char** arguments) {
	ReproduceOptions options;
	int status = read_options(count, arguments, &options);
	if (status != EXIT_DONE) return status;
	if (options.wants_help) return puts(help), EXIT_DONE;
	if (options.name_count == 0 || strcmp(options.names[0], "list") == 0) return print_list(), EXIT_DONE;
	status = check_names(&options);
	return status == EXIT_DONE ? reproduce(&options) : status;
}
