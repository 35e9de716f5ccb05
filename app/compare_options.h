/// @file compare_options.h
/// The options of `jounce compare`.
#ifndef JN_APP_COMPARE_OPTIONS_H
#define JN_APP_COMPARE_OPTIONS_H

#include <stdbool.h>

/// Words as given, in order; as many places as there are arguments.
typedef struct CompareWords {
	int count;
	const char** words;
} CompareWords;

typedef struct CompareOptions {
	const char* scene;      ///< path of the scene file
	const char* directory;  ///< -o; NULL: out/<scene name>_compare
	CompareWords vary;      ///< --vary key=a,b,c
	CompareWords reference; ///< --reference key=value; none: no reference
	CompareWords sets;      ///< --set key=value, for all runs
	int jobs;               ///< --jobs: runs at a time; 0: as many as keep the processors busy
	int threads;            ///< --threads of each run
	bool is_quiet, wants_help;
} CompareOptions;

/// Returns EXIT_DONE, or EXIT_BAD_INPUT after a message. Free with compare_options_free in either case.
int compare_options_read(int count, char** arguments, CompareOptions* options);
void compare_options_free(CompareOptions* options);

#endif
