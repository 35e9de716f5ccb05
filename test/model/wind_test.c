/// @file wind_test.c
/// The wind on a model: total force, derivatives, threads, gusts, and what it does to the orders of integrators.
#include "model/wind.h"

#include "jounce/scene.h"
#include "model/system.h"
#include "support/model_case.h"
#include "table/order_sweep.h"

typedef struct WindCase {
	ModelCase model;
	JnGustDef gusts;
	JnWindDef wind;
} WindCase;

// The box of case_box in a wind that is oblique to all its faces.
static void windy_case(WindCase* c, int element) {
	case_box(&c->model, element, "stable_neo_hookean");
	c->gusts = (JnGustDef){.strength = 3, .period = 0.2, .wavelength = 0.7, .seed = 4, .components = 8};
	c->wind = (JnWindDef){.velocity = {20, -15, 10}, .density = 1.225, .gusts = &c->gusts};
	c->model.body.drag = 1.3;
	c->model.sim.model.wind = &c->wind;
}

static double* new_vector(const Rig* rig) {
	double* vector = rig->space->ops->create(rig->space);
	assert_non_null(vector);
	return vector;
}

static void free_vector(const Rig* rig, double* vector) {
	rig->space->ops->destroy(rig->space, vector);
}

static void a_box_at_rest_feels_pressure_before_and_suction_behind(void** state) {
	(void)state;
	for (int element = 0; element < JN_SOLID_SHAPE_COUNT; ++element) {
		WindCase c;
		Rig rig;
		windy_case(&c, element);
		c.wind.gusts = NULL;
		rig_create(&rig, &c.model, 1);
		double *f = new_vector(&rig), sum[3] = {0, 0, 0};
		assert_int_equal(rig.sys->ops->force(rig.sys, &rig.start, f), JN_OK);
		for (int k = 0; k < rig.length; ++k) sum[k % 3] += f[k];
		const double face[3] = {0.2 * 0.4, 0.2 * 0.4, 0.2 * 0.2}; // [m^2], normal to x, y, z: two of each
		for (int a = 0; a < 3; ++a) {
			const double u = c.wind.velocity[a], expected = 2 * 0.5 * 1.225 * 1.3 * face[a] * u * fabs(u);
			// some hundred triangles, each rounded by 1e-16; at rest, elastic forces leave rounding of 1e-13 N
			expect_near(sum[a], expected, 1e-11, "force along axis %d", a);
		}
		assert_false(rig.sys->depends_on_time);
		free_vector(&rig, f);
		rig_destroy(&rig);
	}
}

static void a_body_without_drag_feels_no_wind(void** state) {
	(void)state;
	WindCase c, calm;
	Rig rig, other;
	windy_case(&c, JN_HEX8);
	windy_case(&calm, JN_HEX8);
	c.model.body.drag = 0;
	calm.model.sim.model.wind = NULL;
	rig_create(&rig, &c.model, 1);
	rig_create(&other, &calm.model, 1);
	rig_shake(&rig, 5, 0.01, 1);
	rig_shake(&other, 5, 0.01, 1);
	double *f = new_vector(&rig), *expected = new_vector(&other);
	assert_int_equal(rig.sys->ops->force(rig.sys, &rig.start, f), JN_OK);
	assert_int_equal(other.sys->ops->force(other.sys, &other.start, expected), JN_OK);
	assert_memory_equal(f, expected, (size_t)rig.length * sizeof *f);
	assert_false(rig.sys->depends_on_time);
	free_vector(&rig, f);
	free_vector(&other, expected);
	rig_destroy(&rig);
	rig_destroy(&other);
}

static void the_wind_is_no_energy(void** state) {
	(void)state;
	WindCase c;
	Rig rig, calm;
	windy_case(&c, JN_HEX8);
	rig_create(&rig, &c.model, 1);
	c.model.sim.model.wind = NULL;
	rig_create(&calm, &c.model, 1);
	rig_shake(&rig, 5, 0.01, 1);
	rig_shake(&calm, 5, 0.01, 1);
	assert_true(rig.sys->ops->energy(rig.sys, &rig.start) == calm.sys->ops->energy(calm.sys, &calm.start));
	assert_false(rig.sys->has_potential);
	assert_true(calm.sys->has_potential);
	assert_true(rig.sys->depends_on_time); // gusts
	rig_destroy(&rig);
	rig_destroy(&calm);
}

