#include "solve/single_algebra.h"

#include "base/aligned.h"
#include "base/processor.h"

_Static_assert(JN_SINGLE_MULTIPLE * sizeof(float) == JN_ALIGNMENT,
			   "vectors are aligned to the entries that they are padded to");

const JnSingleAlgebra* jn_single_algebra(void) {
#if defined(__x86_64__)
	const int width = jn_processor_width();
	if (width == 8) return &jn_single_algebra_8;
	if (width == 4) return &jn_single_algebra_4;
#endif
	return &jn_single_algebra_2;
}

float* jn_single_vector(size_t length) {
	return jn_aligned_take(length * sizeof(float));
}
