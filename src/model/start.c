// Where a model starts: at rest positions, scattered where bodies say so, with the bodies' velocities.
#include "base/random.h"
#include "model/model.h"

// Row sums of the mass matrix times positions: the integral of density * x, as shape functions reproduce x.
static void mass_centre(const JnModel* model, const JnBody* body, double centre[3]) {
	double moment[3] = {0, 0, 0}, mass = 0;
	for (int node = body->first_node; node < body->first_node + body->mesh.node_count; ++node) {
		mass += model->nodal_mass[node];
		for (int axis = 0; axis < 3; ++axis)
			moment[axis] += model->nodal_mass[node] * model->rest[3 * (size_t)node + axis];
	}
	for (int axis = 0; axis < 3; ++axis) centre[axis] = moment[axis] / mass;
}

// x = X,  v = velocity + spin x (X - centre)
static void start_body(const JnModel* model, const JnBody* body, JnState* state) {
	double centre[3];
	mass_centre(model, body, centre);
	for (int node = body->first_node; node < body->first_node + body->mesh.node_count; ++node) {
		const double* rest = model->rest + 3 * (size_t)node;
		for (int axis = 0; axis < 3; ++axis) {
			const int next = (axis + 1) % 3, last = (axis + 2) % 3;
			const double arm[2] = {rest[next] - centre[next], rest[last] - centre[last]};
			const double turn = body->spin[next] * arm[1] - body->spin[last] * arm[0];
			state->x[3 * (size_t)node + axis] = rest[axis];
			state->v[3 * (size_t)node + axis] = body->velocity[axis] + turn;
		}
	}
}

// Every node draws, also a held one, so that what is held changes no other node.
static void scatter_body(const JnModel* model, const JnBody* body, JnState* state) {
	JnRandom random = {(uint64_t)body->scatter.seed};
	if (body->scatter.amplitude == 0) return;
	for (int node = body->first_node; node < body->first_node + body->mesh.node_count; ++node) {
		double point[3];
		jn_random_in_ball(&random, point);
		for (int axis = 0; axis < 3; ++axis) {
			const size_t k = 3 * (size_t)node + (size_t)axis;
			if (!model->held[k]) state->x[k] += body->scatter.amplitude * point[axis];
		}
	}
}

void jn_model_start(JnModel* model, double t, JnState* state) {
	for (int b = 0; b < model->body_count; ++b) {
		start_body(model, &model->bodies[b], state);
		scatter_body(model, &model->bodies[b], state);
	}
	state->t = t;
	model->system->ops->prescribe(model->system, state, NULL);
	jn_state_touch(model->system->space, state);
}
