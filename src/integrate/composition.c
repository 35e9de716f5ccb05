// Splitting methods on M a = f(t, x, v) (EX): a step is a row of kicks and drifts,
//   kick   v += c dt M^-1 f(t, x, v)        drift   x += d dt v,  t += d dt
// For f(t, x) each of them is solved exactly, which makes every such method symplectic.
//
// Time moves with the drifts alone, as a coordinate of speed 1 would: a first kick belongs to the start of the step. So
// loads and driven nodes that change with time keep the order. Forces that depend on v do not: a kick takes them at the
// v before it, an Euler step, so that with damping every method here is of first order.
#include "integrate/composition.h"

#include "base/space.h"
#include "integrate/integrator.h"

/// Work vectors.
enum { ACCELERATION, VECTORS };

// to->v = from->v + kick M^-1 f, to->x = from->x + drift to->v. The work vector takes accelerations, where the system has
// no such verb of its own.
static JnStatus advance(JnIntegrator* self, const JnStep* step, const JnState* from, double kick, double drift) {
	JnSpace* space = self->space;
	JnState* to = step->end;
	JnVec a = self->vectors[ACCELERATION];
	if (step->sys->ops->advance != NULL && step->sys->mass_is_diagonal)
		return step->sys->ops->advance(step->sys, from, kick, drift, to);
	if (from != to) jn_state_copy(space, from, to);
	if (kick != 0) JN_TRY(jn_acceleration(self, step->sys, to, a));
	if (kick != 0) space->ops->combine(space, to->v, 2, (JnTerm[]){{1, to->v}, {kick, a}});
	if (drift != 0) space->ops->combine(space, to->x, 2, (JnTerm[]){{1, to->x}, {drift, to->v}});
	return jn_state_check(space, to);
}

// A kick alone leaves the stamp: what a system keeps by stamp are forces without their part in v. Thus the forces of a last
// kick are known to the next step, and those known at the start serve a first kick. A last kick stands at elapsed = 1, so
// that prescribe writes the positions that are there and corrects velocities alone.
static JnStatus composition_step(JnIntegrator* self, JnStep* step) {
	const JnComposition* table = self->type->table;
	const JnState* from = step->start;
	JnState* end = step->end;
	step->sys->report = &step->report;
	double elapsed = 0;
	for (int i = 0; i < table->count; ++i) {
		const double kick = table->kick[i] * step->dt, drift = table->drift[i] * step->dt;
		JN_TRY(advance(self, step, from, kick, drift));
		elapsed += table->drift[i];
		end->t = i + 1 < table->count ? step->start->t + elapsed * step->dt : step->start->t + step->dt;
		step->sys->ops->prescribe(step->sys, end, NULL);
		end->stamp = from->stamp;
		if (drift != 0) jn_state_touch(self->space, end);
		from = end;
	}
	return JN_OK;
}

static const JnComposition symplectic_euler = {1, {1}, {1}};

static const JnComposition modified_midpoint = {2, {0, 1}, {0.5, 0.5}};

static const JnComposition verlet = {2, {0.5, 0.5}, {1, 0}};

static const JnComposition ruth3 = {3, {7.0 / 24, 3.0 / 4, -1.0 / 24}, {2.0 / 3, -2.0 / 3, 1}};

// theta = 1 / (2 - 2^(1/3)): kicks theta, 1 - 2 theta, theta; drifts theta / 2, (1 - theta) / 2, and back.
static const JnComposition forest_ruth = {
	4,
	{0, 1.351207191959657634048, -1.702414383919315268095, 1.351207191959657634048},
	{0.6756035959798288170238, -0.1756035959798288170238, -0.1756035959798288170238, 0.6756035959798288170238},
};

static const JnComposition pefrl = {
	5,
	{0, 0.7123418310626054, -0.2123418310626054, -0.2123418310626054, 0.7123418310626054},
	{0.1786178958448091, -0.06626458266981849, 0.77529337365001878, -0.06626458266981849, 0.1786178958448091},
};

#define COMPOSITION(method, p, words)                                                                                  \
	const JnIntegratorType jn_##method = {                                                                             \
		.row = {.name = #method, .doc = (words)},                                                                      \
		.needs = JN_NEEDS_DIAGONAL_MASS,                                                                               \
		.order = (p),                                                                                                  \
		.vectors = VECTORS,                                                                                            \
		.table = &(method),                                                                                            \
		.step = composition_step,                                                                                      \
	};

COMPOSITION(symplectic_euler, 1, "Cromer 1981: explicit and symplectic, stable to omega dt = 2; one force a step")
COMPOSITION(
	modified_midpoint, 2,
	"position Verlet, drift-kick-drift: symplectic, stable to omega dt = 2; one force a step, order 1 with damping")
COMPOSITION(verlet, 2,
			"velocity Verlet 1967, or leapfrog: symplectic, stable to omega dt = 2; one force a step, order 1 with "
			"damping; the default among explicit methods")
COMPOSITION(ruth3, 3, "Ruth 1983: symplectic, stable to omega dt = 2.507; three forces a step, order 1 with damping")
COMPOSITION(
	forest_ruth, 4,
	"Forest, Ruth 1990: fourth order, symplectic, stable to omega dt = 1.573 only; three forces a step, order 1 "
	"with damping")
COMPOSITION(pefrl, 4,
			"Omelyan, Mryglod, Folk 2002: fourth order, symplectic, stable to omega dt = 2.989; four forces a step and "
			"far smaller errors than forest_ruth; order 1 with damping")