// 37,632 triangles: enough for two threads to be woken.
static void forces_and_products_have_the_same_bits_for_any_number_of_threads(void** state) {
	(void)state;
	WindCase c;
	double* first[2] = {NULL, NULL};
	windy_case(&c, JN_HEX8);
	c.wind.tangent = 1;
	c.model.box = (JnBoxDef){.size = {1, 0.01, 1}, .cells = {96, 1, 96}, .element = JN_HEX8};
	for (int threads = 1; threads <= 2; ++threads) {
		Rig rig;
		rig_create(&rig, &c.model, threads);
		rig_shake(&rig, 5, 0.002, 1);
		const JnWind* wind = ((JnModelSystem*)rig.sys)->model->wind;
		assert_int_equal(wind->triangles, 4 * 96 * 96 + 8 * 96);
		double* now[2] = {calloc((size_t)rig.length, sizeof(double)), calloc((size_t)rig.length, sizeof(double))};
		jn_wind_force(wind, &rig.start, now[0]);
		assert_true(jn_wind_linearize((JnWind*)(uintptr_t)wind, &rig.start));
		jn_wind_apply(wind, (JnShift){1, 0.1, 0.01}, rig.start.v, now[1]);
		for (int i = 0; i < 2; ++i) {
			if (threads == 1) first[i] = now[i];
			assert_memory_equal(now[i], first[i], (size_t)rig.length * sizeof(double));
			if (threads > 1) free(now[i]);
		}
		rig_destroy(&rig);
	}
	free(first[0]);
	free(first[1]);
}

// (f(x - h d) - f(x + h d)) / 2h, or the same over v.
static void force_difference(Rig* rig, const double* d, double h, double* vector, double* out) {
	double *f = new_vector(rig), *at = new_vector(rig);
	memcpy(at, vector, (size_t)rig->length * sizeof *at);
	for (int side = 0; side < 2; ++side) {
		for (int k = 0; k < rig->length; ++k) vector[k] = at[k] + (side == 0 ? -h : h) * d[k];
		jn_state_touch(rig->space, &rig->start);
		assert_int_equal(rig->sys->ops->force(rig->sys, &rig->start, f), JN_OK);
		for (int k = 0; k < rig->length; ++k) out[k] = side == 0 ? f[k] / (2 * h) : out[k] - f[k] / (2 * h);
	}
	memcpy(vector, at, (size_t)rig->length * sizeof *at);
	jn_state_touch(rig->space, &rig->start);
	free_vector(rig, f);
	free_vector(rig, at);
}

static void expect_products(Rig* rig, const char* what) {
	double *d = new_vector(rig), *difference = new_vector(rig), *product = new_vector(rig);
	uint64_t seed = 5;
	fill_random(&seed, 1, rig->length, d);
	for (int part = 0; part < 2; ++part) { // K over x at constant v, D over v
		force_difference(rig, d, 1e-6, part == 0 ? rig->start.x : rig->start.v, difference);
		assert_int_equal(rig->sys->ops->linearize(rig->sys, &rig->start), JN_OK);
		JnMatrix* matrix = NULL;
		const JnShift shift = part == 0 ? (JnShift){.stiffness = 1} : (JnShift){.damping = 1};
		assert_int_equal(rig->sys->ops->matrix(rig->sys, shift, &matrix), JN_OK);
		matrix->ops->apply(matrix, d, product);
		const double scale = largest_size(product, rig->length);
		assert_true(scale > 0);
		// truncation h^2 f''' / 6, and rounding 1e-16 / h of the elastic forces' sum: below 1e-6 of K d, and of D d, which
		// is far smaller than K d but comes from a difference over v alone
		expect_near(largest_difference(product, difference, rig->length) / scale, 0, part == 0 ? 1e-6 : 1e-5,
					"%s times a vector, %s", part == 0 ? "K" : "D", what);
	}
	free_vector(rig, d);
	free_vector(rig, difference);
	free_vector(rig, product);
}

static void products_with_the_exact_tangent_are_differences_of_the_force(void** state) {
	(void)state;
	for (int element = 0; element < JN_SOLID_SHAPE_COUNT; ++element) {
		WindCase c;
		Rig rig;
		windy_case(&c, element);
		c.wind.tangent = 1;
		c.wind.density = 1000; // as strong as the elastic part
		c.model.box.cells[2] = 1;
		rig_create(&rig, &c.model, 1);
		rig_shake(&rig, 11, 0.01, 0.5);
		expect_products(&rig, jn_shape_info[element].name);
		rig_destroy(&rig);
	}
}

