/// @file qp_sizes_long_test.c
/// Contact solvers over sizes, numbers of bodies, stiffnesses and friction: all reach their tolerance, and the tables of
/// docs/contact_solvers.md are printed.
#include "base/timer.h"
#include "solve/blas.h"
#include "solve/qp_case.h"

typedef struct Size {
	int side, height; ///< cells
	double young;     ///< [Pa]
} Size;

static const Size sizes[] = {{4, 4, 1e5},  {8, 4, 1e4},  {8, 4, 1e5},  {8, 4, 1e6},   {8, 4, 1e7},
							 {8, 4, 1e8},  {8, 8, 1e5},  {12, 4, 1e5}, {12, 12, 1e5}, {16, 4, 1e5},
							 {16, 4, 1e7}, {20, 4, 1e5}, {27, 4, 1e5}, {27, 4, 1e7}};
static const Size walls[] = {{4, 5, 1e5}, {4, 5, 1e6}, {4, 5, 1e7}, {4, 5, 1e8}, {7, 5, 1e5}, {7, 5, 1e7}};
enum {
	SIZES = sizeof sizes / sizeof *sizes,
	WALLS = sizeof walls / sizeof *walls,
	PER_LAYER = 10,
	LAYERS = 4,
	REPEATS = 3
};

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

static double factor_time(QpCase* c) {
	const double start = jn_seconds();
	assert_int_equal(jn_solver_direct.factor(c->solver, 0, c->blocks), JN_OK);
	return jn_seconds() - start;
}

// The best time of some solves from lambda = 0 with memory that is there.
static double solve_time(QpCase* c, const JnQpType* type, double tolerance) {
	const JnQpDef options = {.tolerance = tolerance, .max_iterations = 5000};
	JnQp* qp = NULL;
	double best = INFINITY;
	assert_int_equal(jn_qp_create(type, &options, &qp), JN_OK);
	for (int k = 0; k < REPEATS; ++k) {
		memset(c->lambda, 0, 3 * (size_t)c->problem.count * sizeof *c->lambda);
		const double start = jn_seconds();
		const JnStatus status = jn_qp_solve(qp, &c->problem, c->v, c->lambda, &c->report);
		best = fmin(best, jn_seconds() - start);
		if (status != JN_OK) qp_print(type->row.name, c);
		assert_int_equal(status, JN_OK);
	}
	jn_qp_destroy(qp);
	return best;
}

static void measure(QpCase* c, const Size* size, double mu) {
	static const JnQpType* const types[] = {&jn_qp_delassus, &jn_qp_admm};
	print_message("| %d | %d | %.0e | %g | %.3f |", c->problem.count, 3 * c->pattern.nodes, size->young, mu,
				  factor_time(c));
	for (int t = 0; t < 2; ++t)
		for (int k = 0; k < 2; ++k) {
			const double time = solve_time(c, types[t], k == 0 ? 1e-6 : 1e-8);
			const int count = t == 0 ? c->report.sweeps : c->report.iterations;
			print_message(" %d, %d, %.4f |", count, c->report.factorizations, time);
		}
	print_message(" %.4f |\n", solve_time(c, &jn_qp_auto, 1e-8));
}

static void print_head(void) {
	jn_blas_prepare();
	print_message(
		"| contacts | unknowns | E [Pa] | mu | factor C [s] | delassus to 1e-6: sweeps, factors, time [s] | to 1e-8 | "
		"admm to 1e-6: iterations, factors, time [s] | to 1e-8 | auto to 1e-8 [s] |\n"
		"|---|---|---|---|---|---|---|---|---|---|\n");
}

static void all_solvers_reach_their_tolerance_on_two_boxes(void** state) {
	(void)state;
	print_head();
	for (int s = 0; s < SIZES; ++s)
		for (int m = 0; m < 2; ++m) {
			QpCase c;
			build(&c, &sizes[s], 0.4 * m);
			measure(&c, &sizes[s], 0.4 * m);
			qp_case_destroy(&c);
		}
}

static void all_solvers_reach_their_tolerance_on_forty_boxes(void** state) {
	(void)state;
	print_head();
	for (int s = 0; s < WALLS; ++s)
		for (int m = 0; m < 2; ++m) {
			QpCase c;
			const double mu = 0.4 * m;
			qp_case_wall(&c, (QpWall){PER_LAYER, LAYERS, walls[s].side, walls[s].height, walls[s].young, mu});
			measure(&c, &walls[s], mu);
			qp_case_destroy(&c);
		}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(all_solvers_reach_their_tolerance_on_two_boxes),
		cmocka_unit_test(all_solvers_reach_their_tolerance_on_forty_boxes),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
