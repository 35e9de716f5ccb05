// Chooses kernels by what the processor can do.
#include "force/kernel.h"
#include "force/solid.h"

static const JnSolidKernels* kernels_of_width(int width) {
#if JN_HAS_WIDE_KERNELS
	__builtin_cpu_init();
	const bool has_4 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
	const bool has_8 = has_4 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
					   __builtin_cpu_supports("avx512vl");
	if (width == 8) return has_8 ? &jn_solid_kernels_8 : NULL;
	if (width == 4) return has_4 ? &jn_solid_kernels_4 : NULL;
#endif
	return width == 2 ? &jn_solid_kernels_2 : NULL;
}

int jn_kernel_best_width(void) {
	for (int width = 8; width > 2; width /= 2) {
		if (kernels_of_width(width) != NULL) return width;
	}
	return 2;
}

const JnKernel* jn_kernel_find(JnShape shape, const JnLaw* law, int width) {
	const JnSolidKernels* kernels = kernels_of_width(width != 0 ? width : jn_kernel_best_width());
	if (kernels == NULL) return NULL;
	for (int i = 0; i < JN_SOLID_LAW_COUNT; i++) {
		if ((*kernels)[shape][i].law == law) return &(*kernels)[shape][i];
	}
	return NULL;
}