static void without_a_tangent_products_know_nothing_of_the_wind(void** state) {
	(void)state;
	WindCase c;
	Rig rig, calm;
	windy_case(&c, JN_HEX8);
	rig_create(&rig, &c.model, 1);
	c.model.sim.model.wind = NULL;
	rig_create(&calm, &c.model, 1);
	Rig* both[2] = {&rig, &calm};
	double* out[2];
	for (int i = 0; i < 2; ++i) {
		rig_shake(both[i], 5, 0.01, 1);
		out[i] = new_vector(both[i]);
		JnMatrix* matrix = NULL;
		assert_int_equal(both[i]->sys->ops->linearize(both[i]->sys, &both[i]->start), JN_OK);
		assert_int_equal(both[i]->sys->ops->matrix(both[i]->sys, (JnShift){1, 1e-3, 1e-6}, &matrix), JN_OK);
		matrix->ops->apply(matrix, both[i]->start.v, out[i]);
		assert_int_equal(matrix->ops->solve(matrix, out[i], out[i]), JN_OK);
	}
	assert_memory_equal(out[0], out[1], (size_t)rig.length * sizeof(double));
	for (int i = 0; i < 2; ++i) {
		free_vector(both[i], out[i]);
		rig_destroy(both[i]);
	}
}

static void solve_inverts_apply_with_the_exact_tangent(void** state) {
	(void)state;
	WindCase c;
	Rig rig;
	windy_case(&c, JN_HEX8);
	c.wind.tangent = 1;
	c.wind.density = 1000;
	c.model.body.damping = (JnDampingDef){.alpha = 3, .beta = 0.01};
	rig_create(&rig, &c.model, 1);
	double *z = new_vector(&rig), *rhs = new_vector(&rig), *out = new_vector(&rig);
	uint64_t seed = 17;
	for (int round = 0; round < 2; ++round) { // new factors for a new state, and for new velocities alone
		rig_shake(&rig, 13, 0.005, round == 0 ? 0.5 : 5);
		assert_int_equal(rig.sys->ops->linearize(rig.sys, &rig.start), JN_OK);
		fill_random(&seed, 1, rig.length, z);
		rig.sys->ops->hold(rig.sys, z);
		for (int small = 0; small < 2; ++small) {
			JnMatrix* matrix = NULL;
			const JnShift shift = small ? (JnShift){1, 1e-3, 1e-6} : (JnShift){1, 1e-2, 1e-4};
			assert_int_equal(rig.sys->ops->matrix(rig.sys, shift, &matrix), JN_OK);
			matrix->ops->apply(matrix, z, rhs);
			assert_int_equal(matrix->ops->solve(matrix, rhs, out), JN_OK);
			expect_near(largest_difference(out, z, rig.length), 0, 1e-10, "solve"); // condition below 1e4
		}
	}
	free_vector(&rig, z);
	free_vector(&rig, rhs);
	free_vector(&rig, out);
	rig_destroy(&rig);
}

static void velocities_alone_renew_the_tangent_and_nothing_else_does(void** state) {
	(void)state;
	WindCase c;
	Rig rig;
	windy_case(&c, JN_HEX8);
	c.wind.tangent = 1;
	rig_create(&rig, &c.model, 1);
	rig_shake(&rig, 13, 0.005, 0.5);
	JnMatrix* matrix = NULL;
	double* out = new_vector(&rig);
	assert_int_equal(rig.sys->ops->linearize(rig.sys, &rig.start), JN_OK);
	assert_int_equal(rig.sys->ops->matrix(rig.sys, (JnShift){1, 1e-3, 1e-6}, &matrix), JN_OK);
	assert_int_equal(matrix->ops->solve(matrix, rig.start.v, out), JN_OK);
	assert_true(matrix->is_factored);
	assert_int_equal(rig.sys->ops->linearize(rig.sys, &rig.start), JN_OK);
	assert_true(matrix->is_factored);
	rig.start.v[rig.length - 1] += 1; // the stamp tells of t and x alone
	assert_int_equal(rig.sys->ops->linearize(rig.sys, &rig.start), JN_OK);
	assert_false(matrix->is_factored);
	free_vector(&rig, out);
	rig_destroy(&rig);
}

// ---- gusts

static void air_of(const JnGusts* gusts, double t, const double x[3], double u[3], double gradient[9]) {
	JnAir air;
	jn_gusts_at(gusts, t, &air);
	jn_air_at(&air, x, u, gradient);
}

