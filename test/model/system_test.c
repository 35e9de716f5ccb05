/// @file system_test.c
/// The verbs of a model against each other: force = -d energy/dx, matrix = -d force, solve inverts apply, and stamps
/// that spare work without ever serving an edited state.
#include "support/model_case.h"

static const char* const laws[] = {
	"linear", "st_venant_kirchhoff", "neo_hookean", "stable_neo_hookean", "corotated_frozen", "corotated"};
enum { LAW_COUNT = sizeof laws / sizeof *laws };

// Two bodies' worth of trouble in one: partly held nodes, gravity, a shaken state and velocities.
static void troubled_case(ModelCase* c, int element, const char* law) {
	case_box(c, element, law);
	case_gravity(c, 1, -9.81, 0.5);
	c->box.cells[2] = element == JN_TET10 ? 1 : 2;
	c->box.cells[0] = element == JN_TET10 ? 1 : 2;
	c->fix[1] = (JnFixDef){.where = face_select(FACE_X_HIGH), .axes = "y"};
	c->body.fix.count = 2;
}

static double* new_vector(const Rig* rig) {
	double* vector = rig->space->ops->create(rig->space);
	assert_non_null(vector);
	return vector;
}

static void free_vector(const Rig* rig, double* vector) {
	rig->space->ops->destroy(rig->space, vector);
}

// Force along a direction against the energy's central difference, which has an error of O(h^2) and rounding / h:
// h = 1e-6 of the displacements leaves 1e-9 of the energy's scale.
static void check_force_of(int element, const char* law) {
	ModelCase c;
	Rig rig;
	troubled_case(&c, element, law);
	rig_create(&rig, &c, 1);
	rig_shake(&rig, 7, 0.01, 0); // no velocity: no damping force
	double *f = new_vector(&rig), *d = new_vector(&rig), *x = new_vector(&rig);
	assert_int_equal(rig.sys->ops->force(rig.sys, &rig.start, f), JN_OK);
	memcpy(x, rig.start.x, (size_t)rig.length * sizeof *x);
	uint64_t seed = 3;
	for (int trial = 0; trial < 4; ++trial) {
		fill_random(&seed, 1, rig.length, d);
		const double h = 1e-6;
		double energy[2];
		for (int side = 0; side < 2; ++side) {
			for (int k = 0; k < rig.length; ++k) rig.start.x[k] = x[k] + (side == 0 ? -h : h) * d[k];
			jn_state_touch(rig.space, &rig.start);
			energy[side] = rig.sys->ops->energy(rig.sys, &rig.start);
		}
		const double expected = -(energy[1] - energy[0]) / (2 * h), value = rig.space->ops->dot(rig.space, f, d);
		const double scale = largest_size(f, rig.length) * sqrt(rig.length);
		expect_near(value, expected, 1e-6 * scale, "force of %s along a direction", law);
	}
	free_vector(&rig, f);
	free_vector(&rig, d);
	free_vector(&rig, x);
	rig_destroy(&rig);
}

static void force_is_minus_the_slope_of_the_energy(void** state) {
	(void)state;
	for (int element = 0; element < JN_SOLID_SHAPE_COUNT; ++element)
		for (int i = 0; i < LAW_COUNT; ++i) check_force_of(element, laws[i]);
}

