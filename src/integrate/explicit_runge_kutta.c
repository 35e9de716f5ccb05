// Explicit Runge-Kutta methods on M a = f(t, x, v), in Nystrom's form (the equations stand beside JnNystrom), and the
// semi-implicit relatives of EX that have this form but are no Runge-Kutta methods, since they treat x and v unlike.
// Their order holds for forces that depend on t and v, too.
#include "integrate/explicit_runge_kutta.h"

#include "base/space.h"
#include "integrate/integrator.h"

/// Work vectors: the stages' accelerations.
enum { VECTORS = JN_MAX_EXPLICIT_STAGES };

// end = (t + c dt, x + c dt v + dt^2 sum x_weight_j a_j, v + dt sum v_weight_j a_j), with held nodes where they belong.
static void place(JnIntegrator* self, const JnStep* step, double c, const double x_weight[], const double v_weight[]) {
	const JnState* start = step->start;
	JnState* s = step->end;
	JnTerm x[2 + JN_MAX_EXPLICIT_STAGES] = {{1, start->x}, {c * step->dt, start->v}};
	JnTerm v[1 + JN_MAX_EXPLICIT_STAGES] = {{1, start->v}};
	int x_count = 2, v_count = 1;
	for (int j = 0; j < JN_MAX_EXPLICIT_STAGES; ++j) {
		if (x_weight[j] != 0) x[x_count++] = (JnTerm){step->dt * step->dt * x_weight[j], self->vectors[j]};
		if (v_weight[j] != 0) v[v_count++] = (JnTerm){step->dt * v_weight[j], self->vectors[j]};
	}
	self->space->ops->combine(self->space, s->x, x_count, x);
	self->space->ops->combine(self->space, s->v, v_count, v);
	s->t = start->t + c * step->dt;
	step->sys->ops->prescribe(step->sys, s, NULL);
	jn_state_touch(self->space, s);
}

static JnStatus nystrom_step(JnIntegrator* self, JnStep* step) {
	const JnNystrom* table = self->type->table;
	step->sys->report = &step->report;
	jn_state_copy(self->space, step->start, step->end); // the stamp comes along: forces at the start are known
	for (int i = 0; i < table->stages; ++i) {
		if (i > 0) place(self, step, table->c[i], table->x[i], table->v[i]);
		JN_TRY(jn_acceleration(self, step->sys, step->end, self->vectors[i]));
	}
	place(self, step, 1, table->x_end, table->v_end);
	return jn_state_check(self->space, step->end);
}

static const JnNystrom explicit_euler = {.stages = 1, .v_end = {1}};

// v+ = v + dt a(x),  x+ = x + dt (v + v+) / 2   (Gould, Tobochnik, Christian)
static const JnNystrom midpoint = {.stages = 1, .x_end = {0.5}, .v_end = {1}};

// x_h = x + dt/2 v,  v_h = v + dt/2 a(x),  x+ = x + dt v_h,  v+ = v + dt a(x_h)
static const JnNystrom half_step = {
	.stages = 2,
	.c = {0, 0.5},
	.v = {{0}, {0.5}},
	.x_end = {0.5},
	.v_end = {0, 1},
};

// As half_step, but x_h = x + dt/2 v_h.
static const JnNystrom modified_half_step = {
	.stages = 2,
	.c = {0, 0.5},
	.x = {{0}, {0.25}},
	.v = {{0}, {0.5}},
	.x_end = {0.5},
	.v_end = {0, 1},
};

static const JnNystrom rk4 = {
	.stages = 4,
	.c = {0, 0.5, 0.5, 1},
	.x = {{0}, {0}, {0.25}, {0, 0.5}},
	.v = {{0}, {0.5}, {0, 0.5}, {0, 0, 1}},
	.x_end = {1.0 / 6, 1.0 / 6, 1.0 / 6},
	.v_end = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6},
};

#define EXPLICIT(method, p, words)                                                                                     \
	const JnIntegratorType jn_##method = {                                                                             \
		.row = {.name = #method, .doc = (words)},                                                                      \
		.needs = JN_NEEDS_DIAGONAL_MASS,                                                                               \
		.order = (p),                                                                                                  \
		.vectors = VECTORS,                                                                                            \
		.table = &(method),                                                                                            \
		.step = nystrom_step,                                                                                          \
	};

EXPLICIT(explicit_euler, 1,
		 "Euler: not symplectic, gains energy at every step size without damping, stable to omega dt = 2 xi with "
		 "damping ratio xi; one force a step, for comparison")
EXPLICIT(midpoint, 1,
		 "Gould, Tobochnik, Christian: Euler with the mean velocity; not symplectic, gains energy at every step size "
		 "without damping, stable to omega dt = 4 xi with damping ratio xi; one force a step")
EXPLICIT(half_step, 2,
		 "midpoint rule of Runge and Kutta: not symplectic, gains energy at every step size without damping, slowly at "
		 "small ones; two forces a step, second order with damping")
EXPLICIT(modified_half_step, 2,
		 "half_step with its new velocity in the new position: not symplectic and gains energy slowly, yet stable to "
		 "omega dt = 2; two forces a step, second order with damping")
EXPLICIT(
	rk4, 4,
	"Runge, Kutta 1901: not symplectic, stable to omega dt = 2.828, loses energy below; four forces a step, order 4 "
	"with damping")
