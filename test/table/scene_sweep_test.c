/// @file scene_sweep_test.c
/// Every integrator on every scene of scenes/, for three steps: it steps to the end with finite states, or it is
/// refused before the first step with a message that names it and says what to set. Shapes are meshed coarsely for
/// speed, and of many bodies a few are kept.
#include <glob.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "base/key.h"
#include "control/controller.h"
#include "integrate/integrator.h"
#include "jounce/scene.h"
#include "mesh/shape/shape.h"
#include "support/support.h"

enum { MOST_SETS = 40, SET_LENGTH = 96, MOST_CELLS = 32, STEPS = 3, KEPT_BODIES = 10 };

/// The `--set` entries of a run.
typedef struct Sets {
	char text[MOST_SETS][SET_LENGTH];
	const char* list[MOST_SETS];
	int count;
} Sets;

__attribute__((format(printf, 2, 3))) static void add_set(Sets* sets, const char* format, ...) {
	va_list arguments;
	assert_true(sets->count < MOST_SETS);
	va_start(arguments, format);
	vsnprintf(sets->text[sets->count], SET_LENGTH, format, arguments);
	va_end(arguments);
	sets->list[sets->count] = sets->text[sets->count];
	++sets->count;
}

// Those of the beginning and the end of a scene are often of two kinds.
static bool is_kept(int body, int bodies) {
	return bodies <= KEPT_BODIES || body < KEPT_BODIES / 2 || body >= bodies - KEPT_BODIES / 2;
}

// The scene is the test's own, so that its definitions may be changed.
static void drop_bodies(const JnScene* scene) {
	JnItems* bodies = (JnItems*)&jn_scene_def(scene)->sim.model.bodies;
	JnBodyDef* list = (JnBodyDef*)bodies->data;
	if (bodies->count <= KEPT_BODIES) return;
	const int half = KEPT_BODIES / 2;
	memmove(list + half, list + bodies->count - half, (size_t)half * sizeof *list);
	bodies->count = KEPT_BODIES;
}

/// What a scene says before anything is set.
typedef struct Plan {
	int bodies;
	double dt;
	Sets coarse; // its boxes, with at most MOST_CELLS cells
} Plan;

static double first_step(const JnVariant* step) {
	for (const JnKey* key = step->row->keys; key->name != NULL; ++key)
		if (strcmp(key->name, "dt") == 0) return *(const double*)((const char*)step->options + key->field);
	fail_msg("controller %s has no dt", step->row->name);
	return NAN;
}

// Halve the longest edge of cells until few are left.
static void coarsen_box(const JnBoxDef* box, int index, Sets* sets) {
	int cells[3];
	memcpy(cells, box->cells, sizeof cells);
	while (cells[0] * cells[1] * cells[2] > MOST_CELLS) {
		int longest = 0;
		for (int axis = 1; axis < 3; ++axis)
			if (cells[axis] > cells[longest]) longest = axis;
		cells[longest] /= 2;
	}
	add_set(sets, "bodies[%d].shape.cells=[%d, %d, %d]", index, cells[0], cells[1], cells[2]);
}

// Of the other generated shapes, the coarsest meshes that show what they are.
static void coarsen(const JnBodyDef* body, int index, Sets* sets) {
	static const char* const coarse[][2] = {
		{"sheet", "cells=[6, 6]"},       {"cloth", "cells=[6, 6]"},    {"ball", "cells=2"},
		{"cylinder", "cells=[8, 1, 4]"}, {"torus", "cells=[8, 1, 8]"}, {"rope", "cells=[4, 1, 10]"},
		{"jello", "cells=[32, 1, 2]"},   {"duck", "mesh=voxels"},      {"duck", "cell=6 cm"},
		{"beach_ball", "mesh=voxels"},   {"beach_ball", "cell=5 cm"},  {"points_box", "spacing=5 mm"},
	};
	const char* shape = body->shape.row->name;
	if (strcmp(shape, "box") == 0) coarsen_box(body->shape.options, index, sets);
	for (size_t i = 0; i < sizeof coarse / sizeof *coarse; ++i)
		if (strcmp(shape, coarse[i][0]) == 0) add_set(sets, "bodies[%d].shape.%s", index, coarse[i][1]);
	// Surfaces from elsewhere are not in a clean tree; and a scattered start is a test of its own.
	if (strcmp(shape, "file") == 0) add_set(sets, "bodies[%d].shape={type: ball, radius: 0.4, cells: 2}", index);
	if (body->scatter.amplitude > 0) add_set(sets, "bodies[%d].scatter.amplitude=1 mm", index);
}

