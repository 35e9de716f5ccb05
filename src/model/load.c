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

static void add_load(const JnLoadDef* def, const JnBody* body, const bool* chosen, JnModel* model) {
	const double* mass = model->nodal_mass + body->first_node;
	double total = 0;
	for (int i = 0; i < body->mesh.node_count; ++i) total += chosen[i] ? mass[i] : 0;
	for (int i = 0; i < body->mesh.node_count; ++i)
		for (int axis = 0; axis < 3 && chosen[i]; ++axis)
			model->loads[3 * (size_t)(body->first_node + i) + (size_t)axis] += def->force[axis] * mass[i] / total;
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
