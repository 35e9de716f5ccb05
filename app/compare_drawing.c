// Without pictures the tables are none the worse, and the scripts can be run later.
#include "compare_drawing.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/log.h"
#include "compare_process.h"
#include "record/text_file.h"

CompareDrawing compare_draw(const char* folder, const char* name) {
	char script[64], log[64], path[JN_PATH_SIZE];
	snprintf(script, sizeof script, "%s.gnuplot", name);
	snprintf(log, sizeof log, "%s.log", name);
	const char* const arguments[] = {"gnuplot", script, NULL};
	const pid_t process = compare_process_start("gnuplot", arguments, folder, log);
	if (process < 0)
		jn_warn("no pictures were drawn, since gnuplot cannot be started: %s; the scripts in %s draw them later",
				strerror(errno), folder);
	const int status = process >= 0 ? compare_process_wait(process) : 0;
	if (status != 0) {
		jn_warn("gnuplot could not draw %s/%s; %s beside it says why", folder, script, log);
		return COMPARE_NOT_DRAWN;
	}
	if (jn_path_join(folder, log, path) == JN_OK) unlink(path);
	return process >= 0 ? COMPARE_DRAWN : COMPARE_NO_GNUPLOT;
}
