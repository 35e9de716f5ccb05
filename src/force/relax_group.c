// Chooses the kernels of relaxation by what the processor can do, and makes batches of elements that share no node: each
// element goes to the first open batch that has none of its nodes. Open are the 64 from `base` on; a bit for each of them
// tells, node by node, where a node is.
#include <string.h>

#include "base/log.h"
#include "base/processor.h"
#include "force/relax.h"

enum { LANES = 8, WINDOW = 64 };

/// The open batches that have a node: bit i is batch base + i.
typedef struct Presence {
	int base;
	uint64_t in;
} Presence;

typedef struct Batches {
	const JnKernel* kernel;
	int base, count; // first open batch; batches begun
	uint64_t full;   // of the open ones
	Presence* nodes; // of the model
	int* filled;     // lanes of each batch
	int* member;     // [batch][LANES]: element, or -1
} Batches;

const JnKernel* jn_relax_kernel(JnRelaxKernel which, int width) {
	const int chosen = width != 0 ? width : jn_processor_width();
	if (chosen > jn_processor_width()) return NULL;
#if defined(__x86_64__)
	if (chosen == 8) return &jn_relax_kernels_8[which];
	if (chosen == 4) return &jn_relax_kernels_4[which];
#endif
	return chosen == 2 ? &jn_relax_kernels_2[which] : NULL;
}

static int most_node(const JnKernel* kernel, int count, const JnRelaxElement* elements) {
	int most = 0;
	for (int e = 0; e < count; ++e)
		for (int i = 0; i < kernel->nodes; ++i) most = elements[e].nodes[i] > most ? elements[e].nodes[i] : most;
	return most;
}

static uint64_t seen_from(int base, const Presence* node) {
	const int past = base - node->base;
	return past < WINDOW ? node->in >> past : 0;
}

// Close batches at the front: those that are full, and one more where none is free.
static void slide(Batches* batches, bool must) {
	while (must || (batches->full & 1) != 0) {
		++batches->base;
		batches->full >>= 1;
		must = false;
	}
}

// The open batches in which an element has no place.
static uint64_t taken_for(const Batches* batches, const JnRelaxElement* constraint) {
	uint64_t taken = batches->full;
	for (int i = 0; i < batches->kernel->nodes; ++i)
		taken |= seen_from(batches->base, &batches->nodes[constraint->nodes[i]]);
	return taken;
}

static void put(Batches* batches, int element, const JnRelaxElement* constraint) {
	uint64_t taken = taken_for(batches, constraint);
	if (taken == UINT64_MAX) {
		slide(batches, true);
		taken = taken_for(batches, constraint);
	}
	const int bit = __builtin_ctzll(~taken), batch = batches->base + bit;
	if (batch == batches->count) ++batches->count;
	batches->member[batch * LANES + batches->filled[batch]++] = element;
	for (int i = 0; i < batches->kernel->nodes; ++i) {
		Presence* node = &batches->nodes[constraint->nodes[i]];
		*node = (Presence){batches->base, seen_from(batches->base, node) | (uint64_t)1 << bit};
	}
	if (batches->filled[batch] == LANES) batches->full |= (uint64_t)1 << bit;
	slide(batches, false);
}

static int lane_of(const Batches* batches, int slot) {
	const int element = batches->member[slot];
	return element >= 0 ? element : batches->member[slot - slot % LANES]; // padding repeats the first of its batch
}

// Batches of 8 lanes as those of the kernel, which are as many or more.
static JnStatus fill(const Batches* batches, const JnRelaxElement* elements, int first_node, JnArena* arena,
					 JnGroup* group) {
	const JnKernel* kernel = batches->kernel;
	const int width = kernel->width, slots = batches->count * LANES, weight = kernel->rest_reals - 1;
	*group = (JnGroup){.kernel = kernel, .count = slots, .batches = slots / width};
	JN_NEW(arena, group->nodes, (size_t)slots * kernel->nodes);
	JN_NEW(arena, group->rest, (size_t)slots * kernel->rest_reals);
	for (int slot = 0; slot < slots; ++slot) {
		const JnRelaxElement* element = &elements[lane_of(batches, slot)];
		const ptrdiff_t batch = slot / width, lane = slot % width;
		for (int i = 0; i < kernel->nodes; ++i)
			group->nodes[(batch * kernel->nodes + i) * width + lane] = first_node + element->nodes[i];
		for (int k = 0; k < kernel->rest_reals; ++k)
			group->rest[(batch * kernel->rest_reals + k) * width + lane] =
				k < weight ? element->rest[k] : batches->member[slot] >= 0;
	}
	return JN_OK;
}

static JnStatus arrange(const JnKernel* kernel, int count, const JnRelaxElement* elements, JnArena* scratch,
						Batches* batches) {
	*batches = (Batches){.kernel = kernel};
	JN_NEW(scratch, batches->nodes, most_node(kernel, count, elements) + 1);
	JN_NEW(scratch, batches->filled, count + WINDOW);
	JN_NEW(scratch, batches->member, ((size_t)count + WINDOW) * LANES);
	memset(batches->member, -1, ((size_t)count + WINDOW) * LANES * sizeof *batches->member);
	for (int e = 0; e < count; ++e) put(batches, e, &elements[e]);
	return JN_OK;
}

JnStatus jn_relax_group_create(const JnKernel* kernel, int count, const JnRelaxElement* elements, int first_node,
							   JnArena* arena, JnGroup* group) {
	JnArena scratch = {0};
	Batches batches;
	JnStatus status = arrange(kernel, count, elements, &scratch, &batches);
	if (status == JN_OK) status = fill(&batches, elements, first_node, arena, group);
	jn_arena_free(&scratch);
	return status;
}
