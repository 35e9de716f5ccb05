/// @file compare_recording.h
/// What a run left on disk: summary.json, and the end state and series of run.h5.
#ifndef JN_APP_COMPARE_RECORDING_H
#define JN_APP_COMPARE_RECORDING_H

#include "base/arena.h"

/// Value of a number in the text of summary.json, which has one entry a line; NAN when it is absent or null.
double compare_summary_number(const char* summary, const char* name);

/// Does the text of summary.json say that the run is done? NULL: no.
bool compare_summary_is_done(const char* summary);

/// A probe over time.
typedef struct CompareProbe {
	const char* name;
	double* at[3]; ///< coordinates at each accepted step [m]
} CompareProbe;

typedef struct CompareRecording {
	JnArena arena;
	int node_count;
	double t;             ///< of the last frame [s]
	double *rest, *x, *v; ///< of the last frame, 3 * node_count [m], [m/s]
	int row_count;
	double* times; ///< of the series [s]
	int probe_count;
	CompareProbe* probes;
} CompareRecording;

/// Read run.h5 in `folder`. JN_IO_FAILED after a message. Free with compare_recording_close in either case.
JnStatus compare_recording_open(const char* folder, CompareRecording* recording);
void compare_recording_close(CompareRecording* recording);

#endif
