/// @file order_sweep.h
/// Measures the order of every row of the list of integrators on a problem, and knows where theory says another than the
/// classical order.
///
/// Errors are vectors against esdirk436 at small steps. With E(h) = C h^p + C' h^(p+1) + ...,
///     D(h) = 2^(p+1) E(h/2) - E(h) = C h^p + O(h^(p+2)),   order = log2 |D(h)| / |D(h/2)|
/// so that methods made for small C show the order that rules as h -> 0. A method of order p - 1 still shows p - 1, and
/// one of order p + 1 shows p + 2: neither passes for p.
#ifndef JN_TEST_TABLE_ORDER_SWEEP_H
#define JN_TEST_TABLE_ORDER_SWEEP_H

#include <stdio.h>

#include "integrate/integrator.h"
#include "table/order_problems.h"

enum { ORDER_LEVELS = 3, ORDER_MOST_METHODS = 128, ORDER_EXACT = 0 };

/// Where theory says another order than the classical one, and why.
typedef struct OrderException {
	const char* method;  ///< this method; with `is_family` all that share its step function
	const char* problem; ///< on this problem
	int order;           ///< or ORDER_EXACT: nothing but rounding at every step size
	bool is_family;
	const char* reason; ///< one sentence
} OrderException;

#define ORDER_KICKS                                                                                                    \
	"Kicks take the damping at the velocity before them, as an Euler step does: every composition is of first order "  \
	"where forces depend on v."
#define ORDER_LINEAR                                                                                                   \
	"Made for a phase error of fourth order: its stability function R(z) agrees with exp(z) to z^4, so that it is of " \
	"fourth order where forces are linear."
#define ORDER_SOLVED                                                                                                   \
	"Exact where forces are linear and do not depend on time: errors are below 1e-11, from rounding, at every step "   \
	"size."

// clang-format off
static const OrderException order_exceptions[] = {
	{"verlet", "damped pair", 1, true, ORDER_KICKS},
	{"exponential_rosenbrock", "pair", ORDER_EXACT, false, ORDER_SOLVED},
	{"exponential_rosenbrock", "damped pair", ORDER_EXACT, false, ORDER_SOLVED},
	{"sdirk_3345", "pair", 4, false, ORDER_LINEAR},
	{"sdirk_3345", "damped pair", 4, false, ORDER_LINEAR},
	{"sdirk_4347", "pair", 4, false, ORDER_LINEAR},
	{"sdirk_4347", "damped pair", 4, false, ORDER_LINEAR},
};
// clang-format on
enum { ORDER_EXCEPTION_COUNT = sizeof order_exceptions / sizeof *order_exceptions };

typedef struct OrderSolution {
	int length;
	double at[ORDER_MOST_REALS]; ///< x, then duration * v
} OrderSolution;

typedef struct OrderResult {
	const JnIntegratorType* type;
	const OrderException* exception; ///< NULL: the classical order is expected
	OrderMass mass;
	int expected;
	double measured; ///< order of the leading term; NAN when a run failed
	double plain;    ///< order from the last two errors
	double error;    ///< at the smallest step
	double largest;  ///< error of the three sizes
} OrderResult;

static inline bool order_applies(const OrderException* exception, const JnIntegratorType* type) {
	const JnIntegratorType* named = (const JnIntegratorType*)jn_row_find(&jn_integrator_list, exception->method);
	if (type->order == exception->order) return false; // nothing is exceptional then
	return type == named || (exception->is_family && named != NULL && named->step == type->step);
}

/// The exception for a method on a problem, or NULL.
static inline const OrderException* order_exception(const JnIntegratorType* type, const OrderProblem* problem) {
	for (int i = 0; i < ORDER_EXCEPTION_COUNT; ++i)
		if (strcmp(order_exceptions[i].problem, problem->name) == 0 && order_applies(&order_exceptions[i], type))
			return &order_exceptions[i];
	return NULL;
}

