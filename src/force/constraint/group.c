// Chooses the kernels of constraints by what the processor can do, and puts elements into batches.
#include <assert.h>

#include "base/log.h"
#include "base/processor.h"
#include "force/constraint/constraint.h"
#include "force/constraint/link_parts.h"

const JnKernel* jn_constraint_kernel(JnConstraintKernel which, int width) {
	const int chosen = width != 0 ? width : jn_processor_width();
	if (chosen > jn_processor_width()) return NULL;
#if defined(__x86_64__)
	if (chosen == 8) return &jn_constraint_kernels_8[which];
	if (chosen == 4) return &jn_constraint_kernels_4[which];
#endif
	return chosen == 2 ? &jn_constraint_kernels_2[which] : NULL;
}

static int weights_of(const JnKernel* kernel) {
#define WEIGHTS(name, nodes, reals, weights) [JN_CONSTRAINT_##name] = (weights),
	static const int weights[JN_CONSTRAINT_COUNT] = {JN_CONSTRAINT_KERNELS(WEIGHTS)};
	int which = 0;
	while (jn_constraint_kernel(which, kernel->width) != kernel) ++which;
	return weights[which];
}

JnStatus jn_constraint_group_create(const JnKernel* kernel, int count, const JnConstraint* elements, JnArena* arena,
									JnGroup* group) {
	const int width = kernel->width, batches = (count + width - 1) / width;
	const int padded = kernel->rest_reals - weights_of(kernel); // numbers that padding has
	*group = (JnGroup){.kernel = kernel, .count = count, .batches = batches};
	JN_NEW(arena, group->nodes, (size_t)batches * kernel->nodes * width);
	JN_NEW(arena, group->rest, (size_t)batches * kernel->rest_reals * width);
	for (int slot = 0; slot < batches * width; ++slot) {
		const JnConstraint* element = &elements[slot < count ? slot : count - 1];
		const ptrdiff_t batch = slot / width, lane = slot % width;
		for (int i = 0; kernel->nodes == LINK_NODES && i < LINK_NODES; ++i)
			assert(element->nodes[i] == element->nodes[i - i % JN_FRAME_NODES] + i % JN_FRAME_NODES);
		for (int i = 0; i < kernel->nodes; ++i)
			group->nodes[(batch * kernel->nodes + i) * width + lane] = element->nodes[i];
		for (int k = 0; k < kernel->rest_reals; ++k)
			group->rest[(batch * kernel->rest_reals + k) * width + lane] =
				slot < count || k < padded ? element->rest[k] : 0;
	}
	return JN_OK;
}
