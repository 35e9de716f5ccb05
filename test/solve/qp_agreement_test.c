/// @file qp_agreement_test.c
/// Contact solvers against each other, and on what makes problems hard: redundant, nearly dependent and contradicting
/// contacts, any order of them, good and bad guesses.
#include "solve/qp_case.h"

typedef void Build(QpCase* c, double mu);

static void build_random(QpCase* c, double mu) {
	uint64_t seed = 11;
	qp_case_dense(c, 20, 2);
	qp_touch_random(c, 30, mu, &seed);
	fill_random(&seed, 1, 60, c->vp);
}

// A box on the ground and one that falls on it, askew, 5 x 5 nodes each.
static void build_stack(QpCase* c, double mu) {
	static const double up[3] = {0, 0, 1};
	qp_case_boxes(c, (QpBoxes){{4, 4, 3}, 2, 0.01, 1e5, FACE_NONE});
	qp_case_velocity(c, 0, 0.02, 0, -0.2);
	qp_case_velocity(c, 1, 0.3, -0.1, -0.5);
	qp_touch_ground(c, 0, up, 0, mu);
	qp_touch_stacked(c, 1, 0, 0.3, 0.3, mu);
}

// A box so stiff that the 25 contacts of a face have the freedom of a rigid body: 25 rows of rank 3 but for 1e-6.
static void build_rigid(QpCase* c, double mu) {
	static const double up[3] = {0, 0, 1};
	uint64_t seed = 4;
	qp_case_boxes(c, (QpBoxes){{4, 4, 2}, 1, 0.01, 1e10, FACE_NONE});
	qp_case_velocity(c, 0, 0.1, 0, -0.1);
	for (int k = 0; k < 3 * c->pattern.nodes; ++k) c->vp[k] += 1e-3 * random_number(&seed);
	qp_touch_ground(c, 0, up, 0, mu);
}

typedef struct Named {
	const char* name;
	Build* build;
} Named;

static const Named builds[] = {{"random", build_random}, {"stack", build_stack}, {"rigid", build_rigid}};
enum { RIGID = 2, BUILDS = sizeof builds / sizeof *builds };
static const double mus[] = {0, 0.3, 1};
enum { MUS = 3 };

static double* copy(const double* v, int length) {
	double* out = malloc((size_t)length * sizeof *out);
	memcpy(out, v, (size_t)length * sizeof *out);
	return out;
}

static void both_solvers_find_the_same_velocities(void** state) {
	(void)state;
	for (int b = 0; b < BUILDS; ++b)
		for (int m = 0; m < (b == RIGID ? 2 : MUS); ++m) { // the splitting does not converge at RIGID, mu = 1
			QpCase c;
			builds[b].build(&c, mus[m]);
			const int n = 3 * c.pattern.nodes;
			qp_case_expect(&c, qp_types[0], 1e-8);
			double* v = copy(c.v, n);
			qp_case_expect(&c, qp_types[1], 1e-8);
			// residuals of 1e-8, and problems that magnify them less than a hundred times
			expect_near(largest_difference(v, c.v, n), 0, 1e-6 * largest_size(v, n), "%s, mu %g", builds[b].name,
						mus[m]);
			assert_true(largest_difference(v, c.vp, n) > 1e-3);
			free(v);
			qp_case_destroy(&c);
		}
}

static void walls_of_boxes_are_solved_however_stiff_they_are(void** state) {
	(void)state;
	for (int e = 5; e <= 10; ++e)
		for (int m = 0; m < MUS; ++m) {
			QpCase c;
			qp_case_wall(&c, (QpWall){3, 3, 4, 3, pow(10, e), mus[m]});
			qp_case_expect(&c, &jn_qp_delassus,
						   e < 10 ? 1e-8 : 1e-6); // W is known to 1e-16 of what is 1e8 times larger
			qp_case_destroy(&c);
		}
}

