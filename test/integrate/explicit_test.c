/// @file explicit_test.c
/// Explicit methods: order on a bent solid, with a driven end and with damping; forces a step; and what they refuse.
///
/// Orders are those of the leading error term, as in the sweep over implicit methods: with E(h) = C h^p + C' h^(p+1) + ...,
///     D(h) = 2^(p+1) E(h/2) - E(h) = C h^p + O(h^(p+2)),   order = log2 |D(h)| / |D(h/2)|
#include "integrate/explicit_methods.h"

#include "support/support.h"

// Three sizes a method, halved twice. The largest frequency of the mesh is some 300 rad/s: 0.3 rad a step at 64 steps,
// and 0.02 rad at 1024, where what explicit Euler adds to that mode over the run stays small.
enum { REFERENCE_STEPS = 1024, COARSEST_LOW = 1024, COARSEST_HIGH = 64, LEVELS = 3, MOST_REALS = 512 };

static const double duration = 1.0 / 16;

typedef struct Solution {
	int length;
	double at[MOST_REALS]; // x, then duration * v
} Solution;

typedef void Prepare(ModelCase*);

static void bending(ModelCase* c) {
	case_box(c, JN_HEX8, "stable_neo_hookean");
	case_gravity(c, 1, -9.81, 0.5);
	c->body.mass = 1;
	c->sim.newton = (JnNewtonDef){.tolerance = 1e-12, .max_iterations = 60, .guess = 2};
}

static void driven(ModelCase* c) {
	bending(c);
	case_drive(c, FACE_Z_HIGH, 0.02, 8);
}

static void damped(ModelCase* c) {
	bending(c);
	c->body.damping = (JnDampingDef){.alpha = 2, .beta = 2e-3, .stiffness = 1};
}

// A twist and a bend that grow from the clamped end: smooth in space, and large enough that nothing is linear.
static void set_in_motion(Rig* rig) {
	const double* rest = jn_model_rest(rig->model);
	for (int node = 0; node < rig->nodes; ++node) {
		const double *X = rest + 3 * (size_t)node, height = X[2] * X[2] / 0.16;
		double* v = rig->start.v + 3 * (size_t)node;
		v[0] = height * (0.8 - 6 * (X[1] - 0.1));
		v[1] = height * (0.5 + 6 * (X[0] - 0.1));
		v[2] = 0.4 * X[2];
	}
	rig_begin(rig);
}

static void simulate(Prepare* prepare, const JnRow* method, int steps, Solution* out) {
	ModelCase c;
	Rig rig;
	prepare(&c);
	c.sim.integrator.row = method;
	rig_create(&rig, &c, 1);
	set_in_motion(&rig);
	for (int i = 0; i < steps; ++i) rig_step(&rig, duration / steps);
	out->length = 2 * rig.length;
	assert_true(out->length <= MOST_REALS);
	for (int k = 0; k < rig.length; ++k) {
		out->at[k] = rig.start.x[k];
		out->at[rig.length + k] = duration * rig.start.v[k];
	}
	rig_destroy(&rig);
}

// |scale * (a - reference) - (b - reference)|
static double difference(double scale, const Solution* a, const Solution* b, const Solution* reference) {
	double sum = 0;
	for (int k = 0; k < a->length; ++k) {
		const double whole = scale * (a->at[k] - reference->at[k]) - (b->at[k] - reference->at[k]);
		sum += whole * whole;
	}
	return sqrt(sum);
}

static double leading_order(Prepare* prepare, const JnRow* row, int order, const Solution* reference) {
	Solution at[LEVELS];
	const int coarsest = order == 1 ? COARSEST_LOW : COARSEST_HIGH;
	for (int level = 0; level < LEVELS; ++level) simulate(prepare, row, coarsest << level, &at[level]);
	const double scale = ldexp(1, order + 1);
	return log2(difference(scale, &at[1], &at[0], reference) / difference(scale, &at[2], &at[1], reference));
}

