/// @file peridynamic_input_test.c
/// Mistakes in the material of a peridynamic body, and notches: what they cut, and what they say when they cut nothing.
#include "force/bond.h"
#include "pass/pass_case.h"

static JnStatus attempt(Run* run, const char* shape, const char* material) {
	return run_attempt(run,
					   "duration: 1 s\nintegrator: verlet\n"
					   "bodies:\n"
					   "  - shape: {%s}\n"
					   "    material: {law: peridynamic, density: 2440, young: 72 GPa, %s}\n",
					   shape, material);
}

static void expect_refusal(const char* shape, const char* material, const char* const words[]) {
	Run run;
	log_capture();
	const JnStatus status = attempt(&run, shape, material);
	run_close(&run);
	print_message("%s", log_text());
	for (int i = 0; words[i] != NULL; ++i)
		if (strstr(log_text(), words[i]) == NULL) fail_msg("no '%s' in: %s", words[i], log_text());
	log_release();
	assert_int_equal(status, JN_BAD_INPUT);
}

#define EXPECT_REFUSAL(shape, material, ...) expect_refusal(shape, material, (const char* const[]){__VA_ARGS__, NULL})

static const char* const plate = "type: points_box, size: [0.1, 0.04, 0.001], spacing: 2 mm, layer: true";

static void bonds_break_by_exactly_one_rule(void** state) {
	(void)state;
	EXPECT_REFUSAL(plate, "horizon_spacings: 3", "bodies[0].material", "fracture_energy or critical_stretch");
	EXPECT_REFUSAL(plate, "critical_stretch: 0.01, fracture_energy: 100", "bodies[0].material.fracture_energy",
				   "give one of them");
	EXPECT_REFUSAL(plate, "critical_stretch: -1", "critical_stretch", "-1");
	EXPECT_REFUSAL(plate, "fracture_energy: 0", "fracture_energy", "0");
	EXPECT_REFUSAL(plate, "critical_stretch: 1, poisson: 0.3", "poisson");
}

static void a_horizon_is_one_and_reaches_neighbours(void** state) {
	(void)state;
	EXPECT_REFUSAL(plate, "critical_stretch: 1, horizon: 1 mm", "bodies[0].material.horizon", "0.001 m", "0.002 m",
				   "about 3 spacings");
	EXPECT_REFUSAL(plate, "critical_stretch: 1, horizon: 5 mm, horizon_spacings: 3", "bodies[0].material.horizon",
				   "give one of them");
}

static void more_bonds_than_memory_are_counted_before_they_are_made(void** state) {
	(void)state;
	EXPECT_REFUSAL("type: points_box, size: [1, 1, 1], counts: [200, 200, 200]", "critical_stretch: 1, horizon: 5 cm",
				   "8000000 points", "bonds, more than 2e+08", "10.0 spacings", "larger spacing");
}

static void a_peridynamic_body_is_made_of_points(void** state) {
	(void)state;
	EXPECT_REFUSAL("type: box, size: [1, 1, 1], cells: [1, 1, 1]", "critical_stretch: 1",
				   "'peridynamic' runs on points", "hex8", "points_box");
}

static void points_are_counted_in_one_way(void** state) {
	(void)state;
	EXPECT_REFUSAL("type: points_box, size: [1, 1, 1]", "critical_stretch: 1", "bodies[0].shape",
				   "exactly one of spacing and counts");
	EXPECT_REFUSAL("type: points_box, size: [1, 1, 1], counts: [4, 4, 2], layer: true", "critical_stretch: 1",
				   "bodies[0].shape.counts", "one point along z, not 2");
	EXPECT_REFUSAL("type: points_box, size: [1, 1, 1], spacing: 1 mm", "critical_stretch: 1", "1e+09",
				   "use a larger spacing");
}

static void a_notch_that_cuts_nothing_is_refused(void** state) {
	(void)state;
	EXPECT_REFUSAL(plate, "critical_stretch: 1, notches: [{from: [0, 1, 0], to: [0.05, 1, 0]}]",
				   "bodies[0].material.notches[0]", "crosses no bond", "[0.001, 0.099]");
	EXPECT_REFUSAL(plate,
				   "critical_stretch: 1, notches: [{from: [0, 0.02, 0], to: [0.05, 0.02, 0]}, "
				   "{from: [0, 0.02, 0], to: [0, 0.02, 0]}]",
				   "bodies[0].material.notches[1]", "has no area");
}

