/// @file collision_rules_test.c
/// What collisions promise of themselves: refused attempts leave no trace, steps allocate nothing, and what cannot be is refused.
#include "pass/collision_case.h"
#include "pass/script_controller.h"
#include "pass/suture.h"

enum { MOST_STEPS = 8000 };

// A thread falls across another, onto a block and a floor; its tip pierces the block.
static const char scene[] =
	"duration: 0.12 s\ngravity: [0, -9.81, 0]\nintegrator: {method: %s}\nnewton: {reuse: never, guess: zero}\n"
	"solver: {method: direct}\nstep: %s\n"
	"bodies:\n"
	"  - {name: thread, shape: {type: thread, radius: 1 mm, links: 12, points: [{at: [0.004, 0.006, 0.003]}, "
	"{at: [0.009, 0.018, 0.004]}, {at: [0.05, 0.017, 0.003]}]}, velocity: [0, -0.3, 0], " SOFT_ROD "}\n"
	"  - {name: other, shape: {type: thread, radius: 1 mm, links: 8, points: [{at: [0.03, 0.006, -0.02]}, "
	"{at: [0.031, 0.006, 0.02]}]}, " SOFT_ROD "}\n"
	"  - {name: block, shape: {type: box, origin: [-0.01, -0.01, -0.01], size: [0.02, 0.01, 0.02], cells: [2, 1, 2], "
	"element: tet4}, material: {law: stable_neo_hookean, density: 1000, young: 2e4, poisson: 0.3}, mass: lumped, "
	"fix: [{where: {face: y-}}]}\n"
	"obstacles: [{name: floor, shape: {type: plane, point: [0, -0.005, 0]}}]\n"
	"collision: {friction: 0.3, residue: %g}\n"
	"suture: {thread: thread, body: block, friction: 0.2, hold: 1 mN}\n";

static void replay(const char* method, const char* step, double residue) {
	static Script script;
	Run run, again;
	int rejected = 0, most_pressing = 0, most_sites = 0;
	script = (Script){0};
	run_open(&run, 1, scene, method, step, residue);
	run_open(&again, 1, scene, method, "{dt: 1 ms}", residue);
	jn_sim_destroy(again.sim);
	again.sim = NULL;
	while (!jn_sim_is_done(run.sim)) {
		run_step(&run);
		rejected += jn_sim_last_report(run.sim)->rejected;
		assert_true(script.count < MOST_STEPS);
		script.sizes[script.count++] = jn_sim_last_dt(run.sim);
		most_pressing = (int)fmax(most_pressing, pass_column(run_pass_of(&run, &jn_pass_collision), "collisions"));
		most_sites = (int)fmax(most_sites, pass_column(run_pass_of(&run, &jn_pass_suture), "suture_sites"));
	}
	((JnSceneDef*)jn_scene_def(again.scene))->sim.step = (JnVariant){&script_type.row, &script};
	assert_int_equal(jn_scene_build(again.scene, 1, &again.sim), JN_OK);
	for (int i = 0; i < script.count; ++i) run_step(&again);
	assert_memory_equal(run_state(&again)->x, run_state(&run)->x, (size_t)run.length * sizeof(double));
	assert_memory_equal(run_state(&again)->v, run_state(&run)->v, (size_t)run.length * sizeof(double));
	print_message("%s, %s: %d steps, %d refused, %d pressing, %d sites\n", method, step, script.count, rejected,
				  most_pressing, most_sites);
	assert_true(rejected > 0);
	assert_true(most_pressing > 2);
	assert_true(most_sites > 0);
	run_close(&run);
	run_close(&again);
}

static void refused_attempts_leave_no_trace(void** state) {
	(void)state;
	replay("symplectic_euler", "{controller: stretch_limit, stretch: 0.002, dt: 0.1 ms, dt_max: 0.1 ms}", 1);
	replay("verlet", "{controller: step_doubling, tolerance: 1e-8 m, dt: 0.1 ms, dt_max: 0.1 ms}", 0.5);
	replay("sdirk2", "{controller: stretch_limit, stretch: 0.005, dt: 1 ms, dt_max: 1 ms}", 0);
}

static void refusal(const char* text, const char* format, ...) {
	Run run;
	va_list arguments;
	va_start(arguments, format);
	log_capture();
	const JnStatus status = run_try(&run, 1, format, arguments);
	va_end(arguments);
	const bool says = strstr(log_text(), text) != NULL;
	if (!says) print_error("%s\n", log_text());
	log_release();
	run_close(&run);
	assert_int_equal(status, JN_BAD_INPUT);
	assert_true(says);
}

#define HEAD "duration: 1 s\nintegrator: {method: symplectic_euler}\nstep: {dt: 10 us}\n"
#define THREAD                                                                                                         \
	"  - {name: thread, shape: {type: thread, radius: 1 mm, links: 4, points: [{at: [0, 1, 0]}, {at: [1, 1, "          \
	"0]}]}, " SOFT_ROD "}\n"

static void contact_and_collision_do_not_share_a_thread(void** state) {
	(void)state;
	refusal("both would move the thread 'thread'", HEAD "bodies:\n" THREAD "collision: {}\ncontact: {}\n");
}

