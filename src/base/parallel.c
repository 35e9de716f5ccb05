#include "base/parallel.h"

#include <omp.h>

int jn_threads_available(void) {
	return omp_get_max_threads();
}

int jn_thread_number(void) {
	return omp_get_thread_num();
}
