// Matrices in single precision: what solvers get from a model, against the same in double precision.
#include "force/solid.h"
#include "model/system.h"
#include "support/model_case.h"

// A matrix M + 0.01 D + 0.001 K of a shaken model, as its operator shows it.
typedef struct Shown {
	ModelCase base;
	Rig rig;
	JnOperator matrices;
	int slot;
} Shown;

static void show(Shown* shown, int threads) {
	JnMatrix* matrix = NULL;
	Rig* rig = &shown->rig;
	rig_create(rig, &shown->base, threads);
	rig_shake(rig, 3, 0.002, 0.5);
	assert_int_equal(rig->sys->ops->linearize(rig->sys, &rig->start), JN_OK);
	assert_int_equal(rig->sys->ops->matrix(rig->sys, (JnShift){1, 0.01, 0.001}, &matrix), JN_OK);
	shown->slot = ((const JnModelMatrix*)matrix)->slot;
	shown->matrices = jn_model_matrix_operator((JnModelSystem*)rig->sys);
	assert_non_null(shown->matrices.apply_single);
}

static void set_case(Shown* shown, int shape, const char* law, int mass, int cells) {
	case_box(&shown->base, shape, law);
	shown->base.box.cells[0] = cells + 1; // batches that are not full
	shown->base.box.cells[1] = shown->base.box.cells[2] = cells;
	shown->base.body.mass = mass;
	shown->base.body.damping = (JnDampingDef){.alpha = 3, .beta = 0.01};
}

// The same numbers as doubles and as floats with 4 a node.
static void fill_both(int nodes, double* in, float* single) {
	uint64_t seed = 5;
	for (int k = 0; k < 4 * nodes; ++k) single[k] = k % 4 < 3 ? (float)random_number(&seed) : 0;
	for (int k = 0; k < 3 * nodes; ++k) in[k] = (double)single[4 * (k / 3) + k % 3];
}

static double difference(int nodes, const double* expected, const float* value) {
	double most = 0;
	for (int k = 0; k < 3 * nodes; ++k) {
		const double off = fabs(expected[k] - (double)value[4 * (k / 3) + k % 3]);
		if (!(off <= most)) most = isnan(off) ? INFINITY : off;
	}
	for (int node = 0; node < nodes; ++node) assert_true(value[4 * node + 3] == 0);
	return most;
}

static double largest_of(const double* values, int count) {
	double most = 0;
	for (int k = 0; k < count; ++k) most = fmax(most, fabs(values[k]));
	return most;
}

static void check_apply(Shown* shown, const char* what) {
	const int nodes = shown->rig.nodes;
	double *in = malloc(3 * (size_t)nodes * sizeof *in), *expected = malloc(3 * (size_t)nodes * sizeof *expected);
	float *single = malloc(4 * (size_t)nodes * sizeof *single), *value = malloc(4 * (size_t)nodes * sizeof *value);
	const JnOperator* matrices = &shown->matrices;
	fill_both(nodes, in, single);
	matrices->apply(matrices->user, shown->slot, in, expected);
	matrices->apply_single(matrices->user, shown->slot, single, value);
	const double size = largest_of(expected, 3 * nodes), off = difference(nodes, expected, value);
	if (!(off <= 2e-6 * size)) // sums of some 100 terms, each rounded to 6e-8 of the largest
		fail_msg("%s: single precision is off by %g of %g, tolerance %g", what, off, size, 2e-6 * size);
	free(in);
	free(expected);
	free(single);
	free(value);
}

static void single_precision_agrees_with_double(void** state) {
	(void)state;
	for (int i = 0; i < JN_SOLID_LAW_COUNT; ++i)
		for (int shape = 0; shape < JN_SOLID_SHAPE_COUNT; ++shape)
			for (int mass = 0; mass < 2; ++mass) {
				Shown shown;
				set_case(&shown, shape, jn_law_list.rows[i]->name, mass, 3);
				show(&shown, 1);
				check_apply(&shown, jn_law_list.rows[i]->name);
				((JnModelSystem*)shown.rig.sys)->group_mass = NULL; // as where elements are not parallelepipeds
				check_apply(&shown, jn_law_list.rows[i]->name);
				rig_destroy(&shown.rig);
			}
}

// The diagonal of one matrix has the order of sums of the other: rounding of some hundred terms.
static void diagonal_blocks_are_those_of_the_matrix(void** state) {
	(void)state;
	for (int i = 0; i < JN_SOLID_LAW_COUNT; ++i)
		for (int shape = 0; shape < JN_SOLID_SHAPE_COUNT; ++shape) {
			Shown shown;
			set_case(&shown, shape, jn_law_list.rows[i]->name, 0, 3);
			show(&shown, 1);
			const JnOperator* matrices = &shown.matrices;
			const JnPattern* pattern = &shown.rig.model->pattern;
			const double *blocks = matrices->blocks(matrices->user, shown.slot),
						 *diagonal = matrices->diagonal(matrices->user, shown.slot);
			const double size = largest_of(blocks, 9 * pattern->blocks);
			for (int k = 0; k < 9 * pattern->nodes; ++k) {
				const double expected = blocks[9 * (size_t)pattern->column_start[k / 9] + (size_t)k % 9];
				if (!(fabs(diagonal[k] - expected) <= 1e-13 * size))
					fail_msg("%s: entry %d is %.17g, expected %.17g", jn_law_list.rows[i]->name, k, diagonal[k],
							 expected);
			}
			rig_destroy(&shown.rig);
		}
}

static void a_new_state_is_stored_anew(void** state) {
	(void)state;
	Shown shown;
	set_case(&shown, JN_HEX8, "stable_neo_hookean", 0, 3);
	show(&shown, 1);
	check_apply(&shown, "first state");
	rig_shake(&shown.rig, 8, 0.004, 0.5);
	assert_int_equal(shown.rig.sys->ops->linearize(shown.rig.sys, &shown.rig.start), JN_OK);
	check_apply(&shown, "second state");
	rig_destroy(&shown.rig);
}

static float* product_with(int threads, int shape, size_t* bytes) {
	Shown shown;
	set_case(&shown, shape, "stable_neo_hookean", 0, 16);
	show(&shown, threads);
	const size_t nodes = (size_t)shown.rig.nodes;
	*bytes = 4 * nodes * sizeof(float);
	double* in = malloc(3 * nodes * sizeof *in);
	float *single = malloc(*bytes), *value = malloc(*bytes);
	fill_both((int)nodes, in, single);
	shown.matrices.apply_single(shown.matrices.user, shown.slot, single, value);
	free(in);
	free(single);
	rig_destroy(&shown.rig);
	return value;
}

static void the_number_of_threads_changes_no_bit(void** state) {
	(void)state;
	for (int shape = 0; shape < JN_SOLID_SHAPE_COUNT; shape += 2) {
		size_t bytes;
		float *one = product_with(1, shape, &bytes), *three = product_with(3, shape, &bytes);
		assert_memory_equal(one, three, bytes);
		free(one);
		free(three);
	}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(single_precision_agrees_with_double),
		cmocka_unit_test(diagonal_blocks_are_those_of_the_matrix),
		cmocka_unit_test(a_new_state_is_stored_anew),
		cmocka_unit_test(the_number_of_threads_changes_no_bit),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
