/// @file contact_free_test.c
/// Contact leaves alone what does not touch, for every integrator and every prediction: without impulses the end of a
/// step is the integrator's own, bit for bit.
#include "integrate/integrator.h"
#include "pass/pass_case.h"

static const char* const predictions[] = {"carried", "iterated", "free"};
enum { PREDICTIONS = sizeof predictions / sizeof *predictions, STEPS = 20 };

// Methods that overshoot are predicted free, and refuse the others.
static bool allows(const JnRow* row, int prediction) {
	return !((const JnIntegratorType*)row)->overshoots || strcmp(predictions[prediction], "free") == 0;
}

static const char material[] = "material: {law: stable_neo_hookean, density: 1000, young: 1e5, poisson: 0.3}";

// Explicit methods ask for a diagonal mass; 1 ms resolves cells of 0.1 m, in which sound takes some 8 ms.
static const char* mass_of(const JnRow* row) {
	return (((const JnIntegratorType*)row)->needs & JN_NEEDS_DIAGONAL_MASS) != 0 ? "lumped" : "consistent";
}

// Two spinning boxes 1 mm apart, which fly up from a floor a little below: watched all the time, and they never meet.
static void open_near(Run* run, const char* method, const char* mass, const char* contact) {
	run_open(run, 1,
			 "duration: 1 s\ngravity: [0, -9.81, 0]\n"
			 "integrator: {method: %s}\nnewton: {tolerance: 1e-6}\nstep: {dt: 1 ms, cuts: 0}\n"
			 "bodies:\n"
			 "  - {name: a, shape: {type: box, origin: [0, 0.001, 0], size: [0.2, 0.2, 0.2], cells: [2, 2, 2]}, %s,\n"
			 "     mass: %s, velocity: [0, 1, 0], spin: [0.2, 0, 0]}\n"
			 "  - {name: b, shape: {type: box, origin: [0.201, 0.011, 0.013], size: [0.2, 0.2, 0.2], cells: [2, 2, "
			 "2]}, %s,\n"
			 "     mass: %s, velocity: [0.1, 1, 0], spin: [0.2, 0, 0]}\n"
			 "obstacles:\n  - {name: floor, shape: plane}\n%s",
			 method, material, mass, material, mass, contact);
}

static void expect_same_bits(const Run* a, const Run* b, int first, int length, const char* what) {
	const size_t bytes = (size_t)length * sizeof(double);
	if (memcmp(run_state(a)->x + first, run_state(b)->x + first, bytes) != 0) fail_msg("%s: positions differ", what);
	if (memcmp(run_state(a)->v + first, run_state(b)->v + first, bytes) != 0) fail_msg("%s: velocities differ", what);
}

static void what_never_touches_is_the_same_bit_for_bit_for_every_integrator(void** state) {
	(void)state;
	for (int i = 0; i < jn_integrator_list.count; ++i) {
		const JnRow* row = jn_integrator_list.rows[i];
		Run without;
		open_near(&without, row->name, mass_of(row), "");
		run_steps(&without, STEPS);
		for (int p = 0; p < PREDICTIONS; ++p) {
			if (!allows(row, p)) continue;
			Run with;
			char contact[64], what[96];
			snprintf(contact, sizeof contact, "contact: {prediction: %s, friction: 0.5}\n", predictions[p]);
			snprintf(what, sizeof what, "%s, %s", row->name, predictions[p]);
			open_near(&with, row->name, mass_of(row), contact);
			run_step(&with);
			if (run_column(&with, "contacts") < 8) fail_msg("%s: nothing is near, the test shows nothing", what);
			run_steps(&with, STEPS - 1);
			expect_same_bits(&with, &without, 0, with.length, what);
			assert_true(run_column(&with, "contacts_pressing") == 0);
			run_close(&with);
		}
		run_close(&without);
	}
	print_message("%d integrators, %d predictions\n", jn_integrator_list.count, PREDICTIONS);
}

