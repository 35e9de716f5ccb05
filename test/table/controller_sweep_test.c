/// @file controller_sweep_test.c
/// Every row of the list of controllers: it steps every method or refuses it by name, survives forces that fail, ends a run
/// without a trace when it must, and leaves nothing of the attempts that it refuses.
#include "base/document.h"
#include "support/failing_system.h"
#include "support/spring_case.h"

static int set_up(void** state) {
	(void)state;
	log_capture();
	return 0;
}

static int tear_down(void** state) {
	(void)state;
	log_release();
	return 0;
}

// Keys that make a controller refuse some attempts of the spring from a first step of `dt`, down to `least` seconds.
static void step_text(const JnRow* row, double dt, double least, size_t size, char* text) {
	const char* name = row->name;
	if (strcmp(name, "fixed") == 0) {
		snprintf(text, size, "{controller: fixed, dt: %g s, cuts: %d}", dt, (int)log2(dt / least));
	} else if (strcmp(name, "combined") == 0) {
		snprintf(text, size,
				 "{controller: combined, rules: [{controller: stretch_limit, dt: %g s, dt_min: %g s, stretch: 0.02}, "
				 "{controller: speed_limit, dt: %g s, dt_min: %g s, distance: 3 cm}]}",
				 dt, least, dt, least);
	} else {
		const char* extra = strcmp(name, "stretch_limit") == 0 ? ", stretch: 0.02"
							: strcmp(name, "stable") == 0      ? ", every: 2"
															   : "";
		snprintf(text, size, "{controller: %s, dt: %g s, dt_min: %g s%s}", name, dt, least, extra);
	}
}

static void expect_refusal(const char* controller, const char* method) {
	const char* text = log_text();
	if (strstr(text, controller) == NULL || strstr(text, method) == NULL || strstr(text, "choose") == NULL)
		fail_msg("%s refuses %s without saying what to do: %s", controller, method, text);
}

static void every_controller_steps_every_method_or_refuses_it_by_name(void** state) {
	(void)state;
	for (int k = 0; k < jn_controller_list.count; ++k) {
		int stepped = 0, refused = 0;
		for (int i = 0; i < jn_integrator_list.count; ++i) {
			const JnRow *row = jn_controller_list.rows[k], *method = jn_integrator_list.rows[i];
			SpringCase c;
			char step[300], settings[400];
			step_text(row, 1e-4, 1e-8, sizeof step, step);
			snprintf(settings, sizeof settings, "{duration: 20 ms, integrator: %s, step: %s}", method->name, step);
			log_capture();
			const JnStatus status = spring_open(&c, the_spring(), settings);
			refused += status != JN_OK;
			if (status != JN_OK) expect_refusal(row->name, method->name);
			while (status == JN_OK && !jn_sim_is_done(c.sim)) {
				const JnStatus stepping = jn_sim_step(c.sim);
				if (stepping != JN_OK) fail_msg("%s, %s: %s", row->name, method->name, log_text());
			}
			if (status == JN_OK) {
				expect_near(jn_sim_state(c.sim)->t, 0.02, 1e-11, "%s, %s: end", row->name,
							method->name); // 1e-9 of a step
				++stepped;
			}
			spring_close(&c);
		}
		print_message("%-16s steps %d methods, refuses %d\n", jn_controller_list.rows[k]->name, stepped, refused);
		assert_true(stepped > 0);
	}
}

// A method that the controller serves.
static const char* served(const JnRow* row) {
	if (strcmp(row->name, "stable") == 0) return "verlet";
	return strcmp(row->name, "zienkiewicz_xie") == 0 ? "linearized_newmark" : "tr_bdf2";
}

