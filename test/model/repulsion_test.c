/// @file repulsion_test.c
/// Repulsion of points, a ball and a plate: force against energy, products against forces, Newton's third law, and that a
/// kept list of pairs changes no bit.
#include "force/peridynamic.h"
#include "force/rigid.h"
#include "model/repulsion.h"
#include "model/system.h"
#include "support/model_case.h"

enum { POINTS_OPTIONS = 256, BODIES = 4 };

// Two cubes of points, the second pushed into the first; a ball between them and a plate without end below.
typedef struct RepulsionCase {
	ModelCase base;
	JnBodyDef bodies[BODIES];
	char shapes[BODIES][POINTS_OPTIONS];
	JnPeridynamicDef law;
	JnRigidDef ball, plate;
	JnRepulsionDef repulsion;
	JnCgDef cg;
	JnArena arena;
} RepulsionCase;

static const JnRow* fill_row(RepulsionCase* c, const JnRowList* list, const char* name, const char* yaml,
							 void* options) {
	const JnRow* row = row_named(list, name);
	JnDocument document;
	assert_true(row->options_size <= POINTS_OPTIONS);
	assert_int_equal(jn_document_parse(name, yaml, &c->arena, &document), JN_OK);
	assert_int_equal(jn_keys_read(row->keys, document.root, "", &c->arena, options), JN_OK);
	return row;
}

static void case_repulsion(RepulsionCase* c, double speed) {
	static const char* const shapes[BODIES] = {
		"{size: [0.3, 0.3, 0.3], spacing: 0.1, jitter: 0.2}",
		"{origin: [0.32, 0.05, 0.02], size: [0.3, 0.3, 0.3], spacing: 0.1, jitter: 0.2}",
		"{center: [0.3, 0.15, 0.38], radius: 0.1}", "{point: [0.2, 0.1, -0.06], normal: [0.1, 0, 1], thickness: 0.1}"};
	memset(c, 0, sizeof *c);
	case_box(&c->base, JN_HEX8, "linear");
	fill_row(c, &jn_law_list, "peridynamic", "{density: 1000, young: 1e5, critical_stretch: 100, horizon_spacings: 2}",
			 &c->law);
	fill_row(c, &jn_law_list, "rigid", "{mass: 5}", &c->ball);
	c->plate = c->ball;
	fill_row(c, &jn_solver_list, "cg", "{tolerance: 1e-13}", &c->cg);
	c->repulsion = (JnRepulsionDef){.stiffness = 15, .reach = 1.35, .rest_share = 0.9, .margin = 0.2};
	for (int b = 0; b < BODIES; ++b) {
		static const char* const types[BODIES] = {"points_box", "points_box", "rigid_sphere", "rigid_plate"};
		static const char* const names[BODIES] = {"left", "right", "ball", "plate"};
		JnBodyDef* body = &c->bodies[b];
		*body = (JnBodyDef){.name = names[b]};
		body->shape = (JnVariant){fill_row(c, &jn_shape_list, types[b], shapes[b], c->shapes[b]), c->shapes[b]};
		body->material = b < 2 ? (JnVariant){row_named(&jn_law_list, "peridynamic"), &c->law}
							   : (JnVariant){row_named(&jn_law_list, "rigid"), b == 2 ? &c->ball : &c->plate};
	}
	c->bodies[1].velocity[0] = -speed;
	c->bodies[2].velocity[2] = -speed;
	c->base.sim.model.bodies = (JnItems){BODIES, c->bodies};
	c->base.sim.model.repulsion = &c->repulsion;
	c->base.sim.model.solver = (JnVariant){&jn_solver_cg.row, &c->cg};
}

static void free_case(RepulsionCase* c) {
	jn_arena_free(&c->arena);
}

// Push everything together, so that points, ball and plate overlap.
static void press(Rig* rig, double share, uint64_t seed) {
	const double* rest = jn_model_rest(rig->model);
	for (int k = 0; k < rig->length; ++k) rig->start.x[k] = share * rest[k] + 0.01 * random_number(&seed);
	rig_begin(rig);
}

