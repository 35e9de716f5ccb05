/// @file suture_scene_long_test.c
/// The whole of scenes/suture.yaml: twelve sites, and the slab is gathered.
#include "pass/suture_case.h"

static void a_running_stitch_gathers_the_slab(void** state) {
	(void)state;
	const SutureStory sewn = suture_run(2.5), tight = suture_run(6);
	expect_near(sewn.sites, 12, 0, "sites once the needle is through");
	expect_near(tight.sites, 12, 0, "sites at the end");
	assert_false(tight.is_tip_inside);
	expect_at_most(tight.error, 3e-4, "largest distance of thread and site [m]"); // a quarter of the radius
	expect_at_most(tight.gather, 0.9 * sewn.gather, "distances of sites, and nine tenths of those before");
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_running_stitch_gathers_the_slab),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
