/// @file diagnosis_test.c
/// Runs that fail say why, where and what helps; what they advise is tried. Nothing that is not finite reaches a file.
#include <hdf5.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "jounce/scene.h"
#include "support/support.h"

enum { MOST_SETS = 8 };

/// What became of a run.
typedef struct Run {
	JnStatus status;
	JnRunResult result;
} Run;

static char folder[256];

static int set_up(void** state) {
	(void)state;
	return folder_create(folder);
}

static int tear_down(void** state) {
	(void)state;
	folder_remove(folder);
	return 0;
}

#define SIMULATE(text, ...) simulate(text, (const char* const[]){__VA_ARGS__, NULL})

/// Run a scene with overrides; its files are in `folder`, its messages in log_text().
static Run simulate(const char* text, const char* const sets[]) {
	JnScene* scene = NULL;
	int count = 0;
	while (sets[count] != NULL) ++count;
	file_write(path_join(folder, "scene.yaml"), text);
	log_capture();
	Run run = {.status = jn_scene_load(path_join(folder, "scene.yaml"), count, sets, &scene)};
	const JnRunOptions options = {.directory = folder, .threads = 1};
	if (run.status == JN_OK) run.status = jn_scene_run(scene, &options, &run.result);
	jn_scene_destroy(scene);
	log_release();
	return run;
}

static void expect_success(Run run, double duration) {
	if (run.status != JN_OK) fail_msg("%s: %s", jn_status_name(run.status), log_text());
	if (log_text()[0] != '\0') fail_msg("a run that should be silent says: %s", log_text());
	assert_true(fabs(run.result.t - duration) <= 1e-9 * duration); // steps are summed up
}

/// The number behind the first `label` of the messages.
static double number_after(const char* label) {
	const char* found = strstr(log_text(), label);
	if (found == NULL) fail_msg("'%s' is not in: %s", label, log_text());
	return strtod(found + strlen(label), NULL);
}

static void expect_finite_series(void) {
	Table table = table_read(path_join(folder, "series.csv"));
	assert_true(table.rows > 1);
	for (int row = 1; row < table.rows; ++row)
		for (int column = 0; column < table.columns; ++column)
			if (!isfinite(strtod(table.cells[row][column], NULL)))
				fail_msg("%s is %s in row %d", table.cells[0][column], table.cells[row][column], row);
	table_free(&table);
}

static int hdf5_count(hid_t file) {
	long count = 0;
	const hid_t attribute = H5Aopen_by_name(file, "/frames", "count", H5P_DEFAULT, H5P_DEFAULT);
	assert_true(H5Aread(attribute, H5T_NATIVE_LONG, &count) >= 0);
	H5Aclose(attribute);
	return (int)count;
}

static double frame_time(hid_t file, int frame) {
	char name[64];
	double time = NAN;
	snprintf(name, sizeof name, "/frames/%08d", frame);
	const hid_t attribute = H5Aopen_by_name(file, name, "time", H5P_DEFAULT, H5P_DEFAULT);
	assert_true(H5Aread(attribute, H5T_NATIVE_DOUBLE, &time) >= 0);
	H5Aclose(attribute);
	return time;
}

static void expect_finite_frame(hid_t file, int frame, const char* what) {
	char name[64];
	snprintf(name, sizeof name, "/frames/%08d/%s", frame, what);
	const hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT), space = H5Dget_space(dataset);
	const size_t count = (size_t)H5Sget_simple_extent_npoints(space);
	double* numbers = calloc(count, sizeof *numbers);
	assert_true(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers) >= 0);
	for (size_t k = 0; k < count; ++k)
		if (!isfinite(numbers[k])) fail_msg("%s: number %zu is %g", name, k, numbers[k]);
	free(numbers);
	H5Sclose(space);
	H5Dclose(dataset);
}

/// The run has failed; its files hold finite numbers alone, up to its last state, and the words of its last message.
static void expect_failure(Run run) {
	if (run.status != JN_RUN_FAILED) fail_msg("ended with '%s': %s", jn_status_name(run.status), log_text());
	expect_finite_series();
	const hid_t file = H5Fopen(path_join(folder, "run.h5"), H5F_ACC_RDONLY, H5P_DEFAULT);
	const int last = hdf5_count(file) - 1;
	assert_true(frame_time(file, last) == run.result.t);
	for (int frame = 0; frame <= last; ++frame) {
		expect_finite_frame(file, frame, "position");
		expect_finite_frame(file, frame, "velocity");
	}
	H5Fclose(file);
	char* summary = file_read(path_join(folder, "summary.json"));
	if (strstr(summary, "\"outcome\": \"failed\"") == NULL || strstr(summary, " failed: ") == NULL ||
		strstr(summary, ". Try ") == NULL)
		fail_msg("the summary does not say what failed: %s", summary);
	free(summary);
}

