/// @file suture_scene_test.c
/// The first stitch of scenes/suture.yaml.
#include "pass/suture_case.h"

static void the_first_stitch_goes_in_and_out_again(void** state) {
	(void)state;
	const SutureStory story = suture_run(1.1);
	expect_near(story.sites, 4, 0, "sites"); // in at the top, out at the bottom, and the other way
	assert_false(story.is_tip_inside);
	expect_at_most(story.error, 1e-4, "largest distance of thread and site [m]"); // a tenth of the radius
	// what has been drawn through the first site: from x = 1.1 cm to the tip at 0.52/4.5 m/s along the curve
	expect_near(story.drawn, 0.055, 0.005, "length drawn through [m]"); // the slab gives by millimetres
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(the_first_stitch_goes_in_and_out_again),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
