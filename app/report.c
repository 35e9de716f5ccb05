// jounce report: one page about runs.
#include "report.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>

#include "app.h"
#include "interrupt.h"
#include "options.h"
#include "recording_file.h"
#include "render_sources.h"

enum { USUAL_PICTURES = 6, MOST_PICTURES = 60 };

static const char help[] =
	"usage: jounce report DIR... [-o report.html] [--pictures N] [--color FIELD] [--title WORDS]\n\n"
	"Writes one page that needs nothing but itself: pictures at times evenly spaced, energies, steps, iterations and "
	"probes\n"
	"over time, a table of statistics with where the time went, the scene and the machine. Of several runs also what "
	"differs\n"
	"between their scenes, and how far apart their ends are.\n\n"
	"  -o, --output FILE  default: report.html in the first DIR\n"
	"      --pictures N   0: none; default 6. They are drawn by Chromium; without it the page has none, and says so\n"
	"      --color FIELD  colours the pictures: displacement, speed, or another of the recording\n"
	"      --title WORDS  default: the names of the scenes\n"
	"  -q, --quiet        say nothing\n\n"
	"exit status: 0 done; 2 bad input; 3 files";

static const struct option known[] = {
	{"help", no_argument, NULL, 'h'},           {"color", required_argument, NULL, 'f'},
	{"colour", required_argument, NULL, 'f'},   {"output", required_argument, NULL, 'o'},
	{"pictures", required_argument, NULL, 'p'}, {"quiet", no_argument, NULL, 'q'},
	{"title", required_argument, NULL, 't'},    {0},
};

typedef struct Command {
	ReportOptions report;
	bool wants_help, is_quiet;
} Command;

static int read_pictures(int* pictures) {
	char* end = NULL;
	const long number = strtol(optarg, &end, 10);
	if (end == optarg || *end != '\0' || number < 0 || number > MOST_PICTURES)
		return app_usage_error("report", "--pictures: '%s' is no whole number from 0 to %d", optarg, MOST_PICTURES);
	*pictures = (int)number;
	return EXIT_DONE;
}

static int read_option(int option, char** arguments, Command* command) {
	switch (option) {
	case 'h':
		command->wants_help = true;
		return EXIT_DONE;
	case 'q':
		command->is_quiet = true;
		return EXIT_DONE;
	case 'f':
		command->report.field = optarg;
		return EXIT_DONE;
	case 'o':
		command->report.output = optarg;
		return EXIT_DONE;
	case 'p':
		return read_pictures(&command->report.pictures);
	case 't':
		command->report.title = optarg;
		return EXIT_DONE;
	case ':':
		return app_usage_error("report", "%s needs a value behind it", arguments[optind - 1]);
	default:
		return app_refuse_option("report", known, arguments);
	}
}

static int read_options(int count, char** arguments, Command* command) {
	opterr = 0; // the words are ours
	*command = (Command){.report.pictures = USUAL_PICTURES};
	for (int option; (option = getopt_long(count, arguments, ":ho:q", known, NULL)) != -1;) {
		const int status = read_option(option, arguments, command);
		if (status != EXIT_DONE) return status;
	}
	if (command->wants_help) return EXIT_DONE;
	if (optind == count) return app_usage_error("report", "nothing to report is given: a folder of results");
	if (count - optind > REPORT_MOST_RUNS)
		return app_usage_error("report", "%d runs are too many for one page; at most %d", count - optind,
							   REPORT_MOST_RUNS);
	for (int i = optind; i < count; ++i) recording_file_fold(&arguments[i]);
	return EXIT_DONE;
}

static int report(const Command* command, ViewSources* sources) {
	int status = render_sources_check_field(sources, command->report.field);
	app_catch_interrupts(0);
	if (status == EXIT_DONE) status = app_exit_status(report_write(&command->report, sources));
	if (status == EXIT_DONE && !command->is_quiet && !app_interrupted) printf("wrote %s\n", command->report.output);
	return status;
}

int app_report(int count, char** arguments) {
	Command command;
	ViewSources sources = {0};
	char path[JN_PATH_SIZE];
	int status = read_options(count, arguments, &command);
	if (status != EXIT_DONE) return status;
	if (command.wants_help) return puts(help), EXIT_DONE;
	if (command.report.output == NULL) {
		if (jn_path_join(arguments[optind], "report.html", path) != JN_OK) return EXIT_FILE_FAILED;
		command.report.output = path;
	}
	status = render_sources_open(count - optind, arguments + optind, &sources);
	if (status == EXIT_DONE) status = report(&command, &sources);
	render_sources_close(&sources);
	return status;
}