// ---- steps that are too large

// The thread of a surgeon (E = 750 MPa, 10 cm by 0.4 mm), of which others say that 10 ns a step is needed.
static const char suture[] = "duration: 1 ms\ngravity: [0, -9.81, 0]\nintegrator: {method: symplectic_euler}\n"
							 "step: {controller: fixed, dt: 10 us}\nrecord: {plots: no}\nbodies:\n"
							 "  - name: thread\n"
							 "    shape: {type: thread, points: [{at: [0, 0, 0]}, {at: [0.1, 0, 0]}], radius: 0.2 mm, "
							 "links: 20}\n"
							 "    material: {law: rod, density: 1300 kg/m^3, young: 750 MPa, poisson: 0.4}\n"
							 "    mass: lumped\n    fix: [{where: {face: x-}}]\n";

static void a_stiff_thread_at_a_large_explicit_step_names_step_and_limit(void** state) {
	(void)state;
	const Run run = SIMULATE(suture, "duration=1ms");
	expect_failure(run);
	log_expect("steps of 1e-05 s are above the limit of stability of symplectic_euler");
	log_expect("of 'thread' at (");
	// The sound needs L sqrt(rho / E) = 6.6 us for a link; the diagonals of the links are stiffer, and the frames lighter.
	const double limit = number_after("/ omega = "), omega = number_after("where omega = ");
	assert_true(limit > 1e-6 && limit < 6.6e-6);
	assert_true(fabs(limit * omega - 2) < 0.02); // three digits of each
}

static void its_advice_works(void** state) {
	(void)state;
	char dt[64];
	SIMULATE(suture, "duration=1ms");
	snprintf(dt, sizeof dt, "step.dt=%g s", number_after("Try step.dt = "));
	expect_success(SIMULATE(suture, dt), 1e-3);
	expect_success(SIMULATE(suture, "step={controller: stable}"), 1e-3);
	expect_success(SIMULATE(suture, "integrator.method=sdirk2"), 1e-3);
}

static const char block[] = "duration: 0.2 s\ngravity: [0, 0, -9.81]\nintegrator: {method: sdirk2}\n"
							"step: {controller: fixed, dt: 10 ms}\nrecord: {plots: no}\nbodies:\n"
							"  - name: block\n    shape: {type: box, size: [1, 1, 1], cells: [2, 2, 2]}\n"
							"    material: {law: neo_hookean, density: 1000, young: 1e5, poisson: 0.3}\n"
							"    fix: [{where: {face: z-}}]\n";

// Euler's method gains energy in every step; the advice names another.
static void a_method_that_no_step_makes_stable_is_named(void** state) {
	(void)state;
	char dt[64];
	expect_failure(SIMULATE(block, "integrator.method=explicit_euler", "bodies[0].mass=lumped", "duration=10s"));
	log_expect("no step of explicit_euler is stable without damping");
	snprintf(dt, sizeof dt, "step.dt=%g s", number_after("Try integrator.method: verlet with step.dt = "));
	expect_success(SIMULATE(block, "integrator.method=verlet", "bodies[0].mass=lumped", dt), 0.2);
}

// omega is some 100 1/s, so that the damping ratio is in the hundreds: stability ends near omega dt = 1 / ratio.
static void a_step_too_large_for_strong_damping_names_one_that_works(void** state) {
	(void)state;
	static const char thick[] = "bodies[0].damping={beta: 10 s}", method[] = "integrator.method=symplectic_euler";
	char dt[64];
	expect_failure(SIMULATE(block, method, "bodies[0].mass=lumped", thick));
	log_expect("are above the limit of stability of symplectic_euler");
	const double found = number_after("Try step.dt = ");
	assert_true(found > 0);
	snprintf(dt, sizeof dt, "step.dt=%g s", found);
	expect_success(SIMULATE(block, method, "bodies[0].mass=lumped", thick, dt, "duration=10ms"), 0.01);
}

static int spring(void* user, double t, const double* x, const double* v, double* f) {
	(void)t, (void)v;
	f[0] = -*(const double*)user * x[0];
	return 0;
}

