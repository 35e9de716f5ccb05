/// @file qp_sizes_long_test.c
/// Contact solvers over sizes, stiffnesses and friction: all reach 1e-6, and the table of docs/contact_solvers.md is printed.
#include "base/timer.h"
#include "solve/blas.h"
#include "solve/qp_case.h"

typedef struct Size {
	int side, height; ///< cells
	double young;     ///< [Pa]
} Size;

static const Size sizes[] = {{4, 4, 1e5}, {8, 4, 1e5},   {12, 4, 1e5}, {16, 4, 1e5}, {20, 4, 1e5}, {27, 4, 1e5},
							 {8, 8, 1e5}, {12, 12, 1e5}, {8, 4, 1e4},  {8, 4, 1e6},  {8, 4, 1e7},  {8, 4, 1e8}};
enum { SIZES = sizeof sizes / sizeof *sizes };

// A box on the ground and one that falls on it, askew.
static void build(QpCase* c, const Size* size, double mu) {
	static const double up[3] = {0, 0, 1};
	uint64_t seed = 3;
	qp_case_boxes(c, (QpBoxes){{size->side, size->side, size->height}, 2, 0.01, size->young, FACE_NONE});
	qp_case_velocity(c, 0, 0.02, 0, -0.2);
	qp_case_velocity(c, 1, 0.3, -0.1, -0.5);
	for (int k = 0; k < 3 * c->pattern.nodes; ++k) c->vp[k] += 0.05 * random_number(&seed);
	qp_touch_ground(c, 0, up, 0, mu);
	qp_touch_stacked(c, 1, 0, 0.1 * size->height, 0.3, mu);
}

static void measure(QpCase* c, const JnQpType* type, const Size* size, double mu) {
	const double factor_start = jn_seconds();
	assert_int_equal(jn_solver_direct.factor(c->solver, 0, c->blocks), JN_OK);
	const double start = jn_seconds();
	qp_case_expect(c, type, 1e-6);
	const JnQpReport* r = &c->report;
	print_message("| %s | %d | %d | %g | %g | %d | %d | %d | %d | %.3f | %.3f | %.0e |\n", type->row.name,
				  c->problem.count, 3 * c->pattern.nodes, size->young, mu, r->rows, r->iterations, r->factorizations,
				  r->solves, start - factor_start, jn_seconds() - start, jn_contact_residual_max(&r->residual));
}

static void all_solvers_reach_six_digits_at_all_sizes(void** state) {
	(void)state;
	jn_blas_prepare();
	print_message(
		"| solver | contacts | unknowns | E [Pa] | mu | rows | iterations | factorisations | solves | factor C [s] | "
		"time [s] | residual |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
	for (int s = 0; s < SIZES; ++s)
		for (int m = 0; m < 2; ++m) {
			QpCase c;
			build(&c, &sizes[s], 0.4 * m);
			for (int t = 0; t < QP_TYPES; ++t) measure(&c, qp_types[t], &sizes[s], 0.4 * m);
			qp_case_destroy(&c);
		}
}

int main(void) {
	const struct CMUnitTest tests[] = {cmocka_unit_test(all_solvers_reach_six_digits_at_all_sizes)};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
