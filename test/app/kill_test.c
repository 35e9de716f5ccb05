/// @file kill_test.c
/// Some kills at random moments; kill_long_test.c has many.
#include "kill_case.h"

static void a_killed_run_is_read_and_resumed_bit_for_bit(void** state) {
	(void)state;
	kill_often(6);
}

int main(void) {
	const struct CMUnitTest tests[] = {cmocka_unit_test(a_killed_run_is_read_and_resumed_bit_for_bit)};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
