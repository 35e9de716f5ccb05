#include "options.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "app.h"
#include "base/key.h"

enum { MOST_THREADS = 1024 };

static const struct option known[] = {
	{"help", no_argument, NULL, 'h'},          {"output", required_argument, NULL, 'o'},
	{"quiet", no_argument, NULL, 'q'},         {"set", required_argument, NULL, 's'},
	{"threads", required_argument, NULL, 't'}, {"realtime", optional_argument, NULL, 'r'},
	{"steps", required_argument, NULL, 'n'},   {0},
};

static const char* option_name(void* context, int index) {
	return ((const struct option*)context)[index].name;
}

int app_refuse_option(const char* command, const struct option* options, char** arguments) {
	const char* word = arguments[optind - 1];
	if (optopt != 0 && strncmp(word, "--", 2) != 0) return app_usage_error(command, "there is no option '-%c'", optopt);
	char name[64];
	snprintf(name, sizeof name, "%.*s", (int)strcspn(word + 2, "="), word + 2);
	for (int i = 0; options[i].name != NULL; ++i)
		if (strcmp(options[i].name, name) == 0) return app_usage_error(command, "--%s takes no value", name);
	const char* near = jn_suggest(name, option_name, (void*)options);
	if (near != NULL) return app_usage_error(command, "there is no option '--%s'; did you mean '--%s'?", name, near);
	return app_usage_error(command, "there is no option '--%s'", name);
}

int app_read_count(const char* command, const char* name, int* value) {
	char* end = NULL;
	errno = 0;
	const long number = strtol(optarg, &end, 10);
	if (errno != 0 || end == optarg || *end != '\0' || number < 1 || number > MOST_THREADS)
		return app_usage_error(command, "--%s: '%s' is no whole number from 1 to %d", name, optarg, MOST_THREADS);
	*value = (int)number;
	return EXIT_DONE;
}

int app_read_scene(const char* command, int count, char** arguments, const char** scene) {
	if (optind == count) return app_usage_error(command, "no scene file is given");
	if (optind + 1 < count)
		return app_usage_error(command, "one scene at a time; '%s' is one too many", arguments[optind + 1]);
	*scene = arguments[optind];
	return EXIT_DONE;
}

static int read_speed(const char* command, SceneOptions* options) {
	char* end = NULL;
	if (strcmp(command, "run") != 0) return app_usage_error(command, "--realtime is an option of 'jounce run'");
	options->speed = optarg != NULL ? strtod(optarg, &end) : 1;
	if (optarg == NULL || (end != optarg && *end == '\0' && options->speed >= 1e-6 && options->speed <= 1e6))
		return EXIT_DONE;
	return app_usage_error(command, "--realtime: '%s' is no speed from 1e-6 to 1e6; 1 is real time, 0.5 half as fast",
						   optarg);
}

static int read_steps(const char* command, SceneOptions* options) {
	char* end = NULL;
	errno = 0;
	if (strcmp(command, "run") != 0) return app_usage_error(command, "--steps is an option of 'jounce run'");
	options->steps = strtol(optarg, &end, 10);
	if (errno == 0 && end != optarg && *end == '\0' && options->steps >= 1) return EXIT_DONE;
	return app_usage_error(command, "--steps: '%s' is no whole number from 1", optarg);
}

static int read_option(const char* command, int option, char** arguments, SceneOptions* options) {
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
	case 'n':
		return read_steps(command, options);
	case 'r':
		return read_speed(command, options);
	case 's':
		options->sets[options->set_count++] = optarg;
		return EXIT_DONE;
	case 't':
		return app_read_count(command, "threads", &options->threads);
	case ':':
		return app_usage_error(command, "%s needs a value behind it", arguments[optind - 1]);
	default:
		return app_refuse_option(command, known, arguments);
	}
}

int scene_options_read(const char* command, int count, char** arguments, SceneOptions* options) {
	opterr = 0; // the words are ours
	*options = (SceneOptions){.sets = calloc((size_t)count + 1, sizeof *options->sets)};
	if (options->sets == NULL) return EXIT_RUN_FAILED;
	for (int option; (option = getopt_long(count, arguments, ":ho:q", known, NULL)) != -1;) {
		const int status = read_option(command, option, arguments, options);
		if (status != EXIT_DONE) return status;
	}
	return options->wants_help ? EXIT_DONE : app_read_scene(command, count, arguments, &options->scene);
}

void scene_options_free(SceneOptions* options) {
	free(options->sets);
	options->sets = NULL;
}
