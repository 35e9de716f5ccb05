// dt = safety nu / omega (sqrt(1 + xi^2) - xi), where nu is the largest omega dt at which the method is stable without
// damping (integrate/properties.h), omega the largest frequency of M^-1 K and xi its damping ratio: exact for verlet
// (Belytschko, Liu, Moran 2000, eq. 6.2.13), whose form stands for the other methods too. omega comes from a power iteration,
// which approaches it from below: hence the safety. It is made anew every few steps, from the vector found before.
#include "control/stable.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>

#include "base/log.h"
#include "base/random.h"
#include "control/limits.h"
#include "integrate/integrator.h"
#include "integrate/properties.h"

enum { MODE, PRODUCT, MOMENTUM, VECTORS };

static const double settled = 1e-4; // change of omega^2 at which the iteration may end

typedef struct StableDef {
	double safety;
	int every, iterations;
	JnStepLimits limits;
} StableDef;

typedef struct StableMemory {
	double nu;    // of the method
	double omega; // [1/s]; 0: not known yet
	double xi;
	int age; // accepted steps since
} StableMemory;

static void fill(JnSpace* space, JnVec p) {
	JnRandom random = {1};
	for (size_t k = 0; k < space->length; ++k) p[k] = 2 * jn_random_uniform(&random) - 1;
}

static JnStatus find_matrices(JnSystem* sys, JnMatrix* out[3]) {
	static const JnShift shifts[3] = {{.mass = 1}, {.damping = 1}, {.stiffness = 1}};
	for (int i = 0; i < 3; ++i) JN_TRY(sys->ops->matrix(sys, shifts[i], &out[i]));
	return JN_OK;
}

JnStatus jn_largest_frequency(JnSystem* sys, const JnState* s, int count, JnVec p, JnVec work[2], double* omega,
							  double* xi) {
	JnSpace* space = sys->space;
	JnMatrix *matrices[3], *const *M = &matrices[0], *const *D = &matrices[1], *const *K = &matrices[2];
	double square = 0, before = 0;
	*omega = *xi = 0;
	JN_TRY(sys->ops->linearize(sys, s));
	JN_TRY(find_matrices(sys, matrices));
	if (space->ops->max(space, p) == 0) fill(space, p);
	sys->ops->hold(sys, p);
	for (int i = 0; i < count; ++i, before = square) {
		(*M)->ops->apply(*M, p, work[1]);
		const double norm = sqrt(space->ops->dot(space, p, work[1]));
		if (!(norm > 0)) return JN_OK; // nothing can move
		space->ops->combine(space, p, 1, (JnTerm[]){{1 / norm, p}});
		(*K)->ops->apply(*K, p, work[0]);
		sys->ops->hold(sys, work[0]);
		square = fabs(space->ops->dot(space, p, work[0]));
		if (!isfinite(square)) return JN_NOT_FINITE;
		if (square == 0) return JN_OK;
		*omega = sqrt(square);
		(*D)->ops->apply(*D, p, work[1]);
		*xi = 0.5 * space->ops->dot(space, p, work[1]) / *omega;
		JN_TRY((*M)->ops->solve(*M, work[0], p));
		if (fabs(square - before) < settled * square) break;
	}
	return JN_OK;
}

static JnStatus check(const JnController* self) {
	const StableDef* def = self->options;
	const JnIntegratorType* method = self->integrator->type;
	const JnSystemOps* ops = self->sys->ops;
	JnIntegratorProperties properties;
	JN_TRY(jn_limits_check(self, &def->limits));
	JN_TRY(jn_integrator_properties(method, &properties));
	if (ops->linearize == NULL || ops->matrix == NULL)
		return jn_error(JN_BAD_INPUT,
						"%s.controller: stable needs the tangent of the forces, which this system does not give",
						self->path);
	if (properties.stability_limit == 0)
		return jn_error(JN_BAD_INPUT,
						"%s.controller: no step of %s is stable without damping; choose symplectic_euler or verlet",
						self->path, method->row.name);
	if (!isinf(properties.stability_limit)) return JN_OK;
	return jn_error(
		JN_BAD_INPUT,
		"%s.controller: %s is stable at any step, so that stable has nothing to go by; choose force_error or "
		"another rule about errors",
		self->path, method->row.name);
}