// Two boxes that collide in the first step, and a third that flies by far away.
static void open_collision(Run* run, const char* method, const char* mass, const char* mode, const char* contact) {
	run_open(
		run, 1,
		"duration: 1 s\ngravity: [0, -9.81, 0]\nintegrator: {method: %s}\n"
		"newton: {tolerance: 1e-9, mode: %s, reuse: never, guess: zero}\nstep: {dt: 1 ms, cuts: 0}\n"
		"solver: {method: direct}\n" // iterations for one body would be iterations for all

		"bodies:\n"
		"  - {name: a, shape: {type: box, origin: [0, 1, 0], size: [0.2, 0.2, 0.2], cells: [2, 2, 2]}, %s,\n"
		"     mass: %s, velocity: [1, 0, 0]}\n"
		"  - {name: b, shape: {type: box, origin: [0.201, 1.03, 0.05], size: [0.2, 0.2, 0.2], cells: [2, 2, 2]}, %s,\n"
		"     mass: %s, velocity: [-1, 0, 0]}\n"
		"  - {name: c, shape: {type: box, origin: [0, 3, 0], size: [0.2, 0.2, 0.4], cells: [2, 2, 4]}, %s,\n"
		"     mass: %s, velocity: [0, 1, 0], spin: [1, 0, 2]}\n"
		"%s",
		method, mode, material, mass, material, mass, material, mass, contact);
}

static void compare_bystander(const JnRow* row, const char* mode, int prediction, int steps) {
	Run with, without;
	char contact[64], what[96];
	if (!allows(row, prediction)) return;
	snprintf(contact, sizeof contact, "contact: {prediction: %s}\n", predictions[prediction]);
	snprintf(what, sizeof what, "bystander, %s, %s, %s", row->name, mode, predictions[prediction]);
	open_collision(&without, row->name, mass_of(row), mode, "");
	open_collision(&with, row->name, mass_of(row), mode, contact);
	for (int i = 0; i < steps; ++i) {
		run_step(&with);
		run_step(&without);
		if (i == 0 && !(run_column(&with, "contacts_pressing") > 0)) fail_msg("%s: nothing touches", what);
	}
	expect_same_bits(&with, &without, body_first(&with, 2), body_length(&with, 2), what);
	run_close(&with);
	run_close(&without);
}

// From the same start the predictor is a pure function, so the first step leaves the third body alone bit for bit.
// Iterated predictions of nonlinear stages are others: norms of residuals are those of all bodies, and when the two that
// touch ask for another Newton iteration the third gets one too.
static void a_bystander_of_a_collision_is_left_alone_for_every_integrator(void** state) {
	(void)state;
	for (int i = 0; i < jn_integrator_list.count; ++i) {
		compare_bystander(jn_integrator_list.rows[i], "root", 0, 1);
		compare_bystander(jn_integrator_list.rows[i], "root", 2, 1);
	}
}

// Exponential methods build a Krylov space of all bodies together.
static bool is_iterative(const JnIntegratorType* type) {
	return strncmp(type->row.name, "exponential", strlen("exponential")) == 0;
}

// Where nothing is iterated, bodies share nothing, and so it stays. Methods that keep history lose that of all bodies
// when contact edits the end.
static void a_bystander_is_left_alone_for_many_steps_where_nothing_is_iterated(void** state) {
	(void)state;
	int tried = 0;
	for (int i = 0; i < jn_integrator_list.count; ++i) {
		const JnIntegratorType* type = (const JnIntegratorType*)jn_integrator_list.rows[i];
		if (type->commit != NULL || is_iterative(type)) continue;
		for (int p = 0; p < PREDICTIONS; ++p) compare_bystander(&type->row, "linear", p, STEPS);
		++tried;
	}
	print_message("%d integrators\n", tried);
	assert_true(tried > 0);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(what_never_touches_is_the_same_bit_for_bit_for_every_integrator),
		cmocka_unit_test(a_bystander_of_a_collision_is_left_alone_for_every_integrator),
		cmocka_unit_test(a_bystander_is_left_alone_for_many_steps_where_nothing_is_iterated),
	};
	return cmocka_run_group_tests(tests, case_set_up, case_tear_down);
}
