/// @file motion_test.c
/// Prescribed motions: velocity and acceleration are the derivatives of the displacement, smooth keyframes are smooth at
/// their keys, and driven nodes of a model are where their motion says.
#include "model/motion.h"
#include "support/model_case.h"

typedef struct Motion {
	const JnMotionType* type;
	double options[8];
	double points[4][2];
} Motion;

static void sine_motion(Motion* m) {
	*m = (Motion){.type = (const JnMotionType*)row_named(&jn_motion_list, "sine")};
	*(double*)option(&m->type->row, m->options, "amplitude") = 0.3;
	*(double*)option(&m->type->row, m->options, "frequency") = 1.5;
	*(double*)option(&m->type->row, m->options, "phase") = 0.7;
}

static void keyframes_motion(Motion* m, int curve) {
	*m = (Motion){.type = (const JnMotionType*)row_named(&jn_motion_list, "keyframes"),
				  .points = {{0.1, 0}, {0.5, 0.2}, {0.6, -0.1}, {1, 0.4}}};
	*(JnPoints*)option(&m->type->row, m->options, "points") = (JnPoints){4, m->points};
	*(int*)option(&m->type->row, m->options, "curve") = curve;
}

static JnMotionValue at(const Motion* m, double t) {
	return m->type->at(m->options, t);
}

// Central differences with h = 1e-5: truncation h^2 / 6 of the third derivatives (below 1e5), rounding 1e-16 / h.
static void check_derivatives(const Motion* m, double t) {
	const double h = 1e-5;
	const JnMotionValue before = at(m, t - h), now = at(m, t), after = at(m, t + h);
	expect_near(now.v, (after.x - before.x) / (2 * h), 1e-5, "velocity at %g s", t);
	expect_near(now.a, (after.v - before.v) / (2 * h), 1e-3, "acceleration at %g s", t);
}

static void velocity_and_acceleration_are_derivatives(void** state) {
	(void)state;
	Motion m;
	for (int kind = 0; kind < 3; ++kind) {
		if (kind == 0)
			sine_motion(&m);
		else
			keyframes_motion(&m, kind - 1);
		for (double t = -0.0313; t < 1.2; t += 0.0211) check_derivatives(&m, t); // no time is within h of a key
	}
}

static void smooth_keyframes_are_at_rest_at_their_keys_on_both_sides(void** state) {
	(void)state;
	Motion m;
	keyframes_motion(&m, 0);
	for (int i = 0; i < 4; ++i)
		for (int side = -1; side <= 1; ++side) {
			const JnMotionValue value = at(&m, m.points[i][0] + side * 1e-9);
			expect_near(value.x, m.points[i][1], 1e-15, "position at key %d", i); // grows as the cube of the time
			expect_near(value.v, 0, 1e-12, "velocity at key %d", i);              // as its square, below 1e4 * 1e-18
			expect_near(value.a, 0, 1e-4, "acceleration at key %d", i);           // linear: jerk below 2e4 m/s^3
		}
}

static void linear_keyframes_pass_through_their_keys(void** state) {
	(void)state;
	Motion m;
	keyframes_motion(&m, 1);
	for (int i = 0; i < 4; ++i) expect_near(at(&m, m.points[i][0]).x, m.points[i][1], 1e-15, "key %d", i); // rounding
	expect_near(at(&m, 0.3).x, 0.1, 1e-15, "half way");
	expect_near(at(&m, 0.3).v, 0.5, 1e-15, "half way");
}

static void keyframes_stay_before_the_first_and_after_the_last(void** state) {
	(void)state;
	Motion m;
	for (int curve = 0; curve < 2; ++curve) {
		keyframes_motion(&m, curve);
		assert_true(at(&m, -5).x == 0 && at(&m, 9).x == 0.4);
		assert_true(at(&m, -5).v == 0 && at(&m, 9).v == 0 && at(&m, -5).a == 0 && at(&m, 9).a == 0);
	}
}

static void driven_nodes_follow_their_motion_and_fixed_ones_stay(void** state) {
	(void)state;
	ModelCase c;
	Rig rig;
	case_box(&c, JN_HEX8, "stable_neo_hookean");
	case_drive(&c, FACE_Z_HIGH, 0.02, 3);
	rig_create(&rig, &c, 1);
	const double* rest = jn_model_rest(rig.model);
	double* a = rig.space->ops->create(rig.space);
	for (int i = 0; i < 12; ++i) {
		rig_step(&rig, 0.01);
		const double omega = 2 * 3.14159265358979323846 * 3, t = rig.start.t;
		rig.sys->ops->prescribe(rig.sys, &rig.start, a);
		for (int k = 0; k < rig.length; ++k) {
			const double z = rest[k / 3 * 3 + 2];
			if (z != 0 && z < 0.39) continue;
			const bool moves = z != 0 && k % 3 == 0;
			// exact at any time: the motion itself, up to rounding of its argument
			expect_near(rig.start.x[k], rest[k] + (moves ? 0.02 * sin(omega * t) : 0), 1e-15, "x[%d]", k);
			expect_near(rig.start.v[k], moves ? 0.02 * omega * cos(omega * t) : 0, 1e-14, "v[%d]", k);
			expect_near(a[k], moves ? -0.02 * omega * omega * sin(omega * t) : 0, 1e-12, "a[%d]", k);
		}
	}
	rig.space->ops->destroy(rig.space, a);
	rig_destroy(&rig);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(velocity_and_acceleration_are_derivatives),
		cmocka_unit_test(smooth_keyframes_are_at_rest_at_their_keys_on_both_sides),
		cmocka_unit_test(linear_keyframes_pass_through_their_keys),
		cmocka_unit_test(keyframes_stay_before_the_first_and_after_the_last),
		cmocka_unit_test(driven_nodes_follow_their_motion_and_fixed_ones_stay),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
