/// @file qp_ipopt_test.c
/// Contact solvers without friction against Ipopt, on random problems and on boxes of hexahedra. Skipped without Ipopt.
#ifdef JN_HAS_IPOPT
	#include "solve/ipopt.h"

static void expect_ipopt(QpCase* c, const char* what) {
	const int n = 3 * c->pattern.nodes;
	double* v = malloc((size_t)n * sizeof *v);
	ipopt_solve(c, v);
	const double moved = largest_difference(v, c->vp, n), size = largest_size(v, n);
	assert_true(moved > 1e-2 * size);
	for (int t = 0; t < QP_TYPES; ++t) {
		qp_case_expect(c, qp_types[t], 1e-9);
		// a barrier of 1e-11 displaces contacts that press and open at once by its root: 3e-6
		expect_near(largest_difference(v, c->v, n), 0, 3e-6 * size, "%s %s", qp_types[t]->row.name, what);
	}
	free(v);
}

static void random_problems_agree_with_ipopt(void** state) {
	(void)state;
	for (uint64_t seed = 1; seed <= 5; ++seed) {
		QpCase c;
		uint64_t random = seed;
		qp_case_dense(&c, 20, seed);
		fill_random(&random, 1, 60, c.vp);
		qp_touch_random(&c, 10 + 10 * (int)seed, 0, &random);
		expect_ipopt(&c, "random");
		qp_case_destroy(&c);
	}
}

static void a_stack_of_boxes_agrees_with_ipopt(void** state) {
	(void)state;
	static const double up[3] = {0, 0.1, 1};
	QpCase c;
	qp_case_boxes(&c, (QpBoxes){{4, 4, 3}, 3, 0.01, 1e5, FACE_NONE});
	qp_case_velocity(&c, 0, 0.02, 0, -0.2);
	qp_case_velocity(&c, 1, 0.3, -0.1, -0.5);
	qp_case_velocity(&c, 2, 0, 0.2, -1);
	qp_touch_ground(&c, 0, up, 0.01, 0);
	qp_touch_stacked(&c, 1, 0, 0.3, 0.3, 0);
	qp_touch_stacked(&c, 2, 1, 0.3, 0.5, 0);
	expect_ipopt(&c, "stack");
	qp_case_destroy(&c);
}

static void a_driven_box_agrees_with_ipopt(void** state) {
	(void)state;
	QpCase c;
	qp_case_boxes(&c, (QpBoxes){{4, 4, 3}, 2, 0.01, 1e6, FACE_Z_LOW});
	for (int k = 3 * c.first_node[1] + 2; k < 3 * c.pattern.nodes; k += 3) c.vp[k] = -0.2;
	qp_touch_stacked(&c, 1, 0, 0.3, 0.25, 0);
	expect_ipopt(&c, "driven");
	qp_case_destroy(&c);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(random_problems_agree_with_ipopt),
		cmocka_unit_test(a_stack_of_boxes_agrees_with_ipopt),
		cmocka_unit_test(a_driven_box_agrees_with_ipopt),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
#else
	#include <setjmp.h>
	#include <stdarg.h>
	#include <stddef.h>
	#include <stdint.h>

	#include <cmocka.h>

static void problems_agree_with_ipopt(void** state) {
	(void)state;
	print_message("without Ipopt (Debian: apt-get install coinor-libipopt-dev)\n");
	skip();
}

int main(void) {
	const struct CMUnitTest tests[] = {cmocka_unit_test(problems_agree_with_ipopt)};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
#endif
