// Newmark 1959, and its dissipative relatives HHT (Hilber, Hughes, Taylor 1977) and generalised alpha (Chung, Hulbert 1993):
//   x1 = x0 + dt v0 + dt^2 ((1/2 - beta) a0 + beta a1),   v1 = v0 + dt ((1 - gamma) a0 + gamma a1)
//   newmark             M a1 = f(t1, x1, v1)
//   linearized_newmark  the same with f(t1, x0, v0) and its tangent in place of f(t1, x1, v1)
//   hht_alpha           M a1 = (1 + alpha) f(t1, x1, v1) - alpha f(t0, x0, v0)
//   generalized_alpha   M ((1 - am) a1 + am a0) = f at (1 - af) of the end and af of the start
//
// Newmark's a0 is M^-1 f of the start, a pure function of it. In the two others a is a variable of its own, which equals
// M^-1 f only to first order: they carry it from step to step. Deriving it anew would lower them to first order.
#include "integrate/newmark.h"

#include <stddef.h>

#include "base/space.h"
#include "integrate/integrator.h"

/// Work vectors: predicted x and v, a at start and end, load or mixed x, the a that is carried along, mixed v, held a.
enum { X, V, A0, A1, LOAD, KEPT, MIXED_V, HELD, VECTORS };

typedef struct Weights {
	double beta, gamma;
} Weights;

typedef struct Memory {
	int has_acceleration; // vectors[KEPT] belongs to the present start; 0: it does not
} Memory;

// x and v of the end without the part of a1.
static void predict(JnIntegrator* self, const JnStep* step, Weights w) {
	JnSpace* space = self->space;
	const double dt = step->dt;
	const JnTerm x[] = {{1, step->start->x}, {dt, step->start->v}, {dt * dt * (0.5 - w.beta), self->vectors[A0]}};
	const JnTerm v[] = {{1, step->start->v}, {dt * (1 - w.gamma), self->vectors[A0]}};
	space->ops->combine(space, self->vectors[X], 3, x);
	space->ops->combine(space, self->vectors[V], 2, v);
}

static void correct(JnIntegrator* self, JnStep* step, Weights w) {
	JnSpace* space = self->space;
	const double dt = step->dt;
	JnState* end = step->end;
	space->ops->combine(space, end->x, 2, (JnTerm[]){{1, self->vectors[X]}, {dt * dt * w.beta, self->vectors[A1]}});
	space->ops->combine(space, end->v, 2, (JnTerm[]){{1, self->vectors[V]}, {dt * w.gamma, self->vectors[A1]}});
	end->t = step->start->t + dt;
	step->sys->ops->prescribe(step->sys, end, NULL);
}

static void start_step(JnIntegrator* self, JnStep* step) {
	step->sys->report = &step->report;
	self->step_stamp = step->start->stamp;
	jn_state_copy(self->space, step->start, step->end);
}

static JnStatus solve_end(JnIntegrator* self, JnStep* step, Weights w, JnStage forces) {
	JnStage stage = forces;
	stage.t = step->start->t + step->dt;
	stage.kx = w.beta * step->dt * step->dt;
	stage.kv = w.gamma * step->dt;
	stage.x = self->vectors[X];
	stage.v = self->vectors[V];
	JN_TRY(jn_stage_solve(self, step->sys, &stage, step->end, self->vectors[A1], &step->report));
	return jn_state_check(self->space, step->end);
}

// ---- newmark

static JnStatus newmark_step(JnIntegrator* self, JnStep* step) {
	const Weights* w = self->options;
	start_step(self, step);
	JN_TRY(jn_acceleration(self, step->sys, step->end, self->vectors[A0]));
	predict(self, step, *w);
	return solve_end(self, step, *w, (JnStage){0});
}

