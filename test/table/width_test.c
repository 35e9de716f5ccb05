// Kernels for 8, 4 and 2 numbers side by side give the same bits, in small scenes that between them reach all laws' kinds, passes,
// solvers and integrators with memory: those of test/allocation.
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/processor.h"
#include "support/golden.h"
#include "support/support.h"

static const char* const names[] = {"solids",  "cloth", "suture",      "points",
									"threads", "large", "exponential", "pendulum"};

static void check(const char* name) {
	static const char* const widths[] = {"4", "2"};
	char file[64];
	GoldenRow whole, row;
	snprintf(file, sizeof file, "%s.yaml", name);
	const char* path = path_join(JN_SOURCE_DIR "/test/allocation", file);
	unsetenv("JN_SIMD_WIDTH");
	assert_true(golden_run(path, GOLDEN_FILE, 1, 1, &whole));
	for (int i = 0; i < 2; ++i) {
		setenv("JN_SIMD_WIDTH", widths[i], 1);
		path = path_join(JN_SOURCE_DIR "/test/allocation", file);
		assert_true(golden_run(path, GOLDEN_FILE, 1, 1, &row));
		if (!golden_is_same(&whole, &row))
			fail_msg("%s: %s with vectors of %s, %s with vectors of the processor's", name, row.end, widths[i],
					 whole.end);
	}
	unsetenv("JN_SIMD_WIDTH");
	print_message("%s: %ld steps, %s\n", name, whole.steps, whole.end);
}

static void vectors_of_any_length_give_the_same_bits(void** state) {
	(void)state;
	print_message("the processor has vectors of %d\n", jn_processor_width());
	for (size_t i = 0; i < sizeof names / sizeof *names; ++i) check(names[i]);
}

int main(int count, char** arguments) {
	(void)count;
	golden_prepare(arguments);
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(vectors_of_any_length_give_the_same_bits),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
