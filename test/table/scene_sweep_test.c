/// @file scene_sweep_test.c
/// Every integrator on every scene of scenes/, for three steps: it steps to the end with finite states, or it is
/// refused before the first step with a message that names it and says what to set. Shapes are meshed coarsely for
/// speed, and of many bodies a few are kept.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "integrate/integrator.h"
#include "jounce/scene.h"
#include "support/coarse_scene.h"
#include "support/support.h"

enum { STEPS = 3 };

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
	copy_sets(&plan->coarse, sets);
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
	visit_scenes(sweep);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(every_method_steps_every_scene_or_says_what_to_set),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