// With f linearised about (t1, x0, v0), and a1 = a0 + change:
//   (M + gamma dt D + beta dt^2 K) change = f - K (x~ - x0) - D (v~ - v0) - M a0,
// where x~ and v~ are those that a1 = a0 would give, those of held nodes being exact. In free flight nothing is left on the
// right, and a solver that iterates has nothing to do.
static JnStatus linearized_step(JnIntegrator* self, JnStep* step) {
	const Weights* w = self->options;
	JnSystem* sys = step->sys;
	JnSpace* space = self->space;
	const double dt = step->dt;
	JnVec rhs = self->vectors[LOAD], work = self->vectors[KEPT], a1 = self->vectors[A1];
	JnState* end = step->end;
	JnMatrix *mass, *stiffness, *damping, *matrix;
	start_step(self, step);
	JN_TRY(jn_acceleration(self, sys, end, self->vectors[A0]));
	if (sys->depends_on_time) { // loads are those of the end
		end->t = step->start->t + dt;
		jn_state_touch(space, end);
	}
	JN_TRY(sys->ops->force(sys, end, rhs));
	JN_TRY(sys->ops->linearize(sys, end));
	JN_TRY(sys->ops->matrix(sys, (JnShift){.mass = 1}, &mass));
	JN_TRY(sys->ops->matrix(sys, (JnShift){.stiffness = 1}, &stiffness));
	predict(self, step, *w);
	space->ops->combine(space, a1, 1, (JnTerm[]){{1, self->vectors[A0]}});
	space->ops->combine(space, end->x, 2, (JnTerm[]){{1, self->vectors[X]}, {dt * dt * w->beta, a1}});
	space->ops->combine(space, end->v, 2, (JnTerm[]){{1, self->vectors[V]}, {dt * w->gamma, a1}});
	end->t = step->start->t + dt;
	sys->ops->prescribe(sys, end, a1);
	space->ops->combine(space, end->x, 2, (JnTerm[]){{1, end->x}, {-1, step->start->x}});
	stiffness->ops->apply(stiffness, end->x, work);
	space->ops->combine(space, rhs, 2, (JnTerm[]){{1, rhs}, {-1, work}});
	JN_TRY(sys->ops->matrix(sys, (JnShift){.damping = 1}, &damping));
	space->ops->combine(space, end->v, 2, (JnTerm[]){{1, end->v}, {-1, step->start->v}});
	damping->ops->apply(damping, end->v, work);
	space->ops->combine(space, rhs, 2, (JnTerm[]){{1, rhs}, {-1, work}});
	mass->ops->apply(mass, a1, work);
	space->ops->combine(space, rhs, 2, (JnTerm[]){{1, rhs}, {-1, work}});
	sys->ops->hold(sys, rhs);
	JN_TRY(sys->ops->matrix(sys, (JnShift){1, w->gamma * dt, w->beta * dt * dt}, &matrix));
	JN_TRY(matrix->ops->solve(matrix, rhs, work));
	space->ops->combine(space, a1, 2, (JnTerm[]){{1, a1}, {1, work}});
	correct(self, step, *w);
	jn_state_touch(space, end);
	return jn_state_check(space, end);
}

// ---- hht_alpha and generalized_alpha

// vectors[A0] = the acceleration carried along, or that of the start when there is no history.
static JnStatus recall_acceleration(JnIntegrator* self, JnStep* step) {
	const Memory* memory = self->memory;
	if (!memory->has_acceleration) return jn_acceleration(self, step->sys, step->end, self->vectors[A0]);
	self->space->ops->combine(self->space, self->vectors[A0], 1, (JnTerm[]){{1, self->vectors[KEPT]}});
	return JN_OK;
}

static void keep_acceleration(JnIntegrator* self, const JnStep* step) {
	(void)step;
	self->space->ops->combine(self->space, self->vectors[KEPT], 1, (JnTerm[]){{1, self->vectors[A1]}});
	((Memory*)self->memory)->has_acceleration = true;
}

// Accelerations of the held entries, weighted as the forces are: a1 belongs to the time t1 + alpha dt.
static void weigh_held(JnIntegrator* self, JnStep* step, double alpha) {
	JnSpace* space = self->space;
	JnVec held = self->vectors[HELD], earlier = self->vectors[X];
	space->ops->combine(space, held, 0, NULL);
	space->ops->combine(space, earlier, 0, NULL);
	step->end->t = step->start->t + step->dt;
	step->sys->ops->prescribe(step->sys, step->end, held);
	step->end->t = step->start->t;
	step->sys->ops->prescribe(step->sys, step->end, earlier); // and the copy of the start is whole again
	space->ops->combine(space, held, 2, (JnTerm[]){{1 + alpha, held}, {-alpha, earlier}});
}