static void gusts_have_their_strength_over_time(void** state) {
	(void)state;
	for (int kind = 0; kind < 2; ++kind)
		for (int seed = 0; seed < 3; ++seed) {
			JnGustDef def = {
				.strength = 2, .period = 0.5, .wavelength = kind == 0 ? NAN : 1.5, .seed = seed, .components = 8};
			const JnWindDef wind = {.velocity = {1, 2, 3}, .gusts = &def};
			JnGusts gusts;
			jn_gusts_create(&wind, &gusts);
			const int samples = 200000;
			double sum = 0, mean[3] = {0, 0, 0};
			for (int i = 0; i < samples; ++i) {
				double u[3], gradient[9];
				air_of(&gusts, 0.0123 * i, (double[]){0.3, -0.4, 0.7}, u, gradient);
				for (int a = 0; a < 3; ++a) {
					sum += (u[a] - wind.velocity[a]) * (u[a] - wind.velocity[a]) / samples;
					mean[a] += u[a] / samples;
				}
			}
			// beats of neighbouring frequencies, some 0.1 Hz apart, over 2460 s: their mean is below 1 / (2 pi 0.1 2460)
			expect_near(sqrt(sum), 2, 0.02, "strength, seed %d", seed);
			for (int a = 0; a < 3; ++a) expect_near(mean[a], wind.velocity[a], 0.02, "mean, axis %d", a);
		}
}

static void gusts_are_those_of_their_seed_smooth_and_keep_volume(void** state) {
	(void)state;
	JnGustDef def = {.strength = 2, .period = 0.5, .wavelength = 1.5, .seed = 7, .components = 8};
	const JnWindDef wind = {.gusts = &def};
	JnGusts gusts, again, other;
	jn_gusts_create(&wind, &gusts);
	jn_gusts_create(&wind, &again);
	++def.seed;
	jn_gusts_create(&wind, &other);
	double most = 0;
	for (int i = 0; i < 400; ++i) {
		const double t = 0.05 * i - 3, x[3] = {0.01 * i, 0.2, -0.3};
		double u[3], same[3], later[3], unlike[3], gradient[9], unused[9];
		air_of(&gusts, t, x, u, gradient);
		air_of(&again, t, x, same, unused);
		air_of(&other, t, x, unlike, unused);
		air_of(&gusts, t + 1e-7, x, later, unused);
		assert_memory_equal(u, same, sizeof u);
		most = fmax(most, largest_difference(u, unlike, 3));
		// |du/dt| <= sum of a 2 pi f <= 8 2 sqrt(2/8) 2 pi 4 = 201 m/s^2
		assert_true(largest_difference(u, later, 3) <= 201 * 1e-7 + 1e-12);
		assert_true(fabs(gradient[0] + gradient[4] + gradient[8]) <= 1e-12); // terms below 50, rounded
	}
	assert_true(most > 1);
}

static void waves_travel_at_wavelength_over_period(void** state) {
	(void)state;
	JnGustDef def = {.strength = 1, .period = 0.5, .wavelength = 1.5, .seed = 7, .components = 1};
	const JnWindDef wind = {.gusts = &def};
	JnGusts gusts;
	jn_gusts_create(&wind, &gusts);
	const double* k = gusts.start.wave[0];
	const double length = sqrt(k[0] * k[0] + k[1] * k[1] + k[2] * k[2]);
	for (int i = 0; i < 20; ++i) {
		double here[3], there[3], gradient[9];
		const double t = 0.13 * i, x[3] = {3.0 * t * k[0] / length, 3.0 * t * k[1] / length, 3.0 * t * k[2] / length};
		air_of(&gusts, 0, (double[]){0, 0, 0}, here, gradient);
		air_of(&gusts, t, x, there, gradient);                                  // 1.5 m / 0.5 s = 3 m/s
		expect_near(largest_difference(here, there, 3), 0, 1e-12, "t = %g", t); // phases up to 100 rad, rounded
	}
}

// ---- integrators

#define WIND "wind={velocity: [30, -20, 25], density: 3, gusts: {strength: 2, period: 0.05, wavelength: 0.5}, tangent: "

static JnStatus create_exact(OrderMass mass, OrderSystem* out) {
	return order_create_solid(mass, WIND "exact}", out);
}

static JnStatus create_none(OrderMass mass, OrderSystem* out) {
	return order_create_solid(mass, WIND "none}", out);
}

static const OrderProblem windy_solids[] = {
	{.name = "solid in the wind", .create = create_none, ORDER_SOLID},
	{.name = "solid in the wind, exact", .create = create_exact, ORDER_SOLID},
};

typedef struct Expectation {
	const char* method;
	bool falls; ///< loses its order without the exact tangent
} Expectation;

