// Options by getopt_long; the overrides keep the order in which they were given.
#include "score_options.h"

#include <stdlib.h>

#include "app.h"
#include "base/quantity.h"
#include "options.h"

static const double default_factor = 100;

static const struct option known[] = {
	{"cap", required_argument, NULL, 'c'},    {"factor", required_argument, NULL, 'f'},
	{"help", no_argument, NULL, 'h'},         {"methods", required_argument, NULL, 'm'},
	{"output", required_argument, NULL, 'o'}, {"quiet", no_argument, NULL, 'q'},
	{"set", required_argument, NULL, 's'},    {"threads", required_argument, NULL, 't'},
	{"time", required_argument, NULL, 'T'},   {0},
};

static int read_positive(const char* name, const char* unit, double* value) {
	char sentence[256];
	const char* unit_text;
	if (jn_quantity_read(optarg, unit, value, &unit_text) != JN_QUANTITY_FINE) {
		jn_quantity_explain(optarg, unit, sizeof sentence, sentence);
		return app_usage_error("score", "--%s: %s", name, sentence);
	}
	if (*value > 0) return EXIT_DONE;
	return app_usage_error("score", "--%s: '%s' is not above 0", name, optarg);
}

static int read_option(int option, char** arguments, ScoreOptions* options) {
	switch (option) {
	case 'c':
		return read_positive("cap", "s", &options->cap);
	case 'f':
		return read_positive("factor", "", &options->factor);
	case 'h':
		options->wants_help = true;
		return EXIT_DONE;
	case 'm':
		options->methods = optarg;
		return EXIT_DONE;
	case 'o':
		options->directory = optarg;
		return EXIT_DONE;
	case 'q':
		options->is_quiet = true;
		return EXIT_DONE;
	case 's':
		options->sets.words[options->sets.count++] = optarg;
		return EXIT_DONE;
	case 't':
		return app_read_count("score", "threads", &options->threads);
	case 'T':
		return read_positive("time", "s", &options->time);
	case ':':
		return app_usage_error("score", "%s needs a value behind it", arguments[optind - 1]);
	default:
		return app_refuse_option("score", known, arguments);
	}
}

int score_options_read(int count, char** arguments, ScoreOptions* options) {
	opterr = 0; // the words are ours
	*options = (ScoreOptions){.threads = 1, .factor = default_factor};
	options->sets.words = calloc((size_t)count + 1, sizeof *options->sets.words);
	if (options->sets.words == NULL) return EXIT_RUN_FAILED;
	for (int option; (option = getopt_long(count, arguments, ":ho:q", known, NULL)) != -1;) {
		const int status = read_option(option, arguments, options);
		if (status != EXIT_DONE) return status;
	}
	return options->wants_help ? EXIT_DONE : app_read_scene("score", count, arguments, &options->scene);
}

void score_options_free(ScoreOptions* options) {
	free(options->sets.words);
}
