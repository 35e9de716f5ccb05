/// @file qp_analytic_test.c
/// Contact solvers on problems whose solution is known: a mass on a slope, one contact, colliding bodies, driven nodes.
#include "solve/qp_case.h"

static const double gravity = 9.81, dt = 0.01, slope = 0.5; // [m/s^2], [s], [rad]

// One node of mass 2 kg that has fallen for dt from rest on a slope, seen from the slope: z is its normal.
static void mass_on_slope(QpCase* c, double mu) {
	static const double normal[3] = {0, 0, 1}, one = 1;
	static const int node = 0;
	qp_case_dense(c, 1, 1);
	memset(c->blocks, 0, 9 * sizeof *c->blocks);
	for (int axis = 0; axis < 3; ++axis) c->blocks[4 * axis] = 2;
	qp_case_factor(c);
	qp_case_velocity(c, 0, dt * gravity * sin(slope), 0, -dt * gravity * cos(slope));
	qp_touch(c, 1, &node, &one, normal, 0, mu);
}

static void a_mass_sticks_when_mu_exceeds_the_slope(void** state) {
	(void)state;
	for (int t = 0; t < QP_TYPES; ++t) {
		QpCase c;
		mass_on_slope(&c, tan(slope) * 1.001);
		qp_case_expect(&c, qp_types[t], 1e-10);
		// velocities are 0.1 m/s and the residual allows 1e-10 of it
		for (int axis = 0; axis < 3; ++axis) expect_near(c.v[axis], 0, 1e-11, "%s", qp_types[t]->row.name);
		qp_case_destroy(&c);
	}
}

static void a_mass_slides_with_the_acceleration_of_the_textbook(void** state) {
	(void)state;
	static const double mus[] = {0, 0.1, 0.3, 0.54};
	for (int t = 0; t < QP_TYPES; ++t)
		for (int k = 0; k < 4; ++k) {
			QpCase c;
			mass_on_slope(&c, mus[k]);
			qp_case_expect(&c, qp_types[t], 1e-10);
			const double speed = dt * gravity * (sin(slope) - mus[k] * cos(slope));
			expect_near(c.v[0], speed, 1e-11, "%s mu %g, along the slope", qp_types[t]->row.name, mus[k]);
			expect_near(c.v[2], 0, 1e-11, "%s mu %g, off the slope", qp_types[t]->row.name, mus[k]);
			expect_near(c.lambda[0], 2 * dt * gravity * cos(slope), 2e-10, "%s impulse", qp_types[t]->row.name);
			qp_case_destroy(&c);
		}
}

// Bounds of the tangents are the velocity of the ground: 0.3 m/s along x and -0.2 m/s along y, under the mass above.
static const double belt[3] = {0.3, -0.2, 0};

static void mass_on_belt(QpCase* c, double mu) {
	mass_on_slope(c, mu);
	for (int t = 1; t < 3; ++t)
		for (int axis = 0; axis < 3; ++axis) c->bound[0][t] += c->frame[0][3 * t + axis] * belt[axis];
}

static void a_mass_that_sticks_moves_with_the_belt(void** state) {
	(void)state;
	for (int t = 0; t < QP_TYPES; ++t) {
		QpCase c;
		mass_on_belt(&c, 10);
		qp_case_expect(&c, qp_types[t], 1e-10);
		// velocities are below 1 m/s and the residual allows 1e-10 of it
		for (int axis = 0; axis < 3; ++axis) expect_near(c.v[axis], belt[axis], 1e-10, "%s", qp_types[t]->row.name);
		qp_case_destroy(&c);
	}
}

static void a_mass_that_slides_is_pushed_along_the_belt(void** state) {
	(void)state;
	const double mu = 0.3;
	for (int t = 0; t < QP_TYPES; ++t) {
		QpCase c;
		mass_on_belt(&c, mu);
		qp_case_expect(&c, qp_types[t], 1e-10);
		double u[3];
		jn_contact_velocity(&c.problem, 0, c.v, u);
		const double slip[2] = {u[1] - c.bound[0][1], u[2] - c.bound[0][2]}, speed = hypot(slip[0], slip[1]);
		assert_true(speed > 0.1);
		for (int axis = 0; axis < 2; ++axis) // impulses are below 1 N s
			expect_near(c.lambda[1 + axis], -mu * c.lambda[0] * slip[axis] / speed, 1e-9, "%s", qp_types[t]->row.name);
		qp_case_destroy(&c);
	}
}

