/// @file fracture_test.c
/// Bonds break when a step is accepted, and only then; forces and history of the system follow.
#include "base/space.h"
#include "force/bond.h"
#include "integrate/integrator.h"
#include "math/vec3.h"
#include "pass/fragments.h"
#include "pass/pass.h"
#include "pass/pass_case.h"

// A strip whose right half flies away from the left one.
static const char* const strip =
	"gravity: [0, 0, 0]\nduration: 1 s\nintegrator: %s\nstep: {dt: %s}\n%s"
	"bodies:\n"
	"  - shape: {type: points_box, size: [0.02, 0.004, 0.001], spacing: 0.001, layer: true}\n"
	"    material: {law: peridynamic, density: 1000, young: 1 MPa, critical_stretch: 0.01}\n"
	"    velocity: [10, 0, 0]\n"
	"    fix: [{where: {box: {min: [0, 0, 0], max: [0.01, 1, 1]}}}]\n";

static int whole_bonds(const JnModel* model) {
	int count = 0;
	for (int b = 0; b < model->groups[0].count; ++b) count += jn_bond_get(&model->groups[0], b).force != 0;
	return count;
}

// A step by hand: an attempt that strains bonds beyond what they bear, thrown away; then one that is accepted.
static void an_attempt_breaks_nothing_and_an_accepted_step_does(void** state) {
	(void)state;
	Run run;
	JnPasses passes;
	JnReport report = {0};
	run_open(&run, 1, strip, "verlet", "2 us", "");
	const JnSimDef* def = &jn_scene_def(run.scene)->sim;
	JnSystem* sys = jn_model_system(run.model);
	JnIntegrator* integrator = jn_integrator_create(&def->integrator, &def->newton, sys->space);
	JnState start, end;
	assert_int_equal(jn_passes_create(def, run.model, &passes), JN_OK);
	assert_int_equal(jn_state_create(sys->space, &start), JN_OK);
	assert_int_equal(jn_state_create(sys->space, &end), JN_OK);
	sys->report = &report;
	jn_model_start(run.model, 0, &start);
	const int all = whole_bonds(run.model);
	JnStep step = {.sys = sys, .start = &start, .end = &end, .dt = 2e-6, .method = integrator->type};
	bool edited, again;
	for (int attempt = 0; attempt < 3; ++attempt) {
		assert_int_equal(jn_passes_prepare(&passes, &step, 0), JN_OK);
		assert_int_equal(integrator->type->step(integrator, &step), JN_OK);
		assert_int_equal(jn_passes_correct(&passes, &step, 0, &edited, &again), JN_OK);
		assert_false(edited || again);
		assert_int_equal(whole_bonds(run.model), all);
	}
	const uint64_t stamp = end.stamp;
	jn_passes_commit(&passes, &step);
	print_message("%d bonds, %d after the step\n", all, whole_bonds(run.model));
	assert_true(whole_bonds(run.model) < all);
	assert_true(end.stamp != stamp);
	jn_passes_destroy(&passes);
	jn_state_destroy(sys->space, &start);
	jn_state_destroy(sys->space, &end);
	jn_integrator_destroy(integrator);
	run_close(&run);
}

// Few Newton iterations are not enough for the first attempts, whose ends would strain more bonds: those that are broken
// after the first step are those too long at its end, and no others.
static void attempts_that_fail_break_nothing(void** state) {
	(void)state;
	Run run;
	run_open(&run, 1, strip, "newmark", "200 us", "newton: {mode: root, max_iterations: 3}\n");
	jn_sim_step(run.sim);
	const JnGroup* group = &run.model->groups[0];
	const double* x = run_state(&run)->x;
	int broken = 0;
	for (int b = 0; b < group->count; ++b) {
		const JnBond bond = jn_bond_get(group, b);
		const double r = vec3_distance(x + 3 * (size_t)bond.nodes[0], x + 3 * (size_t)bond.nodes[1]);
		assert_true((bond.force == 0) == (r > bond.length * (1 + bond.stretch)));
		broken += bond.force == 0;
	}
	print_message("%d attempts failed, then %d bonds broke\n", jn_sim_last_report(run.sim)->rejected, broken);
	assert_true(jn_sim_last_report(run.sim)->rejected > 0);
	assert_true(broken > 0);
	run_close(&run);
}

