#include "view_options.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "app.h"
#include "options.h"
#include "recording_file.h"

const char view_help[] =
	"usage: jounce view DIR... [--save PAGE.html] [options]\n"
	"       jounce view SCENE [-o DIR] [--set key=value ...] [--threads N] [--save PAGE.html] [options]\n\n"
	"Shows recordings in the browser, several side by side; of a run in progress, frames appear as they are written.\n"
	"A scene is run, as by `jounce run`, and viewed meanwhile.\n\n"
	"      --save PAGE.html  write one file that shows the recordings without a server, and end; of a scene, when it\n"
	"                        has been run\n"
	"      --limit MB        of that file; frames are left out, evenly, to stay within it; default 50\n"
	"      --port N          of the page; default: any that is free\n"
	"      --host ADDRESS    listen at this address instead of 127.0.0.1, so that others on the network can look\n"
	"      --no-open         open no browser\n\n"
	"Ctrl-C ends it.";

enum { DEFAULT_LIMIT = 50 }; // [MB]

static const struct option known[] = {
	{"help", no_argument, NULL, 'h'},          {"host", required_argument, NULL, 'H'},
	{"limit", required_argument, NULL, 'l'},   {"no-open", no_argument, NULL, 'n'},
	{"output", required_argument, NULL, 'o'},  {"port", required_argument, NULL, 'p'},
	{"save", required_argument, NULL, 'S'},    {"set", required_argument, NULL, 's'},
	{"threads", required_argument, NULL, 't'}, {0},
};

static int read_number(const char* name, double low, double high, double* value) {
	char* end = NULL;
	*value = strtod(optarg, &end);
	if (end != optarg && *end == '\0' && *value >= low && *value <= high) return EXIT_DONE;
	return app_usage_error("view", "--%s: '%s' is no number from %g to %g", name, optarg, low, high);
}

static int read_port(int* port) {
	double number;
	const int status = read_number("port", 0, 65535, &number);
	if (status != EXIT_DONE) return status;
	if (number != floor(number)) return app_usage_error("view", "--port: '%s' is no whole number", optarg);
	*port = (int)number;
	return EXIT_DONE;
}

static int read_option(int option, char** arguments, ViewOptions* options) {
	switch (option) {
	case 'h':
		options->wants_help = true;
		return EXIT_DONE;
	case 'H':
		options->server.host = optarg;
		return EXIT_DONE;
	case 'l':
		return read_number("limit", 1, 1e5, &options->limit);
	case 'n':
		options->opens_nothing = true;
		return EXIT_DONE;
	case 'o':
		options->directory = optarg;
		return EXIT_DONE;
	case 'p':
		return read_port(&options->server.port);
	case 'S':
		options->save = optarg;
		return EXIT_DONE;
	case 's':
		options->sets[options->set_count++] = optarg;
		return EXIT_DONE;
	case 't':
		return app_read_count("view", "threads", &options->threads);
	case ':':
		return app_usage_error("view", "%s needs a value behind it", arguments[optind - 1]);
	default:
		return app_refuse_option("view", known, arguments);
	}
}

int view_options_read(int count, char** arguments, ViewOptions* options) {
	opterr = 0; // the words are ours
	*options = (ViewOptions){.limit = DEFAULT_LIMIT, .sets = calloc((size_t)count + 1, sizeof *options->sets)};
	if (options->sets == NULL) return EXIT_RUN_FAILED;
	for (int option; (option = getopt_long(count, arguments, ":ho:", known, NULL)) != -1;) {
		const int status = read_option(option, arguments, options);
		if (status != EXIT_DONE) return status;
	}
	options->names = arguments + optind;
	options->name_count = count - optind;
	for (int i = optind; i < count; ++i) recording_file_fold(&arguments[i]);
	if (!options->wants_help && options->name_count == 0)
		return app_usage_error("view", "nothing to view is given: folders of results, or a scene");
	return EXIT_DONE;
}

void view_options_free(ViewOptions* options) {
	free(options->sets);
	options->sets = NULL;
}