// The reference is implicit and shares nothing with the methods: esdirk436, whose error at 1024 steps is below 1e-11.
static void check_orders(const char* setting, Prepare* prepare) {
	Solution reference;
	simulate(prepare, row_named(&jn_integrator_list, "esdirk436"), REFERENCE_STEPS, &reference);
	int wrong = 0;
	for (int i = 0; i < METHOD_COUNT; ++i) {
		const JnIntegratorType* type = methods[i].type;
		const int order = prepare == damped ? methods[i].damped_order : type->order;
		const double measured = leading_order(prepare, &type->row, order, &reference);
		print_message("%-10s %-18s order %d: measured %.3f\n", setting, type->row.name, order, measured);
		wrong += !(fabs(measured - order) <= 0.1); // terms of order p + 2 and above
	}
	if (wrong > 0) fail_msg("%s: %d methods miss their order by more than 0.1", setting, wrong);
}

static void every_method_has_its_order_in_bending(void** state) {
	(void)state;
	check_orders("bending", bending);
}

static void every_method_has_its_order_with_a_driven_end(void** state) {
	(void)state;
	check_orders("driven", driven);
}

static void compositions_fall_to_order_one_with_damping_and_the_others_keep_theirs(void** state) {
	(void)state;
	check_orders("damped", damped);
}

// The first step of a method that begins with a force makes it; later ones of verlet find it known.
static void a_step_evaluates_the_forces_as_often_as_the_table_says(void** state) {
	(void)state;
	enum { STEPS = 20 };
	for (int i = 0; i < METHOD_COUNT; ++i) {
		Cube cube;
		Rig rig;
		cube_create(&cube, "stable_neo_hookean", methods[i].type);
		rig_create(&rig, &cube.c, 1);
		rig_shake(&rig, 3, 0.005, 0.1);
		int forces = 0;
		for (int step = 0; step < STEPS; ++step) {
			assert_int_equal(rig_attempt(&rig, 1e-4), JN_OK);
			forces += rig.report.forces;
			const JnState swap = rig.start;
			rig.start = rig.end;
			rig.end = swap;
		}
		const int once = methods[i].type == &jn_verlet ? 1 : 0;
		print_message("%-18s %d forces in %d steps\n", methods[i].type->row.name, forces, STEPS);
		assert_int_equal(forces, STEPS * methods[i].forces + once);
		assert_int_equal(rig.report.factorizations, 0);
		assert_int_equal(rig.report.tangents, 0);
		rig_destroy(&rig);
	}
}

// One force a step in all, begin included, and none of them stale.
static void verlet_hands_its_last_forces_to_the_next_step(void** state) {
	(void)state;
	Cube cube;
	Rig kept, renewed;
	cube_create(&cube, "stable_neo_hookean", &jn_verlet);
	rig_create(&kept, &cube.c, 1);
	rig_create(&renewed, &cube.c, 1);
	rig_shake(&kept, 3, 0.005, 0.1);
	rig_shake(&renewed, 3, 0.005, 0.1);
	for (int step = 0; step < 50; ++step) {
		assert_int_equal(rig_attempt(&kept, 1e-3), JN_OK);
		rig_accept(&kept, 1e-3);
		assert_int_equal(kept.report.forces, step == 0 ? 2 : 1);
		rig_step(&renewed, 1e-3);
		rig_begin(&renewed); // touches, so that the forces are made anew
	}
	assert_int_equal(memcmp(kept.start.x, renewed.start.x, (size_t)kept.length * sizeof(double)), 0);
	assert_int_equal(memcmp(kept.start.v, renewed.start.v, (size_t)kept.length * sizeof(double)), 0);
	rig_destroy(&kept);
	rig_destroy(&renewed);
}

