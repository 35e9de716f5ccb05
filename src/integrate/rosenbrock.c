// Rosenbrock methods on M x'' = f(t, x, v) (HO section 3.3), with f_x = -K and f_v = -D at the start of the step. HO
// prints gamma in place of gamma_i and forgets a f_x in its equation 12, which leaves order 1; the stages are
//   (1/(gamma h) M + D + gamma h K) V_i = f(t + alpha_i h, x^, v^) + M sum_j c_ij/h V_j + gamma_i h f_t - gamma h K w,
//   U_i = gamma h (w + V_i),   x^ = x + sum_j a_ij U_j,   v^ = v + sum_j a_ij V_j,   w = v^ + sum_j c_ij/h U_j,   j < i.
// For Z = w + V_i and times gamma h the product with K is gone:
//   (M + gamma h D + (gamma h)^2 K) Z = gamma h (f + gamma_i h f_t + D w) + M (w + gamma sum_j c_ij V_j)
// so that one K rules the stage even where the factorisation had to replace an indefinite one.
//
// Held nodes are functions of time: the unknowns are the free ones, f stands for f - M a_held, and f_t is its derivative
// at fixed free x and v. U, V, w and Z are zero at held nodes.
#include "integrate/rosenbrock.h"

#include <math.h>

#include "base/space.h"
#include "integrate/integrator.h"
#include "integrate/rosenbrock_tableau.h"

/// Work vectors: f - M a_held, its time derivative, w, the right-hand side, a product; then U_i and V_i of each stage.
enum { FORCE, FORCE_RATE, W, RIGHT, PRODUCT, INCREMENTS };

/// Distance of the states that give f_t, relative to the step. Its error is h^2 f_ttt 1e-6 / 3, that of rounding about
/// 1e-13 f / h.
static const double probe = 1e-3;

static JnVec increment_x(const JnIntegrator* self, int i) {
	return self->vectors[INCREMENTS + 2 * i];
}

static JnVec increment_v(const JnIntegrator* self, int i) {
	return self->vectors[INCREMENTS + 2 * i + 1];
}

// out = base + scale * sum_{j < count} weight_j increment_j
static void add_increments(const JnIntegrator* self, JnVec (*increment)(const JnIntegrator*, int), const double* base,
						   double scale, int count, const double weight[], JnVec out) {
	JnTerm terms[JN_MAX_STAGES + 1] = {{1, base}};
	int n = 1;
	for (int j = 0; j < count; ++j)
		if (weight[j] != 0) terms[n++] = (JnTerm){scale * weight[j], increment(self, j)};
	self->space->ops->combine(self->space, out, n, terms);
}

// out += scale * (matrix of the shift) * in
static JnStatus add_product(JnIntegrator* self, JnSystem* sys, JnShift shift, const double* in, double scale,
							JnVec out) {
	JnMatrix* matrix = NULL;
	JN_TRY(sys->ops->matrix(sys, shift, &matrix));
	matrix->ops->apply(matrix, in, self->vectors[PRODUCT]);
	self->space->ops->combine(self->space, out, 2, (JnTerm[]){{1, out}, {scale, self->vectors[PRODUCT]}});
	return JN_OK;
}

// out = f(s) - M a_held at free nodes, 0 at held ones.
static JnStatus free_force(JnIntegrator* self, JnSystem* sys, JnState* s, JnVec out) {
	JnVec a = self->vectors[RIGHT];
	JN_TRY(sys->ops->force(sys, s, out));
	self->space->ops->combine(self->space, a, 0, NULL);
	sys->ops->prescribe(sys, s, a); // rewrites the held entries of s with the values that they have
	JN_TRY(add_product(self, sys, (JnShift){.mass = 1}, a, -1, out));
	sys->ops->hold(sys, out);
	return JN_OK;
}

// out = the force of the start with the time alone moved on by `ahead`.
static JnStatus later_force(JnIntegrator* self, JnStep* step, double ahead, JnVec out) {
	JnState* s = step->end;
	jn_state_copy(self->space, step->start, s);
	s->t += ahead;
	step->sys->ops->prescribe(step->sys, s, NULL);
	jn_state_touch(self->space, s);
	return free_force(self, step->sys, s, out);
}