// A system of the user's own has no watch over its energy: it fails where its numbers end, and the cut step must not go on
// from there. omega = 100: the limit of verlet is 20 ms.
static void a_system_of_ones_own_that_blows_up_names_its_limit(void** state) {
	(void)state;
	double k = 1e4;
	const double x = 1, v = 0;
	JnSystem* sys = NULL;
	JnSim* sim = NULL;
	assert_int_equal(jn_user_system_create(&(JnUserSystemDef){.count = 1, .user = &k, .force = spring}, &sys), JN_OK);
	assert_int_equal(
		jn_sim_create_for(sys, "{duration: 1000 s, integrator: {method: verlet}, step: {dt: 30 ms}}", &x, &v, &sim),
		JN_OK);
	log_capture();
	JnStatus status = JN_OK;
	while (status == JN_OK && !jn_sim_is_done(sim)) status = jn_sim_step(sim);
	log_release();
	assert_int_equal(status, JN_RUN_FAILED);
	assert_true(isfinite(jn_sim_state(sim)->x[0]) && isfinite(jn_sim_state(sim)->v[0]));
	log_expect("steps of 0.03 s are above the limit of stability of verlet, 2 / omega = 0.02 s, where omega = 100 1/s");
	log_expect("at coordinate 0");
	jn_sim_destroy(sim);
	jn_user_system_destroy(sys);
}

// ---- hard states

// The top of the block is pushed down by almost half of its height within 0.2 s, which a step of 0.4 s cannot follow.
static void a_motion_that_is_too_fast_is_named_and_a_smaller_step_or_a_slower_one_works(void** state) {
	(void)state;
	static const char fast[] =
		"bodies[0].drive=[{where: {face: z+}, z: {type: keyframes, points: [[0, 0], [0.2, -0.45]]}}]",
					  slow[] =
						  "bodies[0].drive=[{where: {face: z+}, z: {type: keyframes, points: [[0, 0], [2, -0.45]]}}]";
	char dt[64];
	expect_failure(SIMULATE(block, fast, "step={dt: 0.4 s, cuts: 0}", "duration=0.4s"));
	log_expect("moves a node by 0.45 m within the step, and the shortest edge there is 0.5 m, at node ");
	log_expect("Try a slower motion (drive), or a smaller step.dt, such as ");
	snprintf(dt, sizeof dt, "step={dt: %g s, cuts: 0}", number_after("a smaller step.dt, such as "));
	expect_success(SIMULATE(block, fast, dt, "duration=0.4s"), 0.4);
	expect_success(SIMULATE(block, slow, "step={dt: 0.4 s, cuts: 0}", "duration=2s"), 2);
}

static void an_inverted_element_is_named_and_a_law_that_knows_such_works(void** state) {
	(void)state;
	const char* fast = "bodies[0].velocity=[0, 0, -40]";
	expect_failure(SIMULATE(block, fast, "integrator.method=verlet", "bodies[0].mass=lumped", "step.cuts=0"));
	log_expect("an element turns inside out (volume ratio -0.");
	log_expect("at cell 0 of 'block' at (");
	log_expect("Try material.law: stable_neo_hookean");
	expect_success(SIMULATE(block, fast, "integrator.method=verlet", "bodies[0].mass=lumped",
							"step={dt: 1 ms, cuts: 0}", "bodies[0].material.law=stable_neo_hookean"),
				   0.2);
}

// A method of one linear solve goes through to the other side, where neo-Hookean energies are not defined.
static void a_state_without_finite_energy_ends_the_run_and_reaches_no_file(void** state) {
	(void)state;
	expect_failure(
		SIMULATE(block, "bodies[0].velocity=[0, 0, -40]", "integrator.method=linearized_newmark", "step.cuts=2"));
	log_expect("it leaves no finite energy; not finite: an element is inside out (volume ratio -0.");
}

static void a_stage_that_does_not_converge_names_residual_and_node(void** state) {
	(void)state;
	const char *law = "bodies[0].material.law=stable_neo_hookean", *fast = "bodies[0].velocity=[0, 0, -5]";
	expect_failure(SIMULATE(block, law, fast, "newton={mode: root, max_iterations: 2}", "step={dt: 50 ms, cuts: 0}"));
	log_expect("not converged: a residual of ");
	log_expect("above newton.tolerance, 1e-08, at node ");
	log_expect("Try newton: {mode: auto, max_iterations: 200}");
	expect_success(SIMULATE(block, law, fast, "newton={mode: auto, max_iterations: 200}", "step={dt: 50 ms, cuts: 0}"),
				   0.2);
}