static void forces_that_fail_end_the_run_at_its_last_good_state(void** state) {
	(void)state;
	for (int k = 0; k < jn_controller_list.count; ++k) {
		const JnRow* row = jn_controller_list.rows[k];
		SpringCase c;
		Spring spring = *the_spring();
		char step[300], settings[400];
		double t = 0, x = -1, v = 0;
		spring.fails_after = 200;
		step_text(row, 1e-3, 1e-6, sizeof step, step);
		snprintf(settings, sizeof settings, "{duration: 50 s, integrator: %s, step: %s}", served(row), step);
		log_capture();
		JnStatus status = spring_open(&c, &spring, settings);
		while (status == JN_OK && !jn_sim_is_done(c.sim)) {
			t = jn_sim_state(c.sim)->t;
			x = jn_sim_state(c.sim)->x[0];
			v = jn_sim_state(c.sim)->v[0];
			status = jn_sim_step(c.sim);
		}
		assert_int_equal(status, JN_RUN_FAILED);
		if (strstr(log_text(), "the forces at its end") == NULL) { // else the step was good, and is the last one
			assert_true(jn_sim_state(c.sim)->t == t && jn_sim_state(c.sim)->x[0] == x &&
						jn_sim_state(c.sim)->v[0] == v);
			if (strstr(log_text(), "not finite") == NULL || strstr(log_text(), "step.") == NULL)
				fail_msg("%s: the reason or the remedy is missing: %s", row->name, log_text());
		}
		spring_close(&c);
	}
}

typedef struct FailingRun {
	SpringCase spring; // its sim is that of the failing system
	FailingSystem failing;
} FailingRun;

// The step is large enough to be refused at first; so is that of the second rule, where there are two.
static void open_failing(FailingRun* run, const JnRow* row, const char* method) {
	const double x = -1, v = 0;
	char step[300], settings[400];
	Spring linear = {.k_x = 100, .k_v = 1};
	run->spring = (SpringCase){.spring = linear};
	const JnUserSystemDef def = {.count = 1,
								 .user = &run->spring.spring,
								 .force = spring_force,
								 .tangent = spring_tangent,
								 .depends_on_time = true};
	assert_int_equal(jn_user_system_create(&def, &run->spring.sys), JN_OK);
	failing_create(&run->failing, run->spring.sys);
	step_text(row, 0.3, 1e-6, sizeof step, step);
	snprintf(settings, sizeof settings, "{duration: 50 s, integrator: %s, step: %s}", method, step);
	assert_int_equal(jn_sim_create_for(&run->failing.base, settings, &x, &v, &run->spring.sim), JN_OK);
}

// A few steps, of which the call of that number fails, or none. Returns how many calls there were.
static long run_failing(const JnRow* row, const char* method, long number, JnStatus outcome) {
	enum { STEPS = 3 };
	FailingRun run;
	JnStatus status = JN_OK;
	double t = 0, x = -1;
	open_failing(&run, row, method);
	failing_at(&run.failing, number, outcome);
	for (int i = 0; i < STEPS && status == JN_OK; ++i) {
		t = jn_sim_state(run.spring.sim)->t;
		x = jn_sim_state(run.spring.sim)->x[0];
		status = jn_sim_step(run.spring.sim);
	}
	const long calls = run.failing.calls;
	const char* culprit = run.failing.culprit;
	const bool is_bad = outcome < JN_OK ? status != outcome : status != JN_OK && status != JN_RUN_FAILED;
	if (number > 0 && (culprit == NULL || is_bad))
		fail_msg("%s: call %ld, %s, fails with '%s', and the run with '%s'", row->name, number,
				 culprit != NULL ? culprit : "none", jn_status_name(outcome), jn_status_name(status));
	const bool has_begun_next = culprit != NULL && strcmp(culprit, "begin") == 0; // after a step that is good
	if (status != JN_OK && !has_begun_next)
		assert_true(jn_sim_state(run.spring.sim)->t == t && jn_sim_state(run.spring.sim)->x[0] == x);
	spring_close(&run.spring);
	return calls;
}

static void fail_each_call(const JnRow* row, const char* method) {
	const long calls = run_failing(row, method, 0, JN_OK);
	for (long number = 1; number <= calls; ++number) {
		run_failing(row, method, number, JN_OUT_OF_MEMORY);
		run_failing(row, method, number, JN_NOT_FINITE);
	}
	print_message("%-16s %-18s %ld calls\n", row->name, method, calls);
}

static void a_call_that_fails_in_a_controller_ends_the_run_or_cuts_the_step(void** state) {
	(void)state;
	for (int k = 0; k < jn_controller_list.count; ++k) {
		const JnRow* row = jn_controller_list.rows[k];
		fail_each_call(row, served(row));
		if (strcmp(row->name, "force_error") == 0) fail_each_call(row, "linearized_newmark"); // it keeps its tangent
	}
}

