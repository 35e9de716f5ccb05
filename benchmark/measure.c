// Timing: a warm-up, then samples of a few milliseconds or one call, whichever is longer. One thread is timed on its own
// clock, which stands still while others have the core; several threads are timed on the wall.
#include <stdlib.h>
#include <time.h>

#include "base/timer.h"
#include "bench.h"

enum { MOST_SAMPLES = 25 };
static const double sample_seconds = 4e-3;

static int by_value(const void* a, const void* b) {
	const double left = *(const double*)a, right = *(const double*)b;
	return (left > right) - (left < right);
}

Timing summarize(double samples[], int count) {
	qsort(samples, (size_t)count, sizeof *samples, by_value);
	const double middle = 0.5 * (samples[(count - 1) / 2] + samples[count / 2]);
	return (Timing){.median = middle, .min = samples[0], .max = samples[count - 1]};
}

double clock_for(int threads) {
	struct timespec now;
	if (threads > 1 || clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) != 0) return jn_seconds();
	return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static double seconds_for(void (*run)(void*), void* context, int threads, long calls) {
	const double start = clock_for(threads);
	for (long i = 0; i < calls; ++i) run(context);
	return clock_for(threads) - start;
}

// Calls that fill a sample: doubled until they do, which is also the warm-up.
static long calls_in_sample(void (*run)(void*), void* context, int threads, double* seconds) {
	long calls = 1;
	*seconds = seconds_for(run, context, threads, calls);
	while (*seconds < sample_seconds) {
		calls *= 2;
		*seconds = seconds_for(run, context, threads, calls);
	}
	return calls;
}

Timing measure(void (*run)(void*), void* context, int threads, double budget, int least) {
	double samples[MOST_SAMPLES], seconds;
	const long calls = calls_in_sample(run, context, threads, &seconds);
	int count = (int)(budget / seconds);
	count = count < least ? least : count;
	count = count > MOST_SAMPLES ? MOST_SAMPLES : count;
	for (int i = 0; i < count; ++i) samples[i] = seconds_for(run, context, threads, calls) / (double)calls;
	return summarize(samples, count);
}
