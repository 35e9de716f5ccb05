/// @file system_test.c
/// Systems of one's own that lack a verb, or whose verbs fail: what needs them says so by name, and what does not goes on.
#include "base/hash.h"
#include "support/failing_system.h"
#include "support/spring_case.h"

typedef struct Case {
	SpringCase spring; // its sim is that of the system in front
	FailingSystem front;
} Case;

// omega = 10 1/s, undamped; the sim is not there yet.
static void open_case(Case* c) {
	c->spring = (SpringCase){.spring = {.k_x = 100}};
	const JnUserSystemDef def = {
		.count = 1, .user = &c->spring.spring, .force = spring_force, .tangent = spring_tangent};
	assert_int_equal(jn_user_system_create(&def, &c->spring.sys), JN_OK);
	failing_create(&c->front, c->spring.sys);
	log_capture();
}

static JnStatus start(Case* c, const char* settings, double x) {
	const double v = 0;
	return jn_sim_create_for(&c->front.base, settings, &x, &v, &c->spring.sim);
}

static void close_case(Case* c) {
	log_release();
	spring_close(&c->spring);
}

static JnStatus run(Case* c) {
	JnStatus status = JN_OK;
	while (status == JN_OK && !jn_sim_is_done(c->spring.sim)) status = jn_sim_step(c->spring.sim);
	return status;
}

// ---- verbs that are not there

static void expect_refusal(Case* c, const char* settings, const char* first, const char* second) {
	assert_int_equal(start(c, settings, -1), JN_BAD_INPUT);
	assert_null(c->spring.sim);
	log_expect(first);
	log_expect(second);
	close_case(c);
}

static void an_implicit_method_needs_a_tangent(void** state) {
	(void)state;
	Case c;
	const char* settings = "{duration: 1 s, integrator: sdirk2}";
	open_case(&c);
	c.front.ops.linearize = NULL;
	expect_refusal(&c, settings, "sdirk2 needs the tangent of the forces", "choose an explicit method");
	open_case(&c);
	c.front.ops.matrix = NULL;
	expect_refusal(&c, settings, "sdirk2 needs the tangent of the forces", "choose an explicit method");
}

static void the_rule_of_stable_steps_needs_a_tangent(void** state) {
	(void)state;
	Case c;
	open_case(&c);
	c.front.ops.linearize = NULL;
	expect_refusal(&c, "{duration: 1 s, integrator: verlet, step: {controller: stable}}",
				   "step.controller: stable needs the tangent", "does not give");
}

static void the_rule_of_stretches_needs_lengths(void** state) {
	(void)state;
	Case c;
	open_case(&c);
	c.front.ops.stretch = NULL;
	expect_refusal(&c, "{duration: 1 s, integrator: verlet, step: {controller: stretch_limit}}",
				   "step.controller: stretch_limit", "choose");
}

// x = -cos(omega t); Verlet's method is off by (omega dt)^2 omega t / 24.
static void an_explicit_method_does_without_a_tangent(void** state) {
	(void)state;
	Case c;
	open_case(&c);
	c.front.ops.linearize = NULL;
	assert_int_equal(start(&c, "{duration: 1 s, integrator: verlet, step: {dt: 1 ms}}", -1), JN_OK);
	assert_int_equal(run(&c), JN_OK);
	expect_near(jn_sim_state(c.spring.sim)->x[0], -cos(10), 1e-4 * 10 / 24, "x after 1 s");
	close_case(&c);
}

static void without_a_tangent_a_run_that_blows_up_names_no_limit(void** state) {
	(void)state;
	Case c;
	open_case(&c);
	c.front.ops.linearize = NULL;
	assert_int_equal(start(&c, "{duration: 1e4 s, integrator: verlet, step: {dt: 0.3 s}}", -1), JN_OK);
	assert_int_equal(run(&c), JN_RUN_FAILED);
	log_expect("not finite, at coordinate 0");
	assert_null(strstr(log_text(), "limit of stability"));
	close_case(&c);
}

// ---- verbs that fail

// The first step fails in its `number`th call, and may not be cut.
static void expect_failure(const char* method, long number, JnStatus outcome, const char* words) {
	Case c;
	char settings[200];
	open_case(&c);
	snprintf(settings, sizeof settings, "{duration: 1 s, integrator: %s, step: {dt: 10 ms, cuts: 0}}", method);
	assert_int_equal(start(&c, settings, -1), JN_OK);
	failing_at(&c.front, number, outcome);
	assert_int_equal(run(&c), JN_RUN_FAILED);
	log_expect(words);
	close_case(&c);
}

static void a_matrix_that_is_not_definite_is_named(void** state) {
	(void)state;
	expect_failure("linearized_newmark", 1, JN_INDEFINITE, "M + dt D + dt^2 K of the step is not positive definite");
	expect_failure("ros2", 3, JN_INDEFINITE, "M + dt D + dt^2 K of the step is not positive definite");
}

