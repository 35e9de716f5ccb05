// Chooses the kernel of bonds by what the processor can do, and builds groups of them.
#include "force/bond.h"

#include "base/processor.h"

extern const JnKernel jn_bond_kernel_2, jn_bond_kernel_4, jn_bond_kernel_8;

const JnKernel* jn_bond_kernel(int width) {
#if defined(__x86_64__)
	const int widest = jn_processor_width(), chosen = width != 0 ? width : widest;
	if (chosen > widest) return NULL;
	if (chosen == 8) return &jn_bond_kernel_8;
	if (chosen == 4) return &jn_bond_kernel_4;
	return chosen == 2 ? &jn_bond_kernel_2 : NULL;
#else
	return width == 0 || width == 2 ? &jn_bond_kernel_2 : NULL;
#endif
}

JnStatus jn_bonds_create(int count, JnArena* arena, JnGroup* group) {
	const JnKernel* kernel = jn_bond_kernel(0);
	const int batches = (int)(((ptrdiff_t)count + kernel->width - 1) / kernel->width);
	*group = (JnGroup){.kernel = kernel, .count = count, .batches = batches};
	JN_NEW(arena, group->nodes, (size_t)batches * 2 * (size_t)kernel->width + 1);
	JN_NEW(arena, group->rest, (size_t)batches * JN_BOND_REALS * (size_t)kernel->width + 1);
	return JN_OK;
}

void jn_bond_set(JnGroup* group, int bond, const JnBond* def) {
	const int width = group->kernel->width, lane = bond % width;
	const ptrdiff_t batch = bond / width;
	double* rest = group->rest + batch * JN_BOND_REALS * width + lane;
	for (int i = 0; i < 2; i++) group->nodes[(batch * 2 + i) * width + lane] = def->nodes[i];
	rest[JN_BOND_LENGTH * width] = def->length;
	rest[JN_BOND_FORCE * width] = def->force;
	rest[JN_BOND_STRETCH * width] = def->stretch;
}

JnBond jn_bond_get(const JnGroup* group, int bond) {
	const int width = group->kernel->width, lane = bond % width;
	const ptrdiff_t batch = bond / width;
	const int* nodes = group->nodes + batch * 2 * width + lane;
	const double* rest = group->rest + batch * JN_BOND_REALS * width + lane;
	return (JnBond){.nodes = {nodes[0], nodes[width]},
					.length = rest[JN_BOND_LENGTH * width],
					.force = rest[JN_BOND_FORCE * width],
					.stretch = rest[JN_BOND_STRETCH * width]};
}

void jn_bonds_pad(JnGroup* group) {
	if (group->count == 0) return;
	JnBond last = jn_bond_get(group, group->count - 1);
	last.force = 0;
	for (int bond = group->count; bond < group->batches * group->kernel->width; bond++) jn_bond_set(group, bond, &last);
}
