// Inputs: the motion between two settings, the same for every stage; forces; names; no allocation.
#include "model/input.h"

#include <malloc.h>

#include "model/hold.h"
#include "model/system.h"
#include "pass/pass_case.h"
#include "support/sanitized.h"

#if defined(__GLIBC__) && !IS_SANITIZED
	#define COUNTS 1
extern void* __libc_malloc(size_t size);               // NOLINT: what glibc calls them
extern void* __libc_calloc(size_t count, size_t size); // NOLINT
extern void* __libc_realloc(void* old, size_t size);   // NOLINT

static volatile bool counting; // compilers believe that malloc changes nothing that they see
static volatile long allocations;

void* malloc(size_t size) {
	allocations += counting;
	return __libc_malloc(size);
}

void* calloc(size_t number, size_t size) {
	allocations += counting;
	return __libc_calloc(number, size);
}

void* realloc(void* old, size_t size) {
	allocations += counting;
	return __libc_realloc(old, size);
}
#else
	#define COUNTS 0
static volatile bool counting;
static volatile long allocations;
#endif

static const double pi = 3.14159265358979323846;
static const double dt = 1e-3;

// A hanging thread whose upper end is driven in the way that `drive` says.
static void open_thread(Run* run, const char* method, const char* drive) {
	run_open(run, 1,
			 "duration: 10 s\ngravity: [0, -9.81, 0]\nintegrator: {method: %s}\nstep: {dt: 1 ms}\nbodies:\n"
			 "  - shape: {type: thread, points: [{at: [0, 0, 0]}, {at: [0, -0.2, 0]}], radius: 4 mm, links: 20}\n"
			 "    material: {law: constraints, density: 1000 kg/m^3, stiffness: 5 kPa}\n    mass: lumped\n"
			 "    damping: {alpha: 20 Hz}\n    drive: [{where: {set: start}, %s}]\n",
			 method, drive);
}

static void set_sine(JnInput* input, double t) {
	const double x[3] = {0.01 * sin(2 * pi * t), 0, 0}, v[3] = {0.01 * 2 * pi * cos(2 * pi * t), 0, 0};
	jn_input_set(input, x, v);
}

// The cubics differ from the sine by dt^4/384 of its fourth derivative, 16 um/s^4 ... 4e-14 m, of any method's stages.
static void an_input_that_follows_a_motion_moves_as_that_motion_does(void** state) {
	(void)state;
	static const char* const methods[] = {"symplectic_euler", "rk4", "verlet", "sdirk2", "esdirk436", "newmark"};
	for (int m = 0; m < 6; ++m) {
		Run run, other;
		open_thread(&run, methods[m], "input: hand");
		open_thread(&other, methods[m], "x: {type: sine, amplitude: 1 cm, frequency: 1 Hz}");
		JnInput* input = jn_sim_input(run.sim, "hand");
		assert_non_null(input);
		set_sine(input, 0); // the velocity at the start is that of an input that stands still
		for (int i = 1; i <= 200; ++i) {
			set_sine(input, i * dt);
			run_step(&run);
			run_step(&other);
		}
		double worst = 0;
		for (int k = 0; k < run.length; ++k) worst = fmax(worst, fabs(run_state(&run)->x[k] - run_state(&other)->x[k]));
		expect_at_most(worst, 1e-5, "%s: difference", methods[m]); // it begins with a kick of 6 cm/s over a step less
		run_close(&run);
		run_close(&other);
	}
}

static JnInput make_input(void) {
	return (JnInput){.name = "hand"};
}

static void a_motion_has_both_ends_and_is_smooth_between_settings(void** state) {
	(void)state;
	JnInput input = make_input();
	JnMotionValue before[3], behind[3];
	const double x[3][3] = {{1, 2, 3}, {2, 0, -1}, {-1, 1, 0}}, v[3][3] = {{10, 0, 5}, {-3, 2, 1}, {0, 0, 0}};
	for (int i = 0; i < 3; ++i) {
		const double t = 0.1 * i;
		jn_input_set(&input, x[i], v[i]);
		jn_input_at(&input, t, before);
		jn_input_begin(&input, t, 0.1);
		jn_input_at(&input, t, behind);
		for (int a = 0; a < 3; ++a) {
			expect_near(behind[a].x, before[a].x, 1e-14, "position at setting %d", i);
			expect_near(behind[a].v, before[a].v, 1e-12, "velocity at setting %d", i);
		}
		jn_input_at(&input, t + 0.1, behind);
		for (int a = 0; a < 3; ++a) {
			expect_near(behind[a].x, x[i][a], 1e-14, "position at the end of step %d", i);
			expect_near(behind[a].v, v[i][a], 1e-12, "velocity at the end of step %d", i);
		}
	}
}

static void velocity_and_acceleration_are_derivatives(void** state) {
	(void)state;
	JnInput input = make_input();
	const double x[2][3] = {{0.1, 0, 0}, {0.2, -0.1, 0.3}}, v[3] = {1, 2, -1}, h = 1e-6;
	jn_input_set(&input, x[0], v);
	jn_input_begin(&input, 0, 0.1);
	jn_input_set(&input, x[1], NULL);
	jn_input_begin(&input, 0.1, 0.1);
	for (double t = 0.103; t < 0.2; t += 0.0137) {
		JnMotionValue a[3], b[3], c[3];
		jn_input_at(&input, t - h, a);
		jn_input_at(&input, t, b);
		jn_input_at(&input, t + h, c);
		for (int k = 0; k < 3; ++k) {
			expect_near((c[k].x - a[k].x) / (2 * h), b[k].v, 1e-7, "velocity");     // third derivatives of 1e3: 2e-10
			expect_near((c[k].v - a[k].v) / (2 * h), b[k].a, 1e-7, "acceleration"); // linear: rounding alone
		}
	}
	JnMotionValue end[3];
	jn_input_at(&input, 0.2, end);
	expect_near(end[0].v, 1, 1e-12, "mean velocity where none is given");
}