// Every bond is on one side of the cut or beyond its end, and the body without the notch has more.
static void no_bond_crosses_a_notch(void** state) {
	(void)state;
	Run whole, cut;
	assert_int_equal(attempt(&whole, plate, "critical_stretch: 1"), JN_OK);
	assert_int_equal(attempt(&cut, plate, "critical_stretch: 1, notches: [{from: [0, 0.02, 0], to: [0.05, 0.02, 0]}]"),
					 JN_OK);
	const JnGroup* group = &cut.model->groups[0];
	const double* rest = jn_model_rest(cut.model);
	for (int b = 0; b < group->count; ++b) {
		const JnBond bond = jn_bond_get(group, b);
		const double *X = rest + 3 * (size_t)bond.nodes[0], *Y = rest + 3 * (size_t)bond.nodes[1];
		if ((X[1] < 0.02) == (Y[1] < 0.02)) continue;
		assert_true(X[0] + (Y[0] - X[0]) * (0.02 - X[1]) / (Y[1] - X[1]) > 0.05);
	}
	print_message("%d bonds, %d without those that the notch cuts\n", whole.model->groups[0].count, group->count);
	assert_true(group->count < whole.model->groups[0].count);
	run_close(&whole);
	run_close(&cut);
}

// A cut in a block ends where its parallelogram ends.
static void a_notch_in_a_block_ends_at_its_edges(void** state) {
	(void)state;
	Run run;
	assert_int_equal(
		attempt(&run, "type: points_box, size: [0.01, 0.01, 0.01], spacing: 1 mm",
				"critical_stretch: 1, horizon_spacings: 2, notches: [{from: [0, 0.005, 0], to: [0.005, 0.005, "
				"0], across: [0, 0, 0.004]}]"),
		JN_OK);
	const JnGroup* group = &run.model->groups[0];
	const double* rest = jn_model_rest(run.model);
	int beside = 0;
	for (int b = 0; b < group->count; ++b) {
		const JnBond bond = jn_bond_get(group, b);
		const double *X = rest + 3 * (size_t)bond.nodes[0], *Y = rest + 3 * (size_t)bond.nodes[1];
		if ((X[1] < 0.005) == (Y[1] < 0.005)) continue;
		const double share = (0.005 - X[1]) / (Y[1] - X[1]);
		const double x = X[0] + share * (Y[0] - X[0]), z = X[2] + share * (Y[2] - X[2]);
		assert_true(x > 0.005 || z > 0.004);
		beside += x < 0.005;
	}
	assert_true(beside > 0);
	run_close(&run);
}

static void points_in_an_unbreakable_box_keep_their_bonds(void** state) {
	(void)state;
	Run run;
	assert_int_equal(attempt(&run, plate, "critical_stretch: 0.01, unbreakable: [{min: [0, 0, 0], max: [1, 0.01, 1]}]"),
					 JN_OK);
	const JnGroup* group = &run.model->groups[0];
	for (int b = 0; b < group->count; ++b) {
		const JnBond bond = jn_bond_get(group, b);
		bool is_kept = false;
		for (int i = 0; i < 2; ++i) is_kept |= jn_model_rest(run.model)[3 * (size_t)bond.nodes[i] + 1] <= 0.01;
		assert_true(is_kept ? isinf(bond.stretch) : bond.stretch == 0.01);
	}
	run_close(&run);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(bonds_break_by_exactly_one_rule),
		cmocka_unit_test(a_horizon_is_one_and_reaches_neighbours),
		cmocka_unit_test(more_bonds_than_memory_are_counted_before_they_are_made),
		cmocka_unit_test(a_peridynamic_body_is_made_of_points),
		cmocka_unit_test(points_are_counted_in_one_way),
		cmocka_unit_test(a_notch_that_cuts_nothing_is_refused),
		cmocka_unit_test(no_bond_crosses_a_notch),
		cmocka_unit_test(a_notch_in_a_block_ends_at_its_edges),
		cmocka_unit_test(points_in_an_unbreakable_box_keep_their_bonds),
	};
	return cmocka_run_group_tests(tests, case_set_up, case_tear_down);
}