// f_t by (4 f(d) - f(2d) - 3 f(0)) / 2d. Both points lie within the step: motions may have kinks where steps meet.
static JnStatus find_force_rate(JnIntegrator* self, JnStep* step) {
	const double distance = probe * step->dt;
	JnVec rate = self->vectors[FORCE_RATE], further = self->vectors[W], here = self->vectors[FORCE];
	JN_TRY(later_force(self, step, distance, rate));
	JN_TRY(later_force(self, step, 2 * distance, further));
	const JnTerm terms[] = {{2 / distance, rate}, {-0.5 / distance, further}, {-1.5 / distance, here}};
	self->space->ops->combine(self->space, rate, 3, terms);
	return JN_OK;
}

static bool shares_state(const JnRosenbrock* table, int i) {
	for (int j = 0; j < i; ++j)
		if (table->a[i][j] != table->a[i - 1][j]) return false;
	return table->alpha[i] == table->alpha[i - 1];
}

// Force of stage i, into FORCE; of the first one also its time derivative.
static JnStatus evaluate(JnIntegrator* self, JnStep* step, int i) {
	const JnRosenbrock* table = self->type->table;
	JnState* s = step->end;
	if (i > 0 && shares_state(table, i)) return JN_OK;
	if (i == 0) {
		jn_state_copy(self->space, step->start, s); // the stamp comes along: forces at the start are known
		JN_TRY(free_force(self, step->sys, s, self->vectors[FORCE]));
		return step->sys->depends_on_time ? find_force_rate(self, step) : JN_OK;
	}
	add_increments(self, increment_x, step->start->x, 1, i, table->a[i], s->x);
	add_increments(self, increment_v, step->start->v, 1, i, table->a[i], s->v);
	s->t = step->start->t + table->alpha[i] * step->dt;
	step->sys->ops->prescribe(step->sys, s, NULL);
	jn_state_touch(self->space, s);
	return free_force(self, step->sys, s, self->vectors[FORCE]);
}

// w = v^ + sum_j c_ij / h U_j at free nodes.
static void find_w(JnIntegrator* self, const JnStep* step, int i) {
	const JnRosenbrock* table = self->type->table;
	JnVec w = self->vectors[W];
	add_increments(self, increment_v, step->start->v, 1, i, table->a[i], w);
	add_increments(self, increment_x, w, 1 / step->dt, i, table->c[i], w);
	step->sys->ops->hold(step->sys, w);
}

// The right-hand side. A system whose D follows the state has moved it on to the stage: linearize brings it back, and is
// free otherwise.
static JnStatus assemble(JnIntegrator* self, JnStep* step, int i) {
	const JnRosenbrock* table = self->type->table;
	JnSystem* sys = step->sys;
	const double gh = table->gamma * step->dt, rate = sys->depends_on_time ? table->gamma_sum[i] * step->dt : 0;
	JnVec w = self->vectors[W], right = self->vectors[RIGHT], momentum = increment_v(self, i);
	JN_TRY(sys->ops->linearize(sys, step->start));
	const JnTerm forces[] = {{gh, self->vectors[FORCE]}, {gh * rate, self->vectors[FORCE_RATE]}};
	self->space->ops->combine(self->space, right, rate != 0 ? 2 : 1, forces);
	JN_TRY(add_product(self, sys, (JnShift){.damping = 1}, w, gh, right));
	add_increments(self, increment_v, w, table->gamma, i, table->c[i], momentum);
	JN_TRY(add_product(self, sys, (JnShift){.mass = 1}, momentum, 1, right));
	sys->ops->hold(sys, right);
	return JN_OK;
}

static JnStatus solve_stage(JnIntegrator* self, JnStep* step, int i) {
	const JnRosenbrock* table = self->type->table;
	const double gh = table->gamma * step->dt;
	JnVec z = increment_x(self, i);
	JnMatrix* matrix = NULL;
	find_w(self, step, i);
	JN_TRY(assemble(self, step, i));
	JN_TRY(step->sys->ops->matrix(step->sys, (JnShift){1, gh, gh * gh}, &matrix));
	JN_TRY(matrix->ops->solve(matrix, self->vectors[RIGHT], z));
	self->space->ops->combine(self->space, increment_v(self, i), 2, (JnTerm[]){{1, z}, {-1, self->vectors[W]}});
	self->space->ops->combine(self->space, z, 1, (JnTerm[]){{gh, z}});
	return isfinite(self->space->ops->max(self->space, z)) ? JN_OK : JN_NOT_FINITE;
}

