/// @file support.h
/// Runs of small scenes, and other work, in which one allocation fails: each must end in a clean error.
#ifndef JN_TEST_ALLOCATION_SUPPORT_H
#define JN_TEST_ALLOCATION_SUPPORT_H

#include "jounce/base.h"

/// What is done while memory is refused. It leaves nothing behind.
typedef struct Work {
	const char* name; ///< NULL: there is no further one
	JnStatus (*run)(const void* user);
	const void* user;
} Work;

/// A scene of this folder, and what is set on it.
typedef struct Case {
	const char* scene; ///< NULL: there is no further case
	const char* sets[4];
} Case;

/// Between them they reach all passes, integrators with memory, solvers and recorders.
extern const Case allocation_cases[];

typedef enum Sweep {
	SWEEP_NEW_SITES, ///< the first allocation of each site that no earlier call has met
	SWEEP_ALL,       ///< every allocation
} Sweep;

/// Do work once without failures, then once for each allocation that the sweep lets fail, those of child processes too.
/// Returns the number of these.
long allocation_sweep(const Work* work, Sweep sweep);

/// The same with a case.
long allocation_sweep_case(const Case* tried, Sweep sweep);

/// Sites met so far by all sweeps. With the variable JN_ALLOCATION_SITES, their addresses are added to the file that it
/// names, for tools/allocation_sites.
int allocation_site_count(void);

#endif
