/// @file qp_input_test.c
/// What contact solvers make of input that is damaged, and of problems that leave out what may be left out.
#include "base/log.h"
#include "solve/qp_case.h"
#include "support/support.h"

// A box on the ground and one on top of it.
static void build(QpCase* c, int side, double mu) {
	static const double up[3] = {0, 0, 1};
	qp_case_boxes(c, (QpBoxes){{side, side, 2}, 2, 0.01, 1e5, FACE_NONE});
	qp_case_velocity(c, 0, 0.1, 0, -0.3);
	qp_case_velocity(c, 1, 0.3, -0.1, -0.5);
	qp_touch_ground(c, 0, up, 0, mu);
	qp_touch_stacked(c, 1, 0, 0.2, 0.3, mu);
}

static void expect_not_finite(QpCase* c, double* number, double wrong, const char* what) {
	const double before = *number;
	*number = wrong;
	for (int t = 0; t < QP_TYPES; ++t) {
		const JnStatus status = qp_case_solve(c, qp_types[t], 1e-8);
		if (status != JN_NOT_FINITE)
			fail_msg("%s: %s of %g ends in %s", qp_types[t]->row.name, what, wrong, jn_status_name(status));
		assert_memory_equal(c->v, c->vp, 3 * (size_t)c->pattern.nodes * sizeof *c->v);
		for (int k = 0; k < 3 * c->problem.count; ++k) assert_true(c->lambda[k] == 0);
	}
	*number = before;
}

static void numbers_that_are_none_are_seen_wherever_they_stand(void** state) {
	(void)state;
	QpCase c;
	build(&c, 2, 0.3);
	static const double wrong[] = {NAN, INFINITY, -INFINITY};
	for (int k = 0; k < 3; ++k) {
		expect_not_finite(&c, &c.frame[3][2], wrong[k], "a normal");
		expect_not_finite(&c, &c.frame[3][7], wrong[k], "a tangent");
		expect_not_finite(&c, &c.bound[3][0], wrong[k], "a bound");
		expect_not_finite(&c, &c.bound[3][2], wrong[k], "a bound of sticking");
		expect_not_finite(&c, &c.friction[3], wrong[k], "friction");
		expect_not_finite(&c, &c.weight[c.start[3]], wrong[k], "a weight");
	}
	qp_case_destroy(&c);
}

// Without friction tangents are not read.
static void tangents_count_where_there_is_friction_alone(void** state) {
	(void)state;
	QpCase c;
	build(&c, 2, 0);
	c.frame[3][7] = c.bound[3][2] = NAN;
	for (int t = 0; t < QP_TYPES; ++t) qp_case_expect(&c, qp_types[t], 1e-8);
	qp_case_destroy(&c);
}

static void a_guess_that_is_not_finite_is_refused(void** state) {
	(void)state;
	for (int t = 0; t < QP_TYPES; ++t) {
		QpCase c;
		JnQp* qp = NULL;
		build(&c, 2, 0.3);
		memset(c.lambda, 0, 3 * (size_t)c.problem.count * sizeof *c.lambda);
		c.lambda[4] = NAN;
		assert_int_equal(jn_qp_create(qp_types[t], &(JnQpDef){1e-8, 1000}, &qp), JN_OK);
		assert_int_equal(jn_qp_solve(qp, &c.problem, c.v, c.lambda, &c.report), JN_NOT_FINITE);
		assert_true(c.lambda[4] == 0);
		jn_qp_destroy(qp);
		qp_case_destroy(&c);
	}
}

static void nodes_that_are_not_there_are_named(void** state) {
	(void)state;
	QpCase c;
	char words[96];
	build(&c, 2, 0.3);
	const int wrong[] = {-1, c.problem.nodes};
	for (int k = 0; k < 2; ++k) {
		const int before = c.node[c.start[3]];
		c.node[c.start[3]] = wrong[k];
		log_capture();
		assert_int_equal(qp_case_solve(&c, &jn_qp_auto, 1e-8), JN_BAD_INPUT);
		log_release();
		snprintf(words, sizeof words, "contact 3 names node %d, but there are %d nodes", wrong[k], c.problem.nodes);
		log_expect(words);
		c.node[c.start[3]] = before;
	}
	qp_case_destroy(&c);
}

