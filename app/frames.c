#include "frames.h"

#include <errno.h>
#include <limits.h>
#include <stdbool.h>
#include <stdlib.h>

#include "app.h"

/// A whole number at `*text`, which moves behind it; `otherwise` when there is none before a colon or the end.
static bool read_number(const char** text, long otherwise, long* number) {
	char* end = NULL;
	*number = otherwise;
	if (**text == ':' || **text == '\0') return true;
	errno = 0;
	*number = strtol(*text, &end, 10);
	const bool is_good = errno == 0 && end != *text && (*end == ':' || *end == '\0') && labs(*number) <= INT_MAX;
	*text = end;
	return is_good;
}

static bool read_range(const char* text, long count, long* first, long* end, long* step) {
	const bool is_one = *text != '\0';
	if (!read_number(&text, 0, first)) return false;
	if (*first < 0) *first += count;
	if (*text == '\0') {
		*end = *first + 1;
		return is_one && *first >= 0 && *first < count;
	}
	text++;
	if (!read_number(&text, count, end)) return false;
	if (*text == ':') {
		text++;
		if (!read_number(&text, 1, step)) return false;
	}
	if (*end < 0) *end += count;
	if (*end > count) *end = count;
	if (*first < 0) *first = 0;
	return *text == '\0' && *step > 0;
}

int app_read_frames(const char* command, const char* text, int frame_count, FrameRange* range) {
	long first = 0, end = frame_count, step = 1;
	if (text != NULL && !read_range(text, frame_count, &first, &end, &step))
		return app_usage_error(command,
							   "--frames: '%s' is no choice of the frames 0 to %d; it reads A:B:STEP, from A up to B "
							   "without B, such as 0:100:2, ::10, -1",
							   text, frame_count - 1);
	if (first >= end)
		return app_usage_error(command, "--frames: '%s' chooses none of the frames 0 to %d", text != NULL ? text : "",
							   frame_count - 1);
	*range = (FrameRange){(int)first, (int)step, (int)((end - first + step - 1) / step)};
	return EXIT_DONE;
}