/// Steps of one size from the start of the problem to its end, through a simulation.
static inline JnStatus order_simulate(const OrderProblem* problem, const OrderSystem* system, const char* method,
									  int steps, OrderSolution* out) {
	char settings[512];
	JnSim* sim = NULL;
	snprintf(settings, sizeof settings,
			 "{duration: %.17g, integrator: {method: %s}, newton: {tolerance: 1e-12, guess: linear}, "
			 "step: {controller: fixed, dt: %.17g, cuts: 0}}",
			 problem->duration, method, problem->duration / steps);
	JN_TRY(jn_sim_create_for(system->sys, settings, system->x, system->v, &sim));
	JnStatus status = JN_OK;
	while (status == JN_OK && !jn_sim_is_done(sim)) status = jn_sim_step(sim);
	if (jn_sim_steps(sim) != steps && status == JN_OK) status = JN_RUN_FAILED;
	const JnState* end = jn_sim_state(sim);
	out->length = 2 * system->length;
	for (int k = 0; k < system->length; ++k) {
		out->at[k] = end->x[k];
		out->at[system->length + k] = problem->duration * end->v[k];
	}
	jn_sim_destroy(sim);
	return status;
}

/// |scale * (a - reference) - (b - reference)|; b NULL: the first part alone.
static inline double order_difference(double scale, const OrderSolution* a, const OrderSolution* b,
									  const OrderSolution* reference) {
	double sum = 0;
	for (int k = 0; k < a->length; ++k) {
		const double part = scale * (a->at[k] - reference->at[k]);
		const double whole = b != NULL ? part - (b->at[k] - reference->at[k]) : part;
		sum += whole * whole;
	}
	return sqrt(sum);
}

/// Steps at the largest size.
static inline int order_coarsest(const OrderProblem* problem, int order) {
	return problem->coarsest[order == ORDER_EXACT || order > 4 ? 3 : order - 1];
}

/// Whether a result is what is expected. 0.1: terms of order p + 2 and above, of which 0.05 were seen. 1e-11: rounding, of
/// the reference too; 4e-13 was seen.
static inline bool order_is_met(const OrderResult* result) {
	if (result->expected == ORDER_EXACT) return result->largest <= 1e-11;
	return fabs(result->measured - result->expected) <= 0.1; // false for NAN
}

/// Fill `measured` and what follows it.
static inline void order_measure(const OrderProblem* problem, const OrderSystem* system, const OrderSolution* reference,
								 OrderResult* result) {
	OrderSolution at[ORDER_LEVELS];
	const int coarsest = order_coarsest(problem, result->expected);
	result->measured = result->plain = result->error = result->largest = NAN;
	for (int level = 0; level < ORDER_LEVELS; ++level)
		if (order_simulate(problem, system, result->type->row.name, coarsest << level, &at[level]) != JN_OK) return;
	const double scale = ldexp(1, result->expected + 1);
	const double coarse = order_difference(scale, &at[1], &at[0], reference);
	const double fine = order_difference(scale, &at[2], &at[1], reference);
	const double before = order_difference(1, &at[1], NULL, reference);
	result->error = order_difference(1, &at[2], NULL, reference);
	result->largest = fmax(fmax(result->error, before), order_difference(1, &at[0], NULL, reference));
	result->plain = log2(before / result->error);
	result->measured = log2(coarse / fine);
}

static inline OrderResult order_expect(const OrderProblem* problem, const JnIntegratorType* type) {
	const OrderException* exception = order_exception(type, problem);
	return (OrderResult){
		.type = type,
		.exception = exception,
		.mass = (type->needs & JN_NEEDS_DIAGONAL_MASS) != 0 ? ORDER_MASS_DIAGONAL : ORDER_MASS_OWN,
		.expected = exception != NULL ? exception->order : type->order,
		.measured = NAN,
	};
}

/// All methods that take the problem with this mass, in the order of the list.
static inline JnStatus order_sweep_mass(const OrderProblem* problem, OrderMass mass, OrderResult results[]) {
	OrderSystem system;
	OrderSolution reference;
	JnStatus status = problem->create(mass, &system);
	if (status == JN_OK) status = order_simulate(problem, &system, "esdirk436", problem->reference, &reference);
	for (int i = 0; i < jn_integrator_list.count && status == JN_OK; ++i)
		if (results[i].mass == mass) order_measure(problem, &system, &reference, &results[i]);
	order_system_destroy(&system);
	return status;
}

/// One result a row of the list; results has ORDER_MOST_METHODS entries.
static inline JnStatus order_sweep(const OrderProblem* problem, OrderResult results[]) {
	if (jn_integrator_list.count > ORDER_MOST_METHODS) return JN_BAD_INPUT;
	for (int i = 0; i < jn_integrator_list.count; ++i)
		results[i] = order_expect(problem, (const JnIntegratorType*)jn_integrator_list.rows[i]);
	JN_TRY(order_sweep_mass(problem, ORDER_MASS_OWN, results));
	return order_sweep_mass(problem, ORDER_MASS_DIAGONAL, results);
}

#endif
