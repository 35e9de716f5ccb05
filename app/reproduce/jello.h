/// @file jello.h
/// The wobbling jello of HO figure 5, also timed in table 1.
#ifndef JN_APP_REPRODUCE_JELLO_H
#define JN_APP_REPRODUCE_JELLO_H

#include "reproduce/plot.h"
#include "reproduce/study.h"

typedef struct JelloCase {
	const char* name; ///< of the case: "jello_sdirk2_dt=5ms"
	const char* title;
	const char* method; ///< integrator.method
	double dt;          ///< [s]
} JelloCase;

enum { JELLO_CASES = 5, JELLO_FINE = 2, JELLO_SDIRK2 = 3 }; // places of BE 0.05 ms and SDIRK2 5 ms
extern const JelloCase jello_cases[JELLO_CASES];

/// Add a case of the jello that lasts `duration` [s].
void jello_add(StudyRun* run, int index, double duration);

/// The amplitude of the wobble of each case: a plot with one curve a case, at times from 1 s to `duration`.
JnStatus jello_amplitudes(StudyRun* run, double duration, Plot* plot);

#endif