static void an_input_that_is_not_set_stands_still(void** state) {
	(void)state;
	Run run;
	open_thread(&run, "symplectic_euler", "input: hand");
	JnInput* input = jn_sim_input(run.sim, "hand");
	jn_input_set(input, (double[3]){0.01, 0.02, 0.03}, (double[3]){1, 1, 1});
	run_steps(&run, 3);
	const double* rest = jn_model_rest(run.model);
	for (int k = 0; k < 9; ++k) {
		expect_near(run_state(&run)->x[k] - rest[k], 0.01 * (k % 3 + 1), 1e-15, "place");
		expect_near(run_state(&run)->v[k], 0, 1e-15, "velocity");
	}
	run_close(&run);
}

// At rest, the hand carries the whole weight.
static void the_force_on_a_hand_that_holds_still_is_the_weight(void** state) {
	(void)state;
	Run run;
	double force[3];
	open_thread(&run, "backward_euler", "input: hand");
	JnInput* input = jn_sim_input(run.sim, "hand");
	run_steps(&run, 4000);
	assert_int_equal(jn_sim_input_force(run.sim, input, force), JN_OK);
	const double weight = 9.81 * jn_model_mass(run.model);
	// what still creeps after 4 s: slow modes are overdamped
	expect_near(force[1], -weight, 1e-5 * weight, "weight");
	expect_near(force[0], 0, 1e-5 * weight, "across");
	expect_near(force[2], 0, 1e-5 * weight, "across");
	run_close(&run);
}

static void nodes_of_several_entries_and_bodies_share_an_input_by_name(void** state) {
	(void)state;
	Run run;
	static const char body[] =
		"shape: {type: box, size: [0.1, 0.1, 0.1], cells: [1, 1, 2]}, material: {law: linear, density: "
		"1000, young: 1e5, poisson: 0.3}";
	run_open(&run, 1,
			 "duration: 1 s\nintegrator: {method: backward_euler}\nstep: {dt: 1 ms}\nbodies:\n"
			 "  - {name: a, %s, drive: [{where: {face: z-}, input: left}, {where: {face: z+}, input: right}]}\n"
			 "  - {name: b, %s, drive: [{where: {face: z-}, input: left}]}\n",
			 body, body);
	assert_int_equal(run.model->input_count, 2);
	assert_int_equal(jn_sim_input(run.sim, "left")->count, 24);
	assert_int_equal(jn_sim_input(run.sim, "right")->count, 12);
	assert_null(jn_sim_input(run.sim, "middle"));
	run_close(&run);
}

// Also with a needle that runs along a curve, damping by products, and forces read back.
static void steps_with_inputs_allocate_nothing(void** state) {
	(void)state;
	static const char* const methods[] = {"symplectic_euler", "verlet", "rk4"};
	for (int m = 0; m < 3; ++m) {
		Run run;
		double force[3];
		run_open(&run, 1,
				 "duration: 10 s\ngravity: [0, -9.81, 0]\nintegrator: {method: %s}\nstep: {dt: 0.1 ms}\nbodies:\n"
				 "  - shape: {type: thread, points: [{at: [0, 0, 0]}, {at: [0, -0.2, 0]}], radius: 4 mm, links: 20, "
				 "needle: 3}\n"
				 "    material: {law: constraints, density: 1000 kg/m^3, stiffness: 5 kPa}\n    mass: lumped\n"
				 "    damping: {beta: 0.1 ms}\n    drive:\n      - {where: {set: end}, input: hand}\n"
				 "      - {where: {set: needle}, along: {curve: {type: helix, radius: 5 cm, pitch: 5 cm, turns: 2}, "
				 "head: {type: "
				 "keyframes, points: [[0, 0], [1, 0.2]]}}}\n",
				 methods[m]);
		JnInput* input = jn_sim_input(run.sim, "hand");
		run_steps(&run, 5);
		allocations = 0;
		for (int i = 0; i < 50; ++i) {
			counting = true;
			jn_input_set(input, (double[3]){1e-5 * i, 0, 0}, NULL);
			const JnStatus status = jn_sim_step(run.sim);
			const JnStatus read = jn_sim_input_force(run.sim, input, force);
			counting = false;
			assert_int_equal(status, JN_OK);
			assert_int_equal(read, JN_OK);
		}
		assert_int_equal(allocations, 0);
		run_close(&run);
	}
	void* volatile probe;
	counting = true;
	probe = malloc(100);
	counting = false;
	assert_true(allocations == COUNTS); // they are seen
	free(probe);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(an_input_that_follows_a_motion_moves_as_that_motion_does),
		cmocka_unit_test(a_motion_has_both_ends_and_is_smooth_between_settings),
		cmocka_unit_test(velocity_and_acceleration_are_derivatives),
		cmocka_unit_test(an_input_that_is_not_set_stands_still),
		cmocka_unit_test(the_force_on_a_hand_that_holds_still_is_the_weight),
		cmocka_unit_test(nodes_of_several_entries_and_bodies_share_an_input_by_name),
		cmocka_unit_test(steps_with_inputs_allocate_nothing),
	};
	return cmocka_run_group_tests(tests, case_set_up, case_tear_down);
}
