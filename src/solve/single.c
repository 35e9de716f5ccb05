#include "solve/single.h"

#include "base/processor.h"

JnSingleSolve jn_single_solve_2, jn_single_solve_4, jn_single_solve_8;

JnSingleSolve* jn_single_solve(void) {
#if defined(__x86_64__)
	const int width = jn_processor_width();
	if (width == 8) return jn_single_solve_8;
	if (width == 4) return jn_single_solve_4;
#endif
	return jn_single_solve_2;
}