// A linearised method has no residual to tell of, nor has an explicit one.
static void what_has_no_stages_tells_no_residual(void** state) {
	(void)state;
	expect_failure("ros2", 1, JN_NOT_CONVERGED, "failed: not converged, ");
	expect_failure("verlet", 1, JN_NOT_CONVERGED, "failed: not converged, ");
}

static void forces_that_fail_at_the_start_are_told_before_the_first_step(void** state) {
	(void)state;
	Case c;
	open_case(&c);
	failing_at(&c.front, 1, JN_NOT_FINITE);
	expect_refusal(&c, "{duration: 1 s, integrator: verlet}", "the forces at the start cannot be evaluated: not finite",
				   "start from another state");
}

static void memory_that_is_out_at_the_start_is_no_fault_of_the_state(void** state) {
	(void)state;
	Case c;
	open_case(&c);
	failing_at(&c.front, 1, JN_OUT_OF_MEMORY);
	assert_int_equal(start(&c, "{duration: 1 s, integrator: verlet}", -1), JN_OUT_OF_MEMORY);
	assert_string_equal(log_text(), "");
	close_case(&c);
}

// ---- starts and settings

static void a_start_that_is_no_number_is_refused(void** state) {
	(void)state;
	Case c;
	open_case(&c);
	assert_int_equal(start(&c, "{duration: 1 s, integrator: verlet}", NAN), JN_BAD_INPUT);
	log_expect("a start position or velocity is not finite");
	close_case(&c);
}

static void settings_that_are_no_yaml_are_refused_with_their_place(void** state) {
	(void)state;
	Case c;
	open_case(&c);
	expect_refusal(&c, "{duration: 1 s", "settings:2:1: the YAML is broken", "flow mapping");
}

// ---- saved states

// Where the first piece of that name has its bytes: pieces are a hash of the name, a size, and the bytes.
static unsigned char* find_piece(const JnArchive* archive, const char* name) {
	const uint64_t wanted = (uint64_t)jn_hash_add(jn_hash_start(), name, strlen(name));
	uint64_t head[2];
	for (size_t at = 0; at < archive->size; at += sizeof head + (size_t)head[1]) {
		memcpy(head, archive->bytes + at, sizeof head);
		if (head[0] == wanted) return archive->bytes + at + sizeof head;
	}
	fail_msg("there is no '%s'", name);
	return NULL;
}

static void expect_refused_state(const char* name, const void* value, size_t size, const char* words) {
	SpringCase c;
	JnArchive archive = {0};
	log_capture();
	assert_int_equal(spring_open(&c, the_spring(), "{duration: 1 s, integrator: sdirk2, step: {dt: 1 ms}}"), JN_OK);
	assert_int_equal(jn_sim_step(c.sim), JN_OK);
	assert_int_equal(jn_sim_save(c.sim, &archive), JN_OK);
	memcpy(find_piece(&archive, name), value, size);
	JnArchive reader = jn_archive_reader(archive.bytes, archive.size);
	assert_int_equal(jn_sim_restore(c.sim, &reader), JN_BAD_INPUT);
	log_expect(words);
	jn_archive_free(&archive);
	spring_close(&c);
	log_release();
}

static void absurd_numbers_in_a_saved_state_are_refused(void** state) {
	(void)state;
	const double nan = NAN, infinite = INFINITY, zero = 0;
	const long negative = -1;
	const int recent = 5; // accelerations; four are kept
	expect_refused_state("x", &nan, sizeof nan, "positions or velocities are not finite");
	expect_refused_state("v", &infinite, sizeof infinite, "positions or velocities are not finite");
	expect_refused_state("t", &nan, sizeof nan, "its time or step is absurd");
	expect_refused_state("next_dt", &zero, sizeof zero, "its time or step is absurd");
	expect_refused_state("next_dt", &infinite, sizeof infinite, "its time or step is absurd");
	expect_refused_state("steps", &negative, sizeof negative, "its time or step is absurd");
	expect_refused_state("recent", &recent, sizeof recent, "'recent' is more than there can be");
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(an_implicit_method_needs_a_tangent),
		cmocka_unit_test(the_rule_of_stable_steps_needs_a_tangent),
		cmocka_unit_test(the_rule_of_stretches_needs_lengths),
		cmocka_unit_test(an_explicit_method_does_without_a_tangent),
		cmocka_unit_test(without_a_tangent_a_run_that_blows_up_names_no_limit),
		cmocka_unit_test(a_matrix_that_is_not_definite_is_named),
		cmocka_unit_test(what_has_no_stages_tells_no_residual),
		cmocka_unit_test(forces_that_fail_at_the_start_are_told_before_the_first_step),
		cmocka_unit_test(memory_that_is_out_at_the_start_is_no_fault_of_the_state),
		cmocka_unit_test(a_start_that_is_no_number_is_refused),
		cmocka_unit_test(settings_that_are_no_yaml_are_refused_with_their_place),
		cmocka_unit_test(absurd_numbers_in_a_saved_state_are_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
