/// @file parallel.h
/// How many threads a piece of work is worth, and ranges that do not depend on it.
#ifndef JN_BASE_PARALLEL_H
#define JN_BASE_PARALLEL_H

#include <stddef.h>

/// `grain`, at least 1; or what JN_THREAD_GRAIN said in the environment when the program started: with 1 every thread has a
/// part in the smallest model, so that tests of small models see what threads could change (docs/determinism.md).
size_t jn_thread_grain(size_t grain);

/// Threads worth waking for `items` of which one thread should have at least `grain`: between 1 and `limit`.
static inline int jn_threads_for(size_t items, size_t grain, int limit) {
	const size_t worth = items / jn_thread_grain(grain);
	return worth < 1 ? 1 : worth < (size_t)limit ? (int)worth : limit;
}

/// Threads that a run may use by default: OMP_NUM_THREADS or the processors this process may run on.
int jn_threads_available(void);

/// The calling thread's number and the team's size inside an OpenMP region.
int jn_thread_number(void);

#endif