// What breaks takes its energy away, and the force at the new start is that of what is left.
static void broken_bonds_leave_the_energy_and_the_forces(void** state) {
	(void)state;
	static const char* const methods[] = {"verlet", "newmark", "bdf2"};
	for (int m = 0; m < 3; ++m) {
		Run run;
		double released = 0;
		run_open(&run, 1, strip, methods[m], "2 us", "");
		JnSystem* sys = jn_model_system(run.model);
		JnVec f = sys->space->ops->create(sys->space), moved = sys->space->ops->create(sys->space);
		assert_true(f != NULL && moved != NULL);
		for (int step = 0; step < 5; ++step) {
			run_step(&run);
			const JnState* now = run_state(&run);
			JnState copy = *now; // with another stamp: made anew
			jn_state_touch(sys->space, &copy);
			assert_int_equal(sys->ops->force(sys, now, f), JN_OK);
			assert_int_equal(sys->ops->force(sys, &copy, moved), JN_OK);
			for (int k = 0; k < run.length; ++k) assert_true(f[k] == moved[k]);
			assert_true(run_column(&run, "fracture.energy") >= released);
			released = run_column(&run, "fracture.energy");
		}
		print_message("%s: %g bonds broken, %.3g J\n", methods[m], run_column(&run, "fracture.broken_total"), released);
		assert_true(run_column(&run, "fracture.broken_total") > 0);
		sys->space->ops->destroy(sys->space, f);
		sys->space->ops->destroy(sys->space, moved);
		run_close(&run);
	}
}

static void the_strip_falls_into_two_pieces(void** state) {
	(void)state;
	Run run;
	run_open(&run, 1, strip, "verlet", "2 us", "");
	assert_true(run_column(&run, "fracture.fragments") == 1);
	assert_true(run_column(&run, "fracture.largest_fragment") == 80);
	run_steps(&run, 100);
	const JnPass* pass = run_pass(&run);
	const double *damage = pass->type->field(pass, 0), *piece = pass->type->field(pass, 1);
	assert_true(run_column(&run, "fracture.fragments") == 2);
	assert_true(run_column(&run, "fracture.loose_points") == 0);
	assert_true(run_column(&run, "fracture.largest_fragment") == 40);
	for (int node = 0; node < 80; ++node) {
		assert_true(piece[node] == (node % 20 < 10 ? 0 : 1));
		assert_true((damage[node] > 0) == (abs(2 * (node % 20) - 19) < 7)); // within the horizon of 3.5 spacings
		assert_true(damage[node] < 1);
	}
	run_close(&run);
}

static void nothing_breaks_before_the_start(void** state) {
	(void)state;
	Run run;
	run_open(&run, 1, strip, "verlet", "2 us", "fracture: {start: 9 us}\n");
	run_steps(&run, 4);
	assert_true(run_column(&run, "fracture.broken_total") == 0);
	run_step(&run);
	assert_true(run_column(&run, "fracture.broken_total") > 0);
	run_close(&run);
}

// A strip whose corner is torn off.
static const char* const torn =
	"gravity: [0, 0, 0]\nduration: 1 s\nintegrator: %s\nstep: {dt: %s}\n%s"
	"bodies:\n"
	"  - shape: {type: points_box, size: [0.02, 0.004, 0.001], spacing: 0.001, layer: true}\n"
	"    material: {law: peridynamic, density: 1000, young: 1 MPa, critical_stretch: 0.01}\n"
	"    loads: [{where: {nearest: [0.02, 0.004, 0]}, force: [0.3, 0.1, 0]}]\n"
	"    fix: [{where: {box: {min: [0, 0, 0], max: [0.01, 1, 1]}}}]\n";

