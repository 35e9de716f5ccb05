/// @file view_options.h
/// The options of `jounce view`.
#ifndef JN_APP_VIEW_OPTIONS_H
#define JN_APP_VIEW_OPTIONS_H

#include <stdbool.h>

#include "view_server.h"

typedef struct ViewOptions {
	ViewServerOptions server;
	const char* save;      ///< path of a page to write; NULL: serve
	double limit;          ///< of that page [MB]
	const char* directory; ///< -o: where a scene's results go; NULL: out/<name>
	int threads;           ///< of a scene's run; 0: not given
	bool wants_help, opens_nothing;
	int set_count, name_count;
	const char** sets;  ///< --set, in order
	char* const* names; ///< folders, or one scene
} ViewOptions;

/// Read them. Returns EXIT_DONE, or EXIT_BAD_INPUT after a message. Free with view_options_free in any case.
int view_options_read(int count, char** arguments, ViewOptions* options);
void view_options_free(ViewOptions* options);

extern const char view_help[];

#endif
