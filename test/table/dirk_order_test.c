/// @file dirk_order_test.c
/// Every diagonally implicit method of the list has its order on a solid of Stable Neo-Hookean hexahedra with Rayleigh
/// damping from a constant K (order_test.c has the problems without). Frozen at the start of each step, K costs all but
/// the first order, as theory says: D then differs by O(dt) from the D of the equations.
///
/// Errors are vectors against esdirk436 at 1024 steps. With E(h) = C h^p + C' h^(p+1) + ...,
///     D(h) = 2^(p+1) E(h/2) - E(h) = C h^p + O(h^(p+2)),   order = log2 |D(h)| / |D(h/2)|
/// so that methods made for small C (sdirk_3345, sdirk_4347: about 4 in the plain ratio of errors) show the order that
/// rules as h -> 0. A method of order p - 1 still shows p - 1, and one of order p + 1 shows p + 2: neither passes for p.
#include "support/model_case.h"

// Three sizes a method. The largest frequency of the mesh is some 300 rad/s, that is 0.3 rad a step at 64 steps.
enum { REFERENCE_STEPS = 1024, COARSEST = 64, LEVELS = 3, MOST_REALS = 512 };

static const double duration = 1.0 / 16;

typedef struct Solution {
	int length;
	double at[MOST_REALS]; // x, then duration * v
} Solution;

typedef void Prepare(ModelCase*);

static void bending(ModelCase* c) {
	case_box(c, JN_HEX8, "stable_neo_hookean");
	case_gravity(c, 1, -9.81, 0.5);
	c->sim.newton = (JnNewtonDef){.tolerance = 1e-12, .max_iterations = 60, .guess = 2};
}

static void damped_by_rest(ModelCase* c) {
	bending(c);
	c->body.damping = (JnDampingDef){.alpha = 2, .beta = 2e-3, .stiffness = 1};
}

static void damped_by_start(ModelCase* c) {
	bending(c);
	c->body.damping = (JnDampingDef){.alpha = 2, .beta = 2e-3, .stiffness = 0};
}

static void damped_by_current(ModelCase* c) {
	bending(c);
	c->body.damping = (JnDampingDef){.alpha = 2, .beta = 2e-3, .stiffness = 2};
}

// A twist and a bend that grow from the clamped end: smooth in space, and large enough that nothing is linear.
static void set_in_motion(Rig* rig) {
	const double* rest = jn_model_rest(rig->model);
	for (int node = 0; node < rig->nodes; ++node) {
		const double *X = rest + 3 * (size_t)node, height = X[2] * X[2] / 0.16;
		double* v = rig->start.v + 3 * (size_t)node;
		v[0] = height * (0.8 - 6 * (X[1] - 0.1));
		v[1] = height * (0.5 + 6 * (X[0] - 0.1));
		v[2] = 0.4 * X[2];
	}
	rig_begin(rig);
}

static void simulate(Prepare* prepare, const JnRow* method, int steps, Solution* out) {
	ModelCase c;
	Rig rig;
	prepare(&c);
	case_method(&c, method);
	rig_create(&rig, &c, 1);
	set_in_motion(&rig);
	for (int i = 0; i < steps; ++i) rig_step(&rig, duration / steps);
	out->length = 2 * rig.length;
	assert_true(out->length <= MOST_REALS);
	for (int k = 0; k < rig.length; ++k) {
		out->at[k] = rig.start.x[k];
		out->at[rig.length + k] = duration * rig.start.v[k];
	}
	rig_destroy(&rig);
}

// |scale * (a - reference) - (b - reference)|; b NULL: the first part alone.
static double difference(double scale, const Solution* a, const Solution* b, const Solution* reference) {
	double sum = 0;
	for (int k = 0; k < a->length; ++k) {
		const double part = scale * (a->at[k] - reference->at[k]);
		const double whole = b != NULL ? part - (b->at[k] - reference->at[k]) : part;
		sum += whole * whole;
	}
	return sqrt(sum);
}

typedef struct Result {
	double error;          // at the smallest step
	double plain, leading; // order from the last two errors, and of the leading term
} Result;

static Result measure(Prepare* prepare, const JnRow* row, const Solution* reference) {
	Solution at[LEVELS];
	for (int level = 0; level < LEVELS; ++level) simulate(prepare, row, COARSEST << level, &at[level]);
	const double scale = ldexp(1, ((const JnIntegratorType*)row)->order + 1);
	const double coarse = difference(scale, &at[1], &at[0], reference);
	const double fine = difference(scale, &at[2], &at[1], reference);
	const double before = difference(1, &at[1], NULL, reference), error = difference(1, &at[2], NULL, reference);
	return (Result){.error = error, .plain = log2(before / error), .leading = log2(coarse / fine)};
}

static void find_reference(Prepare* prepare, Solution* reference) {
	simulate(prepare, row_named(&jn_integrator_list, "esdirk436"), REFERENCE_STEPS, reference);
}

static void print_result(const char* setting, const JnRow* row, Result result) {
	print_message("%-16s %-18s order %d: measured %.3f (plain ratio %.2f, error %.2e)\n", setting, row->name,
				  ((const JnIntegratorType*)row)->order, result.leading, result.plain, result.error);
}

static void check_orders(const char* setting, Prepare* prepare) {
	Solution reference;
	find_reference(prepare, &reference);
	int wrong = 0;
	for (int i = 0; i < jn_integrator_list.count; ++i) {
		const JnRow* row = jn_integrator_list.rows[i];
		if (!is_dirk(row)) continue;
		const Result result = measure(prepare, row, &reference);
		print_result(setting, row, result);
		// 0.1: terms of order p + 2 and above at 0.3 rad a step; measured 0.09 at most
		wrong += !(fabs(result.leading - ((const JnIntegratorType*)row)->order) <= 0.1);
	}
	if (wrong > 0) fail_msg("%s: %d methods miss their order by more than 0.1", setting, wrong);
}

static void every_method_has_its_order_with_damping_by_the_rest_stiffness(void** state) {
	(void)state;
	check_orders("damped by rest", damped_by_rest);
}

// The reference solves the equations with D(x(t)); freezing D over steps is an error of first order. Backward Euler
// keeps its own error of first order beside it.
static void every_method_has_order_one_with_damping_by_the_start_of_the_step(void** state) {
	(void)state;
	Solution reference;
	find_reference(damped_by_current, &reference);
	int wrong = 0;
	for (int i = 0; i < jn_integrator_list.count; ++i) {
		const JnRow* row = jn_integrator_list.rows[i];
		if (!is_dirk(row)) continue;
		const Result result = measure(damped_by_start, row, &reference);
		print_result("damped by start", row, result);
		wrong += !(result.plain >= 0.9); // 0.1 below: terms of the second order at 0.3 rad a step
	}
	if (wrong > 0) fail_msg("%d methods have less than order one", wrong);
}

static void the_reference_is_far_more_accurate_than_what_it_judges(void** state) {
	(void)state;
	Solution reference, other;
	find_reference(damped_by_rest, &reference);
	simulate(damped_by_rest, row_named(&jn_integrator_list, "rodas4"), REFERENCE_STEPS, &other);
	// rodas4 shares no coefficient with esdirk436; the smallest error that is judged is 6.4e-12
	expect_near(difference(1, &other, NULL, &reference), 0, 2e-13, "two methods of fourth order at 1024 steps");
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(the_reference_is_far_more_accurate_than_what_it_judges),
		cmocka_unit_test(every_method_has_its_order_with_damping_by_the_rest_stiffness),
		cmocka_unit_test(every_method_has_order_one_with_damping_by_the_start_of_the_step),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
