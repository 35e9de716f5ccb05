// Each single allocation of small runs is refused once.
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "support.h"

static void each_refused_allocation_ends_in_a_clean_error(void** unused) {
	(void)unused;
	long runs = 0;
	for (const Case* tried = allocation_cases; tried->scene != NULL; ++tried) {
		const long more = allocation_sweep_case(tried, SWEEP_ALL);
		printf("%s: %ld failures\n", tried->scene, more);
		fflush(stdout);
		runs += more;
	}
	printf("%ld failures at %d sites\n", runs, allocation_site_count());
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(each_refused_allocation_ends_in_a_clean_error),
	};
	return cmocka_run_group_tests_name("every", tests, NULL, NULL);
}