// (f(x - h d) - f(x + h d)) / 2h, or the same over v.
static void force_difference(Rig* rig, const double* d, double h, double* vector, double* out) {
	double* f = new_vector(rig);
	double* at = new_vector(rig);
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

static void check_products_of(int element, const char* law) {
	ModelCase c;
	Rig rig;
	troubled_case(&c, element, law);
	c.body.damping = (JnDampingDef){.alpha = 3, .beta = 0.01};
	rig_create(&rig, &c, 1);
	rig_shake(&rig, 11, 0.01, 0.5);
	double *d = new_vector(&rig), *difference = new_vector(&rig), *product = new_vector(&rig);
	uint64_t seed = 5;
	fill_random(&seed, 1, rig.length, d);
	for (int part = 0; part < 2; ++part) { // K over x without velocity, as D is frozen; then D over v
		double* over = part == 0 ? rig.start.x : rig.start.v;
		force_difference(&rig, d, 1e-6, over, difference);
		assert_int_equal(rig.sys->ops->linearize(rig.sys, &rig.start), JN_OK);
		JnMatrix* matrix = NULL;
		const JnShift shift = part == 0 ? (JnShift){.stiffness = 1} : (JnShift){.damping = 1};
		assert_int_equal(rig.sys->ops->matrix(rig.sys, shift, &matrix), JN_OK);
		matrix->ops->apply(matrix, d, product);
		const double scale = largest_size(product, rig.length);
		assert_true(scale > 0);
		// truncation h^2 f''' / 6 and rounding 1e-16 / h of the forces' sum, each below 1e-7 of the product
		expect_near(largest_difference(product, difference, rig.length) / scale, 0, 1e-6, "%s times a vector, %s",
					part == 0 ? "K" : "D", law);
	}
	free_vector(&rig, d);
	free_vector(&rig, difference);
	free_vector(&rig, product);
	rig_destroy(&rig);
}

static void products_with_K_and_D_are_differences_of_the_force(void** state) {
	(void)state;
	for (int element = 0; element < JN_SOLID_SHAPE_COUNT; ++element)
		for (int i = 0; i < LAW_COUNT; ++i) check_products_of(element, laws[i]);
}

static void linearize_brings_damping_of_the_current_state_up_to_date(void** state) {
	(void)state;
	ModelCase c;
	Rig rig;
	troubled_case(&c, JN_HEX8, "stable_neo_hookean");
	c.body.damping = (JnDampingDef){.beta = 0.01, .stiffness = 2};
	rig_create(&rig, &c, 1);
	double *d = new_vector(&rig), *first = new_vector(&rig), *second = new_vector(&rig);
	uint64_t seed = 5;
	fill_random(&seed, 1, rig.length, d);
	rig_shake(&rig, 11, 0.02, 0);
	// now an edit without begin: D must be that of this state, as the contract of linearize says
	for (int k = 0; k < rig.length; ++k) rig.start.x[k] += 0.02 * random_number(&seed);
	rig.sys->ops->prescribe(rig.sys, &rig.start, NULL);
	jn_state_touch(rig.space, &rig.start);
	JnMatrix* matrix = NULL;
	assert_int_equal(rig.sys->ops->linearize(rig.sys, &rig.start), JN_OK);
	assert_int_equal(rig.sys->ops->matrix(rig.sys, (JnShift){.damping = 1}, &matrix), JN_OK);
	matrix->ops->apply(matrix, d, first);
	assert_int_equal(rig.sys->ops->begin(rig.sys, &rig.start), JN_OK); // makes D here
	assert_int_equal(rig.sys->ops->matrix(rig.sys, (JnShift){.damping = 1}, &matrix), JN_OK);
	matrix->ops->apply(matrix, d, second);
	assert_memory_equal(first, second, (size_t)rig.length * sizeof *first);
	free_vector(&rig, d);
	free_vector(&rig, first);
	free_vector(&rig, second);
	rig_destroy(&rig);
}

static void check_inverse(const ModelCase* c, JnShift shift, const char* what) {
	Rig rig;
	rig_create(&rig, c, 1);
	rig_shake(&rig, 13, 0.005, 0.5);
	assert_int_equal(rig.sys->ops->linearize(rig.sys, &rig.start), JN_OK);
	double *z = new_vector(&rig), *rhs = new_vector(&rig), *out = new_vector(&rig);
	uint64_t seed = 17;
	fill_random(&seed, 1, rig.length, z);
	rig.sys->ops->hold(rig.sys, z);
	JnMatrix* matrix = NULL;
	assert_int_equal(rig.sys->ops->matrix(rig.sys, shift, &matrix), JN_OK);
	matrix->ops->apply(matrix, z, rhs); // held rows of rhs are not zero: solve must not see them
	rig.report = (JnReport){0};
	assert_int_equal(matrix->ops->solve(matrix, rhs, out), JN_OK);
	assert_int_equal(rig.report.indefinite, 0);
	// condition number of M + kv D + kx K here is below 1e4; the mass matrices' below 1e2
	expect_near(largest_difference(out, z, rig.length), 0, 1e-10, "%s: solve after apply", what);
	fill_random(&seed, 1, rig.length, rhs);
	assert_int_equal(matrix->ops->solve(matrix, rhs, out), JN_OK);
	double* held = new_vector(&rig);
	memcpy(held, out, (size_t)rig.length * sizeof *held);
	rig.sys->ops->hold(rig.sys, held);
	assert_memory_equal(held, out, (size_t)rig.length * sizeof *held); // held entries are 0 as they are
	free_vector(&rig, held);
	free_vector(&rig, z);
	free_vector(&rig, rhs);
	free_vector(&rig, out);
	rig_destroy(&rig);
}

static void solve_inverts_apply_on_free_entries_and_zeroes_the_held(void** state) {
	(void)state;
	for (int element = 0; element < JN_SOLID_SHAPE_COUNT; ++element)
		for (int mass = 0; mass < 2; ++mass) {
			ModelCase c;
			troubled_case(&c, element, "stable_neo_hookean");
			c.body.mass = mass;
			c.body.damping = (JnDampingDef){.alpha = 3, .beta = 0.01};
			check_inverse(&c, (JnShift){.mass = 1}, "M");
			check_inverse(&c, (JnShift){.mass = 2.5}, "2.5 M");
			check_inverse(&c, (JnShift){1, 1e-3, 1e-6}, "M + kv D + kx K, small step");
			check_inverse(&c, (JnShift){1, 1e-2, 1e-4}, "M + kv D + kx K, large step");
		}
}

static void the_same_stamp_is_evaluated_once(void** state) {
	(void)state;
	ModelCase c;
	Rig rig;
	troubled_case(&c, JN_HEX8, "stable_neo_hookean");
	rig_create(&rig, &c, 1);
	rig_shake(&rig, 19, 0.01, 0);
	double *f = new_vector(&rig), *again = new_vector(&rig);
	rig.start.x[rig.length - 1] += 0.001;
	jn_state_touch(rig.space, &rig.start);
	rig.report = (JnReport){0};
	assert_int_equal(rig.sys->ops->force(rig.sys, &rig.start, f), JN_OK);
	assert_int_equal(rig.sys->ops->force(rig.sys, &rig.start, again), JN_OK);
	assert_int_equal(rig.report.forces, 1);
	assert_memory_equal(f, again, (size_t)rig.length * sizeof *f);
	assert_int_equal(rig.sys->ops->linearize(rig.sys, &rig.start), JN_OK);
	assert_int_equal(rig.sys->ops->linearize(rig.sys, &rig.start), JN_OK);
	assert_int_equal(rig.report.tangents, 1);
	JnMatrix* matrix = NULL;
	for (int i = 0; i < 2; ++i) {
		assert_int_equal(rig.sys->ops->matrix(rig.sys, (JnShift){1, 0, 1e-4}, &matrix), JN_OK);
		assert_int_equal(matrix->ops->solve(matrix, f, again), JN_OK);
	}
	assert_int_equal(rig.report.factorizations, 1);
	assert_int_equal(rig.report.solves, 2);
	free_vector(&rig, f);
	free_vector(&rig, again);
	rig_destroy(&rig);
}

static void an_edited_state_is_never_served_old_numbers(void** state) {
	(void)state;
	ModelCase c;
	Rig rig, fresh;
	troubled_case(&c, JN_HEX8, "stable_neo_hookean");
	rig_create(&rig, &c, 1);
	rig_create(&fresh, &c, 1);
	double *f = new_vector(&rig), *out = new_vector(&rig), *expected = new_vector(&rig);
	JnMatrix *matrix = NULL, *other = NULL;
	const JnShift shift = {1, 0, 1e-4};
	rig_shake(&rig, 19, 0.01, 0);
	assert_int_equal(rig.sys->ops->linearize(rig.sys, &rig.start), JN_OK);
	assert_int_equal(rig.sys->ops->matrix(rig.sys, shift, &matrix), JN_OK);
	assert_int_equal(rig.sys->ops->force(rig.sys, &rig.start, f), JN_OK);
	assert_int_equal(matrix->ops->solve(matrix, f, out), JN_OK);
	rig_shake(&rig, 23, 0.01, 0);
	rig_shake(&fresh, 23, 0.01, 0);
	assert_int_equal(rig.sys->ops->force(rig.sys, &rig.start, f), JN_OK);
	assert_int_equal(fresh.sys->ops->force(fresh.sys, &fresh.start, expected), JN_OK);
	assert_memory_equal(f, expected, (size_t)rig.length * sizeof *f);
	assert_int_equal(rig.sys->ops->linearize(rig.sys, &rig.start), JN_OK);
	assert_int_equal(fresh.sys->ops->linearize(fresh.sys, &fresh.start), JN_OK);
	assert_int_equal(rig.sys->ops->matrix(rig.sys, shift, &matrix), JN_OK);
	assert_int_equal(fresh.sys->ops->matrix(fresh.sys, shift, &other), JN_OK);
	assert_int_equal(matrix->ops->solve(matrix, f, out), JN_OK);
	assert_int_equal(other->ops->solve(other, f, expected), JN_OK);
	assert_memory_equal(out, expected, (size_t)rig.length * sizeof *f);
	free_vector(&rig, f);
	free_vector(&rig, out);
	free_vector(&rig, expected);
	rig_destroy(&rig);
	rig_destroy(&fresh);
}

static void more_shifts_than_slots_are_all_solved_right(void** state) {
	(void)state;
	ModelCase c;
	Rig rig;
	troubled_case(&c, JN_HEX8, "stable_neo_hookean");
	rig_create(&rig, &c, 1);
	rig_shake(&rig, 29, 0.005, 0);
	assert_int_equal(rig.sys->ops->linearize(rig.sys, &rig.start), JN_OK);
	double *z = new_vector(&rig), *rhs = new_vector(&rig), *out = new_vector(&rig);
	uint64_t seed = 1;
	fill_random(&seed, 1, rig.length, z);
	rig.sys->ops->hold(rig.sys, z);
	for (int round = 0; round < 3; ++round)
		for (int i = 0; i < JN_SOLVER_SLOTS + 2; ++i) {
			JnMatrix* matrix = NULL;
			const JnShift shift = {1, 0, 1e-5 * (i + 1)};
			assert_int_equal(rig.sys->ops->matrix(rig.sys, shift, &matrix), JN_OK);
			matrix->ops->apply(matrix, z, rhs);
			assert_int_equal(matrix->ops->solve(matrix, rhs, out), JN_OK);
			expect_near(largest_difference(out, z, rig.length), 0, 1e-10, "shift %d", i); // condition below 1e4
		}
	free_vector(&rig, z);
	free_vector(&rig, rhs);
	free_vector(&rig, out);
	rig_destroy(&rig);
}

static void frozen_rotations_follow_the_start_of_the_step(void** state) {
	(void)state;
	ModelCase c;
	Rig rig, fresh;
	troubled_case(&c, JN_TET4, "corotated_frozen");
	rig_create(&rig, &c, 1);
	rig_create(&fresh, &c, 1);
	double *f = new_vector(&rig), *expected = new_vector(&rig);
	rig_shake(&rig, 31, 0.03, 0);
	assert_int_equal(rig.sys->ops->force(rig.sys, &rig.start, f), JN_OK);
	rig_shake(&rig, 37, 0.03, 0);
	rig_shake(&fresh, 37, 0.03, 0);
	assert_int_equal(rig.sys->ops->force(rig.sys, &rig.start, f), JN_OK);
	assert_int_equal(fresh.sys->ops->force(fresh.sys, &fresh.start, expected), JN_OK);
	assert_memory_equal(f, expected, (size_t)rig.length * sizeof *f);
	JnMatrix *matrix = NULL, *other = NULL;
	assert_int_equal(rig.sys->ops->linearize(rig.sys, &rig.start), JN_OK);
	assert_int_equal(fresh.sys->ops->linearize(fresh.sys, &fresh.start), JN_OK);
	assert_int_equal(rig.sys->ops->matrix(rig.sys, (JnShift){.stiffness = 1}, &matrix), JN_OK);
	assert_int_equal(fresh.sys->ops->matrix(fresh.sys, (JnShift){.stiffness = 1}, &other), JN_OK);
	matrix->ops->apply(matrix, rig.start.x, f);
	other->ops->apply(other, rig.start.x, expected);
	assert_memory_equal(f, expected, (size_t)rig.length * sizeof *f);
	free_vector(&rig, f);
	free_vector(&rig, expected);
	rig_destroy(&rig);
	rig_destroy(&fresh);
}

// D of `law` at the start state of a rig, times a vector.
static void damping_product(Rig* rig, const double* d, double* out) {
	JnMatrix* matrix = NULL;
	assert_int_equal(rig->sys->ops->matrix(rig->sys, (JnShift){.damping = 1}, &matrix), JN_OK);
	matrix->ops->apply(matrix, d, out);
}

static void damping_of_the_current_state_follows_frozen_rotations(void** state) {
	(void)state;
	ModelCase c;
	Rig rig, fresh;
	troubled_case(&c, JN_TET4, "corotated_frozen");
	c.body.damping = (JnDampingDef){.beta = 0.01, .stiffness = 2};
	rig_create(&rig, &c, 1);
	rig_create(&fresh, &c, 1);
	double *f = new_vector(&rig), *expected = new_vector(&rig);
	rig_shake(&rig, 37, 0, 0);
	for (int k = 0; k < rig.length; ++k) rig.start.x[k] += k % 3 == 0 ? 0.3 * rig.start.x[k + 2] : 0;
	jn_state_touch(rig.space, &rig.start);
	memcpy(fresh.start.x, rig.start.x, (size_t)rig.length * sizeof *f);
	jn_state_touch(fresh.space, &fresh.start);
	assert_int_equal(rig.sys->ops->force(rig.sys, &rig.start, f), JN_OK); // as at the end of a step: old rotations
	assert_int_equal(rig.sys->ops->begin(rig.sys, &rig.start), JN_OK);
	assert_int_equal(fresh.sys->ops->begin(fresh.sys, &fresh.start), JN_OK);
	damping_product(&rig, rig.start.x, f);
	damping_product(&fresh, rig.start.x, expected);
	assert_memory_equal(f, expected, (size_t)rig.length * sizeof *f);
	free_vector(&rig, f);
	free_vector(&rig, expected);
	rig_destroy(&rig);
	rig_destroy(&fresh);
}

static void damping_at_rest_does_not_know_the_first_state(void** state) {
	(void)state;
	ModelCase c;
	Rig rig, fresh;
	troubled_case(&c, JN_TET4, "corotated_frozen");
	c.body.damping = (JnDampingDef){.beta = 0.01, .stiffness = 1};
	c.body.fix.count = 0;
	case_drive(&c, FACE_Z_HIGH, 0.1, 1);
	*(double*)option(c.drive.motion[0].row, c.motion, "phase") = 1.5; // bent from the beginning
	rig_create(&rig, &c, 1);
	*(double*)option(c.drive.motion[0].row, c.motion, "amplitude") = 0; // at rest
	rig_create(&fresh, &c, 1);
	double *f = new_vector(&rig), *expected = new_vector(&rig);
	damping_product(&rig, jn_model_rest(rig.model), f);
	damping_product(&fresh, jn_model_rest(rig.model), expected);
	assert_memory_equal(f, expected, (size_t)rig.length * sizeof *f);
	free_vector(&rig, f);
	free_vector(&rig, expected);
	rig_destroy(&rig);
	rig_destroy(&fresh);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(force_is_minus_the_slope_of_the_energy),
		cmocka_unit_test(products_with_K_and_D_are_differences_of_the_force),
		cmocka_unit_test(linearize_brings_damping_of_the_current_state_up_to_date),
		cmocka_unit_test(solve_inverts_apply_on_free_entries_and_zeroes_the_held),
		cmocka_unit_test(the_same_stamp_is_evaluated_once),
		cmocka_unit_test(an_edited_state_is_never_served_old_numbers),
		cmocka_unit_test(more_shifts_than_slots_are_all_solved_right),
		cmocka_unit_test(frozen_rotations_follow_the_start_of_the_step),
		cmocka_unit_test(damping_of_the_current_state_follows_frozen_rotations),
		cmocka_unit_test(damping_at_rest_does_not_know_the_first_state),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
