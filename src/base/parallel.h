/// @file parallel.h
/// How many threads a piece of work is worth, and ranges that do not depend on it.
#ifndef JN_BASE_PARALLEL_H
#define JN_BASE_PARALLEL_H

#include <stddef.h>

/// Threads worth waking for `items` of which one thread should have at least `grain`: between 1 and `limit`.
static inline int jn_threads_for(size_t items, size_t grain, int limit) {
	const size_t worth = items / (grain > 0 ? grain : 1);
	return worth < 1 ? 1 : worth < (size_t)limit ? (int)worth : limit;
}

/// Threads that a run may use by default: OMP_NUM_THREADS or the processors this process may run on.
int jn_threads_available(void);

/// The calling thread's number and the team's size inside an OpenMP region.
int jn_thread_number(void);

#endif