// The largest entry of sum (m_i - m^_i) U_i.
static double estimate_error(JnIntegrator* self) {
	const JnRosenbrock* table = self->type->table;
	JnTerm terms[JN_MAX_STAGES];
	for (int i = 0; i < table->stages; ++i)
		terms[i] = (JnTerm){table->m[i] - table->m_embedded[i], increment_x(self, i)};
	self->space->ops->combine(self->space, self->vectors[PRODUCT], table->stages, terms);
	return self->space->ops->max(self->space, self->vectors[PRODUCT]);
}

static JnStatus rosenbrock_step(JnIntegrator* self, JnStep* step) {
	const JnRosenbrock* table = self->type->table;
	step->sys->report = &step->report;
	for (int i = 0; i < table->stages; ++i) {
		JN_TRY(evaluate(self, step, i));
		JN_TRY(solve_stage(self, step, i));
	}
	add_increments(self, increment_x, step->start->x, 1, table->stages, table->m, step->end->x);
	add_increments(self, increment_v, step->start->v, 1, table->stages, table->m, step->end->v);
	step->end->t = step->start->t + step->dt;
	step->sys->ops->prescribe(step->sys, step->end, NULL);
	jn_state_touch(self->space, step->end);
	if (table->has_embedded) step->report.error = estimate_error(self);
	return jn_state_check(self->space, step->end);
}

static void rosenbrock_properties(const void* table, JnTableauProperties* out) {
	*out = jn_rosenbrock_properties(table);
}

// force_weight: gamma^2, as for a method whose last stage has the diagonal gamma.
#define ROSENBROCK(method, p, stage_count, diagonal, is_overshooting, words)                                           \
	const JnIntegratorType jn_##method = {                                                                             \
		.row = {.name = #method, .doc = (words)},                                                                      \
		.needs = JN_NEEDS_TANGENT,                                                                                     \
		.order = (p),                                                                                                  \
		.force_weight = (diagonal) * (diagonal),                                                                       \
		.overshoots = (is_overshooting),                                                                               \
		.keeps_tangent = true,                                                                                         \
		.vectors = INCREMENTS + 2 * (stage_count),                                                                     \
		.table = &jn_rosenbrock_##method,                                                                              \
		.properties = rosenbrock_properties,                                                                           \
		.step = rosenbrock_step,                                                                                       \
	};

ROSENBROCK(linearized_euler, 1, 1, 1, false,
		   "Baraff, Witkin 1998: one linear solve, no iteration; robust, damps strongly")
ROSENBROCK(linearized_midpoint, 2, 1, 0.5, false, "one linear solve, no iteration; undamped where forces are linear")
ROSENBROCK(ros2, 2, 2, 0.2928932188134525, false,
		   "Verwer et al. 1999: two linear solves; keeps its order with any tangent")
ROSENBROCK(ros3p, 3, 3, 0.7886751345948129, false,
		   "Lang, Verwer 2001: three linear solves, two forces; its error estimate sees little of the positions")
ROSENBROCK(ros3pl, 3, 4, 0.4358665215084590, false,
		   "Lang, Teleaga 2008: four linear solves, third order; bounded on stiff rotating bodies, but damps them")
ROSENBROCK(ros3prl2, 3, 4, 0.4358665215084590, false,
		   "Rang 2015: four linear solves, third order; needs the exact tangent, unstable on stiff rotating bodies")
ROSENBROCK(ros34pw2, 3, 4, 0.4358665215084590, false,
		   "Rang, Angermann 2005: third order with any tangent; unstable on stiff rotating bodies")
ROSENBROCK(ros34pw3, 4, 4, 1.068579021301629, false,
		   "Rang, Angermann 2005: four linear solves, fourth order at small steps; unstable on stiff rotating bodies")
ROSENBROCK(rodas3, 3, 4, 0.5, false,
		   "Sandu et al. 1997: four linear solves, three forces; unstable on stiff rotating bodies")
ROSENBROCK(rodas4, 4, 6, 0.25, true,
		   "Hairer, Wanner 1996: six linear solves, fourth order; the most accurate of its family")
