/// @file ex_phase.h
/// The pictures of study ex-phase, and what the energies of their runs did.
#ifndef JN_APP_REPRODUCE_EX_PHASE_H
#define JN_APP_REPRODUCE_EX_PHASE_H

#include "reproduce/claims.h"
#include "reproduce/study.h"

enum { EX_STARTS = 3, EX_PORTRAITS = 5, EX_MOST_METHODS = 13 };

/// A picture: methods side by side, with a step and a duration of their own.
typedef struct ExPortrait {
	const char *name, *title;
	double dt, duration; ///< [s]
	int columns, count;
	const char* methods[EX_MOST_METHODS];
} ExPortrait;

extern const ExPortrait ex_portraits[EX_PORTRAITS];
extern const double ex_starts[EX_STARTS]; ///< angles [rad]

/// The name of the run of a method from a start.
void ex_name_case(const ExPortrait* portrait, const char* method, int start, char name[96]);

/// What the energy of runs did, relative to that of the start: the worst and the mean of all starts.
typedef struct ExDrift {
	double largest; ///< |E - E_0| / E_0
	double end;     ///< (E - E_0) / E_0 over the last fifth of a run, on average
} ExDrift;

/// NAN where a run is not done; of runs that are not planned nothing is asked. JN_IO_FAILED.
JnStatus ex_find_drift(const StudyRun* run, const ExPortrait* portrait, const char* method, ExDrift* out);

/// What the paper says about the pictures, beside the numbers.
void ex_phase_claims(const StudyRun* run, Table* table);

#endif
