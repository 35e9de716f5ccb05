/// @file physics_test.c
/// What mechanics says about whole simulations: momentum, rest, energy, and that no axis is special.
#include "support/model_case.h"

static void use_method(ModelCase* c, const char* name) {
	case_method(c, row_named(&jn_integrator_list, name));
}

// A free body that spins, shears and stretches.
static void tumbling_case(ModelCase* c, int element) {
	case_box(c, element, "stable_neo_hookean");
	c->body.fix.count = 0;
	c->sim.newton.tolerance = 1e-13;
}

static void set_tumbling(Rig* rig) {
	const double* rest = jn_model_rest(rig->model);
	for (int node = 0; node < rig->nodes; ++node) {
		const double *X = rest + 3 * (size_t)node, x = X[0] - 0.1, y = X[1] - 0.1, z = X[2] - 0.2;
		double* v = rig->start.v + 3 * (size_t)node;
		v[0] = 0.3 + 3 * z - 2 * y + 1.5 * x;
		v[1] = -0.2 + 2 * x + 4 * y * z;
		v[2] = 0.1 - 3 * x;
	}
	rig_begin(rig);
}

// Sums of internal forces vanish by construction, and Newton's residual enters with its tolerance: momentum of 16 kg at
// 1 m/s is kept to rounding by every method.
static void a_free_body_keeps_its_momentum_with_every_method(void** state) {
	(void)state;
	for (int i = 0; i < jn_integrator_list.count; ++i) {
		ModelCase c;
		Rig rig;
		tumbling_case(&c, JN_TET4);
		use_method(&c, jn_integrator_list.rows[i]->name);
		rig_create(&rig, &c, 1);
		set_tumbling(&rig);
		const JnEnergies before = jn_model_energies(rig.model, &rig.start);
		for (int step = 0; step < 20; ++step) rig_step(&rig, 1.0 / 512);
		const JnEnergies after = jn_model_energies(rig.model, &rig.start);
		for (int axis = 0; axis < 3; ++axis)
			expect_near(after.momentum[axis], before.momentum[axis], 1e-12, "%s: momentum",
						jn_integrator_list.rows[i]->name);
		rig_destroy(&rig);
	}
}

// The midpoint rule keeps quadratic invariants, and angular momentum is one.
static void implicit_midpoint_keeps_angular_momentum(void** state) {
	(void)state;
	double drift[2] = {0, 0};
	const char* const methods[] = {"implicit_midpoint", "backward_euler"};
	for (int m = 0; m < 2; ++m) {
		ModelCase c;
		Rig rig;
		tumbling_case(&c, JN_HEX8);
		use_method(&c, methods[m]);
		rig_create(&rig, &c, 1);
		set_tumbling(&rig);
		const JnEnergies before = jn_model_energies(rig.model, &rig.start);
		for (int step = 0; step < 40; ++step) rig_step(&rig, 1.0 / 128);
		const JnEnergies after = jn_model_energies(rig.model, &rig.start);
		for (int axis = 0; axis < 3; ++axis) drift[m] += fabs(after.angular[axis] - before.angular[axis]);
		rig_destroy(&rig);
	}
	// 40 steps whose residuals are 1e-13 of forces of some 100 N, at lever arms of 0.3 m over 0.3 s
	expect_near(drift[0], 0, 1e-11, "angular momentum with implicit_midpoint");
	if (!(drift[1] > 1e-3)) fail_msg("backward_euler drifts by %g only: the test shows nothing", drift[1]);
}

static void a_body_at_rest_stays_at_rest(void** state) {
	(void)state;
	const char* const laws[] = {"linear", "neo_hookean", "stable_neo_hookean", "corotated_frozen", "corotated"};
	for (int law = 0; law < 5; ++law)
		for (int element = 0; element < JN_SOLID_SHAPE_COUNT; ++element) {
			ModelCase c;
			Rig rig;
			case_box(&c, element, laws[law]);
			c.body.fix.count = law % 2;
			rig_create(&rig, &c, 1);
			for (int step = 0; step < 5; ++step) rig_step(&rig, 1.0 / 64);
			const double* rest = jn_model_rest(rig.model);
			expect_near(largest_difference(rig.start.x, rest, rig.length), 0, 1e-14, "%s moved", laws[law]); // rounding
			// what rounding of positions leaves of forces, 1e-16 * 1e3 N/m of nodes of 0.1 kg
			expect_near(largest_size(rig.start.v, rig.length), 0, 1e-13, "%s has a speed", laws[law]);
			rig_destroy(&rig);
		}
}

static double energy_error(const char* method, double dt, double duration) {
	ModelCase c;
	Rig rig;
	case_box(&c, JN_HEX8, "stable_neo_hookean");
	case_gravity(&c, 0, -9.81, 0);
	use_method(&c, method);
	rig_create(&rig, &c, 1);
	double most = 0;
	const JnEnergies before = jn_model_energies(rig.model, &rig.start);
	const long steps = lround(duration / dt);
	for (long step = 0; step < steps; ++step) {
		rig_step(&rig, dt);
		const JnEnergies e = jn_model_energies(rig.model, &rig.start);
		const double error = fabs(e.kinetic + e.elastic + e.gravity - before.kinetic - before.elastic - before.gravity);
		most = fmax(most, error / jn_model_mass(rig.model));
	}
	rig_destroy(&rig);
	return most;
}

