/// @file archive_sweep_test.c
/// A simulation that was restored goes on with the bits of the one that was saved: every scene of scenes/ with its own method
/// and controller, every method, every controller. And saving does not change the motion beyond what solvers leave.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "control/controller.h"
#include "integrate/integrator.h"
#include "support/coarse_scene.h"
#include "support/support.h"

enum { BEFORE = 12, SCENE_BEFORE = 100, AFTER = 12 }; // scenes: until things touch and break

static JnSim* open_sim(const char* path, const Sets* sets, JnScene** scene) {
	JnSim* sim = NULL;
	log_capture();
	if (jn_scene_load(path, sets->count, sets->list, scene) != JN_OK) fail_msg("%s: %s", path, log_text());
	drop_bodies(*scene);
	if (jn_scene_build(*scene, 1, &sim) != JN_OK) fail_msg("%s: %s", path, log_text());
	return sim;
}

static void close_sim(JnSim* sim, JnScene* scene) {
	jn_sim_destroy(sim);
	jn_scene_destroy(scene);
	log_release();
}

static void step_often(JnSim* sim, int steps, const char* what) {
	for (int k = 0; k < steps && !jn_sim_is_done(sim); ++k)
		if (jn_sim_step(sim) != JN_OK) fail_msg("%s: %s", what, log_text());
}

// All that a simulation would save, as bytes.
static JnArchive snapshot(JnSim* sim) {
	JnArchive archive = {0};
	assert_int_equal(jn_sim_snapshot(sim, &archive), JN_OK);
	return archive;
}

static void expect_same_bits(JnSim* saved, JnSim* restored, int step, const char* what) {
	JnArchive a = snapshot(saved), b = snapshot(restored);
	const size_t length = jn_sim_system(saved)->space->length;
	for (size_t k = 0; k < length; ++k)
		if (memcmp(jn_sim_state(saved)->x + k, jn_sim_state(restored)->x + k, sizeof(double)) != 0)
			fail_msg("%s: entry %zu of x differs by %g after %d steps", what, k,
					 jn_sim_state(saved)->x[k] - jn_sim_state(restored)->x[k], step);
	if (a.size != b.size) fail_msg("%s: what would be saved has another size after %d steps", what, step);
	for (size_t at = 0, piece = 0; at < a.size; ++piece) {
		uint64_t head[2];
		memcpy(head, a.bytes + at, sizeof head);
		const size_t size = sizeof head + (size_t)head[1];
		if (memcmp(a.bytes + at, b.bytes + at, size) != 0)
			fail_msg("%s: piece %zu, of %zu bytes, would be saved differently after %d steps", what, piece, size, step);
		at += size;
	}
	jn_archive_free(&a);
	jn_archive_free(&b);
}

// Save on the way, restore into another simulation, and let both go on.
static void check(const char* path, const Sets* sets, int before, const char* what) {
	JnScene *scene = NULL, *other_scene = NULL;
	JnArchive archive = {0};
	JnSim *saved = open_sim(path, sets, &scene), *restored = open_sim(path, sets, &other_scene);
	step_often(saved, before, what);
	assert_int_equal(jn_sim_save(saved, &archive), JN_OK);
	JnArchive reader = jn_archive_reader(archive.bytes, archive.size);
	if (jn_sim_restore(restored, &reader) != JN_OK) fail_msg("%s: %s", what, log_text());
	assert_int_equal(jn_archive_end(&reader), JN_OK);
	for (int k = 0; k < AFTER; ++k) {
		step_often(saved, 1, what);
		step_often(restored, 1, what);
		expect_same_bits(saved, restored, k + 1, what);
		assert_int_equal(jn_sim_last_report(saved)->newton, jn_sim_last_report(restored)->newton);
		assert_int_equal(jn_sim_last_report(saved)->iterations, jn_sim_last_report(restored)->iterations);
	}
	jn_archive_free(&archive);
	close_sim(restored, other_scene);
	close_sim(saved, scene);
}

static void check_scene(const char* path) {
	Plan plan;
	Sets sets;
	make_plan(path, &plan);
	copy_sets(&plan.coarse, &sets);
	check(path, &sets, SCENE_BEFORE, strrchr(path, '/') + 1);
}

static void every_scene_goes_on_with_the_same_bits(void** state) {
	(void)state;
	visit_scenes(check_scene);
}

#define BEAM JN_SOURCE_DIR "/scenes/beam.yaml"

static void choose(const char* method, const char* step, Sets* sets) {
	Plan plan;
	make_plan(BEAM, &plan);
	copy_sets(&plan.coarse, sets);
	add_set(sets, "integrator={method: %s}", method);
	add_set(sets, "step=%s", step);
	add_set(sets, "bodies[0].mass=lumped");
}