static const Expectation expectations[] = {
	{"sdirk2", false},
	{"sdirk3", false},
	{"esdirk325", false},
	{"ros2", false},
	{"ros34pw2", false},
	{"ros3p", true},
	{"ros3pl", true},
	{"ros3prl2", true},
	{"rodas3", true},
	{"rodas4", true},
	{"exponential_rosenbrock", true},
};
enum { EXPECTATION_COUNT = sizeof expectations / sizeof *expectations };

static OrderResult measure(const OrderProblem* problem, const OrderSystem* system, const OrderSolution* reference,
						   const char* method) {
	OrderResult result = {.type = (const JnIntegratorType*)row_named(&jn_integrator_list, method)};
	result.expected = result.type->order;
	order_measure(problem, system, reference, &result);
	print_message("%-26s %-10s order %d: measured %.3f (plain %.2f, error %.2e)\n", problem->name, method,
				  result.expected, result.measured, result.plain, result.error);
	return result;
}

// W-methods (ros2, ros34pw2) keep their order with any matrix, DIRK methods because they iterate; the rest need the exact
// one. Both tangents are judged by one reference, as the equations are the same.
static void rosenbrock_methods_need_the_exact_tangent_and_others_do_not(void** state) {
	(void)state;
	OrderSystem system;
	OrderSolution reference;
	assert_int_equal(windy_solids[0].create(ORDER_MASS_OWN, &system), JN_OK);
	assert_int_equal(order_simulate(&windy_solids[0], &system, "esdirk436", windy_solids[0].reference, &reference),
					 JN_OK);
	order_system_destroy(&system);
	int wrong = 0;
	for (int exact = 0; exact < 2; ++exact) {
		assert_int_equal(windy_solids[exact].create(ORDER_MASS_OWN, &system), JN_OK);
		for (int i = 0; i < EXPECTATION_COUNT; ++i) {
			const OrderResult r = measure(&windy_solids[exact], &system, &reference, expectations[i].method);
			const bool has_order = order_is_met(&r), has_less = r.measured < r.expected - 0.5;
			wrong += expectations[i].falls && exact == 0 ? !has_less : !has_order;
		}
		order_system_destroy(&system);
	}
	assert_int_equal(wrong, 0);
}

static void every_method_runs_in_the_wind(void** state) {
	(void)state;
	for (int exact = 0; exact < 2; ++exact)
		for (int mass = 0; mass < 2; ++mass) {
			OrderSystem system;
			OrderSolution reference = {0}, end = {0};
			OrderProblem problem = windy_solids[exact];
			problem.duration = 1.0 / 256;
			assert_int_equal(problem.create(mass, &system), JN_OK);
			assert_int_equal(order_simulate(&problem, &system, "esdirk436", 16, &reference), JN_OK);
			for (int i = 0; i < jn_integrator_list.count; ++i) {
				const JnIntegratorType* type = (const JnIntegratorType*)jn_integrator_list.rows[i];
				if (((type->needs & JN_NEEDS_DIAGONAL_MASS) != 0) != (mass == ORDER_MASS_DIAGONAL)) continue;
				if (order_simulate(&problem, &system, type->row.name, 64, &end) != JN_OK)
					fail_msg("%s fails in the wind", type->row.name);
				// methods of first order: half of the step 6e-5 s times accelerations of 100 m/s^2, in m
				const double error = order_difference(1, &end, NULL, &reference);
				expect_near(error, 0, 3e-4, "%s, exact %d", type->row.name, exact);
			}
			order_system_destroy(&system);
		}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_box_at_rest_feels_pressure_before_and_suction_behind),
		cmocka_unit_test(a_body_without_drag_feels_no_wind),
		cmocka_unit_test(the_wind_is_no_energy),
		cmocka_unit_test(forces_and_products_have_the_same_bits_for_any_number_of_threads),
		cmocka_unit_test(products_with_the_exact_tangent_are_differences_of_the_force),
		cmocka_unit_test(without_a_tangent_products_know_nothing_of_the_wind),
		cmocka_unit_test(solve_inverts_apply_with_the_exact_tangent),
		cmocka_unit_test(velocities_alone_renew_the_tangent_and_nothing_else_does),
		cmocka_unit_test(gusts_have_their_strength_over_time),
		cmocka_unit_test(gusts_are_those_of_their_seed_smooth_and_keep_volume),
		cmocka_unit_test(waves_travel_at_wavelength_over_period),
		cmocka_unit_test(rosenbrock_methods_need_the_exact_tangent_and_others_do_not),
		cmocka_unit_test(every_method_runs_in_the_wind),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
