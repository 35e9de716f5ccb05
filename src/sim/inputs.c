// Inputs of a simulation: found by name, and the forces that they feel.
#include <string.h>

#include "model/input.h"
#include "model/model.h"
#include "sim/simulation.h"

JnInput* jn_sim_input(JnSim* sim, const char* name) {
	for (int i = 0; sim->model != NULL && i < sim->model->input_count; ++i)
		if (strcmp(sim->model->inputs[i].name, name) == 0) return &sim->model->inputs[i];
	return NULL;
}

JnStatus jn_sim_input_force(JnSim* sim, const JnInput* input, double force[3]) {
	memset(force, 0, 3 * sizeof *force);
	sim->sys->report = &sim->report;
	JN_TRY(sim->sys->ops->force(sim->sys, &sim->start, sim->work[0]));
	jn_passes_react(&sim->passes, sim->work[0]);
	for (int k = 0; k < input->count; ++k) {
		const int entry = sim->model->held_list[input->held[k]].entry;
		force[entry % 3] += sim->work[0][entry];
	}
	return JN_OK;
}
