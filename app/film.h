/// @file film.h
/// A film made of pictures by ffmpeg: an mp4 (H.264, yuv420p: plays everywhere), or a GIF with a palette of its own.
#ifndef JN_APP_FILM_H
#define JN_APP_FILM_H

#include <sys/types.h>

#include "render_options.h"

typedef struct Film {
	const char* path;
	char temporary[JN_PATH_SIZE]; ///< the name while it grows
	char log[JN_PATH_SIZE];       ///< what ffmpeg says
	pid_t process;                ///< of ffmpeg; 0: none
	int input;                    ///< pipe to it; -1: none
} Film;

/// Begin. JN_IO_FAILED after a message, such as that ffmpeg is not there and what to install.
JnStatus film_open(Film* film, const RenderOptions* options, double fps);

/// Add a picture: width * height * 4 bytes. JN_IO_FAILED after a message.
JnStatus film_add(Film* film, const void* pixels, size_t size);

/// The file takes its name now. JN_IO_FAILED after a message.
JnStatus film_close(Film* film);

/// Leave nothing behind. Without effect on a closed film.
void film_abandon(Film* film);

#endif
