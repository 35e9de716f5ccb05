/// @file mode_agreement_test.c
/// Modes root and minimize find the same accelerations, whatever the method asks of a stage: weights, loads, several points
/// with their own steps, carried accelerations, held entries that move.
#include "support/model_case.h"

enum { ROOT, LINEAR, MINIMIZE, AUTO };
enum { REUSE_AUTO, REUSE_NEVER };
enum { STEPS = 6 };
static const double dt = 1.0 / 32;

static const char* const methods[] = {
	"backward_euler", "implicit_midpoint", "sdirk2", "tr_bdf2_b",           "esdirk325", "newmark",
	"hht_alpha",      "generalized_alpha", "bdf2",   "average_vector_field"};
enum { METHODS = sizeof methods / sizeof *methods };

typedef void Prepare(ModelCase* c);

static void falling_beam(ModelCase* c) {
	case_box(c, JN_HEX8, "stable_neo_hookean");
	case_gravity(c, 3, -9.81, 0);
}

static void body_with_damping_that_follows(ModelCase* c) {
	case_damped_body(c);
	c->body.damping.stiffness = 2; // D of the present state: no potential
}

static void linear_body(ModelCase* c) {
	case_box(c, JN_TET4, "linear");
	case_gravity(c, 3, -9.81, 0);
}

static const struct {
	const char* name;
	Prepare* prepare;
} models[] = {{"falling beam", falling_beam},
			  {"driven bar", case_driven_bar},
			  {"damped body", case_damped_body},
			  {"damping that follows", body_with_damping_that_follows},
			  {"linear body", linear_body}};
enum { MODELS = sizeof models / sizeof *models };

static void run(ModelCase* c, Prepare* prepare, const char* method, int mode, int reuse, Rig* rig) {
	prepare(c);
	case_method(c, row_named(&jn_integrator_list, method));
	c->sim.newton = (JnNewtonDef){.mode = mode, .tolerance = 1e-11, .max_iterations = 200, .reuse = reuse, .guess = 2};
	rig_create(rig, c, 1);
	for (int step = 0; step < STEPS; ++step) rig_step(rig, dt);
}

// With kept tangents, steps are taken as they come; with a new one each, by energies and slopes. The stages leave 1e-11
// of some 100 N on nodes of 0.1 kg and more: 1e-8 m/s^2, for 0.2 s; the damped bodies amplify nothing. The second
// derivative at the end of hht_alpha and its like carries errors on: a factor of 10 covers all.
static void expect_agreement(int model, const char* method, int mode, int reuse) {
	ModelCase root_case, other_case;
	Rig root, other;
	run(&root_case, models[model].prepare, method, ROOT, REUSE_NEVER, &root);
	run(&other_case, models[model].prepare, method, mode, reuse, &other);
	expect_near(largest_difference(root.start.x, other.start.x, root.length), 0, 2e-9, "%s, %s, reuse %d: positions",
				models[model].name, method, reuse);
	expect_near(largest_difference(root.start.v, other.start.v, root.length), 0, 2e-8, "%s, %s, reuse %d: velocities",
				models[model].name, method, reuse);
	rig_destroy(&root);
	rig_destroy(&other);
}

static void root_and_minimize_agree_for_all_methods_and_models(void** state) {
	(void)state;
	for (int model = 0; model < MODELS; ++model)
		for (int i = 0; i < METHODS; ++i)
			for (int reuse = REUSE_AUTO; reuse <= REUSE_NEVER; ++reuse)
				expect_agreement(model, methods[i], MINIMIZE, reuse);
}

static void root_and_auto_agree_for_all_methods_and_models(void** state) {
	(void)state;
	for (int model = 0; model < MODELS; ++model)
		for (int i = 0; i < METHODS; ++i) expect_agreement(model, methods[i], AUTO, REUSE_AUTO);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(root_and_minimize_agree_for_all_methods_and_models),
		cmocka_unit_test(root_and_auto_agree_for_all_methods_and_models),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