// The same steps by hand, without any refused attempt: bit for bit the same, where nothing is kept between steps but what a
// method says (no tangent, no guess).
static void replay(const JnRow* row, const char* method, const char* law, bool damped) {
	ModelCase c;
	JnSim* sim = NULL;
	Rig rig;
	JnArena arena = {0};
	JnDocument document;
	JnVariant step;
	char text[300];
	case_box(&c, JN_HEX8, law);
	case_gravity(&c, 3, -9.81, 0);
	case_method(&c, row_named(&jn_integrator_list, method));
	c.body.mass = strcmp(method, "verlet") == 0; // lumped
	c.sim.newton = (JnNewtonDef){.tolerance = 1e-10, .max_iterations = 60, .reuse = 1, .guess = 0};
	if (damped) c.body.damping = (JnDampingDef){.alpha = 0.1, .beta = 2e-3};
	c.sim.duration = 0.4;
	step_text(row, 0.1, 1e-6, sizeof text, text);
	char settings[400];
	snprintf(settings, sizeof settings, "step: %s", text);
	assert_int_equal(jn_document_parse("settings", settings, &arena, &document), JN_OK);
	static const JnKey keys[] = {
		{.name = "step", .kind = JN_VARIANT, .rows = &jn_controller_list, .tag = "controller", .text = "fixed"}, {0}};
	assert_int_equal(jn_keys_read(keys, document.root, "", &arena, &step), JN_OK);
	c.sim.step = step;
	rig_create(&rig, &c, 1);
	assert_int_equal(jn_sim_create(&c.sim, 1, &sim), JN_OK);
	int rejected = 0;
	while (!jn_sim_is_done(sim)) {
		if (jn_sim_step(sim) != JN_OK) fail_msg("%s, %s: %s", row->name, method, log_text());
		rejected += jn_sim_last_report(sim)->rejected;
		rig_step(&rig, jn_sim_last_dt(sim));
		if (memcmp(rig.start.x, jn_sim_state(sim)->x, (size_t)rig.length * sizeof(double)) != 0 ||
			memcmp(rig.start.v, jn_sim_state(sim)->v, (size_t)rig.length * sizeof(double)) != 0)
			fail_msg("%s, %s, %s: step %ld after %d refused attempts differs by %g", row->name, method, law,
					 jn_sim_steps(sim), rejected, largest_difference(rig.start.x, jn_sim_state(sim)->x, rig.length));
	}
	print_message("%-16s %-20s %-18s %4ld steps, %d refused\n", row->name, method, law, jn_sim_steps(sim), rejected);
	jn_sim_destroy(sim);
	rig_destroy(&rig);
	jn_arena_free(&arena);
}

static void refused_attempts_leave_no_trace(void** state) {
	(void)state;
	for (int k = 0; k < jn_controller_list.count; ++k) {
		const JnRow* row = jn_controller_list.rows[k];
		const bool is_embedded = strcmp(row->name, "embedded") == 0, is_xie = strcmp(row->name, "zienkiewicz_xie") == 0;
		const bool is_doubling = strcmp(row->name, "step_doubling") == 0;
		if (strcmp(row->name, "stable") == 0) { // for explicit methods alone
			replay(row, "verlet", "stable_neo_hookean", false);
			continue;
		}
		replay(row, is_embedded ? "ros2" : "linearized_newmark", "stable_neo_hookean", false);
		replay(row, is_xie ? "newmark" : "sdirk2", "corotated_frozen", true);
		if (!is_embedded && !is_doubling) replay(row, "hht_alpha", "stable_neo_hookean", true);
	}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(every_controller_steps_every_method_or_refuses_it_by_name),
		cmocka_unit_test(forces_that_fail_end_the_run_at_its_last_good_state),
		cmocka_unit_test(a_call_that_fails_in_a_controller_ends_the_run_or_cuts_the_step),
		cmocka_unit_test(refused_attempts_leave_no_trace),
	};
	return cmocka_run_group_tests(tests, set_up, tear_down);
}
