// Chooses kernels by what the processor can do.
#include "base/processor.h"
#include "force/kernel.h"
#include "force/solid.h"

static const JnSolidKernels* kernels_of_width(int width) {
#if JN_HAS_WIDE_KERNELS
	if (width > jn_processor_width()) return NULL;
	if (width == 8) return &jn_solid_kernels_8;
	if (width == 4) return &jn_solid_kernels_4;
#endif
	return width == 2 ? &jn_solid_kernels_2 : NULL;
}

int jn_kernel_best_width(void) {
	return jn_processor_width();
}

const JnKernel* jn_kernel_find(JnShape shape, const JnLaw* law, int width) {
	const JnSolidKernels* kernels = kernels_of_width(width != 0 ? width : jn_kernel_best_width());
	if (kernels == NULL || shape >= JN_SOLID_SHAPE_COUNT) return NULL;
	for (int i = 0; i < JN_SOLID_LAW_COUNT; i++) {
		if ((*kernels)[shape][i].law == law) return &(*kernels)[shape][i];
	}
	return NULL;
}