static void make_plan(const char* path, Plan* plan) {
	JnScene* scene = NULL;
	*plan = (Plan){0};
	assert_int_equal(jn_scene_load(path, 0, NULL, &scene), JN_OK);
	const JnSimDef* sim = &jn_scene_def(scene)->sim;
	plan->bodies = sim->model.bodies.count;
	plan->dt = first_step(&sim->step);
	for (int b = 0; b < plan->bodies; ++b)
		if (is_kept(b, plan->bodies)) coarsen((const JnBodyDef*)sim->model.bodies.data + b, b, &plan->coarse);
	jn_scene_destroy(scene);
}

static void expect_finite(const JnSim* sim, const char* path, const char* method) {
	const int length = (int)jn_sim_system((JnSim*)sim)->space->length;
	const JnState* state = jn_sim_state(sim);
	for (int k = 0; k < length; ++k)
		if (!isfinite(state->x[k]) || !isfinite(state->v[k]))
			fail_msg("%s, %s: entry %d is not finite", path, method, k);
}

// "integrator.method: <name> ...; set ... or choose ...", with its place in the file.
static void expect_refusal(const char* method, JnStatus status) {
	assert_int_equal(status, JN_BAD_INPUT);
	const char* text = log_text();
	if (strstr(text, method) == NULL || (strstr(text, "set ") == NULL && strstr(text, "choose ") == NULL))
		fail_msg("%s is refused without saying what to do: %s", method, text);
}

static bool steps_to_the_end(const char* path, const char* method, const Sets* sets, double duration) {
	JnScene* scene = NULL;
	JnSim* sim = NULL;
	log_capture();
	JnStatus status = jn_scene_load(path, sets->count, sets->list, &scene);
	if (status != JN_OK) fail_msg("%s: %s", path, log_text());
	drop_bodies(scene);
	status = jn_scene_build(scene, 1, &sim);
	const bool is_built = status == JN_OK;
	if (!is_built) expect_refusal(method, status);
	while (is_built && !jn_sim_is_done(sim)) {
		status = jn_sim_step(sim);
		if (status != JN_OK) fail_msg("%s, %s: %s: %s", path, method, jn_status_name(status), log_text());
		expect_finite(sim, path, method);
	}
	if (is_built && !(fabs(jn_sim_state(sim)->t - duration) <= 1e-9 * duration)) // what the clipped last step leaves
		fail_msg("%s, %s: ended at t = %g s, not %g s", path, method, jn_sim_state(sim)->t, duration);
	log_release();
	jn_sim_destroy(sim);
	jn_scene_destroy(scene);
	return is_built;
}

static void choose(const Plan* plan, const char* method, double dt, Sets* sets) {
	*sets = plan->coarse;
	for (int i = 0; i < sets->count; ++i) sets->list[i] = sets->text[i];
	add_set(sets, "integrator={method: %s}", method);
	add_set(sets, "step={dt: %.17g s}", dt); // fixed: not every controller serves every method
	add_set(sets, "duration=%.17g s", STEPS * dt);
}

static void lump(const Plan* plan, Sets* sets) {
	for (int b = 0; b < plan->bodies; ++b)
		if (is_kept(b, plan->bodies)) add_set(sets, "bodies[%d].mass=lumped", b);
}

// An explicit method's step must resolve the stiffest element: 1 us is half of what sound takes through 1 cm of
// steel. Linearly implicit methods break at the steps of the stiffest scenes, as docs/rotation.md tells; all stand
// 1 ms.
static void sweep(const char* path) {
	Plan plan;
	int stepped = 0, refused = 0;
	make_plan(path, &plan);
	for (int i = 0; i < jn_integrator_list.count; ++i) {
		const JnIntegratorType* type = (const JnIntegratorType*)jn_integrator_list.rows[i];
		const bool is_explicit = (type->needs & JN_NEEDS_DIAGONAL_MASS) != 0;
		const double dt = is_explicit ? 1e-6 : fmin(plan.dt, 1e-3);
		Sets sets;
		choose(&plan, type->row.name, dt, &sets);
		const bool steps = steps_to_the_end(path, type->row.name, &sets, STEPS * dt);
		stepped += steps;
		refused += !steps;
		if (steps || !is_explicit) continue;
		lump(&plan, &sets);
		if (!steps_to_the_end(path, type->row.name, &sets, STEPS * dt))
			fail_msg("%s, %s: refused with lumped mass too", path, type->row.name);
	}
	print_message("%s: %d methods step, %d are refused\n", strrchr(path, '/') + 1, stepped, refused);
	assert_true(stepped > 0);
}

static void every_method_steps_every_scene_or_says_what_to_set(void** state) {
	(void)state;
	glob_t found;
	assert_int_equal(glob(JN_SOURCE_DIR "/scenes/*.yaml", 0, NULL, &found), 0);
	assert_true(found.gl_pathc >= 2);
	for (size_t i = 0; i < found.gl_pathc; ++i)
		if (strstr(found.gl_pathv[i], "_large.yaml") == NULL)
			sweep(found.gl_pathv[i]); // those are others, with more points
	globfree(&found);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(every_method_steps_every_scene_or_says_what_to_set),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