static void redundant_contacts_of_a_stiff_box_are_solved_with_any_friction(void** state) {
	(void)state;
	for (int m = 0; m <= 10; ++m) {
		QpCase c;
		build_rigid(&c, 0.2 * m);
		qp_case_expect(&c, &jn_qp_delassus, 1e-8);
		qp_case_destroy(&c);
	}
}

static void append_again(QpCase* c, int i, double tilt) {
	const int first = c->start[i];
	const double* f = c->frame[i];
	const double normal[3] = {f[0] + tilt, f[1] - tilt, f[2] + 2 * tilt};
	qp_touch(c, c->start[i + 1] - first, c->node + first, c->weight + first, normal, c->bound[i][0], c->friction[i]);
}

static void expect_same_with_copies(const Named* build, double mu, double tilt, double tolerance) {
	for (int t = 0; t < QP_TYPES; ++t) {
		QpCase c;
		build->build(&c, mu);
		const int n = 3 * c.pattern.nodes, count = c.problem.count;
		qp_case_expect(&c, qp_types[t], 1e-10);
		double* v = copy(c.v, n);
		for (int i = 0; i < count; ++i) append_again(&c, i, tilt);
		qp_case_expect(&c, qp_types[t], tilt > 0 ? 1e-7 : 1e-10); // nearly equal rows: the splitting is slow beyond
		expect_near(largest_difference(v, c.v, n), 0, tolerance, "%s %s, mu %g", qp_types[t]->row.name, build->name,
					mu);
		free(v);
		qp_case_destroy(&c);
	}
}

static void contacts_that_are_given_twice_change_nothing(void** state) {
	(void)state;
	// velocities are 1, residuals 1e-10, magnified less than a hundred times
	for (int b = 0; b < 2; ++b)
		for (int m = 0; m < 2; ++m) expect_same_with_copies(&builds[b], mus[m], 0, 1e-8);
}

static void contacts_that_are_nearly_given_twice_change_nearly_nothing(void** state) {
	(void)state;
	// normals differ by 1e-7, so bounds move the velocities by about 1e-7
	for (int m = 0; m < 2; ++m) expect_same_with_copies(&builds[1], mus[m], 1e-7, 1e-5);
}

// The same contacts from the last to the first.
static void reverse(QpCase* from, QpCase* to) {
	to->problem.count = 0;
	memcpy(to->vp, from->vp, 3 * (size_t)from->pattern.nodes * sizeof *to->vp);
	for (int i = from->problem.count - 1; i >= 0; --i) {
		const int first = from->start[i], count = from->start[i + 1] - first;
		qp_touch(to, count, from->node + first, from->weight + first, from->frame[i], from->bound[i][0],
				 from->friction[i]);
	}
}

static void the_order_of_contacts_does_not_matter(void** state) {
	(void)state;
	for (int t = 0; t < QP_TYPES; ++t)
		for (int b = 0; b < 2; ++b)
			for (int m = 0; m < 2; ++m) {
				QpCase c, other;
				builds[b].build(&c, mus[m]);
				builds[b].build(&other, mus[m]);
				reverse(&c, &other);
				qp_case_expect(&c, qp_types[t], 1e-11);
				qp_case_expect(&other, qp_types[t], 1e-11);
				// residuals of 1e-11, magnified less than a hundred times
				expect_near(largest_difference(c.v, other.v, 3 * c.pattern.nodes), 0, 1e-9, "%s %s, mu %g",
							qp_types[t]->row.name, builds[b].name, mus[m]);
				qp_case_destroy(&c);
				qp_case_destroy(&other);
			}
}

static void bounds_that_contradict_each_other_are_reported_with_finite_velocities(void** state) {
	(void)state;
	static const double up[3] = {0, 0, 1}, down[3] = {0, 0, -1}, one = 1;
	for (int t = 0; t < QP_TYPES; ++t)
		for (int m = 0; m < 2; ++m) {
			QpCase c;
			const int node = 3;
			build_random(&c, mus[m]);
			qp_touch(&c, 1, &node, &one, up, 1, mus[m]);
			qp_touch(&c, 1, &node, &one, down, 1, mus[m]);
			assert_int_equal(qp_case_solve(&c, qp_types[t], 1e-8), JN_NOT_CONVERGED);
			for (int k = 0; k < 3 * c.pattern.nodes; ++k) assert_true(isfinite(c.v[k]));
			for (int k = 0; k < 3 * c.problem.count; ++k) assert_true(isfinite(c.lambda[k]));
			assert_true(c.report.residual.primal > 0.1); // 1 of a velocity of 1 is missing on one side or half on both
			qp_case_destroy(&c);
		}
}

