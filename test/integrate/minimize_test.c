/// @file minimize_test.c
/// Stages as minimisation: states from which the residual alone finds no way, what mode auto does about them, and that
/// nothing changes where the residual finds its way.
#include "support/model_case.h"
#include "support/point_system.h"

enum { ROOT, LINEAR, MINIMIZE, AUTO };
enum { SEEDS = 10, STEPS = 20 };

// A free box of 0.2 x 0.2 x 0.4 m, rather stiff, with every node thrown up to its length away: most elements inverted.
static void thrown_case(ModelCase* c, int element, int mode) {
	case_box(c, element, "stable_neo_hookean");
	c->material.young = 1e6;
	c->material.poisson = 0.4;
	c->body.fix.count = 0;
	c->sim.newton = (JnNewtonDef){.mode = mode, .tolerance = 1e-8, .max_iterations = 200, .guess = 2};
}

// Displacements around the rest positions, or around a single point. Forces are judged against those of this state.
static void throw_nodes(Rig* rig, uint64_t seed, double share_of_rest, double amplitude) {
	const double* rest = jn_model_rest(rig->model);
	for (int k = 0; k < rig->length; ++k) {
		rig->start.x[k] = share_of_rest * rest[k] + amplitude * random_number(&seed);
		rig->start.v[k] = 0;
	}
	rig->sys->force_scale = 0;
	rig_begin(rig);
}

static double total_energy(Rig* rig) {
	const JnEnergies e = jn_model_energies(rig->model, &rig->start);
	return e.kinetic + e.elastic + e.gravity;
}

typedef struct Outcomes {
	int seeds, steps, minimized; // that worked, of SEEDS and SEEDS * STEPS
} Outcomes;

static Outcomes run_thrown(int element, int mode, double share_of_rest, double amplitude) {
	Outcomes out = {0};
	ModelCase c;
	thrown_case(&c, element, mode);
	for (uint64_t seed = 1; seed <= SEEDS; ++seed) {
		Rig rig;
		int steps = 0;
		rig_create(&rig, &c, 1);
		throw_nodes(&rig, 7919 * seed, share_of_rest, amplitude);
		const double before = total_energy(&rig);
		for (; steps < STEPS && rig_attempt(&rig, 0.005) == JN_OK; ++steps) {
			out.minimized += rig.report.minimized;
			assert_true(rig.report.residual <= 1e-8); // the tolerance asked for
			rig_accept(&rig, 0.005);
		}
		if (!(total_energy(&rig) <= before)) fail_msg("seed %d: energy grew", (int)seed); // sdirk2 dissipates
		out.steps += steps;
		out.seeds += steps == STEPS;
		rig_destroy(&rig);
	}
	return out;
}

static void expect_all(const char* what, Outcomes out) {
	if (out.seeds != SEEDS || out.steps != SEEDS * STEPS)
		fail_msg("%s: %d steps of %d worked, %d seeds of %d", what, out.steps, SEEDS * STEPS, out.seeds, SEEDS);
}

static void minimize_solves_every_stage_of_thrown_hexahedra_and_tetrahedra(void** state) {
	(void)state;
	expect_all("hexahedra", run_thrown(JN_HEX8, MINIMIZE, 1, 0.4));
	expect_all("tetrahedra", run_thrown(JN_TET4, MINIMIZE, 1, 0.4));
}

static void auto_solves_them_too_and_says_that_it_changed_over(void** state) {
	(void)state;
	const Outcomes out = run_thrown(JN_HEX8, AUTO, 1, 0.4);
	expect_all("hexahedra", out);
	assert_true(out.minimized > 0);
}

// Otherwise the cases above would be no test.
static void root_fails_for_most_of_them(void** state) {
	(void)state;
	const Outcomes out = run_thrown(JN_HEX8, ROOT, 1, 0.4);
	if (2 * out.seeds > SEEDS) fail_msg("root solves %d of %d", out.seeds, SEEDS);
}

static void nearly_collapsed_bodies_open_again(void** state) {
	(void)state;
	expect_all("hexahedra within 1 cm", run_thrown(JN_HEX8, MINIMIZE, 0, 0.01));
	expect_all("hexahedra within 1 cm, auto", run_thrown(JN_HEX8, AUTO, 0, 0.01));
}

// All nodes in one point: every force is zero by symmetry, an equilibrium that the solver must accept as it is.
static void a_body_in_a_single_point_stays_there(void** state) {
	(void)state;
	for (int mode = MINIMIZE; mode <= AUTO; ++mode) {
		ModelCase c;
		Rig rig;
		thrown_case(&c, JN_HEX8, mode);
		rig_create(&rig, &c, 1);
		throw_nodes(&rig, 1, 0, 0);
		for (int i = 0; i < STEPS; ++i) rig_step(&rig, 0.005);
		expect_near(largest_size(rig.start.x, rig.length), 0, 1e-9, "positions"); // of a body of 0.4 m
		rig_destroy(&rig);
	}
}

