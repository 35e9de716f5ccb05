// Options by getopt_long; the lists keep the words in the order in which they were given.
#include "compare_options.h"

#include <errno.h>
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "app.h"
#include "base/key.h"

enum { MOST_THREADS = 1024 };

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

static const char* option_name(void* context, int index) {
	(void)context;
	return known[index].name;
}

// getopt has just refused the option before `optind`: by its letter, or as a whole word.
static int refuse_option(char** arguments) {
	const char* word = arguments[optind - 1];
	if (optopt != 0 && strncmp(word, "--", 2) != 0)
		return app_usage_error("compare", "there is no option '-%c'", optopt);
	char name[64];
	snprintf(name, sizeof name, "%.*s", (int)strcspn(word + 2, "="), word + 2);
	for (int i = 0; known[i].name != NULL; ++i)
		if (strcmp(known[i].name, name) == 0) return app_usage_error("compare", "--%s takes no value", name);
	const char* near = jn_suggest(name, option_name, NULL);
	if (near == NULL) return app_usage_error("compare", "there is no option '--%s'", name);
	return app_usage_error("compare", "there is no option '--%s'; did you mean '--%s'?", name, near);
}

static int read_count(const char* name, int* value) {
	char* end = NULL;
	errno = 0;
	const long number = strtol(optarg, &end, 10);
	if (errno != 0 || end == optarg || *end != '\0' || number < 1 || number > MOST_THREADS)
		return app_usage_error("compare", "--%s: '%s' is no whole number from 1 to %d", name, optarg, MOST_THREADS);
	*value = (int)number;
	return EXIT_DONE;
}

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
		return read_count("jobs", &options->jobs);
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
		return read_count("threads", &options->threads);
	case 'v':
		return keep_word(&options->vary);
	case ':':
		return app_usage_error("compare", "%s needs a value behind it", arguments[optind - 1]);
	default:
		return refuse_option(arguments);
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
	if (optind == count) return app_usage_error("compare", "no scene file is given");
	if (optind + 1 < count)
		return app_usage_error("compare", "one scene at a time; '%s' is one too many", arguments[optind + 1]);
	options->scene = arguments[optind];
	if (options->vary.count > 0) return EXIT_DONE;
	return app_usage_error("compare", "nothing is varied; say what to compare, such as --vary step.dt=10ms,5ms");
}

void compare_options_free(CompareOptions* options) {
	free(options->vary.words);
	free(options->reference.words);
	free(options->sets.words);
}
