// Products K p, and diagonal blocks, against the element matrices: in double precision to rounding, in single precision to that of floats.
#include "sample.h"

static double size_of(SampleMatrix K, int reals) {
	double most = 0;
	for (int row = 0; row < reals; row++) most = fmax(most, largest(K[row], reals));
	return most;
}

// A direction whose nodes are one element's own, as doubles and as floats with 4 numbers a node; both are the same numbers.
static void random_direction(const Sample* s, uint64_t seed, double* p, float* single) {
	for (int node = 0; node < s->mesh.node_count; node++) {
		for (int a = 0; a < 3; a++) p[3 * node + a] = single[4 * node + a] = (float)random_real(&seed);
		single[4 * node + 3] = 0;
	}
}

static void expected_product(const Sample* s, SampleMatrix K[SAMPLE_ELEMENTS], const double* p,
							 double out[SAMPLE_ELEMENTS][SAMPLE_MOST_REALS]) {
	for (int e = 0; e < SAMPLE_ELEMENTS; e++)
		for (int row = 0; row < s->reals; row++) {
			out[e][row] = 0;
			for (int column = 0; column < s->reals; column++)
				out[e][row] += K[e][row][column] * p[e * s->reals + column];
		}
}

static void check_product(Sample* s, State state) {
	const JnGroup* g = &s->group;
	const int width = g->kernel->width;
	static SampleMatrix K[SAMPLE_ELEMENTS];
	static double p[SAMPLE_ELEMENTS * SAMPLE_MOST_REALS], lanes[2 * SAMPLE_ELEMENTS * SAMPLE_MOST_REALS * 8];
	static float single[SAMPLE_ELEMENTS * 40];
	double expected[SAMPLE_ELEMENTS][SAMPLE_MOST_REALS];
	random_direction(s, 3, p, single);
	for (int definite = 0; definite < 2; definite++) {
		sample_tangent(s, definite, K);
		expected_product(s, K, p, expected);
		g->kernel->product(g, 0, g->batches, s->x, definite, p, lanes);
		for (int e = 0; e < SAMPLE_ELEMENTS; e++)
			for (int row = 0; row < s->reals; row++) // sums of 30 terms, after some 100 roundings of each entry
				expect_near(lanes[((e / width) * s->reals + row) * width + e % width], expected[e][row],
							1e-12 * size_of(K[e], s->reals), definite ? "definite product" : "product", s, state);
	}
}

static void products_are_those_of_the_tangent(void** unused) {
	(void)unused;
	for_all_samples(check_product);
}

static void check_single(Sample* s, State state) {
	const JnGroup* g = &s->group;
	const JnKernel* kernel = g->kernel;
	const int lanes = 2 * kernel->width, pairs = (g->batches + 1) / 2;
	static SampleMatrix K[SAMPLE_ELEMENTS];
	static double p[SAMPLE_ELEMENTS * SAMPLE_MOST_REALS];
	static float single[SAMPLE_ELEMENTS * 40], out[2 * SAMPLE_ELEMENTS * SAMPLE_MOST_REALS * 16];
	double expected[SAMPLE_ELEMENTS][SAMPLE_MOST_REALS];
	random_direction(s, 4, p, single);
	for (int definite = 0; definite < 2; definite++) {
		const size_t floats = (size_t)pairs * kernel->points * kernel->stored_reals[definite] * lanes;
		float* stored = jn_arena_take(&s->arena, floats, sizeof *stored);
		sample_tangent(s, definite, K);
		expected_product(s, K, p, expected);
		kernel->store(g, 0, g->batches, s->x, definite, stored);
		kernel->product_single(g, 0, g->batches, definite, stored, single, out);
		for (int e = 0; e < SAMPLE_ELEMENTS; e++)
			for (int row = 0; row < s->reals; row++) // half a unit of 6e-8 for each of a few roundings, random in sum
				expect_near((double)out[((e / lanes) * s->reals + row) * lanes + e % lanes], expected[e][row],
							2e-6 * size_of(K[e], s->reals),
							definite ? "definite product in single precision" : "product in single precision", s,
							state);
	}
}

static void products_in_single_precision_agree_to_six_digits(void** unused) {
	(void)unused;
	for_all_samples(check_single);
}

static void check_diagonal(Sample* s, State state) {
	const JnGroup* g = &s->group;
	const int width = g->kernel->width, nodes = g->kernel->nodes;
	static SampleMatrix K[SAMPLE_ELEMENTS];
	static double out[2 * SAMPLE_ELEMENTS * 10 * 6 * 8];
	for (int definite = 0; definite < 2; definite++) {
		sample_tangent(s, definite, K);
		g->kernel->diagonal(g, 0, g->batches, s->x, definite, out);
		for (int e = 0; e < SAMPLE_ELEMENTS; e++)
			for (int i = 0; i < nodes; i++)
				for (int k = 0, a = 0; a < 3; a++)
					for (int b = 0; b <= a; b++, k++)
						expect_near(out[(((e / width) * nodes + i) * 6 + k) * width + e % width],
									K[e][3 * i + a][3 * i + b], 1e-12 * size_of(K[e], s->reals),
									definite ? "definite diagonal" : "diagonal", s, state);
	}
}

