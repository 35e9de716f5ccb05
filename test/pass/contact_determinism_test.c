/// @file contact_determinism_test.c
/// Contact gives the same bits for any number of threads, and a run that is done again gives them again.
#include "pass/pass_case.h"

// A wide slab, held below, and a ball and a box that fall onto it and onto each other: enough vertices, triangles and nodes
// that all threads are woken, and few enough contacts to be quick.
static void open_heap(Run* run, int threads, const char* contact) {
	run_open(run, threads,
			 "duration: 10 s\nintegrator: sdirk2\nnewton: {tolerance: 1e-6}\nstep: {dt: 5 ms}\n"
			 "bodies:\n"
			 "  - name: slab\n"
			 "    shape: {type: box, origin: [-1, 0, -1], size: [2, 0.1, 2], cells: [40, 2, 40]}\n"
			 "    material: {law: stable_neo_hookean, density: 1000, young: 1e6, poisson: 0.3}\n"
			 "    fix: [{where: {face: y-}}]\n"
			 "  - name: ball\n"
			 "    shape: {type: ball, center: [0, 0.31, 0], radius: 0.2, cells: 6, rings: 3}\n"
			 "    material: {law: stable_neo_hookean, density: 1000, young: 1e5, poisson: 0.4}\n"
			 "    velocity: [0.3, -1.5, 0]\n"
			 "  - name: box\n"
			 "    shape: {type: box, origin: [0.205, 0.11, -0.1], size: [0.2, 0.2, 0.2], cells: [4, 4, 4]}\n"
			 "    material: {law: stable_neo_hookean, density: 1000, young: 1e5, poisson: 0.3}\n"
			 "    velocity: [-0.5, -1, 0.1]\n"
			 "contact: {friction: 0.4%s}\n",
			 contact);
}

static void expect_same_run(int threads, const char* contact, int steps) {
	Run one, more;
	open_heap(&one, 1, contact);
	open_heap(&more, threads, contact);
	const size_t bytes = (size_t)one.length * sizeof(double);
	for (int i = 0; i < steps; ++i) {
		run_step(&one);
		run_step(&more);
		if (memcmp(run_state(&one)->x, run_state(&more)->x, bytes) != 0) fail_msg("step %d: positions differ", i + 1);
		if (memcmp(run_state(&one)->v, run_state(&more)->v, bytes) != 0) fail_msg("step %d: velocities differ", i + 1);
	}
	double left[32], right[32];
	const JnPass *a = run_pass(&one), *b = run_pass(&more);
	a->type->measure(a, left);
	b->type->measure(b, right);
	assert_memory_equal(left, right, (size_t)a->type->column_count * sizeof(double));
	for (int f = 0; f < a->type->field_count; ++f)
		assert_memory_equal(a->type->field(a, f), b->type->field(b, f),
							(size_t)(one.length / 3 * a->type->fields[f].components) * sizeof(double));
	print_message("%d nodes, %g contacts, %g press\n", one.length / 3, run_column(&one, "contacts"),
				  run_column(&one, "contacts_pressing"));
	assert_true(run_column(&one, "contacts_pressing") > 20);
	run_close(&one);
	run_close(&more);
}

static void two_threads_move_bodies_in_contact_as_one_does(void** state) {
	(void)state;
	expect_same_run(2, "", 4);
	expect_same_run(2, ", prediction: iterated", 2);
}

static void four_threads_do_too(void** state) {
	(void)state;
	expect_same_run(4, "", 3);
}

static void a_run_can_be_repeated(void** state) {
	(void)state;
	expect_same_run(1, "", 3);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(two_threads_move_bodies_in_contact_as_one_does),
		cmocka_unit_test(four_threads_do_too),
		cmocka_unit_test(a_run_can_be_repeated),
	};
	return cmocka_run_group_tests(tests, case_set_up, case_tear_down);
}
