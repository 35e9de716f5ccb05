// JN_SIMD_WIDTH asks for fewer doubles side by side than there are; what makes no sense counts for nothing.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/processor.h"

static int width_with(const char* text) {
	setenv("JN_SIMD_WIDTH", text, 1);
	const int width = jn_processor_width();
	unsetenv("JN_SIMD_WIDTH");
	return width;
}

static void fewer_lanes_can_be_asked_for(void** state) {
	(void)state;
	const int widest = jn_processor_width();
	assert_true(widest == 2 || widest == 4 || widest == 8);
	assert_int_equal(width_with("2"), 2);
	assert_int_equal(width_with("4"), widest < 4 ? widest : 4);
}

static void more_lanes_than_there_are_and_other_words_count_for_nothing(void** state) {
	(void)state;
	static const char* const words[] = {"8", "16", "3", "0", "-2", "", "wide"};
	const int widest = jn_processor_width();
	for (size_t i = 0; i < sizeof words / sizeof *words; ++i) assert_int_equal(width_with(words[i]), widest);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(fewer_lanes_can_be_asked_for),
		cmocka_unit_test(more_lanes_than_there_are_and_other_words_count_for_nothing),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