typedef struct HhtDef {
	double alpha; // -1/3 .. 0
} HhtDef;

static Weights hht_weights(const JnIntegrator* self) {
	const double alpha = ((const HhtDef*)self->options)->alpha;
	return (Weights){.beta = 0.25 * (1 - alpha) * (1 - alpha), .gamma = 0.5 * (1 - 2 * alpha)};
}

static JnStatus hht_step(JnIntegrator* self, JnStep* step) {
	const double alpha = ((const HhtDef*)self->options)->alpha;
	const Weights w = hht_weights(self);
	start_step(self, step);
	JN_TRY(recall_acceleration(self, step));
	JnVec load = self->vectors[LOAD];
	JN_TRY(step->sys->ops->force(step->sys, step->end, load));
	self->space->ops->combine(self->space, load, 1, (JnTerm[]){{-alpha, load}});
	weigh_held(self, step, alpha);
	predict(self, step, w);
	return solve_end(self, step, w, (JnStage){.weight = 1 + alpha, .load = load, .held = self->vectors[HELD]});
}

typedef struct AlphaDef {
	double rho_infinity; // 0 .. 1
} AlphaDef;

static double mass_share(double rho) {
	return (2 * rho - 1) / (rho + 1);
}

static Weights alpha_weights(const JnIntegrator* self) {
	const double rho = ((const AlphaDef*)self->options)->rho_infinity;
	const double am = mass_share(rho), af = rho / (rho + 1);
	return (Weights){.beta = 0.25 * (1 - am + af) * (1 - am + af), .gamma = 0.5 - am + af};
}

// The unknown of the stage is the weighted acceleration  a = (1 - am) a1 + am a0; the end state follows from a1.
static JnStatus generalized_alpha_step(JnIntegrator* self, JnStep* step) {
	const double rho = ((const AlphaDef*)self->options)->rho_infinity;
	const double am = mass_share(rho), af = rho / (rho + 1);
	const Weights w = alpha_weights(self);
	JnSpace* space = self->space;
	const double dt = step->dt, end_share = 1 - af, a1_share = 1 / (1 - am);
	JnVec x = self->vectors[LOAD], a = self->vectors[A1], a0 = self->vectors[A0];
	start_step(self, step);
	JN_TRY(recall_acceleration(self, step));
	predict(self, step, w);
	// (1 - af) (predicted + beta dt^2 a1) + af start, with a1 = (a - am a0) / (1 - am)
	const double kx = end_share * w.beta * dt * dt * a1_share, kv = end_share * w.gamma * dt * a1_share;
	space->ops->combine(space, x, 3, (JnTerm[]){{end_share, self->vectors[X]}, {af, step->start->x}, {-am * kx, a0}});
	JnVec v = self->vectors[MIXED_V];
	space->ops->combine(space, v, 3, (JnTerm[]){{end_share, self->vectors[V]}, {af, step->start->v}, {-am * kv, a0}});
	const JnStage stage = {.t = step->start->t + end_share * dt, .kx = kx, .kv = kv, .x = x, .v = v};
	JN_TRY(jn_stage_solve(self, step->sys, &stage, step->end, a, &step->report));
	space->ops->combine(space, a, 2, (JnTerm[]){{a1_share, a}, {-am * a1_share, a0}});
	correct(self, step, w);
	jn_state_touch(space, step->end);
	return jn_state_check(space, step->end);
}

// ---- what the estimate of Zienkiewicz and Xie needs

static double beta_with(const JnIntegrator* self, Weights w, const double** a0, const double** a1) {
	*a0 = self->vectors[A0];
	*a1 = self->vectors[A1];
	return w.beta;
}

static double newmark_beta(const JnIntegrator* self, const double** a0, const double** a1) {
	return beta_with(self, *(const Weights*)self->options, a0, a1);
}

