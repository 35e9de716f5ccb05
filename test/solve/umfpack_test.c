/// @file umfpack_test.c
/// The sparse LU solver against dense elimination on random unsymmetric matrices, with nodes held wholly and in part.
#include <stdio.h>

#include "solve/solver.h"
#include "support/random_cells.h"

enum { NODES = 40, CELLS = 30, ENTRIES = 3 * NODES };

// Rows have some 20 to 50 entries below 1: with this on the diagonal the condition number stays below 100.
static const double dominant = 60;

/// A random matrix over the pattern of some cells, with the blocks of all rows.
typedef struct FullMatrix {
	RandomCells cells;
	double* blocks; ///< 9 a place of the full rows
	double dense[ENTRIES * ENTRIES];
} FullMatrix;

static void spread(FullMatrix* m) {
	const JnPattern* pattern = &m->cells.pattern;
	memset(m->dense, 0, sizeof m->dense);
	for (int node = 0; node < NODES; ++node)
		for (int k = pattern->full_start[node]; k < pattern->full_start[node + 1]; ++k)
			for (int e = 0; e < 9; ++e)
				m->dense[(3 * node + e / 3) * ENTRIES + 3 * pattern->full_column[k] + e % 3] = m->blocks[9 * k + e];
}

static void full_create(FullMatrix* m, uint64_t seed, double diagonal) {
	cells_create(&m->cells, NODES, CELLS, seed);
	const JnPattern* pattern = &m->cells.pattern;
	const int places = pattern->full_start[NODES];
	m->blocks = jn_arena_take(&m->cells.arena, (size_t)places, 9 * sizeof *m->blocks);
	for (int node = 0; node < NODES; ++node)
		for (int k = pattern->full_start[node]; k < pattern->full_start[node + 1]; ++k)
			for (int e = 0; e < 9; ++e)
				m->blocks[9 * k + e] =
					cells_random(&m->cells) + (pattern->full_column[k] == node && e % 4 == 0 ? diagonal : 0);
	spread(m);
}

static void full_destroy(FullMatrix* m) {
	jn_arena_free(&m->cells.arena);
}

static bool is_held(int pattern, int k) {
	const bool node = k / 3 % 5 == 0 || k / 3 == NODES - 1, axis = k % 7 == 0 || k % 7 == 1;
	return ((pattern & 1) != 0 && node) || ((pattern & 2) != 0 && axis);
}

static void hold(int pattern, bool held[ENTRIES]) {
	for (int k = 0; k < ENTRIES; ++k) held[k] = is_held(pattern, k);
}

// out = matrix x over free entries, 0 at held ones.
static void multiply(const FullMatrix* m, const bool* held, const double* x, double* out) {
	for (int i = 0; i < ENTRIES; ++i) {
		out[i] = 0;
		for (int j = 0; j < ENTRIES && !held[i]; ++j) out[i] += held[j] ? 0 : m->dense[i * ENTRIES + j] * x[j];
	}
}

static void expect_inverse(JnSolver* solver, int slot, const FullMatrix* m, const bool* held, const char* what) {
	double x[ENTRIES], rhs[ENTRIES], out[ENTRIES];
	for (int k = 0; k < ENTRIES; ++k) x[k] = held[k] ? 0 : sin(3.1 * k + slot);
	multiply(m, held, x, rhs);
	for (int k = 0; k < ENTRIES; ++k) rhs[k] = held[k] ? 17 : rhs[k]; // what held entries ask for is ignored
	for (int which = 0; which < 2; ++which) {
		assert_int_equal(which == 0 ? solver->type->solve(solver, slot, rhs, out)
									: solver->type->approximate(solver, slot, 1e-6, rhs, out),
						 JN_OK);
		for (int k = 0; k < ENTRIES; ++k) {
			if (held[k]) assert_true(out[k] == 0);
			// x is below 1 and the condition number below 100: rounding of some 1e-14
			if (!(fabs(out[k] - x[k]) <= 1e-13))
				fail_msg("%s, entry %d: %.17g, expected %.17g, tolerance 1e-13", what, k, out[k], x[k]);
		}
	}
}

static JnSolver* new_solver(const FullMatrix* m, const bool* held) {
	JnSolver* solver = NULL;
	assert_int_equal(jn_solver_unsymmetric.create(NULL, &m->cells.pattern, held, 1, &solver), JN_OK);
	return solver;
}

