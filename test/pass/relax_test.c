// Relaxation of threads: what it keeps short, what it leaves alone, and what is refused.
#include "base/key.h"
#include "base/space.h"
#include "integrate/integrator.h"
#include "pass_case.h"

// 0.2 m in 20 links, held at one end, with springs that its weight stretches by a seventh as it swings.
static const char thread[] =
	"duration: 1 s\n"
	"gravity: [0, -9.81, 0]\n"
	"bodies:\n"
	"  - name: thread\n"
	"    shape: {type: thread, links: 20, radius: 4 mm, points: [{at: [0, 0, 0]}, {at: [0.2, 0, 0]}]}\n"
	"    material: {law: constraints, density: 1000, stiffness: 10 kPa, damping: 50 us}\n"
	"    mass: lumped\n"
	"%s" // fix, spin ...
	"integrator: {method: %s}\n"
	"step: {dt: 0.2 ms}\n"
	"%s"; // relax
static const char held[] = "    fix: [{where: {face: x-}}]\n";
// Compliance beyond all bounds: nothing moves, and the columns tell the stretch.
static const char only_measured[] = "relax: {sweeps: 1, compliance: 1e15}\n";

// How far the tip comes below where it is held, as a share of the length.
static double deepest_tip(const char* relax, double* stretch) {
	Run run;
	double lowest = 0;
	*stretch = 0;
	run_open(&run, 1, thread, held, "symplectic_euler", relax);
	while (run_state(&run)->t < 0.4) {
		run_step(&run);
		lowest = fmin(lowest, run_state(&run)->x[run.length - 8]);
		*stretch = fmax(*stretch, run_column(&run, "relax.stretch_after"));
	}
	run_close(&run);
	return -lowest / 0.2;
}

// All springs rigid make a truss of the thread, which hardly bends; its axis alone does not.
static void relaxed_axis_keeps_a_swinging_thread_short_and_free_to_bend(void** state) {
	(void)state;
	double stretch;
	const double axis = deepest_tip("relax: {}\n", &stretch);
	expect_at_most(stretch, 0.01, "largest stretch of the axis");
	const double plain = deepest_tip(only_measured, &stretch);
	print_message("without: %.3g, at least 0.1\n", stretch);
	assert_true(stretch > 0.1);
	const double truss = deepest_tip("relax: {axis: no, springs: yes, sweeps: 100}\n", &stretch);
	print_message("deepest tip, in lengths: axis %.3f, springs %.3f, nothing relaxed %.3f\n", axis, truss, plain);
	assert_true(axis > 0.8 && axis < 1.01 && truss < 0.5);
}

static void momentum_of_a_free_thread_changes_by_its_weight_alone(void** state) {
	(void)state;
	Run run;
	run_open(&run, 1, thread, "    spin: [3, 20, -40]\n    velocity: [1, 2, 3]\n", "symplectic_euler",
			 "relax: {springs: yes}\n");
	const JnEnergies before = run_energies(&run);
	run_steps(&run, 200);
	const JnEnergies after = run_energies(&run);
	const double mass = jn_model_mass(run.model), fall = -9.81 * mass * run_state(&run)->t;
	for (int a = 0; a < 3; ++a) // 3 m/s, roundings of 200 steps with some 2000 projections each
		expect_near(after.momentum[a] - before.momentum[a], a == 1 ? fall : 0, 1e-11 * mass, "momentum %d", a);
	assert_true(run_column(&run, "relax.displacement") > 1e-9);
	run_close(&run);
}

static void velocities_follow_the_displacement_or_stay(void** state) {
	(void)state;
	static const char* const relax[] = {only_measured, "relax: {}\n", "relax: {velocity: keep}\n"};
	Run runs[3];
	for (int i = 0; i < 3; ++i) {
		run_open(&runs[i], 1, thread, "    fix: [{where: {face: x-}}]\n    scatter: {amplitude: 0.5 mm, seed: 3}\n",
				 "symplectic_euler", relax[i]);
		run_step(&runs[i]);
	}
	const JnState *plain = run_state(&runs[0]), *followed = run_state(&runs[1]), *kept = run_state(&runs[2]);
	const double dt = 0.2e-3;
	assert_true(run_column(&runs[1], "relax.displacement") > 1e-5);
	for (int k = 0; k < runs[0].length; ++k) {
		assert_true(kept->v[k] == plain->v[k]);
		assert_true(kept->x[k] == followed->x[k]);
		const double expected = plain->v[k] + (followed->x[k] - plain->x[k]) / dt; // 1 m/s, from x of 0.1 m over dt
		if (!(fabs(followed->v[k] - expected) <= 1e-12))
			fail_msg("v[%d]: %g, expected %g", k, followed->v[k], expected);
	}
	for (int i = 0; i < 3; ++i) run_close(&runs[i]);
}

// The last step is a billionth of the others, and sweeps always leave something.
static void step_cut_short_gives_no_speed(void** state) {
	(void)state;
	double kinetic[2];
	for (int i = 0; i < 2; ++i) {
		Run run;
		run_open(&run, 1, thread, held, "symplectic_euler", "relax: {sweeps: 2}\n");
		jn_sim_stop_at(run.sim, i == 0 ? 0.1 : 0.1 + 2e-13);
		run_until(&run, 0.1);
		if (i == 1) run_step(&run);
		kinetic[i] = run_energies(&run).kinetic;
		run_close(&run);
	}
	expect_near(kinetic[1], kinetic[0], 1e-3 * kinetic[0], "kinetic energy");
}

