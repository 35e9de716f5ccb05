/// @file cg_test.c
/// Conjugate gradients against the sparse Cholesky factorisation, on random matrices with nodes held wholly and in part.
#include <stdio.h>

#include "solve/solver.h"
#include "support/random_cells.h"

enum { NODES = 40, CELLS = 30, ENTRIES = 3 * NODES };

// Diagonal dominance: no row has more than 39 neighbours of 3 entries below 1, and few have half as many.
static const double dominant = 120;

static const JnCgDef exact = {.tolerance = 1e-13, .max_iterations = 500, .precondition = JN_WAY_BLOCK};

static void hold_some(bool held[ENTRIES]) {
	for (int k = 0; k < ENTRIES; ++k) held[k] = k / 3 % 5 == 0 || k % 7 == 1;
}

static JnSolver* new_solver(const JnSolverType* type, const void* options, const RandomCells* r, const bool* held) {
	JnSolver* solver = NULL;
	assert_int_equal(type->create(options, &r->pattern, held, 1, &solver), JN_OK);
	return solver;
}

static void fill_rhs(double* rhs) {
	for (int k = 0; k < ENTRIES; ++k) rhs[k] = sin(3.1 * k);
}

static double difference_from_direct(const JnCgDef* def, const RandomCells* r, bool is_rough) {
	bool held[ENTRIES];
	double rhs[ENTRIES], expected[ENTRIES], most = 0;
	hold_some(held);
	fill_rhs(rhs);
	JnSolver* direct = new_solver(&jn_solver_direct, &(JnDirectDef){0}, r, held);
	JnSolver* cg = new_solver(&jn_solver_cg, def, r, held);
	assert_int_equal(direct->type->factor(direct, 0, r->blocks), JN_OK);
	assert_int_equal(cg->type->factor(cg, 0, r->blocks), JN_OK);
	assert_int_equal(direct->type->solve(direct, 0, rhs, expected), JN_OK);
	assert_int_equal(is_rough ? cg->type->approximate(cg, 0, 1e-3, rhs, rhs) : cg->type->solve(cg, 0, rhs, rhs), JN_OK);
	for (int k = 0; k < ENTRIES; ++k) {
		if (held[k]) assert_true(rhs[k] == 0);
		most = fmax(most, fabs(rhs[k] - expected[k]));
	}
	direct->type->destroy(direct);
	cg->type->destroy(cg);
	return most;
}

static void solutions_equal_those_of_a_factorisation(void** state) {
	(void)state;
	for (uint64_t seed = 1; seed <= 5; ++seed)
		for (int which = 0; which < 8; ++which) {
			const int precondition = JN_WAY_PLAIN + which / 2;
			RandomCells r;
			JnCgDef def = exact;
			def.precondition = precondition;
			def.precision = which % 2;
			cells_create(&r, NODES, CELLS, seed);
			cells_shift(&r, dominant);
			// solutions are some 1e-2, the residual 1e-13 of a right-hand side of norm 8, the smallest eigenvalue above 50
			const double most = difference_from_direct(&def, &r, false);
			if (!(most <= 2e-14)) fail_msg("seed %d: differs by %g, tolerance 2e-14", (int)seed, most);
			jn_arena_free(&r.arena);
		}
}

static void an_approximate_solution_has_the_rough_tolerance(void** state) {
	(void)state;
	RandomCells r;
	cells_create(&r, NODES, CELLS, 3);
	cells_shift(&r, dominant);
	const double most = difference_from_direct(&exact, &r, true);
	if (!(most > 1e-9 && most <= 2e-4)) fail_msg("differs by %g, expected between 1e-9 and 2e-4", most);
	jn_arena_free(&r.arena);
}

// A shift that leaves every diagonal block positive definite but not the matrix.
static void negative_curvature_is_an_outcome_and_leaves_the_vector_alone(void** state) {
	(void)state;
	RandomCells r;
	const bool held[ENTRIES] = {false};
	double rhs[ENTRIES];
	cells_create(&r, NODES, CELLS, 1);
	cells_shift(&r, 3);
	fill_rhs(rhs);
	JnSolver* cg = new_solver(&jn_solver_cg, &exact, &r, held);
	assert_int_equal(cg->type->factor(cg, 0, r.blocks), JN_OK);
	assert_int_equal(cg->type->solve(cg, 0, rhs, rhs), JN_INDEFINITE);
	for (int k = 0; k < ENTRIES; ++k) assert_true(rhs[k] == sin(3.1 * k));
	r.blocks[9 * r.pattern.column_start[7]] = -1;
	assert_int_equal(cg->type->factor(cg, 0, r.blocks), JN_INDEFINITE);
	cg->type->destroy(cg);
	jn_arena_free(&r.arena);
}

