/// @file run_display.h
/// What a run shows while it goes on and at its end: a progress bar on a terminal and plain lines elsewhere.
#ifndef JN_APP_RUN_DISPLAY_H
#define JN_APP_RUN_DISPLAY_H

#include "jounce/scene.h"

typedef struct RunDisplay {
	bool is_quiet, is_terminal;
	double last; ///< time of the last line [s]
	long steps;  ///< after which the run stops; 0: at its end
} RunDisplay;

RunDisplay run_display_begin(bool is_quiet);

/// For JnRunOptions.progress and jn_log_set_sink; `user` is the RunDisplay. Progress is false once the user has interrupted, and after `steps`.
bool run_display_progress(void* user, const JnProgress* p);
void run_display_message(void* user, JnLogLevel level, const char* message);

/// What the run came to.
void run_display_end(const RunDisplay* display, const JnRunResult* r, const char* directory);

#endif
