#include "model/examine.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>

#include "force/deformation.h"

enum { LANES = 8 }; // the widest kernel's

static const JnSpot nowhere = {.body = -1, .node = -1, .cell = -1, .value = NAN};

static int body_of_node(const JnModel* model, int node) {
	int body = model->body_count - 1;
	while (body > 0 && model->bodies[body].first_node > node) --body;
	return body;
}

JnSpot jn_model_node(const JnModel* model, int node) {
	return (JnSpot){.body = body_of_node(model, node), .node = node, .cell = -1, .value = NAN};
}

JnSpot jn_model_most_squeezed(const JnModel* model, const double* x) {
	JnSpot worst = nowhere;
	for (int b = 0; b < model->body_count; ++b) {
		const JnBody* body = &model->bodies[b];
		if (body->mesh.shape >= JN_SOLID_SHAPE_COUNT || body->law->build != jn_solid_build) continue;
		for (int cell = 0; cell < body->mesh.cell_count; ++cell) {
			const double ratio = jn_cell_volume_ratio(&body->mesh, cell, x + 3 * (ptrdiff_t)body->first_node);
			if (!isfinite(ratio) || ratio >= worst.value) continue;
			const int nodes = jn_shape_info[body->mesh.shape].nodes;
			worst = (JnSpot){.body = b, .node = body->cells[(ptrdiff_t)cell * nodes], .cell = cell, .value = ratio};
		}
	}
	return worst;
}

static double distance(const double* x, int i, int j) {
	const double *a = x + 3 * (ptrdiff_t)i, *b = x + 3 * (ptrdiff_t)j;
	return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

double jn_model_edge_at(const JnModel* model, int node) {
	double shortest = INFINITY;
	for (int g = 0; g < model->group_count; ++g) {
		const JnGroup* group = &model->groups[g];
		for (int e = 0; e < group->count; ++e) {
			bool has_node = false;
			for (int i = 0; i < group->kernel->nodes; ++i) has_node |= jn_group_node(group, e, i) == node;
			for (int i = 0; has_node && i < group->kernel->nodes; ++i) {
				const double edge = distance(model->rest, node, jn_group_node(group, e, i));
				if (edge > 0) shortest = fmin(shortest, edge);
			}
		}
	}
	return shortest;
}

static double group_energy(const JnGroup* group, const double* x) {
	double sum = 0, energy[LANES];
	for (int batch = 0; batch < group->batches; ++batch) {
		group->kernel->energy(group, batch, batch + 1, x, energy);
		for (int lane = 0; lane < group->kernel->width; ++lane) sum += energy[lane];
	}
	return sum;
}

double jn_model_body_energy(const JnModel* model, int index, const JnState* state) {
	const JnBody* body = &model->bodies[index];
	double sum = 0;
	for (int node = body->first_node; node < body->first_node + body->mesh.node_count; ++node) {
		const double* v = state->v + 3 * (ptrdiff_t)node;
		sum += 0.5 * model->nodal_mass[node] * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
	}
	for (int g = 0; g < body->group_count; ++g) sum += group_energy(&model->groups[body->first_group + g], state->x);
	return sum;
}

void jn_spot_name(const JnModel* model, const JnSpot* spot, const double* x, size_t size, char* text) {
	const JnBody* body = &model->bodies[spot->body];
	const bool is_cell = spot->cell >= 0;
	const int count = is_cell ? jn_shape_info[body->mesh.shape].nodes : 1;
	const int* nodes = is_cell ? body->cells + (ptrdiff_t)spot->cell * count : &spot->node;
	double at[3] = {0};
	for (int i = 0; i < count; ++i)
		for (int axis = 0; axis < 3; ++axis) at[axis] += x[3 * (ptrdiff_t)nodes[i] + axis] / count;
	snprintf(text, size, "%s %d of '%.60s' at (%.4g, %.4g, %.4g) m", is_cell ? "cell" : "node",
			 is_cell ? spot->cell : spot->node, body->name, at[0], at[1], at[2]);
}
