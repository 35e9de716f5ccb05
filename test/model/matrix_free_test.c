/// @file matrix_free_test.c
/// Bonds without a matrix against the same with one: products, steps, damping; threads; what is refused.
#include "force/peridynamic.h"
#include "model/stretch.h"
#include "model/system.h"
#include "support/model_case.h"

enum { ASSEMBLED, PRODUCTS, DIRECT, WAYS, OPTIONS = 256 };

typedef struct BondCase {
	ModelCase base;
	char shape[OPTIONS];
	JnPeridynamicDef law;
	JnCgDef cg;
	JnArena arena;
} BondCase;

static const JnRow* fill_row(BondCase* c, const JnRowList* list, const char* name, const char* yaml, void* options) {
	const JnRow* row = row_named(list, name);
	JnDocument document;
	assert_true(row->options_size <= OPTIONS);
	assert_int_equal(jn_document_parse(name, yaml, &c->arena, &document), JN_OK);
	assert_int_equal(jn_keys_read(row->keys, document.root, "", &c->arena, options), JN_OK);
	return row;
}

// A bar of 6 x 3 x 3 spacings and bonds of two, held at one end.
static void case_bonds(BondCase* c, int way) {
	memset(c, 0, sizeof *c);
	case_box(&c->base, JN_HEX8, "linear");
	case_gravity(&c->base, 0, 2, -9.81);
	JnBodyDef* body = &c->base.body;
	const char* shape = "{size: [0.6, 0.3, 0.3], spacing: 0.1, jitter: 0.1}";
	body->shape = (JnVariant){fill_row(c, &jn_shape_list, "points_box", shape, c->shape), c->shape};
	body->material.row = fill_row(c, &jn_law_list, "peridynamic",
								  "{density: 1000, young: 1e5, critical_stretch: 100, horizon_spacings: 2}", &c->law);
	body->material.options = &c->law;
	c->base.fix[0].where = face_select(FACE_X_LOW);
	body->mass = 1;
	if (way == DIRECT) return;
	const char* solver = way == PRODUCTS ? "{tolerance: 1e-12}" : "{tolerance: 1e-12, matrix: assembled}";
	c->base.sim.model.solver = (JnVariant){fill_row(c, &jn_solver_list, "cg", solver, &c->cg), &c->cg};
}

static void a_matrix_free_model_has_diagonal_blocks_alone(void** state) {
	(void)state;
	for (int way = 0; way < WAYS; ++way) {
		BondCase c;
		Rig rig;
		case_bonds(&c, way);
		rig_create(&rig, &c.base, 1);
		assert_int_equal(rig.model->is_matrix_free, way == PRODUCTS);
		assert_int_equal(rig.model->pattern.blocks == rig.nodes, way == PRODUCTS);
		rig_destroy(&rig);
		jn_arena_free(&c.arena);
	}
}

static double stretch_of(int way) {
	BondCase c;
	Rig rig;
	uint64_t seed = 7;
	double moved[3 * 64];
	case_bonds(&c, way);
	rig_create(&rig, &c.base, 1);
	assert_true(rig.length <= 3 * 64);
	fill_random(&seed, 0.01, rig.length, moved);
	for (int k = 0; k < rig.length; ++k) moved[k] += rig.start.x[k];
	const double stretch = jn_model_stretch(rig.model, rig.start.x, moved);
	rig_destroy(&rig);
	jn_arena_free(&c.arena);
	return stretch;
}

static void a_stretch_needs_no_matrix(void** state) {
	(void)state;
	const double with = stretch_of(ASSEMBLED), without = stretch_of(PRODUCTS);
	print_message("stretch %g with a matrix, %g without\n", with, without);
	assert_true(with > 0 && with == without);
}

// K, D and M of a shaken bar times a vector.
static double* products_of(int way, int threads, int* length) {
	BondCase c;
	Rig rig;
	JnMatrix* matrix = NULL;
	case_bonds(&c, way);
	c.base.body.damping = (JnDampingDef){.alpha = 3, .beta = 0.01};
	rig_create(&rig, &c.base, threads);
	rig_shake(&rig, 11, 0.03, 0.5);
	double *in = malloc((size_t)rig.length * sizeof *in), *out = malloc((size_t)rig.length * sizeof *out);
	uint64_t seed = 5;
	fill_random(&seed, 1, rig.length, in);
	assert_int_equal(rig.sys->ops->linearize(rig.sys, &rig.start), JN_OK);
	assert_int_equal(rig.sys->ops->matrix(rig.sys, (JnShift){1, 0.1, 0.01}, &matrix), JN_OK);
	matrix->ops->apply(matrix, in, out);
	*length = rig.length;
	free(in);
	rig_destroy(&rig);
	jn_arena_free(&c.arena);
	return out;
}

