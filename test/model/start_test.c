/// @file start_test.c
/// The first state of a model: rest positions, and velocities from a body's `velocity` and `spin`.
#include "support/model_case.h"

static const double spin[3] = {0.7, -1.1, 2.3}; // [rad/s]

static void turning_case(ModelCase* c, int element, int mass) {
	case_box(c, element, "stable_neo_hookean");
	c->box.origin[0] = 3; // far from the origin, about which nothing turns
	c->box.origin[1] = -2;
	c->body.fix.count = 0;
	c->body.mass = mass;
	memcpy(c->body.spin, spin, sizeof spin);
}

// I of the box about its middle is m / 12 (b^2 + c^2); with the consistent mass matrix it is exact, as the velocity
// of a rotation is linear in X.
static void a_spinning_box_has_the_momenta_of_a_rigid_body(void** state) {
	(void)state;
	for (int element = 0; element < JN_SOLID_SHAPE_COUNT; ++element) {
		ModelCase c;
		Rig rig;
		turning_case(&c, element, 0);
		rig_create(&rig, &c, 1);
		const JnEnergies e = jn_model_energies(rig.model, &rig.start);
		const double mass = 1000 * 0.2 * 0.2 * 0.4, *size = c.box.size;
		double kinetic = 0;
		for (int axis = 0; axis < 3; ++axis) {
			const double b = size[(axis + 1) % 3], d = size[(axis + 2) % 3];
			const double inertia = mass / 12 * (b * b + d * d);
			kinetic += 0.5 * inertia * spin[axis] * spin[axis];
			expect_near(e.momentum[axis], 0, 1e-12, "momentum %d", axis); // rounding of hundreds of sums of 16 kg m/s
			// without momentum the origin serves as well as the centre: the above at a lever arm of 3.7 m
			expect_near(e.angular[axis], inertia * spin[axis], 1e-11, "angular momentum %d", axis);
		}
		expect_near(e.kinetic, kinetic, 1e-12, "kinetic energy");
		rig_destroy(&rig);
	}
}

static void velocity_is_added_to_spin(void** state) {
	(void)state;
	for (int mass = 0; mass < 2; ++mass) {
		ModelCase c;
		Rig rig;
		turning_case(&c, JN_TET10, mass);
		memcpy(c.body.velocity, (double[3]){1, 2, 3}, sizeof c.body.velocity);
		rig_create(&rig, &c, 1);
		const double centre[3] = {3.1, -1.9, 0.2};
		for (int node = 0; node < rig.nodes; ++node) {
			const double *X = jn_model_rest(rig.model) + 3 * node, *v = rig.start.v + 3 * node;
			for (int axis = 0; axis < 3; ++axis) {
				const int next = (axis + 1) % 3, last = (axis + 2) % 3;
				const double turn = spin[next] * (X[last] - centre[last]) - spin[last] * (X[next] - centre[next]);
				expect_near(v[axis], axis + 1 + turn, 1e-13, "velocity"); // rounding of the centre, times the spin
			}
			assert_memory_equal(rig.start.x + 3 * node, X, 3 * sizeof *X);
		}
		rig_destroy(&rig);
	}
}

static void fixed_nodes_do_not_spin(void** state) {
	(void)state;
	ModelCase c;
	Rig rig;
	turning_case(&c, JN_HEX8, 0);
	c.body.fix.count = 1;
	rig_create(&rig, &c, 1);
	int still = 0;
	for (int node = 0; node < rig.nodes; ++node) {
		const bool is_fixed = jn_model_rest(rig.model)[3 * node + 2] == 0;
		const double speed = largest_size(rig.start.v + 3 * node, 3);
		still += is_fixed;
		assert_true(is_fixed ? speed == 0 : speed < 2);
	}
	assert_int_equal(still, 9);
	assert_true(largest_size(rig.start.v, rig.length) > 0.3); // 2.3 rad/s at a lever arm of 0.14 m
	rig_destroy(&rig);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_spinning_box_has_the_momenta_of_a_rigid_body),
		cmocka_unit_test(velocity_is_added_to_spin),
		cmocka_unit_test(fixed_nodes_do_not_spin),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
