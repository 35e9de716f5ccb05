// Durations are counted in bins, each a hundredth wider than the one before: nothing grows while a run goes on.
#define _GNU_SOURCE // clock_nanosleep
#include "scene/pace.h"

#include <math.h>
#include <time.h>

#include "base/timer.h"

static const double shortest = 1e-8, growth = 1.01;
static const double shares[JN_PACE_SHARES] = {0.5, 0.95, 0.99, 0.999};

static int bin_of(double seconds) {
	const double place = seconds > shortest ? log(seconds / shortest) / log(growth) : 0;
	return place < JN_PACE_BINS - 2 ? (int)place + (seconds > shortest) : JN_PACE_BINS - 1;
}

void jn_pace_counts_add(JnPaceCounts* counts, double seconds) {
	++counts->bins[bin_of(seconds)];
	++counts->count;
	counts->most = fmax(counts->most, seconds);
}

// The middle of the bin in which the share falls; bin 0 has what is as good as nothing.
double jn_pace_counts_share(const JnPaceCounts* counts, double share) {
	long sum = 0;
	for (int i = 0; i < JN_PACE_BINS; ++i) {
		sum += counts->bins[i];
		if ((double)sum < share * (double)counts->count || sum == 0) continue;
		return i == 0 ? 0 : fmin(shortest * pow(growth, i - 0.5), counts->most);
	}
	return 0;
}

void jn_pace_begin(JnPace* pace, double speed, double t) {
	*pace = (JnPace){.speed = speed};
	pace->resumed = jn_seconds();
	pace->began = pace->resumed - t / speed;
}

// Time since the clock went on last was recording.
void jn_pace_step_begins(JnPace* pace) {
	pace->resumed = jn_seconds();
}

void jn_pace_step_ends(JnPace* pace, double t) {
	const double now = jn_seconds(), took = now - pace->resumed;
	const double late = fmax(now - (pace->began + t / pace->speed), 0);
	pace->stepping += took;
	pace->missed += late > 0;
	jn_pace_counts_add(&pace->steps, took);
	jn_pace_counts_add(&pace->lateness, late);
	pace->resumed = now;
}

static void sleep_until(double moment) {
	const double whole = floor(moment);
	const struct timespec until = {.tv_sec = (time_t)whole, .tv_nsec = (long)(1e9 * (moment - whole))};
	clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until,
					NULL); // a signal ends it early, and the run perhaps with it
}

void jn_pace_wait(JnPace* pace, double t) {
	const double now = jn_seconds(), stood_still = now - pace->resumed;
	pace->recording += stood_still;
	pace->began += stood_still;
	const double due = pace->began + t / pace->speed;
	if (due > now) sleep_until(due);
	pace->resumed = jn_seconds();
	if (due > now) jn_pace_counts_add(&pace->waking, fmax(pace->resumed - due, 0));
	pace->waiting += pace->resumed - now;
}

JnPaceReport jn_pace_report(const JnPace* pace, double simulated) {
	JnPaceReport report = {
		.speed = pace->speed,
		.steps = pace->steps.count,
		.missed = pace->missed,
		.step_worst = pace->steps.most,
		.lateness_worst = pace->lateness.most,
		.waking_worst = pace->waking.most,
		.reached = simulated / (pace->stepping + pace->waiting),
		.possible = simulated / pace->stepping,
		.stepping_seconds = pace->stepping,
		.waiting_seconds = pace->waiting,
		.recording_seconds = pace->recording,
	};
	for (int i = 0; i < JN_PACE_SHARES; ++i) {
		report.step[i] = jn_pace_counts_share(&pace->steps, shares[i]);
		report.lateness[i] = jn_pace_counts_share(&pace->lateness, shares[i]);
		report.waking[i] = jn_pace_counts_share(&pace->waking, shares[i]);
	}
	return report;
}