static void too_few_iterations_are_an_outcome(void** state) {
	(void)state;
	RandomCells r;
	const bool held[ENTRIES] = {false};
	double rhs[ENTRIES];
	JnCgDef def = exact;
	def.max_iterations = 3;
	cells_create(&r, NODES, CELLS, 1);
	cells_shift(&r, dominant);
	fill_rhs(rhs);
	JnSolver* cg = new_solver(&jn_solver_cg, &def, &r, held);
	assert_int_equal(cg->type->factor(cg, 0, r.blocks), JN_OK);
	assert_int_equal(cg->type->solve(cg, 0, rhs, rhs), JN_NOT_CONVERGED);
	assert_int_equal(cg->iterations, 3);
	rhs[5] = NAN;
	assert_int_equal(cg->type->solve(cg, 0, rhs, rhs), JN_NOT_FINITE);
	memset(rhs, 0, sizeof rhs);
	assert_int_equal(cg->type->solve(cg, 0, rhs, rhs), JN_OK);
	assert_int_equal(cg->iterations, 0);
	cg->type->destroy(cg);
	jn_arena_free(&r.arena);
}

typedef struct Products {
	const RandomCells* r;
	double diagonal[9 * NODES];
	int count;
} Products;

static void multiply(void* user, int slot, const double* in, double* out) {
	Products* products = user;
	assert_int_equal(slot, 2);
	++products->count;
	memset(out, 0, ENTRIES * sizeof *out);
	jn_blocks_apply(&products->r->pattern, products->r->blocks, 1, in, out, 1);
}

static const double* diagonal(void* user, int slot) {
	Products* products = user;
	assert_int_equal(slot, 2);
	for (int node = 0; node < NODES; ++node)
		memcpy(products->diagonal + 9 * node, products->r->blocks + 9 * products->r->pattern.column_start[node],
			   9 * sizeof(double));
	return products->diagonal;
}

static void products_stand_for_a_matrix(void** state) {
	(void)state;
	RandomCells r;
	bool held[ENTRIES];
	double rhs[ENTRIES], first[ENTRIES], second[ENTRIES];
	const double floor = 1e-3 / 16; // 16 roundings count as zero
	cells_create(&r, NODES, CELLS, 4);
	cells_shift(&r, dominant);
	hold_some(held);
	fill_rhs(rhs);
	Products products = {.r = &r};
	JnSolver* cg = new_solver(&jn_solver_cg, &exact, &r, held);
	assert_int_equal(cg->type->factor(cg, 2, r.blocks), JN_OK);
	assert_int_equal(cg->type->solve(cg, 2, rhs, first), JN_OK);
	cg->type->destroy(cg);
	cg = new_solver(&jn_solver_cg, &exact, &r, held);
	cg->type->attach(cg, (JnOperator){.user = &products, .apply = multiply, .diagonal = diagonal, .floor = &floor});
	assert_int_equal(cg->type->factor(cg, 2, NULL), JN_OK);
	assert_int_equal(cg->type->solve(cg, 2, rhs, second), JN_OK);
	assert_int_equal(products.count, cg->iterations);
	for (int k = 0; k < ENTRIES; ++k) { // the floor ends it earlier: 1e-3 over the smallest eigenvalue, above 50
		if (!(fabs(first[k] - second[k]) <= 2e-5)) fail_msg("entry %d: %.17g and %.17g", k, first[k], second[k]);
		rhs[k] *= 1e-5;
	}
	assert_int_equal(cg->type->solve(cg, 2, rhs, second), JN_OK);
	assert_int_equal(cg->iterations, 0); // nothing but rounding
	cg->type->destroy(cg);
	jn_arena_free(&r.arena);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(solutions_equal_those_of_a_factorisation),
		cmocka_unit_test(an_approximate_solution_has_the_rough_tolerance),
		cmocka_unit_test(negative_curvature_is_an_outcome_and_leaves_the_vector_alone),
		cmocka_unit_test(too_few_iterations_are_an_outcome),
		cmocka_unit_test(products_stand_for_a_matrix),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
