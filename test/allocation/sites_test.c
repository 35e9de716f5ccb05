// Each place in jounce that asks for memory is refused once.
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "support.h"

static void a_run_that_is_refused_memory_ends_in_a_clean_error(void** unused) {
	(void)unused;
	long runs = 0;
	for (const Case* tried = allocation_cases; tried->scene != NULL; ++tried) {
		runs += allocation_sweep_case(tried, SWEEP_NEW_SITES);
		printf("%s: %d sites so far\n", tried->scene, allocation_site_count());
		fflush(stdout);
	}
	printf("%ld failures at %d sites\n", runs, allocation_site_count());
	assert_true(runs > 400);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_run_that_is_refused_memory_ends_in_a_clean_error),
	};
	return cmocka_run_group_tests_name("sites", tests, NULL, NULL);
}