// Without friction the tangents of the bound are not read.
static void a_belt_without_friction_moves_nothing(void** state) {
	(void)state;
	for (int t = 0; t < QP_TYPES; ++t) {
		QpCase c;
		mass_on_slope(&c, 0);
		c.bound[0][1] = c.bound[0][2] = NAN;
		qp_case_expect(&c, qp_types[t], 1e-10);
		expect_near(c.v[0], c.vp[0], 0, "%s", qp_types[t]->row.name);
		expect_near(c.v[1], c.vp[1], 0, "%s", qp_types[t]->row.name);
		qp_case_destroy(&c);
	}
}

// A stiff box slides as one body: g (sin - mu cos), but for its strain.
static void a_stiff_box_slides_like_a_mass(void** state) {
	(void)state;
	static const double normal[3] = {0, 0, 1};
	for (int t = 0; t < QP_TYPES; ++t) {
		QpCase c;
		qp_case_boxes(&c, (QpBoxes){{3, 3, 2}, 1, dt, 1e9, FACE_NONE});
		qp_case_velocity(&c, 0, dt * gravity * sin(slope), 0, -dt * gravity * cos(slope));
		qp_touch_ground(&c, 0, normal, 0, 0.3);
		qp_case_expect(&c, qp_types[t], 1e-8);
		const double speed = dt * gravity * (sin(slope) - 0.3 * cos(slope));
		// in dt the stress of its own weight makes strain rates of rho g h / (E dt) = 2e-4 / s: 4e-5 m/s over the box
		for (int k = 0; k < 3 * c.pattern.nodes; k += 3)
			expect_near(c.v[k], speed, 4e-5, "%s node %d", qp_types[t]->row.name, k / 3);
		qp_case_destroy(&c);
	}
}

// W of a single contact, column by column from C^-1.
static void delassus(QpCase* c, double w[9], double before[3]) {
	const int n = 3 * c->pattern.nodes;
	double *f = calloc((size_t)n, sizeof *f), *x = calloc((size_t)n, sizeof *x), column[3];
	for (int j = 0; j < 3; ++j) {
		const double unit[3] = {j == 0, j == 1, j == 2};
		memset(f, 0, (size_t)n * sizeof *f);
		jn_contact_add_impulse(&c->problem, 0, unit, f);
		assert_int_equal(qp_solve_one(c, f, x), JN_OK);
		jn_contact_velocity(&c->problem, 0, x, column);
		for (int i = 0; i < 3; ++i) w[3 * i + j] = column[i];
	}
	jn_contact_velocity(&c->problem, 0, c->vp, before);
	before[0] -= c->bound[0][0];
	free(f);
	free(x);
}

// The multiplier that slides in direction phi, and the sine of the angle from there to the velocity that it leaves.
static double misdirection(const double w[9], const double before[3], double mu, double phi, double lambda[3]) {
	const double d[2] = {cos(phi), sin(phi)};
	lambda[0] = -before[0] / (w[0] - mu * (w[1] * d[0] + w[2] * d[1]));
	lambda[1] = -mu * lambda[0] * d[0];
	lambda[2] = -mu * lambda[0] * d[1];
	double u[2];
	for (int i = 0; i < 2; ++i) {
		const double* row = w + 3 * (i + 1);
		u[i] = before[i + 1] + row[0] * lambda[0] + row[1] * lambda[1] + row[2] * lambda[2];
	}
	if (u[0] * d[0] + u[1] * d[1] <= 0) return NAN; // friction would drive the motion
	return (d[0] * u[1] - d[1] * u[0]) / hypot(u[0], u[1]);
}