static void numbers_that_are_not_finite_are_refused(void** state) {
	(void)state;
	for (int t = 0; t < QP_TYPES; ++t) {
		QpCase c;
		build_random(&c, 0.3);
		c.bound[7][0] = NAN;
		assert_int_equal(qp_case_solve(&c, qp_types[t], 1e-8), JN_NOT_FINITE);
		assert_memory_equal(c.v, c.vp, 60 * sizeof *c.v);
		qp_case_destroy(&c);
	}
}

static void a_solution_as_guess_is_found_again_at_once(void** state) {
	(void)state;
	for (int t = 0; t < QP_TYPES; ++t)
		for (int m = 0; m < MUS; ++m) {
			QpCase c;
			build_stack(&c, mus[m]);
			JnQp* qp = NULL;
			const JnQpDef options = {.tolerance = 1e-8, .max_iterations = 5000};
			JnQpReport first, second;
			assert_int_equal(jn_qp_create(qp_types[t], &options, &qp), JN_OK);
			assert_int_equal(jn_qp_solve(qp, &c.problem, c.v, c.lambda, &first), JN_OK);
			double* v = copy(c.v, 3 * c.pattern.nodes);
			assert_int_equal(jn_qp_solve(qp, &c.problem, c.v, c.lambda, &second), JN_OK);
			assert_true(second.iterations <= first.iterations);
			expect_near(largest_difference(v, c.v, 3 * c.pattern.nodes), 0, 1e-7, "%s mu %g", qp_types[t]->row.name,
						mus[m]);
			free(v);
			jn_qp_destroy(qp);
			qp_case_destroy(&c);
		}
}

// The step after: velocities have changed a little, the guess is the solution of the step before.
static void a_guess_from_the_step_before_saves_factorisations(void** state) {
	(void)state;
	static const double youngs[] = {1e5, 1e7};
	for (int m = 0; m < MUS; ++m)
		for (int y = 0; y < 2; ++y) {
			QpCase c;
			uint64_t seed = 8;
			qp_case_wall(&c, (QpWall){3, 2, 3, 2, youngs[y], mus[m]});
			JnQp* qp = NULL;
			const JnQpDef options = {.tolerance = 1e-8, .max_iterations = 5000};
			JnQpReport first, second;
			assert_int_equal(jn_qp_create(&jn_qp_delassus, &options, &qp), JN_OK);
			assert_int_equal(jn_qp_solve(qp, &c.problem, c.v, c.lambda, &first), JN_OK);
			for (int k = 0; k < 3 * c.pattern.nodes; ++k) c.vp[k] += 1e-7 * random_number(&seed);
			assert_int_equal(jn_qp_solve(qp, &c.problem, c.v, c.lambda, &second), JN_OK);
			if (second.factorizations > 1 || second.sweeps > first.sweeps)
				fail_msg("mu %g, %g Pa: %d factors and %d sweeps, at first %d and %d", mus[m], youngs[y],
						 second.factorizations, second.sweeps, first.factorizations, first.sweeps);
			jn_qp_destroy(qp);
			qp_case_destroy(&c);
		}
}

// A wall of six boxes: contacts couple bodies through two others and more.
static void halves_and_solutions_lead_to_the_same_velocities(void** state) {
	(void)state;
	for (int m = 0; m < MUS; ++m) {
		QpCase c;
		qp_case_wall(&c, (QpWall){3, 2, 3, 2, 1e6, mus[m]});
		const int n = 3 * c.pattern.nodes;
		qp_case_expect(&c, &jn_qp_delassus, 1e-10);
		double* v = copy(c.v, n);
		c.problem.matrix.half = NULL;
		qp_case_expect(&c, &jn_qp_delassus, 1e-10);
		// residuals of 1e-10, magnified less than a hundred times
		expect_near(largest_difference(v, c.v, n), 0, 1e-8, "mu %g", mus[m]);
		free(v);
		qp_case_destroy(&c);
	}
}

