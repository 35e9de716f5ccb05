/// @file mass_test.c
/// Mass: the total, rigid motion, row sums and lumping, for every element.
#include "model/model.h"
#include "support/model_case.h"

enum { CONSISTENT, LUMPED };

static void free_box(ModelCase* c, int element, int mass) {
	case_box(c, element, "linear");
	c->body.fix.count = 0;
	c->body.mass = mass;
}

static void total_mass_is_density_times_volume(void** state) {
	(void)state;
	for (int element = 0; element < JN_SOLID_SHAPE_COUNT; ++element)
		for (int mass = CONSISTENT; mass <= LUMPED; ++mass) {
			ModelCase c;
			Rig rig;
			free_box(&c, element, mass);
			rig_create(&rig, &c, 1);
			// 0.2 * 0.2 * 0.4 m^3 of 1000 kg/m^3; rounding of some 1e3 sums
			expect_near(jn_model_mass(rig.model), 16, 1e-11, "mass of %s", jn_shape_info[element].name);
			rig_destroy(&rig);
		}
}

static void a_translating_body_has_the_kinetic_energy_of_a_point(void** state) {
	(void)state;
	for (int element = 0; element < JN_SOLID_SHAPE_COUNT; ++element)
		for (int mass = CONSISTENT; mass <= LUMPED; ++mass) {
			ModelCase c;
			Rig rig;
			free_box(&c, element, mass);
			c.body.velocity[0] = 1;
			c.body.velocity[1] = -2;
			c.body.velocity[2] = 3;
			rig_create(&rig, &c, 1);
			const JnEnergies e = jn_model_energies(rig.model, &rig.start);
			expect_near(e.kinetic, 0.5 * 16 * 14, 1e-10, "kinetic energy"); // rounding of 1e3 sums
			for (int axis = 0; axis < 3; ++axis)
				expect_near(e.momentum[axis], 16 * c.body.velocity[axis], 1e-11, "momentum");
			rig_destroy(&rig);
		}
}

// Consistent mass integrates the velocity field exactly: rotation has the energy of the box's moment of inertia.
static void a_turning_body_has_its_moment_of_inertia(void** state) {
	(void)state;
	for (int element = 0; element < JN_SOLID_SHAPE_COUNT; ++element) {
		ModelCase c;
		Rig rig;
		free_box(&c, element, CONSISTENT);
		for (int axis = 0; axis < 3; ++axis) c.box.origin[axis] = -0.5 * c.box.size[axis];
		rig_create(&rig, &c, 1);
		for (int node = 0; node < rig.nodes; ++node) { // about x at 2 rad/s
			rig.start.v[3 * node + 1] = -2 * rig.start.x[3 * node + 2];
			rig.start.v[3 * node + 2] = 2 * rig.start.x[3 * node + 1];
		}
		const double inertia = 16.0 / 12 * (0.2 * 0.2 + 0.4 * 0.4);
		const JnEnergies e = jn_model_energies(rig.model, &rig.start);
		expect_near(e.kinetic, 0.5 * inertia * 4, 1e-12, "%s", jn_shape_info[element].name); // rounding
		expect_near(e.angular[0], inertia * 2, 1e-12, "%s", jn_shape_info[element].name);
		rig_destroy(&rig);
	}
}

static void lumped_masses_equal_row_sums_of_the_consistent_ones(void** state) {
	(void)state;
	const int elements[] = {JN_TET4, JN_HEX8}; // tet10 is lumped by its diagonal: its row sums are negative at corners
	for (int i = 0; i < 2; ++i) {
		ModelCase consistent, lumped;
		Rig a, b;
		free_box(&consistent, elements[i], CONSISTENT);
		free_box(&lumped, elements[i], LUMPED);
		rig_create(&a, &consistent, 1);
		rig_create(&b, &lumped, 1);
		assert_true(b.model->mass_is_diagonal && !a.model->mass_is_diagonal);
		const double difference = largest_difference(a.model->nodal_mass, b.model->nodal_mass, a.nodes);
		expect_near(difference, 0, 1e-14, "nodal masses below 1 kg"); // rounding
		rig_destroy(&a);
		rig_destroy(&b);
	}
}

static void lumped_masses_are_positive_and_diagonal(void** state) {
	(void)state;
	for (int element = 0; element < JN_SOLID_SHAPE_COUNT; ++element) {
		ModelCase c;
		Rig rig;
		free_box(&c, element, LUMPED);
		rig_create(&rig, &c, 1);
		const JnPattern* pattern = &rig.model->pattern;
		for (int j = 0; j < rig.nodes; ++j) {
			if (!(rig.model->nodal_mass[j] > 0))
				fail_msg("%s: node %d has mass %g", jn_shape_info[element].name, j, rig.model->nodal_mass[j]);
			assert_true(rig.model->mass[pattern->column_start[j]] == rig.model->nodal_mass[j]);
			for (int k = pattern->column_start[j] + 1; k < pattern->column_start[j + 1]; ++k)
				assert_true(rig.model->mass[k] == 0);
		}
		rig_destroy(&rig);
	}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(total_mass_is_density_times_volume),
		cmocka_unit_test(a_translating_body_has_the_kinetic_energy_of_a_point),
		cmocka_unit_test(a_turning_body_has_its_moment_of_inertia),
		cmocka_unit_test(lumped_masses_equal_row_sums_of_the_consistent_ones),
		cmocka_unit_test(lumped_masses_are_positive_and_diagonal),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