static void a_suture_needs_collisions_and_names_that_exist(void** state) {
	(void)state;
	refusal("add `collision: {}`", HEAD "bodies:\n" THREAD "suture: {thread: thread, body: block}\n");
	refusal("no thread that collides is named 'yarn'",
			HEAD "bodies:\n" THREAD "collision: {}\nsuture: {thread: yarn, body: block}\n");
	refusal("no body with a surface that collides is named 'block'",
			HEAD "bodies:\n" THREAD "collision: {}\nsuture: {thread: thread, body: block}\n");
	refusal("the tip of 'thread' lies within 'block'", HEAD
			"bodies:\n" THREAD
			"  - {name: block, shape: {type: box, origin: [-0.1, 0.9, -0.1], size: [0.2, 0.2, 0.2], cells: [1, 1, 1], "
			"element: tet4}, material: {law: linear, density: 1000, young: 1e5, poisson: 0.3}, mass: lumped}\n"
			"collision: {}\nsuture: {thread: thread, body: block}\n");
}

#define BLOCK                                                                                                          \
	"  - {name: block, shape: {type: box, size: [1, 1, 1], cells: [1, 1, 1]}, material: {law: stable_neo_hookean, "    \
	"density: 1000, young: 2e4, poisson: 0.3}, mass: lumped}\n"

static void a_suture_needs_an_end_and_a_needle_within_its_thread(void** state) {
	(void)state;
	refusal("the loop 'loop' has no tip",
			HEAD "bodies:\n  - {name: loop, shape: {type: thread, radius: 1 mm, links: 9, curve: {type: circle, "
				 "radius: 0.1}, origin: [0, 3, 0]}, " SOFT_ROD "}\n" BLOCK
				 "collision: {}\nsuture: {thread: loop, body: block}\n");
	refusal("suture.needle: 5 links are more than the thread 'thread' has, 4",
			HEAD "bodies:\n" THREAD BLOCK "collision: {}\nsuture: {thread: thread, body: block, needle: 5}\n");
}

static void collisions_without_a_thread_are_refused(void** state) {
	(void)state;
	refusal("no thread is there that could collide", HEAD "bodies:\n" BLOCK "collision: {}\n");
	refusal("collision: stands beside 'system: spring_1d'", HEAD "system: {type: spring_1d}\ncollision: {}\n");
	refusal("suture: stands beside 'system: spring_1d'",
			HEAD "system: {type: spring_1d}\nsuture: {thread: thread, body: block}\n");
}

// More links than an int counts lie within `neighbors`: all of the thread does, and none of it meets another.
static void neighbors_beyond_any_thread_leave_it_alone(void** state) {
	(void)state;
	Run run;
	run_open(&run, 1,
			 HEAD "bodies:\n  - {name: thread, shape: {type: thread, radius: 1 mm, links: 1000, points: [{at: [0, 1, "
				  "0]}, {at: [0.1, 1, 0]}]}, " SOFT_ROD "}\ncollision: {neighbors: 1e6}\n");
	const JnCollision* pass = (const JnCollision*)run_pass_of(&run, &jn_pass_collision);
	const int apart = pass->strands[0].apart, links = pass->strands[0].link_count;
	run_close(&run);
	assert_true(apart >= links);
}

static void a_cloth_beside_a_thread_is_refused(void** state) {
	(void)state;
	refusal(
		"'sheet' is a cloth", HEAD
		"bodies:\n" THREAD
		"  - {name: sheet, shape: {type: cloth, size: [1, 1], cells: [2, 2]}, material: {law: membrane, density: 0.1, "
		"stretch: [100, 100], shear: 10, bend: [1e-3, 1e-3]}, mass: lumped}\ncollision: {}\n");
}

static void a_body_of_negative_masses_beside_a_thread_is_refused(void** state) {
	(void)state;
	static const char scene_of[] =
		"duration: 1 s\nintegrator: {method: backward_euler}\nstep: {dt: 10 us}\nbodies:\n" THREAD
		"  - {name: block, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [1, 1, 1], element: tet10}, material: "
		"{law: "
		"linear, density: 1000, young: 1e5, poisson: 0.3}%s}\ncollision: {}\n";
	Run run;
	refusal("not positive at all nodes of 'block'", scene_of, "");
	run_open(&run, 1, scene_of, ", mass: lumped");
	run_close(&run);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(refused_attempts_leave_no_trace),
		cmocka_unit_test(contact_and_collision_do_not_share_a_thread),
		cmocka_unit_test(a_suture_needs_collisions_and_names_that_exist),
		cmocka_unit_test(a_suture_needs_an_end_and_a_needle_within_its_thread),
		cmocka_unit_test(collisions_without_a_thread_are_refused),
		cmocka_unit_test(neighbors_beyond_any_thread_leave_it_alone),
		cmocka_unit_test(a_cloth_beside_a_thread_is_refused),
		cmocka_unit_test(a_body_of_negative_masses_beside_a_thread_is_refused),
	};
	return cmocka_run_group_tests(tests, case_set_up, case_tear_down);
}
