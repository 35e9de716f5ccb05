/// @file pace.h
/// Simulated time against wall time: a run that waits for the clock, and tells how often it was late.
///
/// A state at simulated time t is due t / speed after the start. A step that is done earlier waits until then; one that is
/// done later has missed its deadline, and the next ones catch up without waiting. The clock stands still while results are
/// measured and written: what a step took, and how late it was, is that of the step alone.
#ifndef JN_SCENE_PACE_H
#define JN_SCENE_PACE_H

#include "jounce/scene.h"

enum { JN_PACE_BINS = 2600 }; // each wider by a hundredth than the one before, from 10 ns to half an hour

/// Counts of durations, for percentiles to a hundredth of their value.
typedef struct JnPaceCounts {
	long bins[JN_PACE_BINS];
	long count;
	double most; ///< [s]
} JnPaceCounts;

void jn_pace_counts_add(JnPaceCounts* counts, double seconds);

/// The duration that a share of those counted, such as 0.99, is not above [s].
double jn_pace_counts_share(const JnPaceCounts* counts, double share);

typedef struct JnPace {
	double speed;                        ///< simulated seconds a wall second
	double began;                        ///< when simulated time 0 was, on the clock that stands still [s]
	double resumed;                      ///< when that clock went on last [s]
	double stepping, waiting, recording; ///< [s]
	long missed;
	JnPaceCounts steps, lateness, waking;
} JnPace;

void jn_pace_begin(JnPace* pace, double speed, double t);

/// Around each step: to simulated time t.
void jn_pace_step_begins(JnPace* pace);
void jn_pace_step_ends(JnPace* pace, double t);

/// After what belongs to no step, such as recording: wait until the state at t is due.
void jn_pace_wait(JnPace* pace, double t);

/// What came of it; `simulated` is how far it went [s].
JnPaceReport jn_pace_report(const JnPace* pace, double simulated);

#endif