// The multiplier of one contact, found by its angle alone; false when no direction is consistent (it sticks).
static bool slide_by_bisection(const double w[9], const double before[3], double mu, double lambda[3]) {
	enum { DIRECTIONS = 720 };
	for (int k = 0; k < DIRECTIONS; ++k) {
		double low = 2 * M_PI * k / DIRECTIONS, high = 2 * M_PI * (k + 1) / DIRECTIONS;
		const double at_low = misdirection(w, before, mu, low, lambda),
					 at_high = misdirection(w, before, mu, high, lambda);
		if (!(at_low >= 0 && at_high < 0)) continue;
		for (int step = 0; step < 60; ++step) {
			const double middle = 0.5 * (low + high);
			if (misdirection(w, before, mu, middle, lambda) >= 0)
				low = middle;
			else
				high = middle;
		}
		misdirection(w, before, mu, low, lambda);
		return true;
	}
	return false;
}

static void solve_three(const double w[9], const double b[3], double x[3]) { // w x = -b, Cramer
	const double det =
		w[0] * (w[4] * w[8] - w[5] * w[7]) - w[1] * (w[3] * w[8] - w[5] * w[6]) + w[2] * (w[3] * w[7] - w[4] * w[6]);
	for (int j = 0; j < 3; ++j) {
		double m[9];
		for (int i = 0; i < 9; ++i) m[i] = i % 3 == j ? -b[i / 3] : w[i];
		x[j] = (m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
				m[2] * (m[3] * m[7] - m[4] * m[6])) /
			   det;
	}
}

static void one_contact_follows_coulombs_law_in_closed_form(void** state) {
	(void)state;
	int sliding = 0, sticking = 0;
	for (uint64_t seed = 1; seed <= 20; ++seed)
		for (int t = 0; t < QP_TYPES; ++t) {
			QpCase c;
			uint64_t random = seed;
			qp_case_dense(&c, 4, seed);
			fill_random(&random, 1, 12, c.vp);
			const double normal[3] = {random_number(&random), random_number(&random), random_number(&random)};
			const int nodes[2] = {1, 3};
			const double weights[2] = {1, -1}, mu = 0.1 + 0.08 * (double)seed;
			qp_touch(&c, 2, nodes, weights, normal, 0, mu);
			double w[9], before[3], expected[3];
			delassus(&c, w, before);
			if (before[0] > 0) c.bound[0][0] = 2 * before[0], before[0] = -before[0]; // g above the velocity: violated
			solve_three(w, before, expected);
			const bool sticks = expected[0] >= 0 && hypot(expected[1], expected[2]) <= mu * expected[0];
			if (!sticks) assert_true(slide_by_bisection(w, before, mu, expected));
			sliding += !sticks, sticking += sticks;
			qp_case_expect(&c, qp_types[t], 1e-10);
			// multipliers are about 1; C is conditioned better than 10 and the residual is 1e-10
			for (int axis = 0; axis < 3; ++axis)
				expect_near(c.lambda[axis], expected[axis], 1e-8, "%s seed %d, %s, axis %d", qp_types[t]->row.name,
							(int)seed, sticks ? "sticking" : "sliding", axis);
			qp_case_destroy(&c);
		}
	assert_true(sliding >= 10 && sticking >= 10);
}

static void colliding_bodies_keep_their_momentum(void** state) {
	(void)state;
	for (int t = 0; t < QP_TYPES; ++t)
		for (int k = 0; k < 2; ++k) {
			QpCase c;
			qp_case_boxes(&c, (QpBoxes){{3, 2, 2}, 2, dt, 1e5, FACE_NONE});
			qp_case_velocity(&c, 0, 0.1, 0.2, 0.5);
			qp_case_velocity(&c, 1, -0.3, 0.1, -1);
			qp_touch_stacked(&c, 1, 0, 0.2, 0.3, 0.4 * k);
			qp_case_expect(&c, qp_types[t], 1e-8);
			const int n = 3 * c.pattern.nodes;
			double *one = malloc((size_t)n * sizeof *one), *mass = malloc((size_t)n * sizeof *mass);
			for (int axis = 0; axis < 3; ++axis) {
				for (int i = 0; i < n; ++i) one[i] = i % 3 == axis;
				qp_apply(&c, one, mass); // K moves no rigid body: C 1 = M 1
				double change = 0, size = 0;
				for (int i = 0; i < n; ++i) {
					change += mass[i] * (c.v[i] - c.vp[i]);
					size += fabs(mass[i] * (c.v[i] - c.vp[i]));
				}
				expect_near(change, 0, 1e-12 * fmax(size, 1), "%s mu %g axis %d", qp_types[t]->row.name, 0.4 * k, axis);
			}
			assert_true(c.lambda[0] > 0);
			free(one);
			free(mass);
			qp_case_destroy(&c);
		}
}

