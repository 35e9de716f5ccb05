/// @file peridynamic_physics_test.c
/// What continuum mechanics says about bodies of bonds: stiffness, the speed of waves, momentum, the price of a crack.
#include "force/bond.h"
#include "pass/pass_case.h"

static const double young = 72e9, density = 2440; // soda-lime glass

static double mean_of(const Run* run, const double low[3], const double high[3], int axis, const double* values) {
	double sum = 0;
	int count = 0;
	for (int node = 0; node < run->length / 3; ++node) {
		const double* X = jn_model_rest(run->model) + 3 * (size_t)node;
		bool is_in = true;
		for (int a = 0; a < 3; ++a) is_in &= X[a] >= low[a] && X[a] <= high[a];
		if (!is_in) continue;
		sum += values[3 * node + axis];
		++count;
	}
	assert_true(count > 0);
	return sum / count;
}

// Mean strain along x between two cross-sections a fifth of the length from the ends.
static double strain_of(const Run* run, double length, const double* size, double spacing) {
	const double* x = run_state(run)->x;
	double place[2], rest[2];
	for (int i = 0; i < 2; ++i) {
		const double at = length * (i == 0 ? 0.3 : 0.7);
		const double low[3] = {at - 0.6 * spacing, 0, -1}, high[3] = {at + 0.6 * spacing, size[1], size[2]};
		place[i] = mean_of(run, low, high, 0, x);
		rest[i] = mean_of(run, low, high, 0, jn_model_rest(run->model));
	}
	return (place[1] - place[0]) / (rest[1] - rest[0]) - 1;
}

// Stress along x: force of the bonds that cross the middle plane within a window of its centre, a share of each edge wide.
static double stress_inside(const Run* run, const double* size, const double share[3]) {
	const JnGroup* group = &run->model->groups[0];
	const double *rest = jn_model_rest(run->model), *x = run_state(run)->x, middle = size[0] / 2;
	double sum = 0;
	for (int b = 0; b < group->count; ++b) {
		const JnBond bond = jn_bond_get(group, b);
		const size_t i = 3 * (size_t)bond.nodes[0], j = 3 * (size_t)bond.nodes[1];
		if ((rest[i] < middle) == (rest[j] < middle)) continue;
		const double at = (middle - rest[i]) / (rest[j] - rest[i]);
		bool is_in = true;
		for (size_t a = 1; a < 3; ++a)
			is_in &= fabs(rest[i + a] + at * (rest[j + a] - rest[i + a]) - size[a] / 2) < share[a] * size[a] / 2;
		double y[3], length = 0;
		for (size_t a = 0; a < 3; ++a) y[a] = x[j + a] - x[i + a], length += y[a] * y[a];
		length = sqrt(length);
		if (is_in) sum += bond.force * (length / bond.length - 1) * fabs(y[0]) / length;
	}
	return sum / (share[1] * size[1] * share[2] * size[2]);
}

typedef struct Moduli {
	double whole, inside; // over that of the material
} Moduli;

// Pulled at both ends; steps far longer than any period of backward Euler are a relaxation to equilibrium.
static Moduli pull(const char* shape, const char* material, const double size[3], double spacing,
				   const double share[3]) {
	Run run;
	const double stress = 1e-5 * young, force = stress * size[1] * size[2];
	run_open(&run, 1,
			 "gravity: [0, 0, 0]\nduration: 1 s\nintegrator: backward_euler\nstep: {dt: 1 ms}\n"
			 "bodies:\n"
			 "  - shape: {type: points_box, size: [%g, %g, %g], spacing: %g, %s}\n"
			 "    material: {law: peridynamic, density: %g, young: %g, critical_stretch: 1000, %s}\n"
			 "    loads:\n"
			 "      - {where: {face: x-}, force: [%.17g, 0, 0]}\n"
			 "      - {where: {face: x+}, force: [%.17g, 0, 0]}\n",
			 size[0], size[1], size[2], spacing, shape, density, young, material, -force, force);
	run_steps(&run, 6);
	const double strain = strain_of(&run, size[0], size, spacing) * young;
	const Moduli out = {stress / strain, stress_inside(&run, size, share) / strain};
	run_close(&run);
	print_message("%s, %s: E is %.4f of what was asked for, inside %.4f\n", shape, material, out.whole, out.inside);
	return out;
}

// Inside, and of a plate as a whole. Three per cent is what the anisotropy of a lattice with three points in the horizon
// leaves.
static void a_stretched_body_has_its_modulus(void** state) {
	(void)state;
	const double plate[3] = {0.06, 0.03, 0.001}, block[3] = {0.018, 0.012, 0.012};
	static const char* const surfaces[] = {"energy", "volume", "none"};
	for (int k = 0; k < 6; ++k) {
		char material[128];
		snprintf(material, sizeof material, "surface: %s, volume: %s", surfaces[k % 3], k < 3 ? "partial" : "none");
		const Moduli moduli = pull("layer: true", material, plate, 0.001, (double[3]){1, 1.0 / 3, 1});
		if (k > 0) continue;
		expect_near(moduli.whole, 1, 0.03, "E of a plate");
		expect_near(moduli.inside, 1, 0.03, "E of a plate, inside");
	}
	const Moduli moduli = pull("layer: false", "surface: energy", block, 0.001, (double[3]){1, 1.0 / 3, 1.0 / 3});
	expect_near(moduli.inside, 1, 0.03, "E of a block, inside");
}

