/// @file dirk_test.c
/// Steps are pure: the same start gives the same end, whatever was stepped before; and start is never written.
#include "support/model_case.h"

static void swinging_case(ModelCase* c, const JnRow* method) {
	case_box(c, JN_HEX8, "stable_neo_hookean");
	case_gravity(c, 1, -9.81, 0);
	case_drive(c, FACE_Z_HIGH, 0.02, 4);
	case_method(c, method);
}

typedef struct Ends {
	double *x, *v;
	size_t bytes;
} Ends;

static Ends keep_end(const Rig* rig) {
	Ends ends = {.bytes = (size_t)rig->length * sizeof(double)};
	ends.x = malloc(ends.bytes);
	ends.v = malloc(ends.bytes);
	memcpy(ends.x, rig->end.x, ends.bytes);
	memcpy(ends.v, rig->end.v, ends.bytes);
	return ends;
}

static void free_ends(Ends* ends) {
	free(ends->x);
	free(ends->v);
}

static void the_same_start_gives_the_same_bits_without_reuse_and_guess(void** state) {
	(void)state;
	for (int i = 0; i < jn_integrator_list.count; ++i) {
		if (!is_dirk(jn_integrator_list.rows[i])) continue;
		ModelCase c;
		Rig rig;
		swinging_case(&c, jn_integrator_list.rows[i]);
		c.sim.newton.reuse = 1;
		c.sim.newton.guess = 0;
		rig_create(&rig, &c, 1);
		rig_step(&rig, 1.0 / 128);
		rig_step(&rig, 1.0 / 128);
		assert_int_equal(rig_attempt(&rig, 1.0 / 128), JN_OK);
		Ends first = keep_end(&rig);
		assert_int_equal(rig_attempt(&rig, 1.0 / 200), JN_OK); // something else in between
		assert_int_equal(rig_attempt(&rig, 1.0 / 128), JN_OK);
		if (memcmp(first.x, rig.end.x, first.bytes) != 0 || memcmp(first.v, rig.end.v, first.bytes) != 0)
			fail_msg("%s: another end from the same start", jn_integrator_list.rows[i]->name);
		free_ends(&first);
		rig_destroy(&rig);
	}
}

static void the_same_start_gives_the_same_end_to_tolerance_with_reuse_and_guess(void** state) {
	(void)state;
	for (int i = 0; i < jn_integrator_list.count; ++i) {
		if (!is_dirk(jn_integrator_list.rows[i])) continue;
		ModelCase c;
		Rig rig;
		swinging_case(&c, jn_integrator_list.rows[i]);
		c.sim.newton.guess = 2;
		rig_create(&rig, &c, 1);
		rig_step(&rig, 1.0 / 128);
		rig_step(&rig, 1.0 / 128);
		assert_int_equal(rig_attempt(&rig, 1.0 / 128), JN_OK);
		Ends first = keep_end(&rig);
		assert_int_equal(rig_attempt(&rig, 1.0 / 200), JN_OK);
		assert_int_equal(rig_attempt(&rig, 1.0 / 128), JN_OK);
		// residuals of 1e-10 of 50 N on nodes of 0.1 kg: 1e-7 m/s^2 over dt = 8 ms, and weights of up to 4 in a step
		const char* name = jn_integrator_list.rows[i]->name;
		expect_near(largest_difference(first.v, rig.end.v, rig.length), 0, 4e-9, "%s: velocities", name);
		expect_near(largest_difference(first.x, rig.end.x, rig.length), 0, 4e-11, "%s: positions", name);
		free_ends(&first);
		rig_destroy(&rig);
	}
}

static void the_start_is_not_written(void** state) {
	(void)state;
	for (int i = 0; i < jn_integrator_list.count; ++i) {
		if (!is_dirk(jn_integrator_list.rows[i])) continue;
		ModelCase c;
		Rig rig;
		swinging_case(&c, jn_integrator_list.rows[i]);
		rig_create(&rig, &c, 1);
		rig_step(&rig, 1.0 / 128);
		jn_state_copy(rig.space, &rig.start, &rig.end);
		Ends start = keep_end(&rig);
		const uint64_t stamp = rig.start.stamp;
		assert_int_equal(rig_attempt(&rig, 1.0 / 128), JN_OK);
		assert_memory_equal(start.x, rig.start.x, start.bytes);
		assert_memory_equal(start.v, rig.start.v, start.bytes);
		assert_true(rig.start.stamp == stamp && rig.start.t == 1.0 / 128);
		assert_true(rig.end.stamp != stamp && rig.end.t == 2.0 / 128);
		free_ends(&start);
		rig_destroy(&rig);
	}
}

// The force at the end of a step is that at the start of the next: begin finds it by its stamp, or evaluates it once.
static void the_end_carries_a_stamp_that_belongs_to_its_bytes(void** state) {
	(void)state;
	for (int i = 0; i < jn_integrator_list.count; ++i) {
		if (!is_dirk(jn_integrator_list.rows[i])) continue;
		ModelCase c;
		Rig rig;
		swinging_case(&c, jn_integrator_list.rows[i]);
		rig_create(&rig, &c, 1);
		rig_step(&rig, 1.0 / 128);
		double *served = rig.space->ops->create(rig.space), *fresh = rig.space->ops->create(rig.space);
		assert_int_equal(rig.sys->ops->force(rig.sys, &rig.start, served), JN_OK);
		jn_state_touch(rig.space, &rig.start); // nothing is known about it any more
		assert_int_equal(rig.sys->ops->force(rig.sys, &rig.start, fresh), JN_OK);
		assert_memory_equal(served, fresh, (size_t)rig.length * sizeof *fresh);
		rig.space->ops->destroy(rig.space, served);
		rig.space->ops->destroy(rig.space, fresh);
		rig_destroy(&rig);
	}
}

static void a_state_that_is_not_finite_is_reported(void** state) {
	(void)state;
	for (int i = 0; i < jn_integrator_list.count; ++i) {
		if (!is_dirk(jn_integrator_list.rows[i])) continue;
		ModelCase c;
		Rig rig;
		swinging_case(&c, jn_integrator_list.rows[i]);
		rig_create(&rig, &c, 1);
		const double middle[3] = {0.1, 0.1, 0.2};
		rig.start.v[3 * jn_model_nearest(rig.model, middle)] = INFINITY;
		rig_begin(&rig);
		const JnStatus status = rig_attempt(&rig, 1.0 / 128);
		if (status != JN_NOT_FINITE)
			fail_msg("%s: %s, expected not finite", jn_integrator_list.rows[i]->name, jn_status_name(status));
		rig_destroy(&rig);
	}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(the_same_start_gives_the_same_bits_without_reuse_and_guess),
		cmocka_unit_test(the_same_start_gives_the_same_end_to_tolerance_with_reuse_and_guess),
		cmocka_unit_test(the_start_is_not_written),
		cmocka_unit_test(the_end_carries_a_stamp_that_belongs_to_its_bytes),
		cmocka_unit_test(a_state_that_is_not_finite_is_reported),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