static void products_are_those_of_the_assembled_matrix(void** state) {
	(void)state;
	int length;
	double *expected = products_of(ASSEMBLED, 1, &length), *value = products_of(PRODUCTS, 1, &length);
	// the same sums in another order: rounding of some hundred terms
	expect_near(largest_difference(value, expected, length), 0, 1e-13 * largest_size(expected, length), "products");
	free(expected);
	free(value);
}

static void the_number_of_threads_changes_no_bit(void** state) {
	(void)state;
	int length;
	double *one = products_of(PRODUCTS, 1, &length), *three = products_of(PRODUCTS, 3, &length);
	assert_memory_equal(one, three, (size_t)length * sizeof *one);
	free(one);
	free(three);
}

static void all_ways_give_the_same_motion(void** state) {
	(void)state;
	static const char* const methods[] = {"linearized_newmark", "backward_euler", "newmark", "sdirk2"};
	for (size_t m = 0; m < sizeof methods / sizeof *methods; ++m) {
		double x[WAYS][600];
		int length = 0;
		for (int way = 0; way < WAYS; ++way) {
			BondCase c;
			Rig rig;
			case_bonds(&c, way);
			case_method(&c.base, row_named(&jn_integrator_list, methods[m]));
			c.base.body.damping.beta = 1e-3;
			rig_create(&rig, &c.base, 1);
			for (int i = 0; i < 10; ++i) rig_step(&rig, 0.01);
			length = rig.length;
			memcpy(x[way], rig.start.x, (size_t)length * sizeof(double));
			rig_destroy(&rig);
			jn_arena_free(&c.arena);
		}
		for (int way = 0; way < DIRECT; ++way) // the bar falls by 0.03 m; tolerances of 1e-10 and 1e-12 a step
			expect_near(largest_difference(x[way], x[DIRECT], length), 0, 1e-10, "%s, way %d", methods[m], way);
	}
}

// With a rotation, a compression beyond rest and a large step the exact matrix is indefinite.
static void an_indefinite_matrix_gives_way_to_its_definite_form(void** state) {
	(void)state;
	double x[WAYS][600];
	int length = 0;
	for (int way = 0; way < WAYS; ++way) {
		BondCase c;
		Rig rig;
		case_bonds(&c, way);
		case_method(&c.base, row_named(&jn_integrator_list, "linearized_newmark"));
		rig_create(&rig, &c.base, 1);
		for (int k = 0; k < rig.length; ++k) rig.start.x[k] = 0.5 * jn_model_rest(rig.model)[k];
		rig_begin(&rig);
		assert_int_equal(rig_attempt(&rig, 0.2), JN_OK);
		assert_int_equal(rig.report.indefinite, 1);
		length = rig.length;
		memcpy(x[way], rig.end.x, (size_t)length * sizeof(double));
		rig_destroy(&rig);
		jn_arena_free(&c.arena);
	}
	for (int way = 0; way < DIRECT; ++way)
		expect_near(largest_difference(x[way], x[DIRECT], length), 0, 1e-8 * largest_size(x[DIRECT], length), "way %d",
					way);
}

static void a_step_makes_one_tangent(void** state) {
	(void)state;
	BondCase c;
	Rig rig;
	case_bonds(&c, PRODUCTS);
	case_method(&c.base, row_named(&jn_integrator_list, "linearized_newmark"));
	rig_create(&rig, &c.base, 1);
	for (int i = 0; i < 5; ++i) {
		rig_step(&rig, 0.01);
		assert_int_equal(rig.report.tangents, 1);
		assert_int_equal(rig.report.solves, 1);
	}
	rig_destroy(&rig);
	jn_arena_free(&c.arena);
}

static void too_many_bonds_for_a_factor_are_refused(void** state) {
	(void)state;
	BondCase c;
	JnModel* model = NULL;
	case_bonds(&c, DIRECT);
	fill_row(&c, &jn_shape_list, "points_box", "{size: [3, 3, 3], spacing: 0.1}", c.shape);
	assert_int_equal(jn_model_create(&c.base.sim.model, 1, &model), JN_BAD_INPUT);
	jn_arena_free(&c.arena);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_matrix_free_model_has_diagonal_blocks_alone),
		cmocka_unit_test(a_stretch_needs_no_matrix),
		cmocka_unit_test(products_are_those_of_the_assembled_matrix),
		cmocka_unit_test(the_number_of_threads_changes_no_bit),
		cmocka_unit_test(all_ways_give_the_same_motion),
		cmocka_unit_test(an_indefinite_matrix_gives_way_to_its_definite_form),
		cmocka_unit_test(a_step_makes_one_tangent),
		cmocka_unit_test(too_many_bonds_for_a_factor_are_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
