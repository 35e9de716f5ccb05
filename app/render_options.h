/// @file render_options.h
/// What `jounce render` is asked for.
#ifndef JN_APP_RENDER_OPTIONS_H
#define JN_APP_RENDER_OPTIONS_H

#include "render_shoot.h"

typedef enum FilmKind { FILM_MP4, FILM_GIF } FilmKind;

typedef struct RenderOptions {
	RenderJob job;      ///< all but its sources and times; `kind` is that of `output`
	const char* output; ///< -o: a picture; NULL: not given
	const char* film;   ///< NULL: not given
	FilmKind film_kind; ///< of `film`
	const char* frames; ///< --frames: A, A:B or A:B:STEP; NULL: not given
	const char* times;  ///< --times: T,T,... or A:B:STEP; NULL: not given
	double fps, speed;  ///< 0: not given
	bool is_quiet, wants_help;
	int folder_count;
	char** folders;
} RenderOptions;

/// Read them. Returns EXIT_DONE, or EXIT_BAD_INPUT after a message.
int render_options_read(int count, char** arguments, RenderOptions* options);

#endif
