#include "sim/stability.h"

#include <math.h>

#include "base/log.h"
#include "base/space.h"
#include "control/stable.h"
#include "integrate/properties.h"
#include "sim/simulation.h"

enum { ITERATIONS = 300, VECTORS = 3 };

// omega is found from below, to a few per cent.
static const double slack = 0.98;

static void ignore(void* user, JnLogLevel level, const char* message) {
	(void)user, (void)level, (void)message;
}

static int largest_entry(const JnSpace* space, const double* vec) {
	size_t largest = 0;
	for (size_t k = 1; k < space->length; ++k)
		if (fabs(vec[k]) > fabs(vec[largest])) largest = k;
	return (int)largest;
}

static bool measure(JnSystem* sys, const JnState* state, JnVec vectors[VECTORS], JnStability* out) {
	JnVec work[2] = {vectors[1], vectors[2]};
	sys->space->ops->combine(sys->space, vectors[0], 0, NULL);
	if (sys->ops->begin(sys, state) != JN_OK) return false;
	const JnStatus status = jn_largest_frequency(sys, state, ITERATIONS, vectors[0], work, &out->omega, &out->xi);
	out->entry = largest_entry(sys->space, vectors[0]);
	return status == JN_OK && out->omega > 0;
}

static bool exceeds(const JnIntegratorType* method, double dt, JnStability* out) {
	if (jn_integrator_stability_limit(method, fmax(out->xi, 0), &out->nu) != JN_OK) return false;
	out->limit = out->nu / out->omega;
	return dt > slack * out->limit;
}

// Systems that are not models do not tell where they started.
static bool exceeds_at_start(JnSim* sim, const JnIntegratorType* method, double dt, JnVec vectors[VECTORS],
							 JnStability* out) {
	JnState state;
	if (sim->model == NULL || jn_state_create(sim->sys->space, &state) != JN_OK) return false;
	jn_model_start(sim->model, 0, &state);
	out->at_start = measure(sim->sys, &state, vectors, out) && exceeds(method, dt, out);
	jn_state_destroy(sim->sys->space, &state);
	return out->at_start;
}

// Is `method` unstable; without one: is the largest frequency known? What the system cannot give, such as a tangent, is no
// error of the run.
static bool look(JnSim* sim, const JnIntegratorType* method, double dt, JnStability* out) {
	JnSystem* sys = sim->sys;
	JnVec vectors[VECTORS];
	JnReport aside = {0}, *report = sys->report;
	bool is_complete = true, is_so = false;
	*out = (JnStability){0};
	if (sys->ops->linearize == NULL || sys->ops->matrix == NULL) return false;
	const JnLog log = jn_log_swap((JnLog){ignore, NULL});
	sys->report = &aside;
	for (int i = 0; i < VECTORS; ++i) is_complete &= (vectors[i] = sys->space->ops->create(sys->space)) != NULL;
	if (is_complete) {
		is_so = (method != NULL && exceeds_at_start(sim, method, dt, vectors, out)) ||
				(measure(sys, &sim->start, vectors, out) && (method == NULL || exceeds(method, dt, out)));
		sys->ops->begin(sys, &sim->start); // rotations and damping as they were
	}
	for (int i = 0; i < VECTORS; ++i) sys->space->ops->destroy(sys->space, vectors[i]);
	sys->report = report;
	jn_log_swap(log);
	return is_so;
}

bool jn_sim_is_unstable(JnSim* sim, const JnIntegratorType* method, double dt, JnStability* out) {
	return (method->needs & JN_NEEDS_TANGENT) == 0 && look(sim, method, dt, out);
}

bool jn_sim_largest_frequency(JnSim* sim, JnStability* out) {
	return look(sim, NULL, 0, out);
}
