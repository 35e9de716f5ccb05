// A long damped thread, with a needle and a hand, moves the same, bit for bit, for one to four threads: 2250 elements each,
// more than the 2048 at which one is woken.
#include "pass/pass_case.h"

enum { STEPS = 10 };

static void run_thread(int threads, const char* method, double** x) {
	Run run;
	run_open(
		&run, threads,
		"duration: 1 s\ngravity: [0, -9.81, 0]\nintegrator: {method: %s}\nstep: {dt: 0.1 ms}\nbodies:\n"
		"  - shape: {type: thread, radius: 4 mm, links: 9000, needle: 20, curve: {type: helix, radius: 1, pitch: 0.1, "
		"turns: "
		"14}}\n    material: {law: constraints, density: 1000 kg/m^3, stiffness: 20 kPa}\n    mass: lumped\n"
		"    damping: {alpha: 1 1/s, beta: 10 us}\n    drive:\n      - {where: {set: end}, input: hand}\n"
		"      - {where: {set: needle}, along: {curve: {type: circle, radius: 1}, head: {type: sine, amplitude: 1 cm, "
		"frequency: 5}}}\n",
		method);
	for (int i = 0; i < STEPS; ++i) {
		jn_input_set(jn_sim_input(run.sim, "hand"), (double[3]){1e-5 * i * i, 0, 1e-5 * i}, NULL);
		run_step(&run);
	}
	*x = malloc(2 * (size_t)run.length * sizeof **x);
	assert_non_null(*x);
	memcpy(*x, run_state(&run)->x, (size_t)run.length * sizeof **x);
	memcpy(*x + run.length, run_state(&run)->v, (size_t)run.length * sizeof **x);
	run_close(&run);
}

static void a_thread_moves_the_same_for_any_number_of_threads(void** state) {
	(void)state;
	static const char* const methods[] = {"symplectic_euler", "rk4"};
	for (int m = 0; m < 2; ++m) {
		double *one, *more;
		run_thread(1, methods[m], &one);
		for (int threads = 2; threads <= 4; ++threads) {
			run_thread(threads, methods[m], &more);
			assert_memory_equal(one, more, 2 * 9 * 9001 * sizeof *one);
			free(more);
		}
		assert_true(one[9 * 9001 + 9 * 4000 + 1] < -0.005); // it falls for a millisecond, and has not blown up
		assert_true(one[9 * 9001 + 9 * 4000 + 1] > -1);
		free(one);
	}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_thread_moves_the_same_for_any_number_of_threads),
	};
	return cmocka_run_group_tests(tests, case_set_up, case_tear_down);
}
