// All scenes end with the same bits with any number of threads, of which each has a part in the smallest model.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "support/golden.h"

static void scenes_give_the_same_bits_with_two_to_sixteen_threads(void** state) {
	(void)state;
	static const int threads[] = {2, 3, 4, 8, 16};
	for (size_t i = 0; i < sizeof threads / sizeof *threads; ++i) golden_check_threads(threads[i], 1);
}

int main(int count, char** arguments) {
	(void)count;
	golden_prepare(arguments);
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(scenes_give_the_same_bits_with_two_to_sixteen_threads),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