static double hht_beta(const JnIntegrator* self, const double** a0, const double** a1) {
	return beta_with(self, hht_weights(self), a0, a1);
}

static double alpha_beta(const JnIntegrator* self, const double** a0, const double** a1) {
	return beta_with(self, alpha_weights(self), a0, a1);
}

static const JnKey newmark_keys[] = {
	{.name = "beta",
	 .kind = JN_REAL,
	 .field = offsetof(Weights, beta),
	 .value = {0.25},
	 .low = 0,
	 .high = 0.5,
	 .open = JN_OPEN_LOW,
	 .remedy = "use 0.25 for unconditional stability; verlet is the explicit case beta = 0",
	 .meaning = "weight of the end's acceleration in the position; 1/4: constant average, 1/6: linear acceleration"},
	{.name = "gamma",
	 .kind = JN_REAL,
	 .field = offsetof(Weights, gamma),
	 .value = {0.5},
	 .low = 0.5,
	 .high = 1,
	 .remedy = "below 1/2 the method gains energy",
	 .meaning = "weight of the end's acceleration in the velocity; above 1/2 it damps and is of first order"},
	{0},
};

static const JnKey hht_keys[] = {
	{.name = "alpha",
	 .kind = JN_REAL,
	 .field = offsetof(HhtDef, alpha),
	 .value = {-0.05},
	 .low = -1.0 / 3,
	 .high = 0,
	 .meaning = "numerical damping of high frequencies; 0: none, -1/3: most"},
	{0},
};

static const JnKey alpha_keys[] = {
	{.name = "rho_infinity",
	 .kind = JN_REAL,
	 .field = offsetof(AlphaDef, rho_infinity),
	 .value = {0.8},
	 .low = 0,
	 .high = 1,
	 .meaning =
		 "share of the highest frequencies' amplitude left after a step; 1: no damping, 0: all gone in one step"},
	{0},
};

const JnIntegratorType jn_newmark = {
	.row = {.name = "newmark",
			.doc = "Newmark 1959: one solve; beta and gamma as keys, undamped and second order by default",
			.keys = newmark_keys,
			.options_size = sizeof(Weights)},
	.needs = JN_NEEDS_TANGENT,
	.order = 2,
	.force_weight = 0.25,
	.vectors = VECTORS,
	.step = newmark_step,
	.newmark_beta = newmark_beta,
};

const JnIntegratorType jn_linearized_newmark = {
	.row = {.name = "linearized_newmark",
			.doc = "Newmark with forces linearised about the start: one linear solve a step, no iteration",
			.keys = newmark_keys,
			.options_size = sizeof(Weights)},
	.needs = JN_NEEDS_TANGENT,
	.order = 2,
	.force_weight = 0.25,
	.vectors = VECTORS,
	.keeps_tangent = true,
	.step = linearized_step,
	.newmark_beta = newmark_beta,
};

const JnIntegratorType jn_hht_alpha = {
	.row = {.name = "hht_alpha",
			.doc = "Hilber, Hughes, Taylor 1977: Newmark that damps high frequencies and stays second order",
			.keys = hht_keys,
			.options_size = sizeof(HhtDef)},
	.needs = JN_NEEDS_TANGENT,
	.order = 2,
	.force_weight = 0.25,
	.vectors = VECTORS,
	.memory_size = sizeof(Memory),
	.step = hht_step,
	.commit = keep_acceleration,
	.newmark_beta = hht_beta,
};

const JnIntegratorType jn_generalized_alpha = {
	.row = {.name = "generalized_alpha",
			.doc = "Chung, Hulbert 1993: damps high frequencies as much as rho_infinity says, low ones least",
			.keys = alpha_keys,
			.options_size = sizeof(AlphaDef)},
	.needs = JN_NEEDS_TANGENT,
	.order = 2,
	.force_weight = 0.25,
	.vectors = VECTORS,
	.memory_size = sizeof(Memory),
	.step = generalized_alpha_step,
	.commit = keep_acceleration,
	.newmark_beta = alpha_beta,
};
