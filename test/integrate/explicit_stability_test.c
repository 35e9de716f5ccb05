/// @file explicit_stability_test.c
/// The largest stable steps of explicit methods, with and without damping, on one node of a linear solid that moves along
/// one axis.
#include "integrate/explicit_methods.h"
#include "integrate/properties.h"

// The step of a linear oscillator is a matrix on (x, v / omega): its spectral radius at omega dt.
static double spectral_radius(Rig* rig, int entry, double omega, double phase) {
	const double rest = jn_model_rest(rig->model)[entry], size = 0.01;
	double m[2][2];
	for (int j = 0; j < 2; ++j) {
		rig->start.x[entry] = rest + (j == 0 ? size : 0);
		rig->start.v[entry] = j == 1 ? size * omega : 0;
		rig_begin(rig);
		assert_int_equal(rig_attempt(rig, phase / omega), JN_OK);
		m[0][j] = (rig->end.x[entry] - rest) / size;
		m[1][j] = rig->end.v[entry] / (size * omega);
	}
	const double mean = 0.5 * (m[0][0] + m[1][1]), determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0];
	const double root = mean * mean - determinant;
	return root < 0 ? sqrt(determinant) : fabs(mean) + sqrt(root);
}

// Rounding leaves 1e-12 in the matrix; its root stands in the radius within 1e-12 of a double eigenvalue only.
static const double growth = 1 + 1e-7;

// The first omega dt at which a step lets something grow, from steps of 0.01 and bisection.
static double stability_limit(Rig* rig, int entry, double omega) {
	double low = 0, high = 0.01;
	while (spectral_radius(rig, entry, omega, high) <= growth) {
		low = high;
		high += 0.01;
		assert_true(high < 10);
	}
	while (high - low > 1e-6) {
		const double middle = 0.5 * (low + high);
		if (spectral_radius(rig, entry, omega, middle) <= growth)
			low = middle;
		else
			high = middle;
	}
	return low;
}

typedef struct Oscillator {
	Cube cube;
	Rig rig;
	int entry;
	double omega; // [rad/s]
} Oscillator;

static void oscillator_start(Oscillator* o, const JnIntegratorType* type, double alpha) {
	oscillator_create(&o->cube, "linear", type);
	o->cube.c.body.damping = (JnDampingDef){.alpha = alpha};
	rig_create(&o->rig, &o->cube.c, 1);
	assert_int_equal(find_free(&o->rig, 1, &o->entry), 1);
	o->omega = sqrt(diagonal_entry(&o->rig, (JnShift){.stiffness = 1}, o->entry) /
					diagonal_entry(&o->rig, (JnShift){.mass = 1}, o->entry));
}

static void limits_of_stability_are_those_of_the_table(void** state) {
	(void)state;
	for (int i = 0; i < METHOD_COUNT; ++i) {
		Oscillator o;
		if (methods[i].limit == 0) continue;
		oscillator_start(&o, methods[i].type, 0);
		const double limit = stability_limit(&o.rig, o.entry, o.omega);
		print_message("%-18s largest omega dt %.5f, expected %.5f\n", methods[i].type->row.name, limit,
					  methods[i].limit);
		// the last digit that is known, bisection, and what the growth allowed to rounding moves: some 1e-6 each
		expect_near(limit, methods[i].limit, 1e-5, "limit of %s", methods[i].type->row.name);
		rig_destroy(&o.rig);
	}
}

static void check_damped_limit(const Method* method, double ratio, double expected) {
	Oscillator o;
	if (expected == 0) return;
	oscillator_start(&o, method->type, 0);
	const double alpha = 2 * ratio * o.omega;
	rig_destroy(&o.rig);
	oscillator_start(&o, method->type, alpha);
	const double limit = stability_limit(&o.rig, o.entry, o.omega);
	print_message("%-18s damping ratio %.2f: largest omega dt %.5f, expected %.3f\n", method->type->row.name, ratio,
				  limit, expected);
	// the table cuts digits off behind the third; the growth allowed to rounding adds 1e-5 at 0.01 of damping
	expect_near(limit, expected, 1e-3, "damped limit of %s", method->type->row.name);
	rig_destroy(&o.rig);
}

static void damping_shifts_the_limits_as_the_table_says(void** state) {
	(void)state;
	for (int i = 0; i < METHOD_COUNT; ++i) {
		check_damped_limit(&methods[i], 0.01, methods[i].limit_001);
		check_damped_limit(&methods[i], 0.1, methods[i].limit_01);
	}
}

// The kick with the old velocity, z = omega dt: |lambda| = 1 at lambda = -1, where 4 - z^2 - 4 xi z = 0.
static void the_limit_of_an_overdamped_motion_is_found(void** state) {
	(void)state;
	static const double ratios[] = {0.1, 1, 10, 100, 1e3, 1e6};
	for (size_t i = 0; i < sizeof ratios / sizeof *ratios; ++i) {
		const double xi = ratios[i], expected = 2 / (xi + sqrt(xi * xi + 1));
		double limit;
		assert_int_equal(jn_integrator_stability_limit(&jn_symplectic_euler, xi, &limit), JN_OK);
		print_message("damping ratio %g: limit %.6g, expected %.6g\n", xi, limit, expected);
		// the radius may exceed 1 by 1e-9, and grows by some xi times the change of z there
		expect_near(limit / expected, 1, 1e-6, "limit at a damping ratio of %g", xi);
	}
}

// Of the linear oscillator with z = omega dt: Euler |1 + iz|, midpoint sqrt(det) = sqrt(1 + z^2/2), half step sqrt(1 + z^4/4).
static void methods_without_limit_grow_at_every_step_size_by_what_theory_says(void** state) {
	(void)state;
	const JnIntegratorType* types[] = {&jn_explicit_euler, &jn_midpoint, &jn_half_step};
	for (int i = 0; i < 3; ++i) {
		Oscillator o;
		oscillator_start(&o, types[i], 0);
		for (double z = 0.05; z < 1.5; z *= 2) {
			const double squares[] = {1 + z * z, 1 + z * z / 2, 1 + z * z * z * z / 4};
			// rounding of 0.1 m against displacements of 0.01 m, over steps of 0.05 rad
			expect_near(spectral_radius(&o.rig, o.entry, o.omega, z), sqrt(squares[i]), 1e-11, "%s at omega dt %g",
						types[i]->row.name, z);
		}
		rig_destroy(&o.rig);
	}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(limits_of_stability_are_those_of_the_table),
		cmocka_unit_test(damping_shifts_the_limits_as_the_table_says),
		cmocka_unit_test(the_limit_of_an_overdamped_motion_is_found),
		cmocka_unit_test(methods_without_limit_grow_at_every_step_size_by_what_theory_says),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