static void a_refused_error_names_its_tolerance_and_its_node(void** state) {
	(void)state;
	expect_failure(SIMULATE(block, "step={controller: force_error, dt_min: 5 ms, tolerance: 1e-9 m, dt: 10 ms}"));
	log_expect(" is above step.tolerance, 1e-09 m, at node ");
	log_expect("the smallest step allowed (step.dt_min = 0.005 s)");
	expect_success(SIMULATE(block, "step={controller: force_error, dt_min: 1 us, tolerance: 1e-6 m, dt: 10 ms}"), 0.2);
}

// ---- contact and collision

// A block is thrown onto another, across its edge.
static const char thrown[] =
	"duration: 0.1 s\ngravity: [0, -9.81, 0]\nintegrator: {method: sdirk2}\n"
	"step: {controller: fixed, dt: 0.1 s, cuts: 0}\nrecord: {plots: no}\ncontact: {friction: 0.3}\nbodies:\n"
	"  - name: above\n    shape: {type: box, size: [1, 1, 1], cells: [2, 2, 2]}\n"
	"    material: {law: stable_neo_hookean, density: 1000, young: 1e4, poisson: 0.3}\n"
	"    velocity: [0, -20, 0]\n    spin: [0, 0, 50]\n"
	"  - name: below\n    shape: {type: box, size: [1, 1, 1], cells: [2, 2, 2], origin: [0.3, -1.05, 0.2]}\n"
	"    material: {law: stable_neo_hookean, density: 1000, young: 1e4, poisson: 0.3}\n";

static void a_contact_that_would_pass_through_names_bodies_depth_and_margin(void** state) {
	(void)state;
	char step[64];
	expect_failure(SIMULATE(thrown, "duration=0.1s"));
	log_expect("not converged in contact of '");
	log_expect("more than the margin of ");
	// a twentieth of the mean edge of the surface: edges of 0.5 m and, across squares, 0.707 m
	const double depth = number_after("which it would enter by "), margin = number_after("more than the margin of ");
	assert_true(depth > margin && margin > 0.5 / 20 && margin < 0.707 / 20);
	snprintf(step, sizeof step, "step={dt: %g s, cuts: 0}", number_after("Try steps of about "));
	expect_success(SIMULATE(thrown, step), 0.1);
	expect_success(SIMULATE(thrown, "step={dt: 0.1 s, cuts: 10}"), 0.1);
}

// The splitting needs some hundred iterations.
static void impulses_that_are_not_found_name_residual_and_tolerance(void** state) {
	(void)state;
	static const char few[] = "contact.solver={method: admm, max_iterations: 3}";
	expect_failure(SIMULATE(thrown, "step={dt: 2 ms, cuts: 0}", few));
	log_expect("not converged in contact of '");
	assert_true(number_after("where a relative residual of ") > number_after("above contact.solver.tolerance, "));
	assert_true(number_after("above contact.solver.tolerance, ") == 1e-7);
	log_expect("Try contact.solver: {method: auto, max_iterations: 2000, tolerance: 1e-07}, a smaller step.dt");
	expect_success(SIMULATE(thrown, "step={dt: 2 ms, cuts: 0}",
							"contact.solver={method: auto, max_iterations: 2000, tolerance: 1e-07}"),
				   0.1);
}

// A stack of threads, a diameter apart, which all begin to fall onto the lowest, the upper ones faster.
#define FALLING(name, height, speed)                                                                                   \
	"  - name: " name "\n    shape: {type: thread, points: [{at: [0, " height " mm, 0]}, {at: [0.1, " height           \
	" mm, 0]}], radius: 2 mm, links: 10}\n"                                                                            \
	"    material: {law: rod, density: 1000, young: 2e5, damping: 0.02 ms}\n    mass: lumped\n"                        \
	"    velocity: [0, -" speed ", 0]\n"

static const char heap[] =
	"duration: 5 ms\ngravity: [0, -9.81, 0]\nintegrator: {method: symplectic_euler}\n"
	"step: {controller: fixed, dt: 0.5 ms, cuts: 0}\nrecord: {plots: no}\ncollision: {iterations: 1}\n"
	"obstacles: [{name: floor, shape: plane}]\nbodies:\n" FALLING("first", "2.01", "0") FALLING("second", "6.01", "5")
		FALLING("third", "10.01", "10");