static void force_is_minus_the_slope_of_the_energy(void** state) {
	(void)state;
	RepulsionCase c;
	Rig rig;
	case_repulsion(&c, 0);
	rig_create(&rig, &c.base, 1);
	double f[300] = {0}, d[300], x[300];
	press(&rig, 0.8, 5);
	memcpy(x, rig.start.x, (size_t)rig.length * sizeof *x);
	assert_int_equal(jn_repulsion_force(rig.model->repulsion, x, f), JN_OK);
	assert_true(jn_repulsion_touching(rig.model->repulsion) > 20);
	uint64_t seed = 3;
	for (int trial = 0; trial < 10; ++trial) {
		double energy[2], slope = 0;
		const double h = 1e-6;
		fill_random(&seed, 1, rig.length, d);
		for (int side = 0; side < 2; ++side) {
			for (int k = 0; k < rig.length; ++k) rig.start.x[k] = x[k] + (side == 0 ? -h : h) * d[k];
			energy[side] = jn_repulsion_energy(rig.model->repulsion, rig.start.x);
		}
		for (int k = 0; k < rig.length; ++k) slope -= f[k] * d[k];
		// error h^2 times third derivatives, and a pair that begins to touch within h: 1e-6 of the forces' sum
		expect_near((energy[1] - energy[0]) / (2 * h), slope, 1e-5 * largest_size(f, rig.length) * rig.length, "slope");
	}
	rig_destroy(&rig);
	free_case(&c);
}

static void products_are_differences_of_the_force(void** state) {
	(void)state;
	RepulsionCase c;
	Rig rig;
	case_repulsion(&c, 0);
	rig_create(&rig, &c.base, 1);
	JnSystem* sys = rig.sys;
	JnMatrix* matrix = NULL;
	double f[2][300], d[300], x[300], product[300];
	press(&rig, 0.8, 6);
	memcpy(x, rig.start.x, (size_t)rig.length * sizeof *x);
	assert_int_equal(sys->ops->linearize(sys, &rig.start), JN_OK);
	assert_int_equal(sys->ops->matrix(sys, (JnShift){.stiffness = 1}, &matrix), JN_OK);
	uint64_t seed = 4;
	for (int trial = 0; trial < 5; ++trial) {
		const double h = 1e-7;
		fill_random(&seed, 1, rig.length, d);
		for (int side = 0; side < 2; ++side) {
			for (int k = 0; k < rig.length; ++k) rig.start.x[k] = x[k] + (side == 0 ? h : -h) * d[k];
			jn_state_touch(rig.space, &rig.start);
			assert_int_equal(sys->ops->force(sys, &rig.start, f[side]), JN_OK);
		}
		matrix->ops->apply(matrix, d, product); // K is that of the linearize, whatever forces were asked for since
		const double scale = largest_size(product, rig.length);
		for (int k = 0; k < rig.length; ++k)
			expect_near((f[1][k] - f[0][k]) / (2 * h), product[k], 1e-5 * scale, "K d, entry %d", k);
	}
	rig_destroy(&rig);
	free_case(&c);
}

static void the_definite_form_has_no_negative_curvature(void** state) {
	(void)state;
	RepulsionCase c;
	Rig rig;
	case_repulsion(&c, 0);
	rig_create(&rig, &c.base, 1);
	press(&rig, 0.35, 7); // turning wins where r is below 2 d / 3
	assert_int_equal(jn_repulsion_linearize(rig.model->repulsion, rig.start.x), JN_OK);
	uint64_t seed = 8;
	bool was_negative = false;
	for (int trial = 0; trial < 200; ++trial) {
		double p[300], y[2][300] = {{0}}, sum[2] = {0};
		fill_random(&seed, 1, rig.length, p);
		jn_repulsion_product(rig.model->repulsion, JN_DEFINITE, 1, p, y[0]);
		jn_repulsion_product(rig.model->repulsion, JN_EXACT, 1, p, y[1]);
		for (int k = 0; k < rig.length; ++k)
			for (int i = 0; i < 2; ++i) sum[i] += p[k] * y[i][k];
		assert_true(sum[0] >= 0 && sum[1] < sum[0]);
		was_negative |= sum[1] < 0;
	}
	assert_true(was_negative); // else nothing was tested
	rig_destroy(&rig);
	free_case(&c);
}

