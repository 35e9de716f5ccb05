/// @file suture_test.c
/// Sites where a thread goes through a body: how they rub, what they hold, that both feel it, and when they come and go.
#include "pass/collision_case.h"
#include "pass/suture.h"

// A straight thread flies through a slab along its own axis, 12 cm long, with 5 cm/s or as given.
static void open_flight(Run* run, const char* method, const char* slab, const char* suture, double speed) {
	run_open(run, 1,
			 "duration: 10 s\ngravity: [0, 0, 0]\nintegrator: {method: %s}\nstep: {dt: 50 us}\n"
			 "bodies:\n"
			 "  - {name: thread, shape: {type: thread, radius: 1 mm, links: 30, points: [{at: [0.001, 0.002, 0.002]}, "
			 "{at: [0.001, 0.122, 0.002]}]}, velocity: [0, %.17g, 0], " SOFT_ROD "}\n"
			 "  - {name: slab, shape: {type: box, origin: [-0.02, -0.01, -0.02], size: [0.04, 0.01, 0.04], cells: [4, "
			 "1, 4], "
			 "element: tet4}, material: {law: stable_neo_hookean, density: 1000, young: 5e3, poisson: 0.3}, mass: "
			 "lumped%s}\n"
			 "collision: {}\nsuture: {thread: thread, body: slab%s}\n",
			 method, -speed, slab, suture);
}

static double sites_of(const Run* run) {
	return pass_column(run_pass_of(run, &jn_pass_suture), "suture_sites");
}

static double drawn_of(const Run* run) {
	return pass_column(run_pass_of(run, &jn_pass_suture), "suture_drawn");
}

static double speed_of(const Run* run) {
	return -body_momentum(run, 0, 1) / body_mass(run, 0);
}

// In at the top, out at the bottom, and both gone when the end has passed; without friction nothing slows it.
static void a_thread_that_flies_through_makes_and_leaves_two_sites(void** state) {
	(void)state;
	Run run;
	open_flight(&run, "symplectic_euler", ", fix: [{where: {face: all}}]", "", 1);
	static const struct {
		double t;
		int sites;
	} expected[] = {{0.0015, 0}, {0.0025, 1}, {0.0115, 1}, {0.0125, 2},
					{0.1215, 2}, {0.1225, 1}, {0.1315, 1}, {0.1325, 0}};
	for (int i = 0; i < 8; ++i) {
		run_until(&run, expected[i].t);
		expect_near(sites_of(&run), expected[i].sites, 0, "sites at %g s", expected[i].t);
		if (expected[i].sites > 0 && expected[i].t < 0.12) // a link is 4 mm, a step 0.05 mm
			expect_near(drawn_of(&run), expected[i].t - 0.002, 1e-4, "length drawn through [m]");
	}
	expect_near(speed_of(&run), 1, 1e-9, "speed [m/s]"); // rounding of 2650 steps
	run_close(&run);
}

// Each site takes its constant hold from the thread: m dv = -F t, whatever waves run along it. Rounding, and what sweeps leave.
static void constant_friction_slows_a_thread_by_the_hold_of_each_site(void** state) {
	(void)state;
	static const char* const methods[] = {"symplectic_euler", "verlet", "backward_euler"};
	for (int m = 0; m < 3; ++m) {
		Run run;
		open_flight(&run, methods[m], ", fix: [{where: {face: all}}]", ", hold: 2 mN", 1);
		run_until(&run, 0.02);
		assert_true(sites_of(&run) == 2);
		const double from = speed_of(&run), t = run_state(&run)->t, mass = body_mass(&run, 0);
		run_until(&run, 0.07);
		const double slowed = from - speed_of(&run), expected = 2 * 2e-3 * (run_state(&run)->t - t) / mass;
		run_close(&run);
		expect_near(slowed, expected, 1e-6 * expected, "%s: loss of speed [m/s]", methods[m]);
	}
}