static void sweeps_that_leave_an_overlap_name_it_and_the_radius(void** state) {
	(void)state;
	char step[64], sweeps[64];
	expect_failure(SIMULATE(heap, "duration=5ms"));
	log_expect("not converged in collision, where sweeps leave ");
	log_expect("more than 0.5 radii, 0.001 m");
	assert_true(number_after("where sweeps leave ") > 1e-3);
	snprintf(sweeps, sizeof sweeps, "collision.iterations=%g", number_after("Try collision.iterations: "));
	snprintf(step, sizeof step, "step={dt: %g s, cuts: 0}", number_after("steps of about "));
	expect_success(SIMULATE(heap, sweeps, step), 5e-3);
}

static void a_thread_that_flies_off_names_how_far_and_its_length(void** state) {
	(void)state;
	char step[64];
	static const char fast[] = "bodies[2].velocity=[0, 1e5, 0]"; // 50 m in 0.5 ms
	expect_failure(SIMULATE(heap, fast));
	log_expect(
		"where something moves by 50 m within the step, more than 100 times the length of the shortest thread, 0.1 m");
	snprintf(step, sizeof step, "step={dt: %g s, cuts: 0}", number_after("Try steps of about "));
	expect_success(SIMULATE(heap, fast, step, "duration=1e-5s", "collision.iterations=100"), 1e-5);
}

// ---- matrices

// A free block as hard as nothing is: what holds it together is 1e16 times what moves it, beyond the digits of numbers.
static void an_indefinite_matrix_names_the_frequency_and_the_step(void** state) {
	(void)state;
	char step[64];
	static const char free_block[] =
		"duration: 1 s\ngravity: [0, 0, -9.81]\nintegrator: {method: linearized_euler}\n"
		"step: {controller: fixed, dt: 1 s, cuts: 0}\nrecord: {plots: no}\nbodies:\n"
		"  - name: block\n    shape: {type: box, size: [1, 1, 1], cells: [2, 2, 2]}\n"
		"    material: {law: stable_neo_hookean, density: 1000, young: 1e18, poisson: 0.3}\n";
	expect_failure(SIMULATE(free_block, "duration=1s"));
	log_expect("indefinite matrix: M + dt D + dt^2 K of the step is not positive definite");
	log_expect("of 'block' at (");
	const double omega = number_after("where omega = "), square = number_after("(omega dt)^2 = ");
	assert_true(fabs(square - omega * omega) < 0.06 * square); // dt = 1 s; two digits of the square, three of omega
	// waves of pressure have c = sqrt(1.346 E / rho) = 3.67e7 m/s: 2 c / h of lumped masses in a row of cells of h = 0.5 m,
	// sqrt(3) times that of consistent ones, and again in three dimensions
	assert_true(omega > 1.4e8 && omega < 4.5e8);
	snprintf(step, sizeof step, "step={dt: %g s, cuts: 0}", number_after("Try steps of "));
	expect_success(SIMULATE(free_block, step, "duration=0.1s"), 0.1);
	expect_success(SIMULATE(free_block, "integrator.method=backward_euler"), 1);
}

// ---- energy

// Newmark's average acceleration keeps no energy of large strains: at this step it gains more than there was.
static void a_gain_of_energy_warns_once_and_names_the_body(void** state) {
	(void)state;
	const char* const sets[] = {"integrator.method=newmark", "bodies[0].material.law=st_venant_kirchhoff",
								"bodies[0].velocity=[0, 0, -20]", "duration=0.5s", NULL};
	const Run run = simulate(block, sets);
	assert_int_equal(run.status, JN_OK);
	const char* first = strstr(log_text(), "J from nowhere");
	assert_non_null(first);
	assert_null(strstr(first + 1, "J from nowhere"));
	log_expect("most in 'block' (");
}

static void the_watch_can_be_turned_off(void** state) {
	(void)state;
	const Run run = SIMULATE(block, "integrator.method=newmark", "bodies[0].material.law=st_venant_kirchhoff",
							 "bodies[0].velocity=[0, 0, -20]", "duration=0.5s", "watch.energy=0");
	expect_success(run, 0.5);
}

// What the drive gives is no gain: the block starts at rest, without weight, and is shaken.
static void work_of_driven_nodes_is_no_gain(void** state) {
	(void)state;
	expect_success(SIMULATE(block, "gravity=[0, 0, 0]", "duration=1s", "bodies[0].material.law=stable_neo_hookean",
							"bodies[0].drive=[{where: {face: z+}, x: {type: sine, amplitude: 0.1, frequency: 3 Hz}}]"),
				   1);
}

