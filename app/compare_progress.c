// On a terminal a line that is written over, elsewhere a line for each run that ends.
#include "compare_progress.h"

#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "base/timer.h"

static int terminal_width(void) {
	struct winsize size;
	return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

// From the runs that have ended, by the steps expected of them; "" before the first has.
static void format_left(const CompareJobs* jobs, char* out, size_t size) {
	const double seconds = (jn_seconds() - jobs->began) * (jobs->work_to_do - jobs->work_done) / jobs->work_done;
	*out = '\0';
	if (!(jobs->work_done > 0) || jobs->was_stopped) return;
	if (seconds < 3600)
		snprintf(out, size, ", left %d:%02d", (int)seconds / 60, (int)seconds % 60);
	else if (seconds < 360000)
		snprintf(out, size, ", left %d:%02d:%02d", (int)seconds / 3600, (int)seconds / 60 % 60, (int)seconds % 60);
}

static const char* running_label(const CompareJobs* jobs) {
	for (int i = 0; i < jobs->plan->run_count; ++i)
		if (jobs->list[i].state == COMPARE_RUNNING) return jobs->plan->runs[i].label;
	return "";
}

void compare_progress_show(const CompareJobs* jobs) {
	if (jobs->options->is_quiet || !jobs->is_terminal) return;
	char line[512], left[32], failed[32] = "";
	format_left(jobs, left, sizeof left);
	if (jobs->failed > 0) snprintf(failed, sizeof failed, ", %d failed", jobs->failed);
	snprintf(line, sizeof line, "%d/%d done, %d running: %s%s%s%s%s", jobs->done, jobs->plan->run_count, jobs->running,
			 running_label(jobs), jobs->running > 1 ? " ..." : "", failed, left, jobs->was_stopped ? ", stopping" : "");
	printf("\r%.*s\033[K", terminal_width() - 1, line);
	fflush(stdout);
}

void compare_progress_clear(const CompareJobs* jobs) {
	if (jobs->options->is_quiet || !jobs->is_terminal) return;
	fputs("\r\033[K", stdout);
	fflush(stdout);
}

void compare_progress_tell(const CompareJobs* jobs, const CompareJob* job) {
	if (jobs->options->is_quiet || jobs->is_terminal) return;
	const CompareRun* run = &jobs->plan->runs[job - jobs->list];
	char left[32];
	format_left(jobs, left, sizeof left);
	if (job->state == COMPARE_DONE)
		printf("%d/%d done%s: %s\n", jobs->done, jobs->plan->run_count, left, run->label);
	else
		printf("%s: %s\n", job->state == COMPARE_FAILED ? "failed" : "stopped", run->label);
	fflush(stdout);
}