// What is saved while a thread is sewn in knows its sites: the restored run goes on with the same bits, until both are gone.
static void a_suture_that_was_saved_goes_on_bit_for_bit(void** state) {
	(void)state;
	static const char fixed[] = ", fix: [{where: {face: all}}]", hold[] = ", hold: 2 mN, friction: 0.1";
	Run saved, restored;
	JnArchive archive = {0};
	open_flight(&saved, "symplectic_euler", fixed, hold, 1);
	open_flight(&restored, "symplectic_euler", fixed, hold, 1);
	run_until(&saved, 0.02);
	assert_true(sites_of(&saved) == 2);
	assert_int_equal(jn_sim_save(saved.sim, &archive), JN_OK);
	JnArchive reader = jn_archive_reader(archive.bytes, archive.size);
	assert_int_equal(jn_sim_restore(restored.sim, &reader), JN_OK);
	jn_archive_free(&archive);
	assert_true(sites_of(&restored) == 2);
	for (double t = 0.02; t < 0.14; t += 0.02) {
		run_until(&saved, t);
		run_until(&restored, t);
		assert_memory_equal(run_state(&saved)->x, run_state(&restored)->x, (size_t)saved.length * sizeof(double));
		assert_memory_equal(run_state(&saved)->v, run_state(&restored)->v, (size_t)saved.length * sizeof(double));
		assert_true(sites_of(&saved) == sites_of(&restored) && drawn_of(&saved) == drawn_of(&restored));
	}
	run_close(&saved);
	run_close(&restored);
}

// Let a force act on the whole thread, in the direction in which it flies.
static double* push(Run* run, double force) {
	double* load = calloc((size_t)run->length, sizeof *load);
	assert_non_null(load);
	for (int k = 0; k < body_length(run, 0) / 3; ++k)
		load[3 * k + 1] = -force * run->model->nodal_mass[k] / body_mass(run, 0);
	jn_model_system_set_load(run->model, JN_LOAD_OF_CONTACT, load); // nobody else does: there is no contact pass
	return load;
}

static void a_pull_below_the_hold_of_its_sites_does_not_move_a_thread(void** state) {
	(void)state;
	Run run;
	open_flight(&run, "symplectic_euler", ", fix: [{where: {face: all}}]", ", hold: 5 mN", 1);
	run_until(&run, 0.1); // 5 and then 10 mN on 0.38 g: it rests from 43 ms on, and swings a little
	assert_true(sites_of(&run) == 2);
	double* load = push(&run, 9e-3);
	const double from = drawn_of(&run);
	run_until(&run, 0.2);
	// free, 9 mN would draw it 12 cm; the strain of 10 mN in 0.63 N over a few centimetres is some 0.1 mm
	expect_near(drawn_of(&run), from, 5e-4, "length drawn through [m]");
	run_close(&run);
	free(load);
}

static void a_pull_above_it_draws_a_thread_with_what_it_exceeds(void** state) {
	(void)state;
	Run run;
	open_flight(&run, "symplectic_euler", ", fix: [{where: {face: all}}]", ", hold: 5 mN", 1);
	run_until(&run, 0.02);
	assert_true(sites_of(&run) == 2);
	double* load = push(&run, 0.02);
	const double from = speed_of(&run), t = run_state(&run)->t, mass = body_mass(&run, 0);
	run_until(&run, 0.05);
	expect_near(mass * (speed_of(&run) - from) / (run_state(&run)->t - t), 0.01, 1e-6, "force left of 20 mN [N]");
	run_close(&run);
	free(load);
}

// Free in space, slab and thread keep their momentum, and the slab gets what the thread loses.
static void a_site_pulls_on_the_thread_and_on_the_body_alike(void** state) {
	(void)state;
	Run run;
	open_flight(&run, "symplectic_euler", "", ", hold: 1 mN, friction: 0.3", 1);
	run_until(&run, 0.02);
	assert_true(sites_of(&run) == 2);
	const JnEnergies before = run_energies(&run);
	const double had = body_momentum(&run, 0, 1);
	run_until(&run, 0.06);
	const JnEnergies after = run_energies(&run);
	const double given = body_momentum(&run, 1, 1);
	print_message("of %g N s the slab has %g\n", had, given);
	assert_true(given < 0.05 * had); // both point down
	for (int a = 0; a < 3; ++a)      // rounding of 800 steps
		expect_near(after.momentum[a], before.momentum[a], 1e-13, "momentum along %c [N s]", "xyz"[a]);
	run_close(&run);
}

// Thrown sideways once it is in, the thread drags the slab along, and stays in its sites.
static void sites_hold_a_thread_across_it(void** state) {
	(void)state;
	Run run;
	open_flight(&run, "symplectic_euler", "", "", 1);
	run_until(&run, 0.03);
	JnState* s = (JnState*)run_state(&run);
	for (int k = 0; k < body_length(&run, 0); k += 3) s->v[k] += 0.3;
	jn_state_touch(jn_sim_system(run.sim)->space, s);
	const double given = 0.3 * body_mass(&run, 0);
	double error = 0;
	while (run_state(&run)->t < 0.05) {
		run_step(&run);
		error = fmax(error, pass_column(run_pass_of(&run, &jn_pass_suture), "suture_error"));
	}
	expect_near(body_momentum(&run, 0, 0) + body_momentum(&run, 1, 0), given, 1e-12, "momentum along x [N s]");
	assert_true(body_momentum(&run, 1, 0) > 0.1 * given);
	expect_at_most(error, 1e-5, "largest distance of thread and site [m]"); // a hundredth of the radius
	run_close(&run);
}

