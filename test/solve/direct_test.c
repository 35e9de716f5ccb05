/// @file direct_test.c
/// The sparse Cholesky solver against dense elimination on random matrices, with nodes held wholly and in part.
#include <stdio.h>

#include "solve/solver.h"
#include "support/random_cells.h"

enum { NODES = 40, CELLS = 30, ENTRIES = 3 * NODES };

// Diagonal dominance: no row has more than 39 neighbours of 3 entries below 1, and few have half as many.
static const double dominant = 120;

typedef struct Held {
	const char* name;
	bool at[ENTRIES];
} Held;

static void hold_some(Held held[4]) {
	memset(held, 0, 4 * sizeof *held);
	held[0].name = "nothing held";
	held[1].name = "nodes held";
	held[2].name = "axes held";
	held[3].name = "nodes and axes held";
	for (int k = 0; k < ENTRIES; ++k) {
		held[1].at[k] = k / 3 % 5 == 0 || k / 3 == NODES - 1;
		held[2].at[k] = k % 7 == 0 || k % 7 == 1;
		held[3].at[k] = held[1].at[k] || held[2].at[k];
	}
}

// x of the free entries by elimination without pivots; the matrix is dominated by its diagonal.
static void dense_solve(const double* matrix, const bool* held, const double* rhs, double* x) {
	double* a = malloc(ENTRIES * ENTRIES * sizeof *a);
	for (int i = 0; i < ENTRIES; ++i) {
		x[i] = held[i] ? 0 : rhs[i];
		for (int j = 0; j < ENTRIES; ++j) a[i * ENTRIES + j] = held[i] || held[j] ? i == j : matrix[i * ENTRIES + j];
	}
	for (int k = 0; k < ENTRIES; ++k)
		for (int i = k + 1; i < ENTRIES; ++i) {
			const double factor = a[i * ENTRIES + k] / a[k * ENTRIES + k];
			for (int j = k; j < ENTRIES; ++j) a[i * ENTRIES + j] -= factor * a[k * ENTRIES + j];
			x[i] -= factor * x[k];
		}
	for (int i = ENTRIES - 1; i >= 0; --i) {
		for (int j = i + 1; j < ENTRIES; ++j) x[i] -= a[i * ENTRIES + j] * x[j];
		x[i] /= a[i * ENTRIES + i];
	}
	free(a);
}

static JnSolver* new_solver(const RandomCells* r, const bool* held, int ordering) {
	JnSolver* solver = NULL;
	assert_int_equal(jn_solver_direct.create(&(JnDirectDef){.ordering = ordering}, &r->pattern, held, 1, &solver),
					 JN_OK);
	return solver;
}

static void expect_solution(JnSolver* solver, int slot, const RandomCells* r, const bool* held, const char* what) {
	double rhs[ENTRIES], out[ENTRIES], expected[ENTRIES];
	for (int k = 0; k < ENTRIES; ++k) rhs[k] = sin(3.1 * k + slot);
	double* dense = cells_dense(r);
	dense_solve(dense, held, rhs, expected);
	assert_int_equal(jn_solver_direct.solve(solver, slot, rhs, out), JN_OK);
	for (int k = 0; k < ENTRIES; ++k) {
		if (held[k]) assert_true(out[k] == 0);
		// solutions are below 0.1 and the condition number below 10: rounding of some 1e-16
		if (!(fabs(out[k] - expected[k]) <= 1e-15))
			fail_msg("%s, entry %d: %.17g, expected %.17g, tolerance 1e-15", what, k, out[k], expected[k]);
	}
	free(dense);
}

static void solutions_equal_those_of_dense_elimination(void** state) {
	(void)state;
	Held held[4];
	hold_some(held);
	for (int h = 0; h < 4; ++h)
		for (int ordering = 0; ordering < 3; ++ordering)
			for (uint64_t seed = 1; seed <= 3; ++seed) {
				RandomCells r;
				cells_create(&r, NODES, CELLS, seed);
				cells_shift(&r, dominant);
				JnSolver* solver = new_solver(&r, held[h].at, ordering);
				assert_int_equal(jn_solver_direct.factor(solver, 0, r.blocks), JN_OK);
				expect_solution(solver, 0, &r, held[h].at, held[h].name);
				jn_solver_direct.destroy(solver);
				jn_arena_free(&r.arena);
			}
}

static void the_right_hand_side_may_be_the_solution(void** state) {
	(void)state;
	Held held[4];
	hold_some(held);
	RandomCells r;
	cells_create(&r, NODES, CELLS, 4);
	cells_shift(&r, dominant);
	JnSolver* solver = new_solver(&r, held[3].at, 0);
	double both[ENTRIES], rhs[ENTRIES], out[ENTRIES];
	for (int k = 0; k < ENTRIES; ++k) both[k] = rhs[k] = cos(k);
	assert_int_equal(jn_solver_direct.factor(solver, 0, r.blocks), JN_OK);
	assert_int_equal(jn_solver_direct.solve(solver, 0, rhs, out), JN_OK);
	assert_int_equal(jn_solver_direct.solve(solver, 0, both, both), JN_OK);
	assert_memory_equal(both, out, sizeof out);
	jn_solver_direct.destroy(solver);
	jn_arena_free(&r.arena);
}

