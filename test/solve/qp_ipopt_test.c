/// @file qp_ipopt_test.c
/// Contact solvers without friction against Ipopt, on random problems, on boxes of hexahedra, and on the problems of
/// scenes: those of grids that lie on each other, both ways, have rows that are redundant or nearly so. Skipped without
/// Ipopt.
#ifdef JN_HAS_IPOPT
	#include "jounce/scene.h"
	#include "pass/contact.h"
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

// ---- problems of scenes

/// A case that borrows everything from a problem, for Ipopt alone.
static QpCase borrow(const JnContactProblem* problem) {
	return (QpCase){.pattern = *problem->matrix.pattern,
					.blocks = (double*)problem->matrix.blocks,
					.vp = (double*)problem->vp,
					.held = (bool*)problem->held,
					.start = (int*)problem->start,
					.node = (int*)problem->node,
					.weight = (double*)problem->weight,
					.frame = (double(*)[9])problem->frame,
					.bound = (double(*)[3])problem->bound,
					.problem = *problem};
}

static void expect_ipopt_on(void* user, const JnContactProblem* problem, const double* guess) {
	const QpCase c = borrow(problem);
	const int n = 3 * problem->nodes;
	double *ipopt = malloc((size_t)n * sizeof *ipopt), *v = malloc((size_t)n * sizeof *v);
	double* lambda = malloc(3 * (size_t)problem->count * sizeof *lambda);
	const JnQpDef options = {.tolerance = 1e-9, .max_iterations = 5000};
	(void)guess;
	ipopt_solve(&c, ipopt);
	const double moved = largest_difference(ipopt, problem->vp, n);
	for (int t = 0; t < QP_TYPES; ++t) {
		JnQp* qp = NULL;
		JnQpReport report;
		memset(lambda, 0, 3 * (size_t)problem->count * sizeof *lambda);
		assert_int_equal(jn_qp_create(qp_types[t], &options, &qp), JN_OK);
		assert_int_equal(jn_qp_solve(qp, problem, v, lambda, &report), JN_OK);
		// as above, a barrier displaces contacts that press and open at once, here tens of them side by side
		expect_near(largest_difference(ipopt, v, n), 0, 3e-5 * moved, "%s, %d contacts", qp_types[t]->row.name,
					problem->count);
		jn_qp_destroy(qp);
	}
	++*(int*)user;
	free(ipopt);
	free(v);
	free(lambda);
}

/// Run a scene without friction up to a time, and compare the problems of the next step.
static void expect_ipopt_in(const char* file, double t, int count, const char* const sets[]) {
	char path[512];
	JnScene* scene = NULL;
	JnSim* sim = NULL;
	int passes = 0, problems = 0;
	snprintf(path, sizeof path, "%s/scenes/%s", JN_SOURCE_DIR, file);
	assert_int_equal(jn_scene_load(path, count, sets, &scene), JN_OK);
	assert_int_equal(jn_scene_build(scene, 1, &sim), JN_OK);
	while (jn_sim_state(sim)->t < t) assert_int_equal(jn_sim_step(sim), JN_OK);
	jn_contact_observe(jn_sim_passes(sim, &passes)[0], expect_ipopt_on, &problems);
	assert_int_equal(jn_sim_step(sim), JN_OK);
	assert_true(problems > 0);
	jn_sim_destroy(sim);
	jn_scene_destroy(scene);
}

static void a_squeezed_ball_agrees_with_ipopt(void** state) {
	(void)state;
	static const char* const sets[] = {"contact.pairs=[]", "bodies[0].shape.cells=4", "bodies[0].shape.rings=2"};
	expect_ipopt_in("squeeze.yaml", 0.9, 3, sets);
}

static void a_bouncing_ball_agrees_with_ipopt(void** state) {
	(void)state;
	static const char* const sets[] = {"bodies[0].shape={type: ball, center: [0, 0.6, 0], radius: 0.5, cells: 4}",
									   "bodies[0].velocity=[1, -5, 0]"};
	expect_ipopt_in("ball.yaml", 0.07, 2, sets);
}

static void a_tower_of_matching_grids_agrees_with_ipopt(void** state) {
	(void)state;
	static const char* const sets[] = {
		"contact.friction=0", "bodies[0].shape={type: box, size: [0.4, 0.2, 0.4], cells: [3, 2, 3]}",
		"bodies[1].shape={type: box, origin: [0.001, 0.2, 0], size: [0.4, 0.2, 0.4], cells: [3, 2, 3]}"};
	expect_ipopt_in("stack.yaml", 0.01, 3, sets);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(random_problems_agree_with_ipopt),
		cmocka_unit_test(a_stack_of_boxes_agrees_with_ipopt),
		cmocka_unit_test(a_driven_box_agrees_with_ipopt),
		cmocka_unit_test(a_squeezed_ball_agrees_with_ipopt),
		cmocka_unit_test(a_bouncing_ball_agrees_with_ipopt),
		cmocka_unit_test(a_tower_of_matching_grids_agrees_with_ipopt),
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
