/// @file contact_memory_test.c
/// Steps in contact allocate nothing once buffers have grown. Every allocation of the process goes through here and is
/// counted while a step runs: those that jounce asks for, of which there must be none, and those that libraries make
/// within calls, which are printed: two a factorisation by CHOLMOD (the workspace of cholmod_super_numeric), with contact or
/// without, and some by OpenBLAS in products of small matrices.

#include <malloc.h>

#include "pass/pass_case.h"
#include "support/sanitized.h"

#if defined(__GLIBC__) && !IS_SANITIZED
	#define COUNTS 1

extern void* __libc_malloc(size_t size);               // NOLINT: what glibc calls them
extern void* __libc_calloc(size_t count, size_t size); // NOLINT
extern void* __libc_realloc(void* old, size_t size);   // NOLINT

extern const char __executable_start, etext; // NOLINT: jounce is linked into the test itself

static bool counting;
static long own, foreign;

static void count(const void* caller) {
	if (!counting) return;
	const bool is_own = (const char*)caller >= &__executable_start && (const char*)caller < &etext;
	++*(is_own ? &own : &foreign);
}

void* malloc(size_t size) {
	count(__builtin_return_address(0));
	return __libc_malloc(size);
}

void* calloc(size_t number, size_t size) {
	count(__builtin_return_address(0));
	return __libc_calloc(number, size);
}

void* realloc(void* old, size_t size) {
	count(__builtin_return_address(0));
	return __libc_realloc(old, size);
}
#else
	#define COUNTS 0
static bool counting;
static long own, foreign;
#endif

static const char material[] = "material: {law: stable_neo_hookean, density: 1000, young: 2e5, poisson: 0.3}, "
							   "damping: {beta: 5 ms}";

/// Two boxes on each other, which slide down a slope or stick, and a third that never touches.
static void open_boxes(Run* run, const char* integrator, const char* contact) {
	run_open(
		run, 1,
		"duration: 10 s\ngravity: [4.38716537, -8.77433074, 0]\nintegrator: {method: %s}\nstep: {dt: 5 ms}\n"
		"bodies:\n"
		"  - {name: low, shape: {type: box, size: [0.4, 0.2, 0.4], cells: [4, 2, 4]}, %s}\n"
		"  - {name: high, shape: {type: box, origin: [0.11, 0.2, 0.12], size: [0.2, 0.2, 0.2], cells: [2, 2, 2]}, %s}\n"
		"  - {name: far, shape: {type: box, origin: [0, 50, 0], size: [0.2, 0.2, 0.2], cells: [2, 2, 2]}, %s}\n"
		"obstacles: [{name: slope, shape: plane}]\ncontact: {%s}\n",
		integrator, material, material, material, contact);
}

static void expect_no_allocation(const char* integrator, const char* contact) {
	Run run;
	open_boxes(&run, integrator, contact);
	own = 0;
	counting = true;
	run_steps(&run, 100);
	counting = false;
	assert_true(own > 0); // buffers grow at first, and that is seen
	own = foreign = 0;
	for (int i = 0; i < 50; ++i) {
		counting = true;
		const JnStatus status = jn_sim_step(run.sim);
		counting = false;
		assert_int_equal(status, JN_OK);
	}
	assert_true(run_column(&run, "contacts_pressing") > 0);
	run_close(&run);
	print_message("%s, %s: %ld allocations in 50 steps, and %ld within libraries\n", integrator, contact, own, foreign);
	assert_int_equal(own, 0);
}

static void sticking_boxes_allocate_nothing(void** state) {
	(void)state;
	if (!COUNTS) skip();
	expect_no_allocation("backward_euler", "friction: 0.7");
	expect_no_allocation("sdirk2", "friction: 0.7");
}

static void sliding_boxes_allocate_nothing(void** state) {
	(void)state;
	if (!COUNTS) skip();
	expect_no_allocation("sdirk2", "friction: 0.3");
	expect_no_allocation("sdirk2", "friction: 0.3, prediction: iterated");
	expect_no_allocation("sdirk2", "friction: 0, prediction: free");
}

static void the_delassus_solver_allocates_nothing(void** state) {
	(void)state;
	if (!COUNTS) skip();
	expect_no_allocation("sdirk2", "friction: 0.3, solver: {method: delassus}");
}

// The splitting has CHOLMOD analyse the pattern of C and the contacts anew in each solve, which allocates; nothing of it
// stays: factors differ in size by some 10 kB, while 50 that stayed were 8 MB.
static void the_splitting_solver_keeps_no_memory(void** state) {
	(void)state;
	if (!COUNTS) skip();
#if COUNTS
	Run run;
	open_boxes(&run, "sdirk2", "friction: 0.3, solver: {method: admm}");
	run_steps(&run, 100);
	const size_t before = mallinfo2().uordblks;
	run_steps(&run, 50);
	const size_t after = mallinfo2().uordblks;
	run_close(&run);
	expect_at_most((double)after - (double)before, 1e5, "growth in 50 steps [bytes]");
#endif
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(sticking_boxes_allocate_nothing),
		cmocka_unit_test(sliding_boxes_allocate_nothing),
		cmocka_unit_test(the_delassus_solver_allocates_nothing),
		cmocka_unit_test(the_splitting_solver_keeps_no_memory),
	};
	return cmocka_run_group_tests(tests, case_set_up, case_tear_down);
}
