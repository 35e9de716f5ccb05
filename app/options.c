#include "options.h"

#include <errno.h>
#include <getopt.h>
#include <stdlib.h>

#include "app.h"

enum { MOST_THREADS = 1024 };

static int read_threads(const char* command, const char* text, int* threads) {
	char* end = NULL;
	errno = 0;
	const long value = strtol(text, &end, 10);
	if (errno != 0 || end == text || *end != '\0' || value < 1 || value > MOST_THREADS)
		return app_usage_error(command, "--threads: '%s' is no number from 1 to %d", text, MOST_THREADS);
	*threads = (int)value;
	return EXIT_DONE;
}

static int read_option(const char* command, int option, SceneOptions* options) {
	switch (option) {
	case 'h':
		options->wants_help = true;
		return EXIT_DONE;
	case 'o':
		options->directory = optarg;
		return EXIT_DONE;
	case 'q':
		options->is_quiet = true;
		return EXIT_DONE;
	case 's':
		options->sets[options->set_count++] = optarg;
		return EXIT_DONE;
	case 't':
		return read_threads(command, optarg, &options->threads);
	default:
		return app_usage_error(command, "an option is unknown or lacks its value");
	}
}

int scene_options_read(const char* command, int count, char** arguments, SceneOptions* options) {
	static const struct option known[] = {
		{"help", no_argument, NULL, 'h'},          {"output", required_argument, NULL, 'o'},
		{"quiet", no_argument, NULL, 'q'},         {"set", required_argument, NULL, 's'},
		{"threads", required_argument, NULL, 't'}, {0},
	};
	*options = (SceneOptions){.sets = calloc((size_t)count + 1, sizeof *options->sets)};
	if (options->sets == NULL) return EXIT_RUN_FAILED;
	for (int option; (option = getopt_long(count, arguments, "ho:q", known, NULL)) != -1;) {
		const int status = read_option(command, option, options);
		if (status != EXIT_DONE) return status;
	}
	if (options->wants_help) return EXIT_DONE;
	if (optind == count) return app_usage_error(command, "no scene file is given");
	if (optind + 1 < count)
		return app_usage_error(command, "one scene at a time; '%s' is too much", arguments[optind + 1]);
	options->scene = arguments[optind];
	return EXIT_DONE;
}

void scene_options_free(SceneOptions* options) {
	free(options->sets);
	options->sets = NULL;
}