static void splitting_works_from_the_verbs_alone(void** state) {
	(void)state;
	for (int m = 0; m < 2; ++m) {
		QpCase c;
		build_stack(&c, mus[m]);
		const int n = 3 * c.pattern.nodes;
		qp_case_expect(&c, &jn_qp_admm, 1e-8);
		double* v = copy(c.v, n);
		c.problem.matrix.blocks = NULL;
		c.problem.matrix.half = NULL;
		c.problem.matrix.solve_many = NULL;
		for (int t = 0; t < QP_TYPES; ++t) {
			qp_case_expect(&c, qp_types[t], 1e-8);
			// residuals of 1e-8, magnified less than a hundred times; velocities are 0.5 m/s
			expect_near(largest_difference(v, c.v, n), 0, 1e-6, "%s mu %g", qp_types[t]->row.name, mus[m]);
		}
		free(v);
		qp_case_destroy(&c);
	}
}

// The residual itself: zero iterations of anything, a wrong v or lambda must be seen.
static void residuals_see_every_kind_of_error(void** state) {
	(void)state;
	QpCase c;
	build_stack(&c, 0.3);
	qp_case_expect(&c, &jn_qp_delassus, 1e-10);
	double* work = calloc(9 * (size_t)c.pattern.nodes, sizeof *work);
	JnContactResidual r;
	int pressing = 0;
	while (c.lambda[3 * pressing] == 0) ++pressing;
	c.v[3 * c.node[c.start[pressing]] + 2] -= 1e-3;
	jn_contact_residual(&c.problem, c.v, c.lambda, work, &r);
	assert_true(r.primal > 1e-4 && r.stationarity > 1e-6);
	c.v[3 * c.node[c.start[pressing]] + 2] += 2e-3;
	jn_contact_residual(&c.problem, c.v, c.lambda, work, &r);
	assert_true(r.complementarity > 1e-4);
	const double normal = c.lambda[3 * pressing];
	c.lambda[3 * pressing] = -normal;
	jn_contact_residual(&c.problem, c.v, c.lambda, work, &r);
	assert_true(r.dual > 1e-4);
	c.lambda[3 * pressing] = normal;
	c.lambda[3 * pressing + 1] += normal;
	jn_contact_residual(&c.problem, c.v, c.lambda, work, &r);
	assert_true(r.friction > 1e-4);
	c.v[5] = NAN;
	jn_contact_residual(&c.problem, c.v, c.lambda, work, &r);
	assert_true(isnan(jn_contact_residual_max(&r)));
	free(work);
	qp_case_destroy(&c);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(both_solvers_find_the_same_velocities),
		cmocka_unit_test(walls_of_boxes_are_solved_however_stiff_they_are),
		cmocka_unit_test(redundant_contacts_of_a_stiff_box_are_solved_with_any_friction),
		cmocka_unit_test(contacts_that_are_given_twice_change_nothing),
		cmocka_unit_test(contacts_that_are_nearly_given_twice_change_nearly_nothing),
		cmocka_unit_test(the_order_of_contacts_does_not_matter),
		cmocka_unit_test(bounds_that_contradict_each_other_are_reported_with_finite_velocities),
		cmocka_unit_test(numbers_that_are_not_finite_are_refused),
		cmocka_unit_test(a_solution_as_guess_is_found_again_at_once),
		cmocka_unit_test(a_guess_from_the_step_before_saves_factorisations),
		cmocka_unit_test(halves_and_solutions_lead_to_the_same_velocities),
		cmocka_unit_test(splitting_works_from_the_verbs_alone),
		cmocka_unit_test(residuals_see_every_kind_of_error),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
