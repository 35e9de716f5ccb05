// Random displacement at the start.
#include "support/model_case.h"

static void scattered_rig(Rig* rig, ModelCase* c, double amplitude, int seed) {
	case_box(c, JN_HEX8, "stable_neo_hookean");
	c->box.cells[0] = c->box.cells[1] = c->box.cells[2] = 7;
	c->body.scatter = (JnScatterDef){.amplitude = amplitude, .seed = seed};
	rig_create(rig, c, 1);
}

static double displacement(const Rig* rig, int node) {
	const double *x = rig->start.x + 3 * node, *X = jn_model_rest(rig->model) + 3 * node;
	return hypot(hypot(x[0] - X[0], x[1] - X[1]), x[2] - X[2]);
}

static void free_nodes_move_within_the_ball_and_held_ones_stay(void** state) {
	(void)state;
	ModelCase c;
	Rig rig;
	int held = 0, free_count = 0;
	double squares = 0;
	scattered_rig(&rig, &c, 0.03, 5);
	for (int node = 0; node < rig.nodes; ++node) {
		const double moved = displacement(&rig, node);
		const bool is_held = jn_model_rest(rig.model)[3 * node + 2] == 0;
		held += is_held;
		if (is_held) assert_true(moved == 0);
		if (is_held) continue;
		++free_count;
		squares += moved * moved;
		assert_true(moved > 0 && moved <= 0.03 * (1 + 1e-12)); // rounding of positions near 0.4
	}
	assert_int_equal(held, 64);
	// uniform in a ball: mean square 3/5, with variance 3/7 - 9/25 = 0.0686; five standard errors of 448 nodes
	expect_near(squares / free_count / (0.03 * 0.03), 0.6, 5 * sqrt(0.0686 / 448), "mean square");
	rig_destroy(&rig);
}

static void held_axes_alone_stay(void** state) {
	(void)state;
	ModelCase c;
	Rig whole, partly;
	scattered_rig(&whole, &c, 0.03, 5);
	rig_destroy(&whole);
	c.fix[0].axes = "y";
	rig_create(&partly, &c, 1);
	c.body.fix.count = 0;
	rig_create(&whole, &c, 1);
	for (int k = 0; k < whole.length; ++k) {
		const double X = jn_model_rest(whole.model)[k];
		const bool is_held = k % 3 == 1 && jn_model_rest(whole.model)[k / 3 * 3 + 2] == 0;
		// what is fixed changes no other axis
		assert_true(partly.start.x[k] == (is_held ? X : whole.start.x[k]));
		assert_true(whole.start.x[k] != X);
	}
	rig_destroy(&partly);
	rig_destroy(&whole);
}

static void the_seed_decides(void** state) {
	(void)state;
	ModelCase c;
	Rig first, same, other;
	scattered_rig(&first, &c, 0.03, 1);
	scattered_rig(&same, &c, 0.03, 1);
	scattered_rig(&other, &c, 0.03, 2);
	assert_memory_equal(first.start.x, same.start.x, (size_t)first.length * sizeof(double));
	assert_true(largest_difference(first.start.x, other.start.x, first.length) > 0.01);
	rig_destroy(&first);
	rig_destroy(&same);
	rig_destroy(&other);
}

static void amplitude_zero_is_rest(void** state) {
	(void)state;
	ModelCase c;
	Rig rig;
	scattered_rig(&rig, &c, 0, 1);
	assert_memory_equal(rig.start.x, jn_model_rest(rig.model), (size_t)rig.length * sizeof(double));
	rig_destroy(&rig);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(free_nodes_move_within_the_ball_and_held_ones_stay),
		cmocka_unit_test(held_axes_alone_stay),
		cmocka_unit_test(the_seed_decides),
		cmocka_unit_test(amplitude_zero_is_rest),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