static void the_same_start_gives_the_same_end_after_other_attempts(void** state) {
	(void)state;
	for (int i = 0; i < METHOD_COUNT; ++i) {
		ModelCase c;
		Rig rig;
		Solution first = {0};
		driven(&c);
		c.body.damping = (JnDampingDef){.alpha = 2, .beta = 2e-3};
		c.sim.integrator.row = &methods[i].type->row;
		rig_create(&rig, &c, 1);
		set_in_motion(&rig);
		for (int k = 0; k < 3; ++k) { // the second attempt has another size, and leaves other forces in the cache
			assert_int_equal(rig_attempt(&rig, k == 1 ? 2e-4 : 3e-4), JN_OK);
			if (k == 0) memcpy(first.at, rig.end.x, (size_t)rig.length * sizeof(double));
			if (k == 0) memcpy(first.at + rig.length, rig.end.v, (size_t)rig.length * sizeof(double));
		}
		assert_int_equal(memcmp(first.at, rig.end.x, (size_t)rig.length * sizeof(double)), 0);
		assert_int_equal(memcmp(first.at + rig.length, rig.end.v, (size_t)rig.length * sizeof(double)), 0);
		rig_destroy(&rig);
	}
}

static void driven_nodes_stand_where_they_are_prescribed_at_the_end(void** state) {
	(void)state;
	const double t = 0.02, omega = 2 * 3.14159265358979323846 * 8;
	for (int i = 0; i < METHOD_COUNT; ++i) {
		ModelCase c;
		Rig rig;
		driven(&c);
		c.sim.integrator.row = &methods[i].type->row;
		rig_create(&rig, &c, 1);
		assert_int_equal(rig_attempt(&rig, t), JN_OK);
		assert_true(rig.end.t == t);
		const int k = rig.length - 3; // x of the last node, on the upper face
		expect_near(rig.end.x[k], jn_model_rest(rig.model)[k] + 0.02 * sin(omega * t), 1e-15, "position");
		expect_near(rig.end.v[k], 0.02 * omega * cos(omega * t), 1e-14, "velocity"); // rounding of about 1 m/s
		rig_destroy(&rig);
	}
}

static void a_step_that_blows_up_is_an_outcome(void** state) {
	(void)state;
	for (int i = 0; i < METHOD_COUNT; ++i) {
		Cube cube;
		Rig rig;
		cube_create(&cube, "stable_neo_hookean", methods[i].type);
		rig_create(&rig, &cube.c, 1);
		rig_shake(&rig, 3, 0.005, 1e200);
		rig.start.v[rig.length - 1] = INFINITY;
		assert_int_equal(rig_attempt(&rig, 1), JN_NOT_FINITE);
		rig_destroy(&rig);
	}
}

static void a_consistent_mass_is_refused_with_the_remedy(void** state) {
	(void)state;
	for (int i = 0; i < METHOD_COUNT; ++i)
		for (int is_lumped = 0; is_lumped < 2; ++is_lumped) {
			Cube cube;
			Rig rig;
			cube_create(&cube, "stable_neo_hookean", methods[i].type);
			cube.c.body.mass = is_lumped;
			rig_create(&rig, &cube.c, 1);
			log_capture();
			const JnStatus status = jn_integrator_accepts(methods[i].type, rig.sys);
			assert_int_equal(status, is_lumped ? JN_OK : JN_BAD_INPUT);
			if (!is_lumped) assert_non_null(strstr(log_text(), "mass: lumped"));
			if (!is_lumped) assert_non_null(strstr(log_text(), methods[i].type->row.name));
			log_release();
			rig_destroy(&rig);
		}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(every_method_has_its_order_in_bending),
		cmocka_unit_test(every_method_has_its_order_with_a_driven_end),
		cmocka_unit_test(compositions_fall_to_order_one_with_damping_and_the_others_keep_theirs),
		cmocka_unit_test(a_step_evaluates_the_forces_as_often_as_the_table_says),
		cmocka_unit_test(verlet_hands_its_last_forces_to_the_next_step),
		cmocka_unit_test(the_same_start_gives_the_same_end_after_other_attempts),
		cmocka_unit_test(driven_nodes_stand_where_they_are_prescribed_at_the_end),
		cmocka_unit_test(a_step_that_blows_up_is_an_outcome),
		cmocka_unit_test(a_consistent_mass_is_refused_with_the_remedy),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