// Steps after which some point has lost its bonds in part, but 0.6 of them or more.
static int count_hanging(const char* fracture) {
	Run run;
	int hanging = 0;
	run_open(&run, 1, torn, "verlet", "1 us", fracture);
	for (int step = 0; step < 60; ++step) {
		run_step(&run);
		const double* damage = run_pass(&run)->type->field(run_pass(&run), 0);
		for (int node = 0; node < 80; ++node) hanging += damage[node] >= 0.6 && damage[node] < 1;
	}
	assert_true(run_column(&run, "fracture.loose_points") > 0);
	run_close(&run);
	return hanging;
}

static void debris_loses_all_its_bonds(void** state) {
	(void)state;
	const int as_they_are = count_hanging(""), without = count_hanging("fracture: {debris: 0.6}\n");
	print_message("%d states that hang by a few bonds, %d with debris\n", as_they_are, without);
	assert_true(as_they_are > 0);
	assert_int_equal(without, 0);
}

static void threads_change_nothing(void** state) {
	(void)state;
	Run one, two;
	static const char* const plate =
		"gravity: [0, 0, 0]\nduration: 1 s\nintegrator: verlet\nstep: {dt: 0.1 us}\n"
		"bodies:\n"
		"  - shape: {type: points_box, size: [0.04, 0.02, 0.001], spacing: 0.0005, layer: true}\n"
		"    material: {law: peridynamic, density: 2440, young: 72 GPa, critical_stretch: 0.001}\n"
		"    spin: [0, 0, 40000]\n%s";
	run_open(&one, 1, plate, "");
	run_open(&two, 2, plate, "");
	for (int step = 0; step < 60; ++step) {
		run_step(&one);
		run_step(&two);
		assert_memory_equal(run_state(&one)->x, run_state(&two)->x, (size_t)one.length * sizeof(double));
		assert_true(run_column(&one, "fracture.energy") == run_column(&two, "fracture.energy"));
	}
	print_message("%g bonds broken\n", run_column(&one, "fracture.broken_total"));
	assert_true(run_column(&one, "fracture.broken_total") > 0);
	run_close(&one);
	run_close(&two);
}

static void pieces_are_numbered_by_their_lowest_points(void** state) {
	(void)state;
	JnArena arena = {0};
	JnGroup group;
	JnFragments fragments;
	static const int ends[][2] = {{5, 1}, {6, 2}, {2, 4}, {1, 3}};
	const bool broken[] = {false, false, false, true}, member[] = {true, true, true, true, true, true, true, false};
	const double expected[] = {0, 1, 2, 3, 2, 1, 2, -1};
	assert_int_equal(jn_bonds_create(4, &arena, &group), JN_OK);
	for (int b = 0; b < 4; ++b) {
		const JnBond bond = {.nodes = {ends[b][0], ends[b][1]}, .length = 1, .force = 1};
		jn_bond_set(&group, b, &bond);
	}
	assert_int_equal(jn_fragments_create(8, &arena, &fragments), JN_OK);
	jn_fragments_begin(&fragments);
	jn_fragments_join(&fragments, &group, broken);
	jn_fragments_count(&fragments, member);
	for (int i = 0; i < 8; ++i) assert_true(fragments.number[i] == expected[i]);
	assert_int_equal(fragments.count, 2);
	assert_int_equal(fragments.loose_count, 2);
	assert_int_equal(fragments.largest, 3);
	jn_arena_free(&arena);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(an_attempt_breaks_nothing_and_an_accepted_step_does),
		cmocka_unit_test(attempts_that_fail_break_nothing),
		cmocka_unit_test(broken_bonds_leave_the_energy_and_the_forces),
		cmocka_unit_test(the_strip_falls_into_two_pieces),
		cmocka_unit_test(nothing_breaks_before_the_start),
		cmocka_unit_test(debris_loses_all_its_bonds),
		cmocka_unit_test(threads_change_nothing),
		cmocka_unit_test(pieces_are_numbered_by_their_lowest_points),
	};
	return cmocka_run_group_tests(tests, case_set_up, case_tear_down);
}