static void diagonals_are_those_of_the_tangent(void** unused) {
	(void)unused;
	for_all_samples(check_diagonal);
}

// Five tetrahedra whose cells are listed so that lowest nodes jump: forces are those of the same cells in order.
static void cells_at_random_are_sorted_by_their_nodes(void** unused) {
	(void)unused;
	static const int order[SAMPLE_ELEMENTS] = {3, 0, 4, 1, 2};
	Sample s = sample_create(JN_TET4, &jn_law_stable_neo_hookean, 2, STRETCHED, 5), mixed = s;
	int cells[4 * SAMPLE_ELEMENTS];
	for (int k = 0; k < 4 * SAMPLE_ELEMENTS; k++) cells[k] = s.mesh.cells[4 * order[k / 4] + k % 4];
	mixed.mesh.cells = cells;
	sample_group(&mixed, &jn_law_stable_neo_hookean, 2);
	double force[2][SAMPLE_ELEMENTS][SAMPLE_MOST_REALS];
	sample_force(&s, force[0]);
	sample_force(&mixed, force[1]);
	for (int e = 0; e < SAMPLE_ELEMENTS; e++) {
		assert_int_equal(jn_group_node(&mixed.group, e, 0), 4 * e);
		assert_memory_equal(force[0][e], force[1][e], 12 * sizeof(double));
	}
	jn_arena_free(&s.arena);
}

// The same box sheared, whose cells share one Jacobian, and with one node moved, whose cells do not.
static void parallelepipeds_are_told_from_other_hexahedra(void** unused) {
	(void)unused;
	Sample s = {.reals = 24};
	uint64_t seed = 9;
	sample_mesh(&s, JN_HEX8, 0, &seed);
	for (int i = 0; i < s.mesh.node_count; i++) s.mesh.nodes[3 * i] += 0.3 * s.mesh.nodes[3 * i + 2];
	s.x = s.mesh.nodes;
	sample_group(&s, &jn_law_linear, 2);
	assert_int_equal(s.group.rest_points, 1);
	s.mesh.nodes[3] += 1e-9; // of 0.1 m
	sample_group(&s, &jn_law_linear, 2);
	assert_int_equal(s.group.rest_points, 8);
	jn_arena_free(&s.arena);
}

/// Products in double and in single precision and diagonals, element by element, one behind the other.
static int collect(Sample* s, double* out) {
	const JnGroup* g = &s->group;
	const JnKernel* kernel = g->kernel;
	const int width = kernel->width, lanes = 2 * width, pairs = (g->batches + 1) / 2;
	static double p[SAMPLE_ELEMENTS * SAMPLE_MOST_REALS], wide[2 * SAMPLE_ELEMENTS * SAMPLE_MOST_REALS * 8];
	static float single[SAMPLE_ELEMENTS * 40], rows[2 * SAMPLE_ELEMENTS * SAMPLE_MOST_REALS * 16];
	int count = 0;
	random_direction(s, 5, p, single);
	for (int definite = 0; definite < 2; definite++) {
		const size_t floats = (size_t)pairs * kernel->points * kernel->stored_reals[definite] * lanes;
		float* stored = jn_arena_take(&s->arena, floats, sizeof *stored);
		kernel->product(g, 0, g->batches, s->x, definite, p, wide);
		kernel->store(g, 0, g->batches, s->x, definite, stored);
		kernel->product_single(g, 0, g->batches, definite, stored, single, rows);
		for (int e = 0; e < SAMPLE_ELEMENTS; e++)
			for (int row = 0; row < s->reals; row++) {
				out[count++] = wide[((e / width) * s->reals + row) * width + e % width];
				out[count++] = (double)rows[((e / lanes) * s->reals + row) * lanes + e % lanes];
			}
		kernel->diagonal(g, 0, g->batches, s->x, definite, wide);
		for (int e = 0; e < SAMPLE_ELEMENTS; e++)
			for (int k = 0; k < 6 * kernel->nodes; k++)
				out[count++] = wide[((e / width) * 6 * kernel->nodes + k) * width + e % width];
	}
	return count;
}

static void check_widths(Sample* s, State state) {
	sample_check_widths(s, state, collect);
}

static void all_widths_agree_to_the_bit(void** unused) {
	(void)unused;
	for_all_samples(check_widths);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(products_are_those_of_the_tangent),
		cmocka_unit_test(diagonals_are_those_of_the_tangent),
		cmocka_unit_test(all_widths_agree_to_the_bit),
		cmocka_unit_test(cells_at_random_are_sorted_by_their_nodes),
		cmocka_unit_test(parallelepipeds_are_told_from_other_hexahedra),
		cmocka_unit_test(products_in_single_precision_agree_to_six_digits),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