static void work_of_the_wind_is_no_gain(void** state) {
	(void)state;
	expect_success(SIMULATE(block, "gravity=[0, 0, 0]", "duration=1s", "wind={velocity: [30, 0, 0]}",
							"bodies[0].drag=1.5", "bodies[0].material.law=stable_neo_hookean"),
				   1);
}

// ---- what users of other programs have met

static void a_body_without_mass_is_bad_input(void** state) {
	(void)state;
	assert_int_equal(SIMULATE(block, "bodies[0].material.density=0").status, JN_BAD_INPUT);
	log_expect("density");
}

// The same block a thousand times smaller, and a thousand times faster for it, moves alike.
static void a_body_scaled_down_moves_as_the_large_one(void** state) {
	(void)state;
	const Run large = SIMULATE(block, "gravity=[0, 0, -9.81]");
	expect_success(large, 0.2);
	const Run small = SIMULATE(block, "bodies[0].shape.size=[1 mm, 1 mm, 1 mm]", "gravity=[0, 0, -9810]",
							   "duration=0.2 ms", "step.dt=10 us");
	expect_success(small, 0.2e-3);
	assert_int_equal(small.result.steps, large.result.steps);
	// energies a mass are those of speeds, which are the same
	const double error = large.result.specific_error;
	assert_true(fabs(small.result.specific_error - error) <= 1e-6 * error); // Newton's tolerance
}

// A helix in free fall stays what it is.
static void a_helix_in_free_fall_keeps_its_energy(void** state) {
	(void)state;
	static const char helix[] =
		"duration: 1 s\ngravity: [0, -9.81, 0]\nintegrator: {method: verlet}\nstep: {controller: stable}\n"
		"record: {plots: no}\nbodies:\n  - name: helix\n"
		"    shape: {type: thread, curve: {type: helix, radius: 5 cm, pitch: 2 cm, turns: 3}, radius: 4 mm, links: "
		"60}\n"
		"    material: {law: constraints, density: 1000 kg/m^3, stiffness: 15 kPa}\n    mass: lumped\n";
	const Run run = SIMULATE(helix, "duration=1s");
	expect_success(run, 1);
	assert_true(run.result.specific_error < 1e-6 * 0.5 * 9.81 * 9.81); // of the kinetic energy at the end: rounding
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_stiff_thread_at_a_large_explicit_step_names_step_and_limit),
		cmocka_unit_test(its_advice_works),
		cmocka_unit_test(a_method_that_no_step_makes_stable_is_named),
		cmocka_unit_test(a_step_too_large_for_strong_damping_names_one_that_works),
		cmocka_unit_test(a_system_of_ones_own_that_blows_up_names_its_limit),
		cmocka_unit_test(a_motion_that_is_too_fast_is_named_and_a_smaller_step_or_a_slower_one_works),
		cmocka_unit_test(an_inverted_element_is_named_and_a_law_that_knows_such_works),
		cmocka_unit_test(a_state_without_finite_energy_ends_the_run_and_reaches_no_file),
		cmocka_unit_test(a_stage_that_does_not_converge_names_residual_and_node),
		cmocka_unit_test(a_refused_error_names_its_tolerance_and_its_node),
		cmocka_unit_test(a_contact_that_would_pass_through_names_bodies_depth_and_margin),
		cmocka_unit_test(impulses_that_are_not_found_name_residual_and_tolerance),
		cmocka_unit_test(sweeps_that_leave_an_overlap_name_it_and_the_radius),
		cmocka_unit_test(a_thread_that_flies_off_names_how_far_and_its_length),
		cmocka_unit_test(an_indefinite_matrix_names_the_frequency_and_the_step),
		cmocka_unit_test(a_gain_of_energy_warns_once_and_names_the_body),
		cmocka_unit_test(the_watch_can_be_turned_off),
		cmocka_unit_test(work_of_driven_nodes_is_no_gain),
		cmocka_unit_test(work_of_the_wind_is_no_gain),
		cmocka_unit_test(a_body_without_mass_is_bad_input),
		cmocka_unit_test(a_body_scaled_down_moves_as_the_large_one),
		cmocka_unit_test(a_helix_in_free_fall_keeps_its_energy),
	};
	return cmocka_run_group_tests(tests, set_up, tear_down);
}