static double largest(const double* a, const double* b, int count) {
	double most = 0;
	for (int k = 0; k < count; ++k) most = fmax(most, fabs(a[k] - b[k]));
	return most;
}

static void what_is_left_out_is_as_if_it_were_none(void** state) {
	(void)state;
	QpCase c;
	build(&c, 2, 0);
	const int n = 3 * c.pattern.nodes;
	double* whole = malloc((size_t)n * sizeof *whole);
	for (int t = 0; t < QP_TYPES; ++t) {
		const JnContactProblem problem = c.problem;
		qp_case_expect(&c, qp_types[t], 1e-10);
		memcpy(whole, c.v, (size_t)n * sizeof *whole);
		c.problem.held = NULL, c.problem.friction = NULL;
		qp_case_expect(&c, qp_types[t], 1e-10);
		assert_memory_equal(whole, c.v, (size_t)n * sizeof *whole);
		c.problem.body_count = 0, c.problem.first_node = NULL, c.problem.matrix.half = NULL;
		qp_case_expect(&c, qp_types[t], 1e-10);
		c.problem = problem;
		// residuals of 1e-10, magnified less than a hundred times; velocities are 0.5 m/s
		expect_near(largest(whole, c.v, n), 0, 1e-8, "%s", qp_types[t]->row.name);
	}
	free(whole);
	qp_case_destroy(&c);
}

// A contact that nothing can move, as all its nodes are held or have no weight, is no row.
static void contacts_that_move_nothing_change_nothing(void** state) {
	(void)state;
	static const double up[3] = {0, 0, 1}, none = 0;
	for (int t = 0; t < QP_TYPES; ++t) {
		QpCase c;
		build(&c, 2, 0.3);
		const int n = 3 * c.pattern.nodes, node = 5, known = c.problem.count;
		qp_case_expect(&c, qp_types[t], 1e-10);
		double* whole = malloc((size_t)n * sizeof *whole);
		memcpy(whole, c.v, (size_t)n * sizeof *whole);
		qp_touch(&c, 1, &node, &none, up, -1, 0.3);
		qp_case_expect(&c, qp_types[t], 1e-10);
		// as above
		expect_near(largest(whole, c.v, n), 0, 1e-8, "%s", qp_types[t]->row.name);
		for (int k = 0; k < 3; ++k) assert_true(c.lambda[3 * known + k] == 0);
		free(whole);
		qp_case_destroy(&c);
	}
}

// Where the matrix has no halves, more than 300 rows are the splitting's.
static void many_rows_without_halves_are_solved_by_splitting(void** state) {
	(void)state;
	QpCase c;
	build(&c, 8, 0.3); // 81 nodes on the ground and as many on top: 3 rows each
	const int n = 3 * c.pattern.nodes;
	double* whole = malloc((size_t)n * sizeof *whole);
	qp_case_expect(&c, &jn_qp_delassus, 1e-8);
	memcpy(whole, c.v, (size_t)n * sizeof *whole);
	c.problem.matrix.half = NULL;
	qp_case_expect(&c, &jn_qp_auto, 1e-8);
	assert_true(c.report.factorizations > 0);
	// residuals of 1e-8, magnified less than a hundred times; velocities are 0.5 m/s
	expect_near(largest(whole, c.v, n), 0, 1e-6, "splitting");
	free(whole);
	qp_case_destroy(&c);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(numbers_that_are_none_are_seen_wherever_they_stand),
		cmocka_unit_test(tangents_count_where_there_is_friction_alone),
		cmocka_unit_test(a_guess_that_is_not_finite_is_refused),
		cmocka_unit_test(nodes_that_are_not_there_are_named),
		cmocka_unit_test(what_is_left_out_is_as_if_it_were_none),
		cmocka_unit_test(contacts_that_move_nothing_change_nothing),
		cmocka_unit_test(many_rows_without_halves_are_solved_by_splitting),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
