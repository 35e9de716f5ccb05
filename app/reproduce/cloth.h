/// @file cloth.h
/// The thick cloth of HO figure 6, also timed in table 1.
#ifndef JN_APP_REPRODUCE_CLOTH_H
#define JN_APP_REPRODUCE_CLOTH_H

#include "reproduce/plot.h"
#include "reproduce/study.h"

typedef struct ClothCase {
	const char* name; ///< of the case: "cloth_sdirk2_dt=5ms"
	const char* title;
	const char* method; ///< integrator.method
	double dt;          ///< [s]
	double beta;        ///< of Rayleigh damping [s]
} ClothCase;

/// The damped one is the last; table 1 leaves it out.
enum { CLOTH_CASES = 6, CLOTH_FINE = 1, CLOTH_SDIRK2 = 2, CLOTH_UNDAMPED = 5 };
extern const ClothCase cloth_cases[CLOTH_CASES];

/// Add a case of the cloth that lasts `duration` [s].
void cloth_add(StudyRun* run, int index, double duration);

/// The height of wrinkles of the first `count` cases: a plot with one curve a case, at times from 0 to `duration`.
JnStatus cloth_wrinkles(StudyRun* run, int count, double duration, Plot* plot);

#endif
