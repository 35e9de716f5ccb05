/// @file contact_input_test.c
/// Mistakes in `contact:` of a scene file: the message names the place, the key, the value, and what to do.
#include "pass/pass_case.h"

/// Line 12 is that of `contact:`; its entries follow on their own lines.
static const char* refusal(const char* contact) {
	Run run;
	log_capture();
	const JnStatus status = run_attempt(&run,
										"duration: 1 s\nintegrator: sdirk2\n"
										"bodies:\n"
										"  - name: block\n"
										"    shape: {type: box, size: [1, 1, 1], cells: [1, 1, 1]}\n"
										"    material: {law: linear, density: 1000, young: 1e5, poisson: 0.3}\n"
										"    contact: {surface: rubber}\n"
										"obstacles:\n"
										"  - name: floor\n"
										"    shape: {type: plane}\n"
										"    surface: wood\n"
										"contact:\n%s\n",
										contact);
	run_close(&run);
	print_message("%s", log_text());
	assert_int_equal(status, JN_BAD_INPUT);
	return log_text();
}

/// Each of these words, up to a NULL, and the place "scene.yaml:<line>:<column>".
static void expect_refusal(const char* contact, const char* place, const char* const words[]) {
	const char* text = refusal(contact);
	char at[64];
	snprintf(at, sizeof at, "scene.yaml:%s", place);
	if (strstr(text, at) == NULL) fail_msg("no place %s in: %s", at, text);
	for (int i = 0; words[i] != NULL; ++i)
		if (strstr(text, words[i]) == NULL) fail_msg("no '%s' in: %s", words[i], text);
	log_release();
}

#define EXPECT_REFUSAL(contact, place, ...) expect_refusal(contact, place, (const char* const[]){__VA_ARGS__, NULL})

static void a_surface_that_nothing_has_is_refused_with_the_nearest_name(void** state) {
	(void)state;
	EXPECT_REFUSAL("  pairs:\n    - {first: ruber, second: wood, friction: 0.5}", "14:8", "contact.pairs[0].first",
				   "ruber", "did you mean 'rubber'?");
	EXPECT_REFUSAL("  pairs:\n    - {first: rubber, second: wood, friction: 0.5}\n"
				   "    - {first: rubber, second: quicksilver, friction: 0.5}",
				   "15:23", "contact.pairs[1].second", "quicksilver", "`surface`");
}

static void friction_below_zero_is_refused(void** state) {
	(void)state;
	EXPECT_REFUSAL("  friction: -0.1", "13:3", "contact.friction", "-0.1", "[0, 100]");
	EXPECT_REFUSAL("  pairs:\n    - {first: rubber, second: wood, friction: -1}", "14:37", "contact.pairs[0].friction",
				   "-1");
}

static void a_pair_without_friction_is_refused(void** state) {
	(void)state;
	EXPECT_REFUSAL("  pairs:\n    - {first: rubber, second: wood}", "14:7", "contact.pairs[0]", "friction");
}

static void an_unknown_solver_is_refused_with_the_known_ones(void** state) {
	(void)state;
	EXPECT_REFUSAL("  solver: {method: delasus}", "13:12", "contact.solver", "delasus", "delassus");
}

static void no_rounds_at_all_are_refused(void** state) {
	(void)state;
	EXPECT_REFUSAL("  rounds: 0", "13:3", "contact.rounds", "0", "[1, 1000]");
}

static void an_unknown_key_is_refused_with_the_nearest_one(void** state) {
	(void)state;
	EXPECT_REFUSAL("  fricton: 0.3", "13:3", "contact.fricton", "friction");
	EXPECT_REFUSAL("  bounce: 0.3", "13:3", "contact.bounce");
}

static void an_unknown_word_is_refused_with_the_known_ones(void** state) {
	(void)state;
	EXPECT_REFUSAL("  prediction: none", "13:3", "contact.prediction", "none", "auto", "carried", "iterated", "free");
	EXPECT_REFUSAL("  rule: touch", "13:3", "contact.rule", "touch", "approaching", "touching");
}

static void a_negative_margin_is_refused(void** state) {
	(void)state;
	EXPECT_REFUSAL("  margin: -1 mm", "13:3", "contact.margin", "-1 mm");
	EXPECT_REFUSAL("  push_out: -1 m/s", "13:3", "contact.push_out", "-1");
	EXPECT_REFUSAL("  push_out: 1 m", "13:3", "contact.push_out", "m/s");
}

static void contact_that_is_no_mapping_is_refused(void** state) {
	(void)state;
	EXPECT_REFUSAL("  - 1", "12:1", "contact", "is a list");
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_surface_that_nothing_has_is_refused_with_the_nearest_name),
		cmocka_unit_test(friction_below_zero_is_refused),
		cmocka_unit_test(a_pair_without_friction_is_refused),
		cmocka_unit_test(an_unknown_solver_is_refused_with_the_known_ones),
		cmocka_unit_test(no_rounds_at_all_are_refused),
		cmocka_unit_test(an_unknown_key_is_refused_with_the_nearest_one),
		cmocka_unit_test(an_unknown_word_is_refused_with_the_known_ones),
		cmocka_unit_test(a_negative_margin_is_refused),
		cmocka_unit_test(contact_that_is_no_mapping_is_refused),
	};
	return cmocka_run_group_tests(tests, case_set_up, case_tear_down);
}
