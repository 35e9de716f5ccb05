/// @file options.h
/// The options that commands on scenes share.
#ifndef JN_APP_OPTIONS_H
#define JN_APP_OPTIONS_H

#include <getopt.h>
#include <stdbool.h>

typedef struct SceneOptions {
	const char* scene;     ///< path of the scene file
	const char* directory; ///< -o; NULL: out/<scene name>
	int threads;           ///< --threads; 0: all
	double speed;          ///< --realtime, of `run` alone: simulated seconds a wall second; 0: not given
	long steps;            ///< --steps, of `run` alone; 0: all
	bool is_quiet;         ///< --quiet
	bool wants_help;       ///< --help was given
	int set_count;
	const char** sets; ///< --set, in order; as many places as there are arguments
} SceneOptions;

/// Read the options of `command`. Returns EXIT_DONE, or EXIT_BAD_INPUT after a message. Free with scene_options_free.
int scene_options_read(const char* command, int count, char** arguments, SceneOptions* options);
void scene_options_free(SceneOptions* options);

/// Say what is wrong with the option that getopt has just refused, before `optind`; returns EXIT_BAD_INPUT.
int app_refuse_option(const char* command, const struct option* options, char** arguments);

/// The one scene file that stands behind the options, which getopt_long has read.
int app_read_scene(const char* command, int count, char** arguments, const char** scene);

/// Read `optarg` as a count of threads or processes, at least 1. Returns EXIT_DONE, or EXIT_BAD_INPUT after a message.
int app_read_count(const char* command, const char* name, int* value);

#endif
