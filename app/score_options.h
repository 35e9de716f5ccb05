/// @file score_options.h
/// The options of `jounce score`.
#ifndef JN_APP_SCORE_OPTIONS_H
#define JN_APP_SCORE_OPTIONS_H

#include "compare_options.h"

typedef struct ScoreOptions {
	const char* scene;     ///< path of the scene file
	const char* directory; ///< -o; NULL: out/<scene name>_score
	const char* methods;   ///< --methods: names with commas between, or "all"; NULL: the nine of the paper
	CompareWords sets;     ///< --set key=value, for all runs
	double time;           ///< --time: of each run [s]; 0: the scene's duration
	double cap;            ///< --cap: no larger step is tried [s]; 0: a fiftieth of the time
	double factor;         ///< --factor: energies may leave the start by so many times the energy in motion
	int threads;           ///< --threads of each run
	bool is_quiet, wants_help;
} ScoreOptions;

/// Returns EXIT_DONE, or EXIT_BAD_INPUT after a message. Free with score_options_free in either case.
int score_options_read(int count, char** arguments, ScoreOptions* options);
void score_options_free(ScoreOptions* options);

#endif
