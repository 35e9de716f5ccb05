#include "base/algebra.h"

#include "base/processor.h"

const JnAlgebra* jn_algebra_best(void) {
#if defined(__x86_64__)
	const int width = jn_processor_width();
	return width == 8 ? &jn_algebra_8 : width == 4 ? &jn_algebra_4 : &jn_algebra_2;
#else
	return &jn_algebra_2;
#endif
}
