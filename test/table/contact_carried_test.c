/// @file contact_carried_test.c
/// Every integrator on a bar that stands up after a fall: contact forces that it carries from step to step add no energy,
/// and where they would, they are not carried. The bar is linear and undamped; stiffnesses take the highest frequency from
/// a part of a turn a step to several.
#include "integrate/integrator.h"
#include "integrate/properties.h"
#include "pass/pass_case.h"

static bool is_explicit(const JnIntegratorType* type) {
	return (type->needs & JN_NEEDS_TANGENT) == 0;
}

/// Largest growth of the total energy over that at the start, as a share of the fall's m g h.
static double growth(const JnIntegratorType* type, double young, const char* prediction) {
	Run run;
	run_open(
		&run, 1,
		"duration: 10 s\nintegrator: {method: %s}\nstep: {dt: 5 ms, cuts: 0}\n"
		"bodies:\n"
		"  - {name: bar, shape: {type: box, origin: [0, 0.1, 0], size: [0.1, 0.8, 0.1], cells: [1, 8, 1]}, mass: %s,\n"
		"     material: {law: linear, density: 1000, young: %g, poisson: 0}}\n"
		"obstacles: [{name: floor, shape: plane}]\ncontact: {prediction: %s}\n",
		type->row.name, is_explicit(type) ? "lumped" : "consistent", young, prediction);
	const double scale = jn_model_mass(run.model) * 9.81 * 0.1;
	double most = 0;
	for (int i = 0; i < 300; ++i) {
		if (jn_sim_step(run.sim) != JN_OK) {
			most = INFINITY;
			break;
		}
		const JnEnergies e = jn_model_energies(run.model, run_state(&run));
		most = fmax(most, (e.kinetic + e.elastic + e.gravity) / scale);
	}
	run_close(&run);
	return most;
}

static void carried_forces_add_no_energy(void** state) {
	(void)state;
	static const double youngs[] = {3e4, 3e5, 1e6, 3e6, 1e7, 3e7};
	int failed = 0;
	for (int i = 0; i < jn_integrator_list.count; ++i) {
		const JnIntegratorType* type = (const JnIntegratorType*)jn_integrator_list.rows[i];
		JnIntegratorProperties properties;
		jn_integrator_properties(type, &properties);
		if (!properties.a_stable && properties.stability_limit == 0) continue; // it grows without any contact
		for (int k = 0; k < (is_explicit(type) ? 1 : 6); ++k) {
			const double most = growth(type, youngs[k], "auto");
			if (most <= 0.02) continue;
			print_error("%s, E = %g Pa: energy grew by %g of that of the fall\n", type->row.name, youngs[k], most);
			++failed;
		}
	}
	assert_int_equal(failed, 0);
}

static void what_would_grow_is_refused(void** state) {
	(void)state;
	Run run;
	log_capture();
	run_open(&run, 1,
			 "duration: 1 s\nintegrator: esdirk436\nstep: {dt: 5 ms}\n"
			 "bodies: [{name: box, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [1, 1, 1]},\n"
			 "  material: {law: linear, density: 1000, young: 1e5, poisson: 0}}]\n"
			 "obstacles: [{name: floor, shape: plane}]\ncontact: {prediction: carried}\n");
	assert_int_equal(jn_sim_step(run.sim), JN_BAD_INPUT);
	assert_non_null(
		strstr(log_text(), "contact.prediction: carried forces would grow from step to step with esdirk436"));
	log_release();
	run_close(&run);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(carried_forces_add_no_energy),
		cmocka_unit_test(what_would_grow_is_refused),
	};
	return cmocka_run_group_tests(tests, case_set_up, case_tear_down);
}
