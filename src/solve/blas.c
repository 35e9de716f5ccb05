#include "solve/blas.h"

#include <cblas.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void jn_blas_prepare(void) {
	openblas_set_num_threads(1);
}

void jn_blas_name(char* out, size_t size) {
	const char* config = openblas_get_config(); // "OpenBLAS 0.3.21 NO_LAPACKE DYNAMIC_ARCH ..."
	const char* space = strchr(config, ' ');
	const char* end = space != NULL ? strchr(space + 1, ' ') : NULL;
	const int length = end != NULL ? (int)(end - config) : (int)strlen(config);
	snprintf(out, size, "%.*s %s", length, config, openblas_get_corename());
}

#if defined(__x86_64__)
// The kernels that the instruction set allows, in the names of OpenBLAS; NULL when any choice is fine.
static const char* best_core(void) {
	__builtin_cpu_init();
	if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
		__builtin_cpu_supports("avx512vl"))
		return "SKYLAKEX";
	if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "HASWELL";
	return NULL;
}

const char* jn_blas_better_core(void) {
	static const char* const outdated[] = {"Prescott", "Core2",       "Penryn",  "Dunnington",   "Atom",
										   "Nehalem",  "Sandybridge", "Opteron", "Opteron_SSE3", "Barcelona"};
	const char* chosen = openblas_get_corename();
	for (size_t i = 0; i < sizeof outdated / sizeof *outdated; ++i)
		if (strcmp(chosen, outdated[i]) == 0) return best_core();
	return NULL;
}
#else
const char* jn_blas_better_core(void) {
	return NULL;
}
#endif

// True when the variable has been added.
static bool add_variable(const char* name, const char* value) {
	return value != NULL && getenv(name) == NULL && setenv(name, value, 1) == 0;
}

void jn_blas_restart(char** arguments) {
	const bool has_core = add_variable("OPENBLAS_CORETYPE", jn_blas_better_core());
	const bool has_count = add_variable("OPENBLAS_NUM_THREADS", "1");
	const bool has_policy = add_variable("OMP_WAIT_POLICY", "passive");
	if (has_core || has_count || has_policy) execv("/proc/self/exe", arguments);
}