static void held_nodes_stay_where_they_are_held(void** state) {
	(void)state;
	Run run;
	run_open(&run, 1, thread, held, "rk4", "relax: {}\n");
	run_steps(&run, 100);
	int count = 0;
	for (int k = 0; k < run.length; ++k) {
		if (!run.model->held[k]) continue;
		assert_true(run_state(&run)->x[k] == run.model->rest[k]);
		assert_true(run_state(&run)->v[k] == 0);
		++count;
	}
	assert_int_equal(count, 9);
	run_close(&run);
}

// `correct` of the same attempt twice gives the same end, and only `commit` lets the columns see it.
static void rejected_attempt_leaves_no_trace(void** state) {
	(void)state;
	Run run;
	double ends[2][3 * 63];
	run_open(&run, 1, thread, held, "symplectic_euler", "relax: {springs: yes, volumes: yes, compliance: 1e-3}\n");
	run_steps(&run, 10);
	JnPass* pass = (JnPass*)run_pass(&run);
	const double stretch = run_column(&run, "relax.stretch_before"), moved = run_column(&run, "relax.displacement");
	JnSystem* sys = jn_sim_system(run.sim);
	JnState end;
	assert_int_equal(jn_state_create(sys->space, &end), JN_OK);
	JnStep step = {.sys = sys, .start = run_state(&run), .end = &end, .dt = 1e-3};
	for (int i = 0; i < 2; ++i) {
		bool edited = false, again = false;
		for (int k = 0; k < run.length; ++k) end.x[k] = 1.1 * run_state(&run)->x[k];
		assert_int_equal(pass->type->correct(pass, &step, 0, &edited, &again), JN_OK);
		assert_true(edited && !again);
		memcpy(ends[i], end.x, sizeof ends[i]);
	}
	assert_memory_equal(ends[0], ends[1], sizeof ends[0]);
	assert_true(run_column(&run, "relax.stretch_before") == stretch && run_column(&run, "relax.displacement") == moved);
	pass->type->commit(pass, &step);
	assert_true(run_column(&run, "relax.stretch_before") > 0.09); // of lengths that grew by a tenth
	jn_state_destroy(sys->space, &end);
	run_close(&run);
}

// It begins scattered: links of 10 mm are off by a few per cent.
static void every_integrator_can_be_relaxed(void** state) {
	(void)state;
	for (int i = 0; i < jn_integrator_list.count; ++i) {
		Run run;
		run_open(&run, 1, thread, "    fix: [{where: {face: x-}}]\n    scatter: {amplitude: 0.5 mm, seed: 3}\n",
				 jn_integrator_list.rows[i]->name, "relax: {sweeps: 20}\n");
		run_steps(&run, 20);
		const double stretch = run_column(&run, "relax.stretch_after");
		if (!(stretch < 0.01)) fail_msg("%s: stretch %g", jn_integrator_list.rows[i]->name, stretch);
		run_close(&run);
	}
}

static void order_tells_whether_it_runs_before_contact_or_after(void** state) {
	(void)state;
	static const char* const orders[] = {"before", "after"};
	for (int i = 0; i < 2; ++i) {
		Run run;
		char text[160];
		int count;
		snprintf(text, sizeof text,
				 "contact: {}\nobstacles: [{name: floor, shape: {type: plane, point: [0, -1, 0]}}]\n"
				 "relax: {order: %s}\n",
				 orders[i]);
		run_open(&run, 1, thread, held, "symplectic_euler", text);
		JnPass* const* passes = jn_sim_passes(run.sim, &count);
		assert_int_equal(count, 2);
		assert_string_equal(passes[i]->type->row.name, "relax");
		assert_string_equal(passes[1 - i]->type->row.name, "contact");
		run_close(&run);
	}
}

static void expect_refusal(const char* text, const char* format, ...) {
	Run run;
	va_list arguments;
	va_start(arguments, format);
	log_capture();
	assert_int_equal(run_try(&run, 1, format, arguments), JN_BAD_INPUT);
	if (strstr(log_text(), text) == NULL) fail_msg("'%s' is not in: %s", text, log_text());
	log_release();
	va_end(arguments);
	run_close(&run);
}

static void what_cannot_be_relaxed_is_refused(void** state) {
	(void)state;
	expect_refusal("relax.axis: neither axis nor springs nor volumes are to relax", thread, held, "rk4",
				   "relax: {axis: no}\n");
	expect_refusal(
		"relax: no body has what is to relax; threads of law constraints or rod have an axis",
		"duration: 1\nbodies: [{name: a, shape: {type: box, size: [1, 1, 1], cells: [1, 1, 1]}, material: {law: "
		"linear, density: 1, young: 1, poisson: 0}}]\nrelax: {}\n");
	expect_refusal("relax: stands beside 'system: spring_1d'", "duration: 1\nsystem: {type: spring_1d}\nrelax: {}\n");
	expect_refusal("relax.factor: 2 is outside (0, 2)", thread, held, "rk4", "relax: {factor: 2}\n");
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, case_set_up, case_tear_down)

int main(void) {
	const struct CMUnitTest tests[] = {
		TEST(relaxed_axis_keeps_a_swinging_thread_short_and_free_to_bend),
		TEST(momentum_of_a_free_thread_changes_by_its_weight_alone),
		TEST(velocities_follow_the_displacement_or_stay),
		TEST(step_cut_short_gives_no_speed),
		TEST(held_nodes_stay_where_they_are_held),
		TEST(rejected_attempt_leaves_no_trace),
		TEST(every_integrator_can_be_relaxed),
		TEST(order_tells_whether_it_runs_before_contact_or_after),
		TEST(what_cannot_be_relaxed_is_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
