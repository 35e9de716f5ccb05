/// @file symplectic_test.c
/// The geometry of explicit steps: which maps (x, v) -> (x+, v+) are symplectic, which are undone by a step of -dt, and
/// what follows for the energy over a hundred thousand steps.
#include "integrate/explicit_methods.h"

enum { MOST_FREE = 12, MOST = 2 * MOST_FREE };

typedef struct Map {
	Cube cube;
	Rig rig;
	int count, entries[MOST_FREE]; // free coordinates
	double mass[MOST_FREE];        // [kg]
	double dt;
} Map;

// A cube in full motion, deformed by about a tenth of its edge. Its largest frequency is some 44 rad/s.
static void map_create(Map* map, const JnIntegratorType* type, double dt) {
	map->dt = dt;
	cube_create(&map->cube, "stable_neo_hookean", type);
	case_gravity(&map->cube.c, 1, -9.81, 0.5);
	rig_create(&map->rig, &map->cube.c, 1);
	map->count = find_free(&map->rig, MOST_FREE, map->entries);
	assert_int_equal(map->count, MOST_FREE);
	for (int i = 0; i < map->count; ++i)
		map->mass[i] = diagonal_entry(&map->rig, (JnShift){.mass = 1}, map->entries[i]);
	rig_shake(&map->rig, 17, 0.01, 1);
}

// Coordinate i of a state: positions, then velocities.
static double* coordinate(const Map* map, JnState* s, int i) {
	return i < map->count ? &s->x[map->entries[i]] : &s->v[map->entries[i - map->count]];
}

// Column j of d(end) / d(start), by central differences: 1e-6 m, or the velocity that makes it in a step, leave a
// truncation of (1e-6 / 0.1)^2 and rounding of 1e-17 m / 1e-6 m.
static void differentiate(Map* map, int j, double jacobian[MOST][MOST]) {
	Rig* rig = &map->rig;
	double* varied = coordinate(map, &rig->start, j);
	const double value = *varied, h = j < map->count ? 1e-6 : 1e-6 / map->dt;
	for (int side = -1; side <= 1; side += 2) {
		*varied = value + side * h;
		rig_begin(rig);
		assert_int_equal(rig_attempt(rig, map->dt), JN_OK);
		for (int i = 0; i < 2 * map->count; ++i) {
			const double half = side * *coordinate(map, &rig->end, i) / (2 * h);
			jacobian[i][j] = side < 0 ? half : jacobian[i][j] + half;
		}
	}
	*varied = value;
}

// Largest entry of J^T W J - W, where W = [0 M; -M 0], over (x, dt v) so that all entries have one unit, and over the
// largest mass.
static double symplectic_defect(Map* map) {
	double jacobian[MOST][MOST], most = 0, heaviest = 0;
	const int n = map->count;
	for (int j = 0; j < 2 * n; ++j) differentiate(map, j, jacobian);
	for (int i = 0; i < n; ++i) heaviest = fmax(heaviest, map->mass[i]);
	for (int a = 0; a < 2 * n; ++a)
		for (int b = 0; b < 2 * n; ++b) {
			double sum = 0;
			for (int k = 0; k < n; ++k)
				sum += map->mass[k] * (jacobian[k][a] * jacobian[n + k][b] - jacobian[n + k][a] * jacobian[k][b]);
			if (b == a + n) sum -= map->mass[a];
			if (a == b + n) sum += map->mass[b];
			// d/d(dt v) = d/dv / dt, and W carries v = (dt v) / dt
			const double unit = map->dt / (heaviest * (a < n ? 1 : map->dt) * (b < n ? 1 : map->dt));
			most = fmax(most, fabs(sum * unit));
		}
	return most;
}

static void compositions_are_symplectic_and_no_other_method_is(void** state) {
	(void)state;
	for (int i = 0; i < METHOD_COUNT; ++i) {
		Map map;
		map_create(&map, methods[i].type, 8e-3);
		const double defect = symplectic_defect(&map);
		print_message("%-18s defect %.2e\n", methods[i].type->row.name, defect);
		if (methods[i].is_symplectic)
			expect_near(defect, 0, 1e-7, "defect of %s", methods[i].type->row.name); // what differences leave
		else
			assert_true(defect > 1e-5); // rk4, the least, has 8e-5 at 0.35 rad a step
		rig_destroy(&map.rig);
	}
}

// After dt and -dt, over (x, dt v) [m].
static double return_defect(Map* map) {
	Rig* rig = &map->rig;
	double start[MOST], most = 0;
	for (int i = 0; i < 2 * map->count; ++i) start[i] = *coordinate(map, &rig->start, i);
	rig_step(rig, map->dt);
	rig_step(rig, -map->dt);
	for (int i = 0; i < 2 * map->count; ++i) {
		const double unit = i < map->count ? 1 : map->dt;
		most = fmax(most, unit * fabs(*coordinate(map, &rig->start, i) - start[i]));
	}
	return most;
}