// A strip that flies against a wall: the front at which it comes to rest runs along it, so that the momentum falls
// linearly and is gone after L / c, with the speed c = sqrt(E / rho) of waves in a thin bar.
static void waves_in_a_strip_have_the_speed_of_a_bar(void** state) {
	(void)state;
	Run run;
	const double expected = sqrt(young / density), dt = 1e-7;
	run_open(&run, 1,
			 "gravity: [0, 0, 0]\nduration: 1 s\nintegrator: verlet\nstep: {dt: %g s}\n"
			 "bodies:\n"
			 "  - shape: {type: points_box, size: [0.163, 0.02, 0.001], spacing: 0.001, layer: true}\n"
			 "    material: {law: peridynamic, density: %g, young: %g, critical_stretch: 1000}\n"
			 "    velocity: [0.1, 0, 0]\n"
			 "    fix: [{where: {box: {min: [0, 0, 0], max: [0.003, 1, 1]}}, axes: x}]\n",
			 dt, density, young);
	double before = 1, now = 1;
	while (now > 0) {
		run_step(&run);
		before = now;
		now = jn_model_energies(run.model, run_state(&run)).momentum[0];
	}
	const double t = run_state(&run)->t - dt * now / (now - before), length = 0.16; // of what is free
	expect_near(length / t / expected, 1, 0.03, "speed of the wave over that of a bar");
	run_close(&run);
}

// Sums of bond forces vanish by construction; 5000 bonds of forces up to 1e3 N over 1e-5 s round to this.
static void a_free_body_that_cracks_keeps_its_momentum(void** state) {
	(void)state;
	Run run;
	run_open(&run, 1,
			 "gravity: [0, 0, 0]\nduration: 1 s\nintegrator: verlet\nstep: {dt: 0.1 us}\n"
			 "bodies:\n"
			 "  - shape: {type: points_box, size: [0.02, 0.01, 0.001], spacing: 0.001, layer: true, jitter: 0.2}\n"
			 "    material: {law: peridynamic, density: %g, young: %g, critical_stretch: 0.001}\n"
			 "    velocity: [3, 1, 0]\n"
			 "    spin: [0, 0, 60000]\n",
			 density, young);
	const JnEnergies before = jn_model_energies(run.model, run_state(&run));
	const double total = before.kinetic + before.elastic;
	run_steps(&run, 400);
	const JnEnergies after = jn_model_energies(run.model, run_state(&run));
	assert_true(run_column(&run, "fracture.broken_total") > 100);
	assert_true(run_column(&run, "fracture.fragments") > 1);
	for (int axis = 0; axis < 3; ++axis) {
		expect_near(after.momentum[axis], before.momentum[axis], 1e-12, "momentum %d", axis);
		expect_near(after.angular[axis], before.angular[axis], 1e-13, "angular momentum %d", axis);
	}
	// with what has broken, up to the energy error of verlet at a tenth of the shortest period
	expect_near((after.kinetic + after.elastic + run_column(&run, "fracture.energy")) / total, 1, 0.01, "energy");
	run_close(&run);
}

// The upper half is lifted by small steps, and every bond across breaks as soon as it may.
static double price_of_a_crack(const char* body, double spacings, double height, double area) {
	Run run;
	run_open(&run, 1,
			 "gravity: [0, 0, 0]\nduration: 1 s\nintegrator: verlet\nstep: {dt: 0.1 us}\nsolver: {method: cg}\n"
			 "bodies:\n"
			 "  - shape: {type: points_box, %s}\n"
			 "    material: {law: peridynamic, density: %g, young: %g, fracture_energy: 135, horizon_spacings: %g}\n",
			 body, density, young, spacings);
	const double lift = 4e-4; // more than sqrt(2 s0) times the longest bond
	JnGroup* group = &run.model->groups[0];
	const double* rest = jn_model_rest(run.model);
	double* x = malloc((size_t)run.length * sizeof *x);
	int* broken = malloc((size_t)group->count * sizeof *broken);
	double released = 0;
	assert_true(x != NULL && broken != NULL);
	for (int step = 1; step <= 2000; ++step) {
		for (int k = 0; k < run.length; ++k) {
			const bool is_lifted = k % 3 == 1 && rest[k] > height;
			x[k] = rest[k] + (is_lifted ? lift * step / 2000 : 0);
		}
		group->kernel->damage(group, 0, group->batches, x, NULL, broken, &released);
	}
	for (int b = 0; b < group->count; ++b) {
		const JnBond bond = jn_bond_get(group, b);
		const bool is_across = (rest[3 * bond.nodes[0] + 1] > height) != (rest[3 * bond.nodes[1] + 1] > height);
		assert_true((bond.force == 0) == is_across);
	}
	free(x);
	free(broken);
	run_close(&run);
	return released / area;
}

// Bonds that lie nearly along the plane must be lifted far: by sqrt(2 s0) of their length.
static void separating_a_plane_costs_the_fracture_energy(void** state) {
	(void)state;
	const char* const layer = "size: [0.08, 0.02, 0.001], spacing: 0.001, layer: true";
	const double plate = price_of_a_crack(layer, 3, 0.01, 0.08 * 0.001);
	const double dense = price_of_a_crack(layer, 6, 0.01, 0.08 * 0.001);
	const double block = price_of_a_crack("size: [0.024, 0.012, 0.024], spacing: 0.001", 3, 0.006, 0.024 * 0.024);
	expect_near(plate / 135, 1, 0.1, "energy of an area of crack in a plate, over G0");
	expect_near(dense / 135, 1, 0.1, "the same with twice as many points in the horizon");
	expect_near(block / 135, 1, 0.1, "energy of an area of crack in a block, over G0");
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_stretched_body_has_its_modulus),
		cmocka_unit_test(waves_in_a_strip_have_the_speed_of_a_bar),
		cmocka_unit_test(a_free_body_that_cracks_keeps_its_momentum),
		cmocka_unit_test(separating_a_plane_costs_the_fracture_energy),
	};
	return cmocka_run_group_tests(tests, case_set_up, case_tear_down);
}
