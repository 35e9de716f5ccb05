// plots/: a gnuplot file for every picture whose columns exist, and the pictures when gnuplot is at hand.
#define _GNU_SOURCE // posix_spawn_file_actions_addchdir_np, environ
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <spawn.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/log.h"
#include "record/plot_script.h"
#include "record/text_file.h"

enum { PLOT_LIMIT = 16 };

typedef struct Plots {
	JnRecorder base;
	int columns[PLOT_LIMIT]; // of each plot's first curve; -1: the plot is skipped
	JnSeriesRange ranges[PLOT_LIMIT];
	long rows;
} Plots;

static JnStatus open_plots(JnRecorder* recorder, const JnRecordInfo* info) {
	Plots* plots = (Plots*)recorder;
	const bool has_time = info->wants_plots && jn_column_find(info, "t") >= 0;
	for (int i = 0; jn_plot_list[i].name != NULL; i++) {
		plots->columns[i] = has_time ? jn_column_find(info, jn_plot_list[i].curves[0].column) : -1;
	}
	return JN_OK;
}

static void archive_plots(JnRecorder* recorder, JnArchive* archive) {
	Plots* plots = (Plots*)recorder;
	jn_archive_bytes(archive, "ranges", plots->ranges, sizeof plots->ranges);
	jn_archive_long(archive, "rows", &plots->rows);
}

static JnStatus resume_plots(JnRecorder* recorder, const JnRecordInfo* info, JnArchive* archive) {
	archive_plots(recorder, archive);
	JN_TRY(archive->status);
	return open_plots(recorder, info);
}

static JnStatus write_plots(JnRecorder* recorder, const JnRecordStep* step) {
	Plots* plots = (Plots*)recorder;
	if (step->values == NULL) return JN_OK;
	plots->rows++;
	for (int i = 0; jn_plot_list[i].name != NULL; i++) {
		JnSeriesRange* range = &plots->ranges[i];
		const double value = plots->columns[i] >= 0 ? step->values[plots->columns[i]] : 0;
		range->rows = plots->rows;
		if (!(value > 0)) continue;
		range->low = range->high > 0 ? fmin(range->low, value) : value;
		range->high = fmax(range->high, value);
	}
	return JN_OK;
}

// Run `gnuplot script` in `folder`, its words into gnuplot.log there. 0, or the reason why not in errno's numbers; a
// script that fails gives ECANCELED.
static int run_gnuplot(const char* folder, const char* script) {
	char* const arguments[] = {(char[]){"gnuplot"}, (char*)script, NULL};
	posix_spawn_file_actions_t actions;
	int reason = posix_spawn_file_actions_init(&actions);
	if (reason != 0) return reason;
	reason = posix_spawn_file_actions_addchdir_np(&actions, folder);
	if (reason == 0) reason = posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
	const int flags = O_WRONLY | O_CREAT | O_APPEND;
	if (reason == 0) reason = posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "gnuplot.log", flags, 0666);
	if (reason == 0) reason = posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
	pid_t child = 0;
	if (reason == 0) reason = posix_spawnp(&child, "gnuplot", &actions, NULL, arguments, environ);
	posix_spawn_file_actions_destroy(&actions);
	if (reason != 0) return reason;
	int outcome = 0;
	while (waitpid(child, &outcome, 0) < 0) {
		if (errno != EINTR) return errno;
	}
	return WIFEXITED(outcome) && WEXITSTATUS(outcome) == 0 ? 0 : ECANCELED;
}

// Pictures are a courtesy: without them the run is none the worse, and the scripts can be run later.
static void draw(const Plots* plots, const char* folder) {
	char log_path[JN_PATH_SIZE];
	if (jn_path_join(folder, "gnuplot.log", log_path) != JN_OK) return;
	unlink(log_path);
	int reason = 0;
	for (int i = 0; jn_plot_list[i].name != NULL && (reason == 0 || reason == ECANCELED); i++) {
		char script[64];
		snprintf(script, sizeof script, "%s.gnuplot", jn_plot_list[i].name);
		if (plots->columns[i] < 0) continue;
		const int outcome = run_gnuplot(folder, script);
		if (outcome != 0) reason = outcome;
	}
	if (reason == ECANCELED) {
		jn_warn("gnuplot could not draw all plots; %s says why, and the scripts beside it can be run again", log_path);
		return;
	}
	unlink(log_path);
	if (reason == 0) return;
	jn_warn("no plots were drawn, since gnuplot cannot be started: %s; the scripts in %s draw them later",
			strerror(reason), folder);
}

static JnStatus close_plots(JnRecorder* recorder, const JnRecordEnd* end) {
	const Plots* plots = (const Plots*)recorder;
	const JnRecordInfo* info = recorder->info;
	(void)end;
	if (plots->rows == 0 || !info->wants_plots) return JN_OK;
	char folder[JN_PATH_SIZE];
	JN_TRY(jn_path_join(info->directory, "plots", folder));
	if (mkdir(folder, 0777) != 0 && errno != EEXIST) {
		return jn_error(JN_IO_FAILED, "%s: cannot create the folder: %s", folder, strerror(errno));
	}
	for (int i = 0; jn_plot_list[i].name != NULL; i++) {
		if (plots->columns[i] >= 0) JN_TRY(jn_plot_write(&jn_plot_list[i], info, info->directory, plots->ranges[i]));
	}
	draw(plots, folder);
	return JN_OK;
}

const JnRecorderType jn_recorder_plots = {
	.name = "plots",
	.doc = "plots/: energies, energy error, step sizes and cost over time, by gnuplot",
	.size = sizeof(Plots),
	.open = open_plots,
	.write = write_plots,
	.close = close_plots,
	.resume = resume_plots,
	.archive = archive_plots,
};
