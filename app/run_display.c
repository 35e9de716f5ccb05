#include "run_display.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "base/timer.h"
#include "interrupt.h"

RunDisplay run_display_begin(bool is_quiet) {
	return (RunDisplay){.is_quiet = is_quiet, .is_terminal = isatty(STDOUT_FILENO) != 0, .last = jn_seconds()};
}

static void format_duration(double seconds, char* out, size_t size) {
	if (!isfinite(seconds) || seconds > 359999)
		snprintf(out, size, "--:--");
	else if (seconds >= 3600)
		snprintf(out, size, "%d:%02d:%02d", (int)seconds / 3600, (int)seconds / 60 % 60, (int)seconds % 60);
	else
		snprintf(out, size, "%d:%02d", (int)seconds / 60, (int)seconds % 60);
}

static int terminal_width(void) {
	struct winsize size;
	return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

// One line that is written over and over; cut to the terminal, for a line that wraps cannot be written over.
static void print_bar(const JnProgress* p, double pace, const char* left) {
	enum { BAR = 20 };
	char bar[BAR + 1], line[256];
	const double share = p->t / p->t_end;
	const int full = (int)(share * BAR + 0.5);
	for (int i = 0; i < BAR; ++i) bar[i] = i < full ? '#' : '.';
	bar[BAR] = '\0';
	snprintf(line, sizeof line,
			 "[%s] %3.0f%%  t %.4g of %g s  left %s  pace %.3g s/s  dt %.3g s  newton %d  drift %.1e J/kg", bar,
			 100 * share, p->t, p->t_end, left, pace, p->dt, p->newton, p->specific_error);
	printf("\r%.*s\033[K", terminal_width() - 1, line);
}

static void print_progress(const RunDisplay* display, const JnProgress* p) {
	char left[24];
	const double pace = p->t > 0 ? p->wall_seconds / p->t : 0;
	format_duration(pace * (p->t_end - p->t), left, sizeof left);
	if (display->is_terminal)
		print_bar(p, pace, left);
	else
		printf("t %.6g of %g s, step %ld, left %s, pace %.3g s/s, dt %.3g s, newton %d, drift %.3e J/kg\n", p->t,
			   p->t_end, p->steps, left, pace, p->dt, p->newton, p->specific_error);
	fflush(stdout);
}

// Messages start on a line of their own, not behind the progress bar.
void run_display_message(void* user, JnLogLevel level, const char* message) {
	const RunDisplay* display = user;
	if (level == JN_LOG_INFO) return;
	if (display->is_terminal && !display->is_quiet) fputs("\r\033[K", stdout);
	fflush(stdout);
	fprintf(stderr, "jounce: %s: %s\n", level == JN_LOG_ERROR ? "error" : "warning", message);
}

bool run_display_progress(void* user, const JnProgress* p) {
	RunDisplay* display = user;
	const double pause = display->is_terminal ? 0.1 : 5, now = jn_seconds();
	if (!display->is_quiet && now - display->last >= pause) {
		print_progress(display, p);
		display->last = now;
	}
	return !app_interrupted && (display->steps == 0 || p->steps < display->steps);
}

static void print_percentiles(const char* what, const double values[JN_PACE_SHARES], double worst) {
	printf("%s: median %.3g us, 95 %% %.3g, 99 %% %.3g, 99.9 %% %.3g, worst %.3g us\n", what, 1e6 * values[0],
		   1e6 * values[1], 1e6 * values[2], 1e6 * values[3], 1e6 * worst);
}

static void print_pace(const JnPaceReport* pace) {
	const double share = pace->steps > 0 ? 100.0 * (double)pace->missed / (double)pace->steps : 0;
	printf("real time x %.4g: %ld of %ld deadlines missed (%.3g %%); reached x %.4g, possible x %.4g\n", pace->speed,
		   pace->missed, pace->steps, share, pace->reached, pace->possible);
	print_percentiles("a step took", pace->step, pace->step_worst);
	print_percentiles("it was late by", pace->lateness, pace->lateness_worst);
	print_percentiles("the system woke it late by", pace->waking, pace->waking_worst);
	printf("%.3g s stepping, %.3g s waiting; %.3g s recording, during which the clock stood still\n",
		   pace->stepping_seconds, pace->waiting_seconds, pace->recording_seconds);
}

// Which solver served, and how often.
static void print_ways(const JnRunResult* r) {
	long iterated = 0;
	if (r->solves == 0) return;
	printf("%ld linear solves:", r->solves);
	for (int way = 0; way < JN_WAY_COUNT; ++way) {
		if (r->served[way] == 0) continue;
		printf(" %ld %s%s,", r->served[way], way == JN_WAY_DIRECT ? "" : "cg ", jn_way_name((JnWay)way));
		if (way != JN_WAY_DIRECT) iterated += r->served[way];
	}
	if (iterated > 0) printf(" %.3g iterations each,", (double)r->iterations / (double)iterated);
	printf(" %ld changes\n", r->changes);
}

void run_display_end(const RunDisplay* display, const JnRunResult* r, const char* directory) {
	const double steps = r->steps > 0 ? (double)r->steps : 1;
	if (display->is_terminal) fputs("\r\033[K", stdout);
	if (r->was_stopped) printf("stopped as asked, at t = %.6g of %g s\n", r->t, r->t_end);
	printf("%ld steps to t = %.6g s in %.3g s of wall time", r->steps, r->t, r->wall_seconds);
	if (r->t > 0) printf(" (%.3g s per simulated s)", r->wall_seconds / r->t);
	printf("\n%.2f Newton iterations a step, %ld factorisations, %ld rejected attempts\n", (double)r->newton / steps,
		   r->factorizations, r->rejected);
	print_ways(r);
	printf("energy error |e(t) - e(0)|: %.6g J/kg\n", r->specific_error);
	if (r->pace.speed > 0) print_pace(&r->pace);
	printf("wrote %s: run.h5 (%ld frame%s), run.xdmf, surface.xdmf, series.csv, summary.json%s\n", directory, r->frames,
		   r->frames == 1 ? "" : "s", r->has_plots ? ", plots/" : "");
	if (r->was_stopped) printf("to go on: jounce resume %s\n", directory);
}