static void solutions_are_those_of_the_unsymmetric_matrix(void** state) {
	(void)state;
	for (int pattern = 0; pattern < 4; ++pattern)
		for (uint64_t seed = 1; seed <= 5; ++seed) {
			FullMatrix m;
			bool held[ENTRIES];
			full_create(&m, seed, dominant);
			hold(pattern, held);
			JnSolver* solver = new_solver(&m, held);
			assert_int_equal(solver->type->factor(solver, 0, m.blocks), JN_OK);
			expect_inverse(solver, 0, &m, held, "solve");
			assert_true(solver->type->cost(solver).factor_entries >= ENTRIES - 60);
			solver->type->destroy(solver);
			full_destroy(&m);
		}
}

static void slots_keep_their_own_factors_and_can_be_factored_again(void** state) {
	(void)state;
	static FullMatrix m[JN_SOLVER_SLOTS];
	bool held[ENTRIES];
	hold(3, held);
	for (int slot = 0; slot < JN_SOLVER_SLOTS; ++slot) full_create(&m[slot], 7, dominant * (1 + slot));
	JnSolver* solver = new_solver(&m[0], held);
	for (int round = 0; round < 2; ++round)
		for (int slot = JN_SOLVER_SLOTS - 1; slot >= 0; --slot)
			assert_int_equal(solver->type->factor(solver, slot, m[slot].blocks), JN_OK);
	for (int slot = 0; slot < JN_SOLVER_SLOTS; ++slot) expect_inverse(solver, slot, &m[slot], held, "slot");
	assert_int_equal(solver->type->factor(solver, 1, m[2].blocks), JN_OK);
	expect_inverse(solver, 1, &m[2], held, "new numbers");
	solver->type->destroy(solver);
	for (int slot = 0; slot < JN_SOLVER_SLOTS; ++slot) full_destroy(&m[slot]);
}

static void the_right_hand_side_may_be_the_solution(void** state) {
	(void)state;
	FullMatrix m;
	bool held[ENTRIES];
	double both[ENTRIES], rhs[ENTRIES], out[ENTRIES];
	full_create(&m, 9, dominant);
	hold(2, held);
	JnSolver* solver = new_solver(&m, held);
	for (int k = 0; k < ENTRIES; ++k) both[k] = rhs[k] = cos(k);
	assert_int_equal(solver->type->factor(solver, 0, m.blocks), JN_OK);
	assert_int_equal(solver->type->solve(solver, 0, rhs, out), JN_OK);
	assert_int_equal(solver->type->solve(solver, 0, both, both), JN_OK);
	assert_memory_equal(both, out, sizeof out);
	solver->type->destroy(solver);
	full_destroy(&m);
}

static void indefinite_matrices_are_solved_and_singular_ones_reported(void** state) {
	(void)state;
	FullMatrix m;
	bool held[ENTRIES];
	full_create(&m, 11, dominant);
	hold(1, held);
	JnSolver* solver = new_solver(&m, held);
	const JnPattern* pattern = &m.cells.pattern;
	const int node = 17; // free in this pattern
	for (int k = pattern->full_start[node]; k < pattern->full_start[node + 1]; ++k)
		if (pattern->full_column[k] == node) m.blocks[9 * k + 8] -= 2 * dominant;
	spread(&m);
	assert_int_equal(solver->type->factor(solver, 0, m.blocks), JN_OK);
	expect_inverse(solver, 0, &m, held, "indefinite");
	double kept[3];
	for (int k = pattern->full_start[node]; k < pattern->full_start[node + 1]; ++k) // an empty row
		for (int c = 0; c < 3; ++c) {
			if (pattern->full_column[k] == node) kept[c] = m.blocks[9 * k + 6 + c];
			m.blocks[9 * k + 6 + c] = 0;
		}
	assert_int_equal(solver->type->factor(solver, 0, m.blocks), JN_INDEFINITE);
	for (int k = pattern->full_start[node]; k < pattern->full_start[node + 1]; ++k)
		for (int c = 0; c < 3 && pattern->full_column[k] == node; ++c) m.blocks[9 * k + 6 + c] = kept[c];
	spread(&m);
	assert_int_equal(solver->type->factor(solver, 0, m.blocks), JN_OK); // the slot stays usable
	expect_inverse(solver, 0, &m, held, "after a singular one");
	solver->type->destroy(solver);
	full_destroy(&m);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(solutions_are_those_of_the_unsymmetric_matrix),
		cmocka_unit_test(slots_keep_their_own_factors_and_can_be_factored_again),
		cmocka_unit_test(the_right_hand_side_may_be_the_solution),
		cmocka_unit_test(indefinite_matrices_are_solved_and_singular_ones_reported),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
