#include "base/parallel.h"

#include <omp.h>
#include <stdlib.h>

// Set before main, and never again: read in every step, where a search of the environment would be felt.
static size_t grain_of_all;

__attribute__((constructor)) static void read_grain(void) {
	const char* text = getenv("JN_THREAD_GRAIN");
	grain_of_all = text != NULL ? strtoull(text, NULL, 10) : 0;
}

size_t jn_thread_grain(size_t grain) {
	return grain_of_all > 0 ? grain_of_all : grain > 0 ? grain : 1;
}

int jn_threads_available(void) {
	return omp_get_max_threads();
}

int jn_thread_number(void) {
	return omp_get_thread_num();
}
