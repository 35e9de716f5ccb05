/// @file collision_knot_test.c
/// The first second of scenes/knot.yaml, in which the loop closes: no link passes through another.
#include "pass/knot_case.h"

static void a_knot_that_closes_stays_a_knot(void** state) {
	(void)state;
	const KnotStory story = knot_run(0.9, 5e-3);
	assert_int_equal(story.least_determinant, 3);
	assert_int_equal(story.most_determinant, 3);
	expect_at_most(0.99, story.least, "0.99 diameters, and the least distance"); // sweeps leave some nanometres
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_knot_that_closes_stays_a_knot),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
