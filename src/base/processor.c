#include "base/processor.h"

int jn_processor_width(void) {
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
