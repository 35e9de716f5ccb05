#include "model/examine.h"

#include <math.h>
#include <stdio.h>

#include "force/deformation.h"

enum { LANES = 8 }; // the widest kernel's

static const JnSpot nowhere = {.body = -1, .node = -1, .element = -1, .group = -1, .value = NAN};

static int body_of_node(const JnModel* model, int node) {
	int body = model->body_count - 1;
	while (body > 0 && model->bodies[body].first_node > node) --body;
	return body;
}

static int body_of_group(const JnModel* model, int group) {
	int body = model->body_count - 1;
	while (body > 0 && model->bodies[body].first_group > group) --body;
	return body;
}

JnSpot jn_model_node(const JnModel* model, int node) {
	return (JnSpot){.body = body_of_node(model, node), .node = node, .element = -1, .group = -1, .value = NAN};
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
			worst = (JnSpot){.body = b,
							 .node = body->cells[(ptrdiff_t)cell * nodes],
							 .element = cell,
							 .is_cell = true,
							 .group = -1,
							 .value = ratio};
		}
	}
	return worst;
}

JnSpot jn_model_most_stretched(const JnModel* model, const double* x) {
	JnSpot worst = nowhere;
	worst.value = 1;
	for (int g = 0; g < model->group_count; ++g) {
		const JnGroup* group = &model->groups[g];
		for (int e = 0; e < group->count && group->kernel->damage == NULL; ++e) {
			const double stretch = jn_element_stretch(group, e, model->rest, x);
			if (!isfinite(stretch) || fabs(log(stretch)) <= fabs(log(worst.value))) continue;
			worst = (JnSpot){.body = body_of_group(model, g),
							 .node = jn_group_node(group, e, 0),
							 .element = e,
							 .group = g,
							 .value = stretch};
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

// The nodes of a place: at most `room` of them.
static int nodes_of(const JnModel* model, const JnSpot* spot, int room, int* nodes) {
	int count = 0;
	if (spot->element < 0) {
		nodes[count++] = spot->node;
		return count;
	}
	const JnBody* body = &model->bodies[spot->body];
	const int all = spot->is_cell ? jn_shape_info[body->mesh.shape].nodes : model->groups[spot->group].kernel->nodes;
	for (; count < all && count < room; ++count)
		nodes[count] = spot->is_cell ? body->cells[(ptrdiff_t)spot->element * all + count]
									 : jn_group_node(&model->groups[spot->group], spot->element, count);
	return count;
}

void jn_spot_name(const JnModel* model, const JnSpot* spot, const double* x, size_t size, char* text) {
	enum { MOST_NODES = 16 };
	int nodes[MOST_NODES];
	char what[64];
	double at[3] = {0};
	const int count = nodes_of(model, spot, MOST_NODES, nodes);
	for (int i = 0; i < count; ++i)
		for (int axis = 0; axis < 3; ++axis) at[axis] += x[3 * (ptrdiff_t)nodes[i] + axis] / count;
	if (spot->element < 0)
		snprintf(what, sizeof what, "node %d", spot->node);
	else if (spot->is_cell)
		snprintf(what, sizeof what, "cell %d", spot->element);
	else
		snprintf(what, sizeof what, "the element of nodes %d and %d", nodes[0], nodes[count > 1]);
	snprintf(text, size, "%s of '%.60s' at (%.4g, %.4g, %.4g) m", what, model->bodies[spot->body].name, at[0], at[1],
			 at[2]);
}
