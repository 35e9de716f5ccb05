// Options by getopt_long; the lists keep the words in the order in which they were given.
#include "compare_options.h"

#include <stdlib.h>

#include "app.h"
#include "options.h"

static const struct option known[] = {
	{"help", no_argument, NULL, 'h'},
	{"jobs", required_argument, NULL, 'j'},
	{"output", required_argument, NULL, 'o'},
	{"quiet", no_argument, NULL, 'q'},
	{"reference", required_argument, NULL, 'r'},
	{"set", required_argument, NULL, 's'},
	{"threads", required_argument, NULL, 't'},
	{"vary", required_argument, NULL, 'v'},
	{0},
};

static int keep_word(CompareWords* list) {
	list->words[list->count++] = optarg;
	return EXIT_DONE;
}

static int read_option(int option, char** arguments, CompareOptions* options) {
	switch (option) {
	case 'h':
		options->wants_help = true;
		return EXIT_DONE;
	case 'j':
		return app_read_count("compare", "jobs", &options->jobs);
	case 'o':
		options->directory = optarg;
		return EXIT_DONE;
	case 'q':
		options->is_quiet = true;
		return EXIT_DONE;
	case 'r':
		return keep_word(&options->reference);
	case 's':
		return keep_word(&options->sets);
	case 't':
		return app_read_count("compare", "threads", &options->threads);
	case 'v':
		return keep_word(&options->vary);
	case ':':
		return app_usage_error("compare", "%s needs a value behind it", arguments[optind - 1]);
	default:
		return app_refuse_option("compare", known, arguments);
	}
}

static bool make_room(int count, CompareOptions* options) {
	CompareWords* lists[] = {&options->vary, &options->reference, &options->sets};
	for (int i = 0; i < 3; ++i) {
		lists[i]->words = calloc((size_t)count + 1, sizeof *lists[i]->words);
		if (lists[i]->words == NULL) return false;
	}
	return true;
}

int compare_options_read(int count, char** arguments, CompareOptions* options) {
	opterr = 0; // the words are ours
	*options = (CompareOptions){.threads = 1};
	if (!make_room(count, options)) return EXIT_RUN_FAILED;
	for (int option; (option = getopt_long(count, arguments, ":ho:q", known, NULL)) != -1;) {
		const int status = read_option(option, arguments, options);
		if (status != EXIT_DONE) return status;
	}
	if (options->wants_help) return EXIT_DONE;
	const int status = app_read_scene("compare", count, arguments, &options->scene);
	if (status != EXIT_DONE || options->vary.count > 0) return status;
	return app_usage_error("compare", "nothing is varied; say what to compare, such as --vary step.dt=10ms,5ms");
}

void compare_options_free(CompareOptions* options) {
	free(options->vary.words);
	free(options->reference.words);
	free(options->sets.words);
}
