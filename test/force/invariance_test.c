// What elements must not notice: rigid motions, size, the order of nodes, the width of the vector unit.
#include "sample.h"

// Rounding of positions is 1e-16 of 0.1 m, or of 10 m after a translation, over strains of 0.02.
static const double TOLERANCE = 1e-9;

static void check_balance(Sample* s, State state) {
	double f[SAMPLE_ELEMENTS][SAMPLE_MOST_REALS];
	sample_force(s, f);
	const bool turns = strcmp(s->group.kernel->law->row.name, "linear") != 0;
	for (int e = 0; e < SAMPLE_ELEMENTS; e++) {
		double net[3] = {0}, torque[3] = {0};
		const double scale = largest(f[e], s->reals);
		for (int k = 0; k < s->reals; k++) {
			const int node = k / 3, a = k % 3, b = (a + 1) % 3, c = (a + 2) % 3;
			const double* x = s->x + e * s->reals + 3 * node;
			net[a] += f[e][k];
			torque[a] += x[b] * f[e][3 * node + c] - x[c] * f[e][3 * node + b];
		}
		expect_near(largest(net, 3), 0, TOLERANCE * scale, "net force", s, state);
		// frozen rotations balance torque at the state where they were frozen, as here
		if (turns) expect_near(largest(torque, 3), 0, TOLERANCE * scale, "net torque", s, state);
	}
}

static void forces_and_torques_balance(void** unused) {
	(void)unused;
	for_all_samples(check_balance);
}

static void check_motion(Sample* s, State state) {
	double before[SAMPLE_ELEMENTS][SAMPLE_MOST_REALS], after[SAMPLE_ELEMENTS][SAMPLE_MOST_REALS];
	double R[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
	uint64_t seed = 5;
	if (strcmp(s->group.kernel->law->row.name, "linear") != 0) random_rotation(&seed, R);
	sample_force(s, before);
	for (int i = 0; i < s->mesh.node_count; i++) {
		double* x = s->x + 3 * i;
		const double old[3] = {x[0], x[1], x[2]};
		for (int a = 0; a < 3; a++) x[a] = R[a][0] * old[0] + R[a][1] * old[1] + R[a][2] * old[2] + 3 * a - 7;
	}
	if (s->group.kernel->freeze != NULL) s->group.kernel->freeze(&s->group, 0, s->group.batches, s->x);
	sample_force(s, after);
	for (int e = 0; e < SAMPLE_ELEMENTS; e++) {
		for (int k = 0; k < s->reals; k++) {
			const double* f = before[e] + k / 3 * 3;
			const double expected = R[k % 3][0] * f[0] + R[k % 3][1] * f[1] + R[k % 3][2] * f[2];
			expect_near(after[e][k], expected, TOLERANCE * largest(before[e], s->reals), "moved force", s, state);
		}
	}
}

static void forces_turn_with_the_body_and_ignore_its_place(void** unused) {
	(void)unused;
	for_all_samples(check_motion);
}

static void check_scale(Sample* s, State state) {
	double before[SAMPLE_ELEMENTS][SAMPLE_MOST_REALS], after[SAMPLE_ELEMENTS][SAMPLE_MOST_REALS];
	sample_force(s, before);
	for (int k = 0; k < 3 * s->mesh.node_count; k++) {
		s->mesh.nodes[k] *= 1000;
		s->x[k] *= 1000;
	}
	sample_group(s, s->group.kernel->law, s->group.kernel->width);
	sample_force(s, after);
	for (int k = 0; k < s->reals; k++) {
		const double scale = largest(before[0], s->reals);
		expect_near(after[0][k] / 1e6, before[0][k], TOLERANCE * scale, "scaled force", s, state);
	}
}

static void forces_grow_with_the_square_of_size(void** unused) {
	(void)unused;
	for_all_samples(check_scale);
}

static void check_permutation(Sample* s, State state) {
	static const int even[2][4] = {{1, 2, 0, 3}, {1, 0, 3, 2}};
	if (s->mesh.shape != JN_TET4) return;
	double before[SAMPLE_ELEMENTS][SAMPLE_MOST_REALS], after[SAMPLE_ELEMENTS][SAMPLE_MOST_REALS];
	sample_force(s, before);
	for (int order = 0; order < 2; order++) {
		for (int i = 0; i < s->mesh.node_count; i++) s->mesh.cells[i] = i / 4 * 4 + even[order][i % 4];
		sample_group(s, s->group.kernel->law, s->group.kernel->width);
		sample_force(s, after);
		for (int k = 0; k < SAMPLE_ELEMENTS * 12; k++) {
			const int e = k / 12, i = k / 3 % 4, a = k % 3;
			const double expected = before[e][3 * even[order][i] + a];
			expect_near(after[e][3 * i + a], expected, TOLERANCE * largest(before[e], 12), "force", s, state);
		}
	}
}

static void tet4_forces_do_not_depend_on_the_order_of_nodes(void** unused) {
	(void)unused;
	for_all_samples(check_permutation);
}

/// Numbers of a sample one behind the other: energies, forces, both tangents.
static int collect(Sample* s, double* out) {
	static SampleMatrix K[SAMPLE_ELEMENTS];
	double f[SAMPLE_ELEMENTS][SAMPLE_MOST_REALS];
	int count = SAMPLE_ELEMENTS;
	sample_energy(s, out);
	sample_force(s, f);
	for (int e = 0; e < SAMPLE_ELEMENTS; e++) {
		for (int k = 0; k < s->reals; k++) out[count++] = f[e][k];
	}
	for (int definite = 0; definite < 2; definite++) {
		sample_tangent(s, definite == 1, K);
		for (int e = 0; e < SAMPLE_ELEMENTS; e++) {
			for (int k = 0; k < s->reals * s->reals; k++) out[count++] = K[e][k / s->reals][k % s->reals];
		}
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
		cmocka_unit_test(forces_and_torques_balance),
		cmocka_unit_test(forces_turn_with_the_body_and_ignore_its_place),
		cmocka_unit_test(forces_grow_with_the_square_of_size),
		cmocka_unit_test(tet4_forces_do_not_depend_on_the_order_of_nodes),
		cmocka_unit_test(all_widths_agree_to_the_bit),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
