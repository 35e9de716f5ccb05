// Chooses the kernels of cloth by what the processor can do, and puts elements into batches.
#include <string.h>

#include "base/log.h"
#include "base/processor.h"
#include "force/cloth/cloth.h"

const JnKernel* jn_cloth_kernel(JnClothKernel which, int width) {
	const int chosen = width != 0 ? width : jn_processor_width();
	if (chosen > jn_processor_width()) return NULL;
#if defined(__x86_64__)
	if (chosen == 8) return &jn_cloth_kernels_8[which];
	if (chosen == 4) return &jn_cloth_kernels_4[which];
#endif
	return chosen == 2 ? &jn_cloth_kernels_2[which] : NULL;
}

static int weights_of(const JnKernel* kernel) {
#define WEIGHTS(name, nodes, reals, weights) [JN_CLOTH_##name] = (weights),
	static const int weights[JN_CLOTH_COUNT] = {JN_CLOTH_KERNELS(WEIGHTS)};
	int which = 0;
	while (jn_cloth_kernel(which, kernel->width) != kernel) ++which;
	return weights[which];
}

JnStatus jn_cloth_group_create(const JnKernel* kernel, int count, const JnClothElement* elements, JnArena* arena,
							   JnGroup* group) {
	const int width = kernel->width, batches = (count + width - 1) / width;
	const int padded = kernel->rest_reals - weights_of(kernel); // numbers that padding has
	*group = (JnGroup){.kernel = kernel, .count = count, .batches = batches};
	JN_NEW(arena, group->nodes, (size_t)batches * kernel->nodes * width);
	JN_NEW(arena, group->rest, (size_t)batches * kernel->rest_reals * width);
	for (int slot = 0; slot < batches * width; ++slot) {
		const JnClothElement* element = &elements[slot < count ? slot : count - 1];
		const ptrdiff_t batch = slot / width, lane = slot % width;
		for (int i = 0; i < kernel->nodes; ++i)
			group->nodes[(batch * kernel->nodes + i) * width + lane] = element->nodes[i];
		for (int k = 0; k < kernel->rest_reals; ++k)
			group->rest[(batch * kernel->rest_reals + k) * width + lane] =
				slot < count || k < padded ? element->rest[k] : 0;
	}
	return JN_OK;
}
