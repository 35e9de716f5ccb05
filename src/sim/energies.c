// Energies and mass of what is simulated: of a model, or of a built-in system by its mass matrix and its potential.
#include "base/space.h"
#include "sim/simulation.h"

// work[0] = M in
static void apply_mass(const JnSim* sim, const double* in) {
	JnMatrix* mass = NULL;
	sim->sys->ops->matrix(sim->sys, (JnShift){.mass = 1}, &mass);
	mass->ops->apply(mass, in, sim->work[0]);
}

double jn_sim_mass(const JnSim* sim) {
	if (sim->model != NULL) return jn_model_mass(sim->model);
	JnSpace* space = sim->sys->space;
	space->ops->combine(space, sim->work[1], 0, NULL);
	for (size_t k = 0; k < space->length; k += 3) sim->work[1][k] = 1;
	apply_mass(sim, sim->work[1]);
	return space->ops->dot(space, sim->work[1], sim->work[0]);
}

static void add_momenta(const double* x, const double* p, JnEnergies* out) {
	for (int axis = 0; axis < 3; ++axis) {
		const int next = (axis + 1) % 3, last = (axis + 2) % 3;
		out->momentum[axis] += p[axis];
		out->angular[axis] += x[next] * p[last] - x[last] * p[next];
	}
}

JnEnergies jn_sim_energies(JnSim* sim) {
	const JnState* state = &sim->start;
	if (sim->model != NULL) return jn_model_energies(sim->model, state);
	JnSpace* space = sim->sys->space;
	JnEnergies out = {.elastic = sim->sys->ops->energy(sim->sys, state)};
	apply_mass(sim, state->v);
	out.kinetic = 0.5 * space->ops->dot(space, state->v, sim->work[0]);
	for (size_t k = 0; k + 3 <= space->length; k += 3) add_momenta(state->x + k, sim->work[0] + k, &out);
	return out;
}
