/// @file collision_memory_test.c
/// Steps with collisions and sutures allocate nothing once buffers have grown. Every allocation of the process goes through
/// here and is counted while a step runs.
#include "pass/collision_case.h"
#include "pass/suture.h"
#include "support/sanitized.h"

#if defined(__GLIBC__) && !IS_SANITIZED
	#define COUNTS 1

extern void* __libc_malloc(size_t size);               // NOLINT: what glibc calls them
extern void* __libc_calloc(size_t count, size_t size); // NOLINT
extern void* __libc_realloc(void* old, size_t size);   // NOLINT

static bool counting;
static long count;

void* malloc(size_t size) {
	count += counting;
	return __libc_malloc(size);
}

void* calloc(size_t number, size_t size) {
	count += counting;
	return __libc_calloc(number, size);
}

void* realloc(void* old, size_t size) {
	count += counting;
	return __libc_realloc(old, size);
}
#else
	#define COUNTS 0
static bool counting;
static long count;
#endif

static void steps_with_collisions_and_sutures_allocate_nothing(void** state) {
	(void)state;
	if (!COUNTS) skip();
	Run run;
	run_open(
		&run, 1,
		"duration: 1 s\ngravity: [0, -9.81, 0]\nintegrator: {method: symplectic_euler}\nstep: {dt: 50 us}\n"
		"bodies:\n"
		"  - {name: thread, shape: {type: thread, radius: 1 mm, links: 24, points: [{at: [0.004, 0.006, 0.003]}, "
		"{at: [0.009, 0.018, 0.004]}, {at: [0.05, 0.017, 0.003]}]}, velocity: [0, -0.3, 0], " SOFT_ROD "}\n"
		"  - {name: other, shape: {type: thread, radius: 1 mm, links: 8, points: [{at: [0.03, 0.006, -0.02]}, "
		"{at: [0.031, 0.006, 0.02]}]}, " SOFT_ROD "}\n"
		"  - {name: block, shape: {type: box, origin: [-0.01, -0.01, -0.01], size: [0.02, 0.01, 0.02], cells: [2, 1, "
		"2], "
		"element: tet4}, material: {law: stable_neo_hookean, density: 1000, young: 2e4, poisson: 0.3}, mass: lumped, "
		"fix: [{where: {face: y-}}]}\n"
		"obstacles: [{name: floor, shape: {type: plane, point: [0, -0.005, 0]}}]\n"
		"collision: {friction: 0.3}\nsuture: {thread: thread, body: block, friction: 0.2, hold: 1 mN}\n");
	run_until(&run, 0.08);
	count = 0;
	double pressing = 0, sites = 0;
	for (int i = 0; i < 1000; ++i) {
		counting = true;
		const JnStatus status = jn_sim_step(run.sim);
		counting = false;
		assert_int_equal(status, JN_OK);
		pressing = fmax(pressing, pass_column(run_pass_of(&run, &jn_pass_collision), "collisions"));
		sites = fmax(sites, pass_column(run_pass_of(&run, &jn_pass_suture), "suture_sites"));
	}
	run_close(&run);
	print_message("%ld allocations in 1000 steps with up to %g contacts and %g sites\n", count, pressing, sites);
	assert_true(pressing > 0);
	assert_true(sites > 0);
	assert_int_equal(count, 0);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(steps_with_collisions_and_sutures_allocate_nothing),
	};
	return cmocka_run_group_tests(tests, case_set_up, case_tear_down);
}