static void a_kept_list_changes_no_bit(void** state) {
	(void)state;
	RepulsionCase c[2];
	Rig rig[2];
	for (int i = 0; i < 2; ++i) {
		case_repulsion(&c[i], 0);
		c[i].repulsion.margin = i == 0 ? 0.001 : 5;
		rig_create(&rig[i], &c[i].base, 1);
	}
	uint64_t seed = 9;
	double x[300];
	for (int trial = 0; trial < 50; ++trial) {
		double f[2][300] = {{0}};
		const double* rest = jn_model_rest(rig[0].model);
		for (int k = 0; k < rig[0].length; ++k) x[k] = (1 - 0.005 * trial) * rest[k] + 0.03 * random_number(&seed);
		for (int i = 0; i < 2; ++i) assert_int_equal(jn_repulsion_force(rig[i].model->repulsion, x, f[i]), JN_OK);
		assert_memory_equal(f[0], f[1], sizeof f[0]);
	}
	for (int i = 0; i < 2; ++i) {
		rig_destroy(&rig[i]);
		free_case(&c[i]);
	}
}

// The right cube and the ball fly into the rest; the plate is free too.
static void collisions_keep_momentum_and_energy(void** state) {
	(void)state;
	static const char* const methods[] = {"verlet", "newmark", "linearized_newmark"};
	for (int m = 0; m < 3; ++m) {
		RepulsionCase c;
		Rig rig;
		case_repulsion(&c, 2);
		case_method(&c.base, row_named(&jn_integrator_list, methods[m]));
		rig_create(&rig, &c.base, 1);
		const JnEnergies before = jn_model_energies(rig.model, &rig.start);
		int touching = 0;
		for (int i = 0; i < 400; ++i) {
			rig_step(&rig, 2e-4);
			touching += jn_repulsion_touching(rig.model->repulsion);
		}
		const JnEnergies after = jn_model_energies(rig.model, &rig.start);
		assert_true(touching > 400);
		for (int a = 0; a < 3; ++a) // M v of some 100 kg m/s; the solver leaves 1e-13 of it a step
			expect_near(after.momentum[a], before.momentum[a], 1e-8, "%s: momentum", methods[m]);
		const double total = before.kinetic + before.elastic;
		assert_true(after.elastic > 0.01 * total);
		// second order: (omega dt)^2 / 12 with the stiffest pair's omega dt of 0.3
		expect_near(after.kinetic + after.elastic, total, 0.02 * total, "%s: energy", methods[m]);
		rig_destroy(&rig);
		free_case(&c);
	}
}

static void a_ball_rebounds_from_a_fixed_plate(void** state) {
	(void)state;
	RepulsionCase c;
	Rig rig;
	JnFixDef fix = {.where = face_select(FACE_ALL), .axes = "xyz"};
	case_repulsion(&c, 3);
	c.ball.stiffness = c.plate.stiffness = 1e5;
	c.bodies[3].fix = (JnItems){1, &fix};
	fill_row(&c, &jn_shape_list, "rigid_plate", "{point: [0, 0, 0], normal: [0, 0, 1], thickness: 0.1}", c.shapes[3]);
	c.base.sim.model.bodies = (JnItems){2, c.bodies + 2};
	case_method(&c.base, row_named(&jn_integrator_list, "verlet"));
	rig_create(&rig, &c.base, 1);
	double lowest = 1;
	for (int i = 0; i < 4000; ++i) {
		rig_step(&rig, 1e-4);
		lowest = fmin(lowest, rig.start.x[2]);
	}
	// 1/2 m v^2 = 1/2 k g^2: it sinks in by 3 sqrt(5 / 1e5) = 0.0212 m, omega dt = 0.014, and leaves as fast as it came
	expect_near(lowest, 0.15 - 3 * sqrt(5 / 1e5), 1e-5, "lowest place of the ball");
	expect_near(rig.start.v[2], 3, 1e-3, "speed after the rebound");
	rig_destroy(&rig);
	free_case(&c);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(force_is_minus_the_slope_of_the_energy),
		cmocka_unit_test(products_are_differences_of_the_force),
		cmocka_unit_test(the_definite_form_has_no_negative_curvature),
		cmocka_unit_test(a_kept_list_changes_no_bit),
		cmocka_unit_test(collisions_keep_momentum_and_energy),
		cmocka_unit_test(a_ball_rebounds_from_a_fixed_plate),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
