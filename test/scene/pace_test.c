// Keeping pace with the clock: percentiles of durations, deadlines, and a clock that stands still.
#include "scene/pace.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/timer.h"

static void expect_near(double value, double expected, double tolerance) {
	if (!(fabs(value - expected) <= tolerance))
		fail_msg("%.9g, expected %.9g, tolerance %.3g", value, expected, tolerance);
}

static void percentiles_are_those_of_the_durations_to_a_hundredth(void** state) {
	(void)state;
	static JnPaceCounts counts;
	for (int i = 1; i <= 1000; ++i) jn_pace_counts_add(&counts, 1e-6 * i);
	static const double shares[] = {0.001, 0.5, 0.95, 0.99, 0.999, 1};
	for (int i = 0; i < 6; ++i) {
		const double expected = 1e-3 * shares[i];
		expect_near(jn_pace_counts_share(&counts, shares[i]), expected, 0.0051 * expected); // half a bin
	}
	assert_true(counts.most == 1e-6 * 1000);
}

static void what_takes_no_time_is_none(void** state) {
	(void)state;
	static JnPaceCounts counts;
	for (int i = 0; i < 90; ++i) jn_pace_counts_add(&counts, 0);
	for (int i = 0; i < 10; ++i) jn_pace_counts_add(&counts, 5e-3);
	assert_true(jn_pace_counts_share(&counts, 0.9) == 0);
	expect_near(jn_pace_counts_share(&counts, 0.95), 5e-3, 0.0051 * 5e-3);
}

static void spend(double seconds) {
	const double until = jn_seconds() + seconds;
	while (jn_seconds() < until) continue;
}

// Ten steps of 1 ms of simulated time.
static JnPaceReport keep_pace(double speed, double step, double record) {
	static JnPace pace;
	jn_pace_begin(&pace, speed, 0);
	for (int i = 1; i <= 10; ++i) {
		jn_pace_step_begins(&pace);
		spend(step);
		jn_pace_step_ends(&pace, 1e-3 * i);
		spend(record);
		jn_pace_wait(&pace, 1e-3 * i);
	}
	return jn_pace_report(&pace, 1e-2);
}

static void fast_steps_wait_for_the_clock(void** state) {
	(void)state;
	const double began = jn_seconds();
	const JnPaceReport report = keep_pace(0.5, 1e-5, 0);
	assert_true(jn_seconds() - began >= 0.02 * (1 - 1e-6));                          // 10 ms at half the speed
	assert_true(report.waking_worst > 0 && report.waking[0] <= report.waking_worst); // by a few microseconds at least
	assert_true(report.reached <= 0.5 * (1 + 1e-2) && report.possible > 0.5); // turns of the loop are counted nowhere
	assert_int_equal(report.steps, 10);
}

static void slow_steps_miss_their_deadlines_by_more_and_more(void** state) {
	(void)state;
	const JnPaceReport report = keep_pace(1, 2e-3, 0); // 2 ms for steps of 1 ms
	assert_int_equal(report.missed, 10);
	assert_true(report.lateness_worst >= 0.01 * (1 - 1e-3) && report.waiting_seconds < 1e-3);
	assert_true(report.possible <= 0.5 * (1 + 1e-6));
}

// Steps take a tenth of their time and recording twice of it: if the clock went on, all but the first would be late.
static void the_clock_stands_still_while_results_are_written(void** state) {
	(void)state;
	const JnPaceReport report = keep_pace(0.1, 1e-3, 2e-2);
	assert_true(report.recording_seconds >= 0.2 * (1 - 1e-6));
	assert_true(report.lateness[0] == 0 && report.missed < 5); // a busy machine may wake some of them late
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(percentiles_are_those_of_the_durations_to_a_hundredth),
		cmocka_unit_test(what_takes_no_time_is_none),
		cmocka_unit_test(fast_steps_wait_for_the_clock),
		cmocka_unit_test(slow_steps_miss_their_deadlines_by_more_and_more),
		cmocka_unit_test(the_clock_stands_still_while_results_are_written),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
