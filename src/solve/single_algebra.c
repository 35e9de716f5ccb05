#include "solve/single_algebra.h"

#include <stdlib.h>
#include <string.h>

#include "base/processor.h"

enum { ALIGNMENT = JN_SINGLE_MULTIPLE * sizeof(float) };

const JnSingleAlgebra* jn_single_algebra(void) {
#if defined(__x86_64__)
	const int width = jn_processor_width();
	if (width == 8) return &jn_single_algebra_8;
	if (width == 4) return &jn_single_algebra_4;
#endif
	return &jn_single_algebra_2;
}

float* jn_single_vector(size_t length) {
	const size_t bytes = (length * sizeof(float) + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
	float* vec = aligned_alloc(ALIGNMENT, bytes > 0 ? bytes : ALIGNMENT);
	return vec != NULL ? memset(vec, 0, bytes) : NULL;
}