// Pressed sideways by a constant force while it slides, what it loses is mu times what the sites hold across it.
static void friction_along_is_its_share_of_the_force_across(void** state) {
	(void)state;
	Run run;
	open_flight(&run, "symplectic_euler", ", fix: [{where: {face: all}}]", ", friction: 0.3", 1);
	run_until(&run, 0.02);
	assert_true(sites_of(&run) == 2);
	double* load = push(&run, 0);
	const double mass = body_mass(&run, 0), from = speed_of(&run), t = run_state(&run)->t;
	double across = 0;
	const JnCollision* pass = run_collision(&run);
	for (int k = 0; k < body_length(&run, 0) / 3; ++k) load[3 * k] = 0.0005 * run.model->nodal_mass[k] / mass;
	while (run_state(&run)->t < 0.04) {
		run_step(&run);
		for (int i = 0; i < pass->kept.count; ++i)
			across += hypot(pass->kept.blocks[i].impulse[JN_LEVEL_VELOCITY][1],
							pass->kept.blocks[i].impulse[JN_LEVEL_VELOCITY][2]);
	}
	const double lost = mass * (from - speed_of(&run));
	print_message("impulse across: %g N s of %g\n", across, 0.0005 * (run_state(&run)->t - t));
	assert_true(across > 2e-6); // the rest swings sideways first
	expect_near(lost / across, 0.3, 0.03,
				"lost along over held across"); // the thread is bent: it is not along y everywhere
	run_close(&run);
	free(load);
}

static void a_thread_drawn_back_leaves_its_site(void** state) {
	(void)state;
	Run run;
	open_flight(&run, "symplectic_euler", ", fix: [{where: {face: all}}]", "", 1);
	run_until(&run, 0.008);
	assert_true(sites_of(&run) == 1);
	JnState* s = (JnState*)run_state(&run);
	for (int k = 0; k < body_length(&run, 0); ++k) s->v[k] = -s->v[k];
	jn_state_touch(jn_sim_system(run.sim)->space, s);
	run_until(&run, 0.013);
	expect_near(sites_of(&run), 1, 0, "sites, the tip 1 mm within");
	run_until(&run, 0.015);
	expect_near(sites_of(&run), 0, 0, "sites, the tip 1 mm without");
	run_close(&run);
}

// Back out of both in one step of 15 mm: the tip is outside again, and pierces anew when it comes back.
static void a_thread_drawn_out_of_two_sites_at_once_is_outside(void** state) {
	(void)state;
	Run run;
	open_flight(&run, "symplectic_euler", ", fix: [{where: {face: all}}]", "", 1);
	const JnSuture* pass = (const JnSuture*)run_pass_of(&run, &jn_pass_suture);
	run_until(&run, 0.014);
	assert_true(sites_of(&run) == 2);
	JnState* s = (JnState*)run_state(&run);
	for (int k = 0; k < body_length(&run, 0); ++k) s->v[k] *= -300;
	jn_state_touch(jn_sim_system(run.sim)->space, s);
	run_steps(&run, 3);
	expect_near(sites_of(&run), 0, 0, "sites");
	assert_false(pass->is_tip_inside);
	run_close(&run);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_suture_that_was_saved_goes_on_bit_for_bit),
		cmocka_unit_test(a_thread_that_flies_through_makes_and_leaves_two_sites),
		cmocka_unit_test(constant_friction_slows_a_thread_by_the_hold_of_each_site),
		cmocka_unit_test(a_pull_below_the_hold_of_its_sites_does_not_move_a_thread),
		cmocka_unit_test(a_pull_above_it_draws_a_thread_with_what_it_exceeds),
		cmocka_unit_test(a_site_pulls_on_the_thread_and_on_the_body_alike),
		cmocka_unit_test(sites_hold_a_thread_across_it),
		cmocka_unit_test(friction_along_is_its_share_of_the_force_across),
		cmocka_unit_test(a_thread_drawn_back_leaves_its_site),
		cmocka_unit_test(a_thread_drawn_out_of_two_sites_at_once_is_outside),
	};
	return cmocka_run_group_tests(tests, case_set_up, case_tear_down);
}