static void every_method_goes_on_with_the_same_bits(void** state) {
	(void)state;
	for (int i = 0; i < jn_integrator_list.count; ++i) {
		const JnIntegratorType* type = (const JnIntegratorType*)jn_integrator_list.rows[i];
		const bool is_explicit = (type->needs & JN_NEEDS_DIAGONAL_MASS) != 0;
		Sets sets;
		choose(type->row.name, is_explicit ? "{dt: 10 us}" : "{dt: 1 ms}", &sets);
		check(BEAM, &sets, BEFORE, type->row.name);
	}
}

static const char* served(const char* controller) {
	if (strcmp(controller, "stable") == 0) return "verlet";
	return strcmp(controller, "zienkiewicz_xie") == 0 ? "linearized_newmark" : "tr_bdf2";
}

static void every_controller_goes_on_with_the_same_bits(void** state) {
	(void)state;
	for (int i = 0; i < jn_controller_list.count; ++i) {
		const char* name = jn_controller_list.rows[i]->name;
		char step[128];
		Sets sets;
		if (strcmp(name, "combined") == 0)
			snprintf(step, sizeof step, "{controller: combined, rules: [embedded, speed_limit]}");
		else
			snprintf(step, sizeof step, "{controller: %s, dt: 0.1 ms}", name);
		choose(served(name), step, &sets);
		check(BEAM, &sets, BEFORE, name);
	}
}

// Newton's tolerance is 1e-8 of the forces: accelerations differ by that at most, positions by t^2 / 2 of it.
static void saving_changes_the_motion_by_no_more_than_solvers_leave(void** state) {
	(void)state;
	for (int i = 0; i < jn_integrator_list.count; ++i) {
		const JnIntegratorType* type = (const JnIntegratorType*)jn_integrator_list.rows[i];
		if ((type->needs & JN_NEEDS_DIAGONAL_MASS) != 0) continue;
		JnScene *scene = NULL, *other_scene = NULL;
		Sets sets;
		choose(type->row.name, "{dt: 1 ms}", &sets);
		JnSim *saved = open_sim(BEAM, &sets, &scene), *other = open_sim(BEAM, &sets, &other_scene);
		for (int k = 0; k < BEFORE + AFTER; ++k) {
			JnArchive archive = {0};
			assert_int_equal(jn_sim_save(saved, &archive), JN_OK);
			jn_archive_free(&archive);
			step_often(saved, 1, type->row.name);
			step_often(other, 1, type->row.name);
		}
		const JnState *a = jn_sim_state(saved), *b = jn_sim_state(other);
		double apart = 0;
		for (size_t k = 0; k < jn_sim_system(saved)->space->length; ++k) apart = fmax(apart, fabs(a->x[k] - b->x[k]));
		const double moved = 0.5 * 9.81 * a->t * a->t;
		if (!(apart <= 1e-6 * moved)) fail_msg("%s: %g of %g m", type->row.name, apart, moved);
		close_sim(other, other_scene);
		close_sim(saved, scene);
	}
}

static void a_state_of_another_scene_is_refused(void** state) {
	(void)state;
	JnScene *scene = NULL, *other_scene = NULL;
	Sets sets, others;
	JnArchive archive = {0};
	choose("bdf2", "{dt: 1 ms}", &sets);
	choose("sdirk2", "{dt: 1 ms}", &others);
	JnSim *saved = open_sim(BEAM, &sets, &scene), *other = open_sim(BEAM, &others, &other_scene);
	assert_int_equal(jn_sim_save(saved, &archive), JN_OK);
	JnArchive reader = jn_archive_reader(archive.bytes, archive.size);
	assert_int_equal(jn_sim_restore(other, &reader), JN_BAD_INPUT);
	log_expect("of another scene");
	jn_archive_free(&archive);
	close_sim(other, other_scene);
	close_sim(saved, scene);
}

// Wherever it is cut, and whatever byte of it is another one: refused, or read as it stands; never a crash.
static void a_damaged_state_is_refused(void** state) {
	(void)state;
	JnScene* scene = NULL;
	Sets sets;
	JnArchive archive = {0};
	choose("bdf2", "{dt: 1 ms}", &sets);
	JnSim* sim = open_sim(BEAM, &sets, &scene);
	assert_int_equal(jn_sim_save(sim, &archive), JN_OK);
	close_sim(sim, scene);
	for (size_t cut = 0; cut < archive.size; cut += 1 + archive.size / 40) {
		sim = open_sim(BEAM, &sets, &scene);
		JnArchive reader = jn_archive_reader(archive.bytes, cut);
		assert_int_equal(jn_sim_restore(sim, &reader), JN_BAD_INPUT);
		log_expect("the saved state does not fit");
		close_sim(sim, scene);
	}
	jn_archive_free(&archive);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(every_scene_goes_on_with_the_same_bits),
		cmocka_unit_test(every_method_goes_on_with_the_same_bits),
		cmocka_unit_test(every_controller_goes_on_with_the_same_bits),
		cmocka_unit_test(saving_changes_the_motion_by_no_more_than_solvers_leave),
		cmocka_unit_test(a_state_of_another_scene_is_refused),
		cmocka_unit_test(a_damaged_state_is_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
