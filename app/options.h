/// @file options.h
/// The options that commands on scenes share.
#ifndef JN_APP_OPTIONS_H
#define JN_APP_OPTIONS_H

#include <stdbool.h>

typedef struct SceneOptions {
	const char* scene;     ///< path of the scene file
	const char* directory; ///< -o; NULL: out/<scene name>
	int threads;           ///< --threads; 0: all
	bool is_quiet;         ///< --quiet
	bool wants_help;       ///< --help was given
	int set_count;
	const char** sets; ///< --set, in order; as many places as there are arguments
} SceneOptions;

/// Read the options of `command`. Returns EXIT_DONE, or EXIT_BAD_INPUT after a message. Free with scene_options_free.
int scene_options_read(const char* command, int count, char** arguments, SceneOptions* options);
void scene_options_free(SceneOptions* options);

#endif
