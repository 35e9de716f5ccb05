#include "film.h"

#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/log.h"
#include "compare_files.h"
#include "compare_process.h"
#include "interrupt.h"

enum { MOST_WORDS = 40, TAIL_BYTES = 400 };

static const char* const mp4_words[] = {
	"-vf",
	"scale=out_color_matrix=bt709:out_range=tv,format=yuv420p",
	"-c:v",
	"libx264",
	"-preset",
	"medium",
	"-crf",
	"18",
	"-colorspace",
	"bt709",
	"-color_primaries",
	"bt709",
	"-color_trc",
	"bt709",
	"-color_range",
	"tv",
	"-movflags",
	"+faststart",
	"-f",
	"mp4",
	NULL,
};

// One palette for all of the film, from what changes in it, or a still background would take most of the colours.
static const char* const gif_words[] = {
	"-filter_complex",
	"split[a][b];[a]palettegen=stats_mode=full[p];[b][p]paletteuse=dither=sierra2_4a:diff_mode=rectangle",
	"-loop",
	"0",
	"-f",
	"gif",
	NULL,
};

static JnStatus name_files(Film* film) {
	const int temporary = snprintf(film->temporary, sizeof film->temporary, "%s.tmp", film->path);
	const int log = snprintf(film->log, sizeof film->log, "%s.log", film->path);
	if (temporary < JN_PATH_SIZE && log < JN_PATH_SIZE) return JN_OK;
	return jn_error(JN_IO_FAILED, "%s: the path is too long", film->path);
}

JnStatus film_open(Film* film, const RenderOptions* options, double fps) {
	char size[32], rate[32];
	*film = (Film){.path = options->film, .input = -1};
	JN_TRY(name_files(film));
	snprintf(size, sizeof size, "%dx%d", options->job.width, options->job.height);
	snprintf(rate, sizeof rate, "%.9g", fps);
	const char* words[MOST_WORDS] = {
		"ffmpeg", "-hide_banner", "-loglevel", "error",      "-nostdin", "-y", "-f",     "rawvideo", "-pixel_format",
		"rgba",   "-video_size",  size,        "-framerate", rate,       "-i", "pipe:0", "-an",      "-bitexact"};
	const char* const* kind = options->film_kind == FILM_GIF ? gif_words : mp4_words;
	int count = 0;
	while (words[count] != NULL) ++count;
	while (*kind != NULL) words[count++] = *kind++;
	words[count] = film->temporary;
	film->process = compare_process_feed("ffmpeg", words, film->log, &film->input);
	if (film->process > 0) return JN_OK;
	film->process = 0;
	if (errno == ENOENT)
		return jn_error(JN_IO_FAILED, "films are made by ffmpeg, which is not there; Debian: apt-get install ffmpeg");
	return jn_error(JN_IO_FAILED, "ffmpeg cannot be started: %s", strerror(errno));
}

static void end_process(Film* film) {
	if (film->input >= 0) close(film->input);
	if (film->process > 0) {
		kill(-film->process, SIGKILL);
		compare_process_wait(film->process);
	}
	film->input = -1;
	film->process = 0;
}

static JnStatus fail(Film* film) {
	char* words = compare_file_read(film->log);
	const size_t length = words != NULL ? strlen(words) : 0;
	const char* tail = length > TAIL_BYTES ? words + length - TAIL_BYTES : words;
	const JnStatus status = jn_error(JN_IO_FAILED, "%s: ffmpeg makes no film of this: %s", film->path,
									 length > 0 ? tail : "it says nothing");
	free(words);
	return status;
}

JnStatus film_add(Film* film, const void* pixels, size_t size) {
	const char* at = pixels;
	while (size > 0) {
		const ssize_t length = write(film->input, at, size);
		if (length < 0 && errno == EINTR && !app_interrupted) continue;
		if (length < 0 && errno == EINTR) return JN_OK; // the film is not wanted any more
		if (length < 0) return fail(film);
		at += length;
		size -= (size_t)length;
	}
	return JN_OK;
}

JnStatus film_close(Film* film) {
	if (film->input >= 0) close(film->input);
	film->input = -1;
	const int status = film->process > 0 ? compare_process_wait(film->process) : -1;
	film->process = 0;
	if (status != 0) return fail(film);
	if (rename(film->temporary, film->path) != 0)
		return jn_error(JN_IO_FAILED, "%s: cannot write the file: %s", film->path, strerror(errno));
	unlink(film->log);
	return JN_OK;
}

void film_abandon(Film* film) {
	end_process(film);
	if (film->temporary[0] != '\0') unlink(film->temporary);
	if (film->log[0] != '\0') unlink(film->log);
}