static JnStatus create(JnController* self) {
	JnIntegratorProperties properties;
	JN_TRY(jn_integrator_properties(self->integrator->type, &properties));
	((StableMemory*)self->memory)->nu = properties.stability_limit;
	return JN_OK;
}

static double first(JnController* self) {
	return ((const StableDef*)self->options)->limits.dt;
}

static JnStatus measure(JnController* self, const JnState* s) {
	const StableDef* def = self->options;
	StableMemory* memory = self->memory;
	double omega, xi;
	JnVec work[2] = {self->vectors[PRODUCT], self->vectors[MOMENTUM]};
	memory->age = 0;
	JN_TRY(jn_largest_frequency(self->sys, s, def->iterations, self->vectors[MODE], work, &omega, &xi));
	memory->omega = omega;
	memory->xi = xi;
	return JN_OK;
}

// The best step [s].
static double best(const JnController* self) {
	const StableMemory* memory = self->memory;
	const double limit = memory->nu / memory->omega * (sqrt(1 + memory->xi * memory->xi) - memory->xi);
	return ((const StableDef*)self->options)->safety * limit;
}

// The sizes of the first attempts are anybody's guess: those beyond the limit are thrown away.
static JnStatus judge(JnController* self, JnStep* step, JnStatus outcome, JnVerdict* verdict) {
	const StableDef* def = self->options;
	StableMemory* memory = self->memory;
	const JnStatus known = memory->omega == 0 ? measure(self, step->start) : JN_OK;
	if (known < JN_OK) return known;
	const double factor = best(self) / step->dt;
	if (known != JN_OK || outcome != JN_OK) return jn_limits_refuse(&def->limits, step, jn_cut, verdict);
	if (factor < def->safety) return jn_limits_refuse(&def->limits, step, factor, verdict);
	if (++memory->age >= def->every) outcome = measure(self, step->end);
	if (outcome < JN_OK) return outcome;
	if (outcome != JN_OK) return jn_limits_refuse(&def->limits, step, jn_cut, verdict);
	jn_limits_accept(&def->limits, step, best(self) / step->dt, verdict);
	return JN_OK;
}

static void explain(const JnController* self, JnComplaint* complaint) {
	const StableMemory* memory = self->memory;
	jn_limits_explain(self, &((const StableDef*)self->options)->limits, "", NAN, 0, complaint);
	if (memory->omega == 0) return;
	snprintf(complaint->cause, sizeof complaint->cause,
			 "the step is above %.3g s, %s.safety of the largest stable one at a frequency of %.3g rad/s", best(self),
			 self->path, memory->omega);
	snprintf(complaint->remedy, sizeof complaint->remedy, "a smaller %s.dt_min, or an implicit method (sdirk2)",
			 self->path);
}

static const JnKey keys[] = {
	{.name = "safety",
	 .kind = JN_REAL,
	 .field = offsetof(StableDef, safety),
	 .value = {0.8},
	 .low = 0.01,
	 .high = 1,
	 .meaning = "share of the largest stable step"},
	{.name = "every",
	 .kind = JN_INTEGER,
	 .field = offsetof(StableDef, every),
	 .value = {20},
	 .low = 1,
	 .high = 1000000,
	 .meaning = "steps after which the largest frequency is found anew"},
	{.name = "iterations",
	 .kind = JN_INTEGER,
	 .field = offsetof(StableDef, iterations),
	 .value = {50},
	 .low = 1,
	 .high = 10000,
	 .meaning = "products with the tangent for that, at most; fewer where the frequency settles"},
	JN_STEP_LIMIT_ROWS(StableDef, 1),
	{0},
};

const JnControllerType jn_controller_stable = {
	.row = {.name = "stable",
			.doc = "steps at a share of the stability limit of explicit methods, by the largest frequency of the model",
			.keys = keys,
			.options_size = sizeof(StableDef)},
	.memory_size = sizeof(StableMemory),
	.vectors = VECTORS,
	.check = check,
	.create = create,
	.first = first,
	.judge = judge,
	.explain = explain,
};