// ---- where the residual finds its way

static void auto_gives_the_bits_of_root_where_root_converges(void** state) {
	(void)state;
	Rig rigs[2];
	for (int i = 0; i < 2; ++i) {
		ModelCase c;
		case_box(&c, JN_HEX8, "stable_neo_hookean");
		case_gravity(&c, 3, -9.81, 0);
		c.sim.newton =
			(JnNewtonDef){.mode = i == 0 ? ROOT : AUTO, .tolerance = 1e-8, .max_iterations = 200, .guess = 2};
		rig_create(&rigs[i], &c, 1);
		for (int step = 0; step < STEPS; ++step) rig_step(&rigs[i], 1.0 / 64);
	}
	assert_memory_equal(rigs[0].start.x, rigs[1].start.x, (size_t)rigs[0].length * sizeof(double));
	assert_memory_equal(rigs[0].start.v, rigs[1].start.v, (size_t)rigs[0].length * sizeof(double));
	rig_destroy(&rigs[0]);
	rig_destroy(&rigs[1]);
}

static void minimize_costs_no_more_than_twice_the_iterations_of_root_in_mild_states(void** state) {
	(void)state;
	int newton[2] = {0}, factorizations[2] = {0};
	for (int i = 0; i < 2; ++i) {
		ModelCase c;
		Rig rig;
		case_box(&c, JN_HEX8, "stable_neo_hookean");
		case_gravity(&c, 3, -9.81, 0);
		c.sim.newton =
			(JnNewtonDef){.mode = i == 0 ? ROOT : MINIMIZE, .tolerance = 1e-8, .max_iterations = 200, .guess = 2};
		rig_create(&rig, &c, 1);
		for (int step = 0; step < STEPS; ++step) {
			rig_step(&rig, 1.0 / 64);
			newton[i] += rig.report.newton;
			factorizations[i] += rig.report.factorizations;
		}
		rig_destroy(&rig);
	}
	if (newton[1] > 2 * newton[0] || factorizations[1] > 2 * factorizations[0])
		fail_msg("%d iterations and %d factorisations, root %d and %d", newton[1], factorizations[1], newton[0],
				 factorizations[0]);
}

// ---- forces without a known potential: three coordinates of 1 kg

// -dE/dx of a double well, E = 100 (x^2 - 1)^2, which the system keeps to itself. At x = 0 it pushes outwards: K < 0.
static double well(double x) {
	return -400 * x * (x * x - 1);
}

static double well_stiffness(double x) {
	return 400 * (3 * x * x - 1);
}

static void a_step_without_potential_is_solved_by_slopes(void** state) {
	(void)state;
	for (int mode = MINIMIZE; mode <= AUTO; ++mode)
		for (int start = -4; start <= 4; ++start) {
			PointSystem system;
			point_create(&system, well, well_stiffness);
			JnSpace* space = system.base.space;
			const JnVariant method = {.row = row_named(&jn_integrator_list, "backward_euler")};
			const JnNewtonDef newton = {.mode = mode, .tolerance = 1e-9, .max_iterations = 200};
			JnIntegrator* integrator = jn_integrator_create(&method, &newton, space);
			JnState s;
			assert_int_equal(jn_state_create(space, &s), JN_OK);
			JnVec x = space->ops->create(space), v = space->ops->create(space), a = space->ops->create(space);
			for (int k = 0; k < POINT_LENGTH; ++k) x[k] = 0.3 * start + 0.05 * (k + 1);
			const JnStage stage = {.kx = 1, .kv = 1, .x = x, .v = v};
			assert_int_equal(jn_stage_solve(integrator, &system.base, &stage, &s, a, &system.report), JN_OK);
			for (int k = 0; k < POINT_LENGTH; ++k)
				expect_near(well(s.x[k]) - a[k], 0, 1e-9, "residual"); // as asked for
			jn_state_destroy(space, &s);
			space->ops->destroy(space, x);
			space->ops->destroy(space, v);
			space->ops->destroy(space, a);
			jn_integrator_destroy(integrator);
			point_destroy(&system);
		}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(minimize_solves_every_stage_of_thrown_hexahedra_and_tetrahedra),
		cmocka_unit_test(auto_solves_them_too_and_says_that_it_changed_over),
		cmocka_unit_test(root_fails_for_most_of_them),
		cmocka_unit_test(nearly_collapsed_bodies_open_again),
		cmocka_unit_test(a_body_in_a_single_point_stays_there),
		cmocka_unit_test(auto_gives_the_bits_of_root_where_root_converges),
		cmocka_unit_test(minimize_costs_no_more_than_twice_the_iterations_of_root_in_mild_states),
		cmocka_unit_test(a_step_without_potential_is_solved_by_slopes),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
