// Stiffness damping as products of kernels: the matrix that they stand for, where it is taken, and when it is made.
#include "model/damping.h"
#include "pass/pass_case.h"

enum { STEPS = 40 };

static void open_thread(Run* run, const char* method, const char* damping) {
	run_open(run, 1,
			 "duration: 1 s\nintegrator: {method: %s}\nstep: {dt: 0.1 ms}\nbodies:\n"
			 "  - shape: {type: thread, points: [{at: [0, 0, 0]}, {at: [0.1, 0, 0]}], radius: 5 mm, links: 10}\n"
			 "    material: {law: constraints, density: 1000 kg/m^3, stiffness: 160 kPa}\n"
			 "    mass: lumped\n    fix: [{where: {face: x-}}]\n    damping: {%s}\n",
			 method, damping);
}

static JnModelSystem* system_of(const Run* run) {
	return (JnModelSystem*)jn_model_system(run->model);
}

static double norm_of(const double* a, int length) {
	double sum = 0;
	for (int k = 0; k < length; ++k) sum += a[k] * a[k];
	return sqrt(sum);
}

// D p by products, and by the tangents of all groups at x, assembled here.
static void expect_damping_at(const Run* run, double beta, const double* x, const char* what) {
	JnModelSystem* sys = system_of(run);
	const JnPattern* pattern = &run->model->pattern;
	double *out = calloc((size_t)run->length, sizeof *out), *expected = calloc((size_t)run->length, sizeof *out);
	double *p = calloc((size_t)run->length, sizeof *p), *blocks = calloc(9 * (size_t)pattern->blocks, sizeof *blocks);
	for (int k = 0; k < run->length; ++k) p[k] = sin(1.3 * k);
	jn_damping_apply(sys, 1, p, out);
	jn_assembly_tangent(sys->assembly, x, JN_DEFINITE, NULL, blocks);
	jn_blocks_apply(pattern, blocks, beta, p, expected, 1);
	const double size = norm_of(expected, run->length);
	for (int k = 0; k < run->length; ++k) out[k] -= expected[k];
	assert_true(size > 1e-3);
	// some twenty entries meet in a sum, each rounded a few times
	expect_at_most(norm_of(out, run->length) / size, 1e-14, "%s: difference of D p", what);
	free(out);
	free(expected);
	free(p);
	free(blocks);
}

static void products_equal_the_tangent_at_the_start_of_the_step(void** state) {
	(void)state;
	Run run;
	open_thread(&run, "symplectic_euler", "beta: 1 ms");
	run_steps(&run, STEPS);
	assert_non_null(system_of(&run)->damping_x);
	expect_damping_at(&run, 1e-3, run_state(&run)->x, "start");
	run_close(&run);
}

static void damping_at_rest_stays_that_of_the_rest_positions(void** state) {
	(void)state;
	Run run;
	open_thread(&run, "symplectic_euler", "beta: 1 ms, stiffness: rest");
	run_steps(&run, STEPS);
	expect_damping_at(&run, 1e-3, jn_model_rest(run.model), "rest");
	run_close(&run);
}

static void current_damping_is_that_of_the_last_state_whose_force_was_asked_for(void** state) {
	(void)state;
	Run run;
	open_thread(&run, "symplectic_euler", "beta: 1 ms, stiffness: current");
	run_steps(&run, STEPS);
	JnSystem* sys = jn_sim_system(run.sim);
	JnVec f = sys->space->ops->create(sys->space);
	assert_int_equal(sys->ops->force(sys, run_state(&run), f), JN_OK);
	expect_damping_at(&run, 1e-3, run_state(&run)->x, "current");
	sys->space->ops->destroy(sys->space, f);
	run_close(&run);
}

static void explicit_steps_assemble_nothing(void** state) {
	(void)state;
	static const char* const methods[] = {"symplectic_euler", "verlet", "rk4"};
	for (int m = 0; m < 3; ++m)
		for (int kind = 0; kind < 3; ++kind) {
			static const char* const kinds[] = {"beta: 1 ms", "beta: 1 ms, stiffness: rest",
												"beta: 1 ms, stiffness: current"};
			Run run;
			open_thread(&run, methods[m], kinds[kind]);
			for (int i = 0; i < STEPS; ++i) {
				run_step(&run);
				assert_int_equal(jn_sim_last_report(run.sim)->tangents, 0);
			}
			assert_false(system_of(&run)->damping_is_assembled);
			run_close(&run);
		}
}

// Asked for in the middle of a run, the matrix is that of the products; nothing of the run changes by asking.
static void a_matrix_that_is_asked_for_is_that_of_the_products(void** state) {
	(void)state;
	Run run, other;
	open_thread(&run, "verlet", "beta: 1 ms");
	open_thread(&other, "verlet", "beta: 1 ms");
	double out[2][3 * 33];
	assert_true(run.length <= 3 * 33);
	for (int i = 0; i < STEPS; ++i) {
		run_step(&run);
		run_step(&other);
		const double* blocks = jn_damping_blocks(system_of(&run));
		memset(out, 0, sizeof out);
		jn_blocks_apply(&run.model->pattern, blocks, 1, run_state(&run)->v, out[0], 1);
		jn_damping_apply(system_of(&run), 1, run_state(&run)->v, out[1]);
		const double size = norm_of(out[0], run.length);
		for (int k = 0; k < run.length; ++k) out[0][k] -= out[1][k];
		assert_true(norm_of(out[0], run.length) <= 1e-13 * size); // v is smooth, so that the sums cancel a little
	}
	assert_memory_equal(run_state(&run)->x, run_state(&other)->x, (size_t)run.length * sizeof(double));
	run_close(&run);
	run_close(&other);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(products_equal_the_tangent_at_the_start_of_the_step),
		cmocka_unit_test(damping_at_rest_stays_that_of_the_rest_positions),
		cmocka_unit_test(current_damping_is_that_of_the_last_state_whose_force_was_asked_for),
		cmocka_unit_test(explicit_steps_assemble_nothing),
		cmocka_unit_test(a_matrix_that_is_asked_for_is_that_of_the_products),
	};
	return cmocka_run_group_tests(tests, case_set_up, case_tear_down);
}
