// From forces of elements to those of nodes: the same bits with one thread and with several, at every width.
#include "force/thread_case.h"
#include "model/scatter.h"

enum { LINKS = 11 };

static JnGroup links_of(int width, JnArena* arena) {
	JnConstraint elements[LINKS] = {0};
	JnGroup group;
	for (int e = 0; e < LINKS; ++e)
		for (int i = 0; i < 6; ++i) elements[e].nodes[i] = 3 * e + i;
	const JnKernel* kernel = jn_constraint_kernel(JN_CONSTRAINT_thread_link, width);
	assert_int_equal(jn_constraint_group_create(kernel, LINKS, elements, arena, &group), JN_OK);
	return group;
}

// Sums of three numbers depend on their order: what was there before, and the two links at a frame, in element order.
static void links_add_in_the_order_of_elements_whatever_the_range(void** unused) {
	(void)unused;
	enum { REALS = 9 * (LINKS + 1) };
	for (int width = 2; width <= 8; width *= 2) {
		JnArena arena = {0};
		if (jn_constraint_kernel(JN_CONSTRAINT_thread_link, width) == NULL) continue;
		const JnGroup group = links_of(width, &arena);
		double buffer[16 * 18], whole[REALS], parts[REALS], expected[REALS];
		uint64_t seed = 6;
		for (int k = 0; k < 16 * 18; ++k) buffer[k] = random_real(&seed);
		for (int k = 0; k < REALS; ++k) whole[k] = parts[k] = expected[k] = random_real(&seed);
		for (int e = 0; e < LINKS; ++e)
			for (int k = 0; k < 18; ++k) expected[9 * e + k] += -0.3 * buffer[(e / width * 18 + k) * width + e % width];
		const JnNodeRange all = {.low = 0, .high = REALS / 3, .is_all = true}, low = {.low = 0, .high = 13},
						  high = {.low = 13, .high = REALS / 3};
		jn_scatters(width)->forces(&group, 0, group.batches, buffer, -0.3, all, whole);
		jn_scatters(width)->forces(&group, 0, group.batches, buffer, -0.3, low, parts);
		jn_scatters(width)->forces(&group, 0, group.batches, buffer, -0.3, high, parts);
		assert_memory_equal(whole, expected, sizeof expected);
		assert_memory_equal(parts, expected, sizeof expected);
		jn_arena_free(&arena);
	}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(links_add_in_the_order_of_elements_whatever_the_range),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
