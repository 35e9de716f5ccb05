/// @file contact_adaptive_test.c
/// Contact with steps that are chosen: attempts that are refused leave nothing in it, and frames between steps show no overlap.
#include "pass/pass_case.h"
#include "pass/script_controller.h"

enum { MOST_STEPS = 4000 };

static const char scene[] =
	"duration: 0.5 s\nintegrator: {method: %s}\n"
	"newton: {reuse: never, guess: zero}\nsolver: {method: direct}\nstep: %s\n"
	"contact: {prediction: %s}\n"
	"obstacles: [{name: floor, shape: {type: plane}}]\n"
	"bodies:\n"
	"  - {name: box, shape: {type: box, origin: [0, 0.3, 0], size: [0.2, 0.2, 0.2], cells: [2, 2, 2]}, "
	"material: {law: stable_neo_hookean, density: 1000, young: 2e5, poisson: 0.3}, damping: {beta: 2 ms}}\n";

static void replay(const char* method, const char* step, const char* prediction) {
	static Script script;
	static double t[MOST_STEPS];
	Run run, again;
	int rejected = 0;
	script = (Script){0};
	run_open(&run, 1, scene, method, step, prediction);
	run_open(&again, 1, scene, method, "{dt: 1 ms}", prediction);
	jn_sim_destroy(again.sim);
	again.sim = NULL;
	while (!jn_sim_is_done(run.sim)) {
		assert_int_equal(jn_sim_step(run.sim), JN_OK);
		rejected += jn_sim_last_report(run.sim)->rejected;
		assert_true(script.count < MOST_STEPS);
		t[script.count] = jn_sim_state(run.sim)->t;
		script.sizes[script.count++] = jn_sim_last_dt(run.sim);
	}
	((JnSceneDef*)jn_scene_def(again.scene))->sim.step = (JnVariant){&script_type.row, &script};
	assert_int_equal(jn_scene_build(again.scene, 1, &again.sim), JN_OK);
	for (int i = 0; i < script.count; ++i) assert_int_equal(jn_sim_step(again.sim), JN_OK);
	assert_true(jn_sim_state(again.sim)->t == t[script.count - 1]);
	assert_memory_equal(jn_sim_state(again.sim)->x, jn_sim_state(run.sim)->x, (size_t)run.length * sizeof(double));
	assert_memory_equal(jn_sim_state(again.sim)->v, jn_sim_state(run.sim)->v, (size_t)run.length * sizeof(double));
	print_message("%-20s %-60s %-10s %d steps, %d refused\n", method, step, prediction, script.count, rejected);
	assert_true(rejected > 0);
	run_close(&run);
	run_close(&again);
}

static void refused_attempts_leave_no_trace_in_contact(void** state) {
	(void)state;
	static const char* const predictions[] = {"free", "carried", "iterated"};
	for (int i = 0; i < 3; ++i) {
		replay("sdirk2", "{controller: stretch_limit, stretch: 0.02, dt: 20 ms}", predictions[i]);
		replay("linearized_newmark", "{controller: force_error, tolerance: 1e-5 m, dt: 20 ms}", predictions[i]);
		replay("sdirk2", "{controller: step_doubling, tolerance: 1e-4 m, dt: 20 ms}", predictions[i]);
	}
}

// Lowest point between two steps, and at their ends.
static double lowest(const double* x, int length) {
	double low = INFINITY;
	for (int k = 1; k < length; k += 3) low = fmin(low, x[k]);
	return low;
}

static void frames_between_steps_show_no_overlap(void** state) {
	(void)state;
	Run run;
	run_open(&run, 1, scene, "sdirk2", "{dt: 10 ms}", "auto");
	JnSpace* space = jn_sim_system(run.sim)->space;
	JnState s = {.x = space->ops->create(space), .v = space->ops->create(space)};
	double ends = lowest(jn_sim_state(run.sim)->x, run.length), between = INFINITY;
	while (!jn_sim_is_done(run.sim)) {
		const double t = jn_sim_state(run.sim)->t;
		assert_int_equal(jn_sim_step(run.sim), JN_OK);
		ends = fmin(ends, lowest(jn_sim_state(run.sim)->x, run.length));
		for (int k = 1; k < 8; ++k) {
			jn_sim_state_at(run.sim, t + k / 8.0 * jn_sim_last_dt(run.sim), &s);
			between = fmin(between, lowest(s.x, run.length));
		}
	}
	print_message("lowest point at steps %.3e m, between them %.3e m\n", ends, between);
	assert_true(ends < 1e-3);                                                            // it has landed
	expect_at_most(ends - between, 1e-12, "overlap between steps beyond that of steps"); // rounding
	space->ops->destroy(space, s.x);
	space->ops->destroy(space, s.v);
	run_close(&run);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(refused_attempts_leave_no_trace_in_contact, case_set_up, case_tear_down),
		cmocka_unit_test_setup_teardown(frames_between_steps_show_no_overlap, case_set_up, case_tear_down),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
