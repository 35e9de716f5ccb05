/// @file collision_knot_long_test.c
/// The whole of scenes/knot.yaml: the knot holds, and the tension comes through it.
#include "pass/knot_case.h"

static void a_knot_holds_twice_the_weight_of_its_thread(void** state) {
	(void)state;
	const KnotStory story = knot_run(5, 0.02);
	assert_int_equal(story.least_determinant, 3);
	assert_int_equal(story.most_determinant, 3);
	expect_at_most(0.99, story.least, "0.99 diameters, and the least distance"); // sweeps leave some nanometres
	// it swings a little to the end: parts in a thousand of the weight are left
	expect_near(story.start_tension, 1, 0.02, "tension at the held end over load and weight");
	expect_near(story.end_tension, 1, 0.02, "tension at the drawn end over the load");
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_knot_holds_twice_the_weight_of_its_thread),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