static void methods_of_higher_order_lose_less_energy(void** state) {
	(void)state;
	const double euler = energy_error("backward_euler", 1.0 / 128, 0.5);
	const double second = energy_error("sdirk2", 1.0 / 128, 0.5);
	const double fourth = energy_error("esdirk436", 1.0 / 128, 0.5);
	print_message("energy errors [J/kg]: backward_euler %.3g, sdirk2 %.3g, esdirk436 %.3g\n", euler, second, fourth);
	// far apart, so that no accident of one step size decides
	if (!(euler > 5 * second && second > 5 * fourth))
		fail_msg("errors %g, %g, %g J/kg, expected to fall at least fivefold each", euler, second, fourth);
}

static void energy_error_vanishes_with_the_step(void** state) {
	(void)state;
	const double coarse = energy_error("esdirk436", 1.0 / 128, 0.25), fine = energy_error("esdirk436", 1.0 / 512, 0.25);
	if (!(fine < coarse / 100)) // fourth order would be 256
		fail_msg("error %g J/kg with a quarter of the step, expected below a hundredth of %g", fine, coarse);
}

// The box with its axes turned by a cyclic exchange (x, y, z) -> (y, z, x), a rotation by 120 degrees, with gravity and
// velocity turned too, moves as the first one, turned. Hexahedra only: the split into tetrahedra favours a diagonal.
static void turned_case(ModelCase* c, int turn) {
	static const int faces[] = {FACE_Z_LOW, FACE_X_LOW, FACE_Y_LOW};
	const double size[3] = {0.2, 0.3, 0.4}, gravity[3] = {1, -9.81, 2}, velocity[3] = {0.5, 0.2, -0.4};
	const int cells[3] = {2, 3, 4};
	case_box(c, JN_HEX8, "stable_neo_hookean");
	for (int axis = 0; axis < 3; ++axis) {
		const int to = (axis + turn) % 3;
		c->box.size[to] = size[axis];
		c->box.cells[to] = cells[axis];
		c->sim.model.gravity[to] = gravity[axis];
		c->body.velocity[to] = velocity[axis];
	}
	c->fix[0].where = face_select(faces[turn]);
	c->sim.newton.tolerance = 1e-12;
}

static void a_turned_model_gives_the_turned_result(void** state) {
	(void)state;
	Rig straight;
	ModelCase c;
	turned_case(&c, 0);
	rig_create(&straight, &c, 1);
	for (int step = 0; step < 16; ++step) rig_step(&straight, 1.0 / 64);
	for (int turn = 1; turn < 3; ++turn) {
		Rig turned;
		turned_case(&c, turn);
		rig_create(&turned, &c, 1);
		for (int step = 0; step < 16; ++step) rig_step(&turned, 1.0 / 64);
		double most = 0;
		for (int node = 0; node < straight.nodes; ++node) {
			double point[3];
			for (int axis = 0; axis < 3; ++axis)
				point[(axis + turn) % 3] = jn_model_rest(straight.model)[3 * node + axis];
			const int other = jn_model_nearest(turned.model, point);
			for (int axis = 0; axis < 3; ++axis) {
				const int k = 3 * node + axis, l = 3 * other + (axis + turn) % 3;
				most = fmax(most, fabs(straight.start.x[k] - turned.start.x[l]));
				most = fmax(most, fabs(straight.start.v[k] - turned.start.v[l]));
			}
		}
		expect_near(most, 0, 1e-9, "turned by %d axes", turn); // 32 stages solved to 1e-12 of forces of 100 N
		rig_destroy(&turned);
	}
	rig_destroy(&straight);
}

// Backward Euler with lumped mass on a body in free fall: every node falls as a point, x = -g t (t + dt) / 2.
static void a_falling_body_falls_as_a_point(void** state) {
	(void)state;
	for (int mass = 0; mass < 2; ++mass) {
		ModelCase c;
		Rig rig;
		case_box(&c, JN_TET10, "stable_neo_hookean");
		c.body.fix.count = 0;
		c.body.mass = mass;
		case_gravity(&c, 0, -9.81, 0);
		use_method(&c, "backward_euler");
		rig_create(&rig, &c, 1);
		for (int step = 0; step < 16; ++step) rig_step(&rig, 1.0 / 64);
		const double fall = -9.81 * 0.25 * (0.25 + 1.0 / 64) / 2;
		for (int k = 0; k < rig.length; ++k) {
			const double expected = jn_model_rest(rig.model)[k] + (k % 3 == 1 ? fall : 0);
			expect_near(rig.start.x[k], expected, 1e-10, "x[%d]", k); // the tolerance of Newton, 1e-10 of the weight
		}
		rig_destroy(&rig);
	}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_free_body_keeps_its_momentum_with_every_method),
		cmocka_unit_test(implicit_midpoint_keeps_angular_momentum),
		cmocka_unit_test(a_body_at_rest_stays_at_rest),
		cmocka_unit_test(methods_of_higher_order_lose_less_energy),
		cmocka_unit_test(energy_error_vanishes_with_the_step),
		cmocka_unit_test(a_turned_model_gives_the_turned_result),
		cmocka_unit_test(a_falling_body_falls_as_a_point),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