static void contacts_that_open_leave_the_prediction_bit_for_bit(void** state) {
	(void)state;
	for (int t = 0; t < QP_TYPES; ++t) {
		QpCase c;
		uint64_t seed = 5;
		qp_case_dense(&c, 10, 3);
		qp_touch_random(&c, 12, 0.3, &seed);
		fill_random(&seed, 1, 30, c.vp);
		for (int i = 0; i < c.problem.count; ++i) {
			double u[3];
			jn_contact_velocity(&c.problem, i, c.vp, u);
			c.bound[i][0] = u[0] - (i % 2 == 0 ? 0 : 0.1); // grazing, or parting
		}
		qp_case_expect(&c, qp_types[t], 1e-8);
		assert_memory_equal(c.v, c.vp, 30 * sizeof *c.v);
		assert_int_equal(c.report.solves, 0);
		c.problem.count = 0;
		qp_case_expect(&c, qp_types[t], 1e-8);
		assert_memory_equal(c.v, c.vp, 30 * sizeof *c.v);
		qp_case_destroy(&c);
	}
}

static void bodies_without_contact_keep_the_prediction_bit_for_bit(void** state) {
	(void)state;
	for (int t = 0; t < QP_TYPES; ++t) {
		QpCase c;
		uint64_t seed = 9;
		qp_case_boxes(&c, (QpBoxes){{2, 2, 1}, 4, dt, 1e5, FACE_NONE});
		fill_random(&seed, 0.1, 3 * c.pattern.nodes, c.vp);
		qp_touch_stacked(&c, 3, 1, 0.1, 0, 0.2);
		qp_case_expect(&c, qp_types[t], 1e-8);
		const size_t bytes = 3 * (size_t)c.first_node[1] * sizeof *c.v;
		for (int body = 0; body < 4; ++body) {
			const int offset = 3 * c.first_node[body];
			assert_int_equal(memcmp(c.v + offset, c.vp + offset, bytes) == 0, body == 0 || body == 2);
		}
		qp_case_destroy(&c);
	}
}

static void driven_nodes_push_and_keep_their_velocity(void** state) {
	(void)state;
	for (int t = 0; t < QP_TYPES; ++t) {
		QpCase c;
		qp_case_boxes(&c, (QpBoxes){{2, 2, 2}, 2, dt, 1e5, FACE_Z_LOW}); // the lower face of each box is driven
		for (int k = 3 * c.first_node[1] + 2; k < 3 * c.pattern.nodes; k += 3) c.vp[k] = -0.2;
		qp_touch_stacked(&c, 1, 0, 0.2, 0.25, 0.3);
		qp_case_expect(&c, qp_types[t], 1e-8);
		for (int k = 0; k < 3 * c.pattern.nodes; ++k)
			if (c.held[k]) assert_true(c.v[k] == c.vp[k]);
		for (int i = 0; i < c.problem.count; ++i) {
			double u[3];
			jn_contact_velocity(&c.problem, i, c.v, u);
			assert_true(u[0] >= -1e-8 * 0.2);
		}
		assert_true(largest_size(c.lambda, 3 * c.problem.count) > 0);
		qp_case_destroy(&c);
	}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_mass_sticks_when_mu_exceeds_the_slope),
		cmocka_unit_test(a_mass_slides_with_the_acceleration_of_the_textbook),
		cmocka_unit_test(a_mass_that_sticks_moves_with_the_belt),
		cmocka_unit_test(a_mass_that_slides_is_pushed_along_the_belt),
		cmocka_unit_test(a_belt_without_friction_moves_nothing),
		cmocka_unit_test(a_stiff_box_slides_like_a_mass),
		cmocka_unit_test(one_contact_follows_coulombs_law_in_closed_form),
		cmocka_unit_test(colliding_bodies_keep_their_momentum),
		cmocka_unit_test(contacts_that_open_leave_the_prediction_bit_for_bit),
		cmocka_unit_test(bodies_without_contact_keep_the_prediction_bit_for_bit),
		cmocka_unit_test(driven_nodes_push_and_keep_their_velocity),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
