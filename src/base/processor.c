#include "base/processor.h"

#include <stdlib.h>

static int widest(void) {
#if defined(__x86_64__)
	__builtin_cpu_init();
	if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return 2;
	const int has_512 =
		__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
	return has_512 ? 8 : 4;
#else
	return 2;
#endif
}

int jn_processor_width(void) {
	const char* asked = getenv("JN_SIMD_WIDTH");
	const int most = widest(), width = asked != NULL ? atoi(asked) : most;
	return (width == 2 || width == 4) && width < most ? width : most;
}