static void symmetric_compositions_are_undone_by_a_step_back_and_no_other_method_is(void** state) {
	(void)state;
	for (int i = 0; i < METHOD_COUNT; ++i) {
		Map map;
		map_create(&map, methods[i].type, 8e-3);
		const double defect = return_defect(&map);
		print_message("%-18s returns within %.2e m\n", methods[i].type->row.name, defect);
		if (methods[i].reverses)
			expect_near(defect, 0, 1e-12, "%s", methods[i].type->row.name); // some rounding of 0.1 m
		else
			assert_true(defect > 1e-7); // rk4, the least: 1.5e-6 m
		rig_destroy(&map.rig);
	}
}

static void driven_nodes_do_not_hinder_the_way_back(void** state) {
	(void)state;
	for (int i = 0; i < METHOD_COUNT; ++i) {
		ModelCase c;
		Rig rig;
		if (!methods[i].reverses) continue;
		case_box(&c, JN_HEX8, "stable_neo_hookean");
		case_drive(&c, FACE_Z_HIGH, 0.02, 8);
		c.body.mass = 1;
		c.sim.integrator.row = &methods[i].type->row;
		rig_create(&rig, &c, 1);
		rig_shake(&rig, 5, 0.002, 0.1);
		double* x = rig.space->ops->create(rig.space);
		assert_non_null(x);
		memcpy(x, rig.start.x, (size_t)rig.length * sizeof *x);
		rig_step(&rig, 2e-3);
		assert_true(largest_difference(rig.start.x, x, rig.length) > 1e-5); // it moved
		rig_step(&rig, -2e-3);
		expect_near(largest_difference(rig.start.x, x, rig.length), 0, 1e-12, "%s", methods[i].type->row.name);
		rig.space->ops->destroy(rig.space, x);
		rig_destroy(&rig);
	}
}

static double total_energy(const Rig* rig) {
	const JnEnergies e = jn_model_energies(rig->model, &rig->start);
	return e.kinetic + e.elastic + e.gravity;
}

// Energy errors over that of the start: largest in the first and in the second half, and mean over each half.
typedef struct Drift {
	double first, second, mean_first, mean_second;
} Drift;

static Drift run(const JnIntegratorType* type, int steps) {
	Map map;
	Drift out = {0};
	map_create(&map, type, 4e-3);
	const double start = total_energy(&map.rig);
	assert_true(start > 0);
	for (int step = 0; step < steps; ++step) {
		rig_step(&map.rig, map.dt);
		const double error = total_energy(&map.rig) / start - 1;
		double* most = step < steps / 2 ? &out.first : &out.second;
		double* mean = step < steps / 2 ? &out.mean_first : &out.mean_second;
		*most = fmax(*most, fabs(error));
		*mean += error / (steps / 2);
	}
	rig_destroy(&map.rig);
	print_message("%-18s %d steps: energy error %.3e, then %.3e; mean %.3e, then %.3e\n", type->row.name, steps,
				  out.first, out.second, out.mean_first, out.mean_second);
	return out;
}

// The error oscillates with the motion and returns: its largest value is met again and again, its mean stays.
static void verlet_keeps_the_energy_over_a_hundred_thousand_steps(void** state) {
	(void)state;
	const Drift drift = run(&jn_verlet, 100000);
	assert_true(drift.first < 0.0154 && drift.second < 0.0154); // (0.18 rad)^2 / 2
	// twelve incommensurate oscillations meet their extremes at random, and keep the mean to a fraction of them
	expect_near(drift.mean_second, drift.mean_first, 0.1 * drift.first, "mean error of the second half");
}

static void half_step_gains_energy_and_rk4_loses_it(void** state) {
	(void)state;
	const Drift half = run(&jn_half_step, 300), rk4 = run(&jn_rk4, 20000);
	assert_true(half.mean_first > 0 && half.mean_second > 2 * half.mean_first); // steady growth: 3 times
	assert_true(rk4.mean_first < 0 && rk4.mean_second < 2 * rk4.mean_first);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(compositions_are_symplectic_and_no_other_method_is),
		cmocka_unit_test(symmetric_compositions_are_undone_by_a_step_back_and_no_other_method_is),
		cmocka_unit_test(driven_nodes_do_not_hinder_the_way_back),
		cmocka_unit_test(verlet_keeps_the_energy_over_a_hundred_thousand_steps),
		cmocka_unit_test(half_step_gains_energy_and_rk4_loses_it),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
