// Constant forces on nodes: they move the centre of mass as they should, and have a potential.
#include "pass/pass_case.h"

static const char* const block =
	"gravity: [0, 0, 0]\nduration: 1 s\nintegrator: implicit_midpoint\nnewton: {tolerance: 1e-12}\nstep: {dt: 5 ms}\n"
	"bodies:\n"
	"  - shape: {type: box, size: [0.1, 0.1, 0.2], cells: [2, 2, 4]}\n"
	"    material: {law: stable_neo_hookean, density: 1000, young: 1e5, poisson: 0.3}\n"
	"    loads: [{where: {face: x+}, force: [3, 0, -1]}, {where: {%s}, force: [1, 2, 0]}]\n";

// 2 kg under 4, 2 and -1 N for 0.1 s.
static void loads_move_the_centre_of_mass(void** state) {
	(void)state;
	Run run;
	const double expected[3] = {0.4, 0.2, -0.1};
	run_open(&run, 1, block, "face: z+");
	run_steps(&run, 20);
	const JnEnergies e = jn_model_energies(run.model, run_state(&run));
	for (int axis = 0; axis < 3; ++axis)
		expect_near(e.momentum[axis], expected[axis], 1e-9, "momentum %d after the loads' impulse", axis); // Newton's
	run_close(&run);
}

// From rest, so that all energies begin at 0: what the loads do is kinetic and elastic. The midpoint rule keeps it but
// for the nonlinearity of the law at strains of some 1e-2.
static void what_loads_do_is_kinetic_and_elastic(void** state) {
	(void)state;
	Run run;
	run_open(&run, 1, block, "face: z+");
	run_steps(&run, 40);
	const JnEnergies e = jn_model_energies(run.model, run_state(&run));
	assert_true(e.gravity < -0.01);
	expect_near((e.kinetic + e.elastic) / -e.gravity, 1, 1e-4, "energy over the work of the loads");
	run_close(&run);
}

static void a_load_on_no_node_is_refused_with_its_place(void** state) {
	(void)state;
	Run run;
	log_capture();
	const JnStatus status = run_attempt(&run, block, "box: {min: [5, 5, 5], max: [6, 6, 6]}");
	print_message("%s", log_text());
	assert_int_equal(status, JN_BAD_INPUT);
	assert_non_null(strstr(log_text(), "bodies[0].loads[1].where"));
	log_release();
	run_close(&run);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(loads_move_the_centre_of_mass),
		cmocka_unit_test(what_loads_do_is_kinetic_and_elastic),
		cmocka_unit_test(a_load_on_no_node_is_refused_with_its_place),
	};
	return cmocka_run_group_tests(tests, case_set_up, case_tear_down);
}
