// A load is shared by its nodes in proportion to their masses, which for points is to their volumes: a traction on a
// face is the force on its outermost layer of points.
#include "model/load.h"

#include <stdio.h>

#include "model/select.h"

const JnKey jn_load_keys[] = {
	{.name = "where",
	 .kind = JN_OBJECT,
	 .field = offsetof(JnLoadDef, where),
	 .keys = jn_select_keys,
	 .meaning = "which nodes, by their rest positions: exactly one of the entries"},
	{.name = "force",
	 .kind = JN_REAL3,
	 .field = offsetof(JnLoadDef, force),
	 .required = true,
	 .unit = "N",
	 .meaning = "on all of them together, shared in proportion to their masses; a traction is it over the area"},
	{0},
};

// Row sums of the mass matrix are below 0 at corners of tet10, and may cancel; its diagonal never is.
static double mass_of(const JnModel* model, const JnBody* body, int i) {
	const int node = body->first_node + i;
	if (body->mesh.shape != JN_TET10) return model->nodal_mass[node];
	return model->mass[jn_pattern_find(&model->pattern, node, node)];
}

static void add_load(const JnLoadDef* def, const JnBody* body, const bool* chosen, JnModel* model) {
	double total = 0;
	for (int i = 0; i < body->mesh.node_count; ++i) total += chosen[i] ? mass_of(model, body, i) : 0;
	for (int i = 0; i < body->mesh.node_count; ++i) {
		const double share = chosen[i] ? mass_of(model, body, i) / total : 0;
		for (int axis = 0; axis < 3; ++axis)
			model->loads[3 * (size_t)(body->first_node + i) + (size_t)axis] += def->force[axis] * share;
	}
}

static JnStatus load_body(const JnBodyDef* def, int index, const JnBody* body, JnArena* scratch, JnModel* model) {
	bool* chosen;
	JN_NEW(scratch, chosen, body->mesh.node_count);
	for (int i = 0; i < def->loads.count; ++i) {
		const JnLoadDef* load = (const JnLoadDef*)def->loads.data + i;
		char what[96];
		snprintf(what, sizeof what, "bodies[%d].loads[%d].where", index, i);
		JN_TRY(jn_select_nodes(&load->where, &body->mesh, what, chosen));
		add_load(load, body, chosen, model);
	}
	return JN_OK;
}

JnStatus jn_loads_build(const JnItems* bodies, JnModel* model, JnArena* scratch) {
	int count = 0;
	for (int b = 0; b < bodies->count; ++b) count += ((const JnBodyDef*)bodies->data)[b].loads.count;
	if (count == 0) return JN_OK;
	JN_NEW(&model->arena, model->loads, 3 * (size_t)model->node_count);
	for (int b = 0; b < bodies->count; ++b)
		JN_TRY(load_body((const JnBodyDef*)bodies->data + b, b, &model->bodies[b], scratch, model));
	return JN_OK;
}

double jn_loads_potential(const JnModel* model, const double* x) {
	double sum = 0;
	if (model->loads == NULL) return 0;
	for (size_t k = 0; k < 3 * (size_t)model->node_count; ++k) sum -= model->loads[k] * (x[k] - model->rest[k]);
	return sum;
}