static void slots_keep_their_own_factors(void** state) {
	(void)state;
	Held held[4];
	hold_some(held);
	RandomCells r[JN_SOLVER_SLOTS];
	for (int slot = 0; slot < JN_SOLVER_SLOTS; ++slot) { // the same pattern with other numbers
		cells_create(&r[slot], NODES, CELLS, 5);
		for (int k = 0; k < 9 * r[slot].pattern.blocks; ++k) r[slot].blocks[k] *= cos(slot);
		cells_shift(&r[slot], dominant * (1 + slot));
	}
	JnSolver* solver = new_solver(&r[0], held[1].at, 0);
	for (int slot = JN_SOLVER_SLOTS - 1; slot >= 0; --slot)
		assert_int_equal(jn_solver_direct.factor(solver, slot, r[slot].blocks), JN_OK);
	for (int slot = 0; slot < JN_SOLVER_SLOTS; ++slot) expect_solution(solver, slot, &r[slot], held[1].at, "slot");
	jn_solver_direct.destroy(solver);
	for (int slot = 0; slot < JN_SOLVER_SLOTS; ++slot) jn_arena_free(&r[slot].arena);
}

static void an_indefinite_matrix_is_reported_and_the_slot_stays_usable(void** state) {
	(void)state;
	Held held[4];
	hold_some(held);
	for (int h = 0; h < 4; ++h) {
		RandomCells r;
		cells_create(&r, NODES, CELLS, 6);
		cells_shift(&r, dominant);
		JnSolver* solver = new_solver(&r, held[h].at, 0);
		double* diagonal = r.blocks + 9 * r.pattern.column_start[17] + 8; // entry 53, held in none of the four
		assert_false(held[h].at[53]);
		for (int round = 0; round < 3; ++round) {
			*diagonal -= 2 * dominant;
			assert_int_equal(jn_solver_direct.factor(solver, 0, r.blocks), JN_INDEFINITE);
			*diagonal += 2 * dominant;
			assert_int_equal(jn_solver_direct.factor(solver, 0, r.blocks), JN_OK);
			expect_solution(solver, 0, &r, held[h].at, "after an indefinite matrix");
		}
		jn_solver_direct.destroy(solver);
		jn_arena_free(&r.arena);
	}
}

static void the_zero_matrix_is_not_positive_definite(void** state) {
	(void)state;
	Held held[4];
	hold_some(held);
	RandomCells r;
	cells_create(&r, NODES, CELLS, 7);
	memset(r.blocks, 0, 9 * (size_t)r.pattern.blocks * sizeof *r.blocks);
	JnSolver* solver = new_solver(&r, held[0].at, 0);
	assert_int_equal(jn_solver_direct.factor(solver, 0, r.blocks), JN_INDEFINITE);
	jn_solver_direct.destroy(solver);
	jn_arena_free(&r.arena);
}

static void what_stands_in_held_rows_does_not_matter(void** state) {
	(void)state;
	Held held[4];
	hold_some(held);
	RandomCells r;
	cells_create(&r, NODES, CELLS, 8);
	cells_shift(&r, dominant);
	JnSolver* solver = new_solver(&r, held[1].at, 0);
	double rhs[ENTRIES], before[ENTRIES], after[ENTRIES];
	for (int k = 0; k < ENTRIES; ++k) rhs[k] = sin(k);
	assert_int_equal(jn_solver_direct.factor(solver, 0, r.blocks), JN_OK);
	assert_int_equal(jn_solver_direct.solve(solver, 0, rhs, before), JN_OK);
	for (int j = 0; j < NODES; ++j)
		for (int k = r.pattern.column_start[j]; k < r.pattern.column_start[j + 1]; ++k)
			if (held[1].at[3 * j] || held[1].at[3 * r.pattern.row[k]])
				for (int e = 0; e < 9; ++e) r.blocks[9 * k + e] = NAN;
	for (int k = 0; k < ENTRIES; ++k) rhs[k] = held[1].at[k] ? NAN : rhs[k];
	assert_int_equal(jn_solver_direct.factor(solver, 0, r.blocks), JN_OK);
	assert_int_equal(jn_solver_direct.solve(solver, 0, rhs, after), JN_OK);
	assert_memory_equal(before, after, sizeof after);
	jn_solver_direct.destroy(solver);
	jn_arena_free(&r.arena);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(solutions_equal_those_of_dense_elimination),
		cmocka_unit_test(the_right_hand_side_may_be_the_solution),
		cmocka_unit_test(slots_keep_their_own_factors),
		cmocka_unit_test(an_indefinite_matrix_is_reported_and_the_slot_stays_usable),
		cmocka_unit_test(the_zero_matrix_is_not_positive_definite),
		cmocka_unit_test(what_stands_in_held_rows_does_not_matter),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
