#include "scene/probe.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/key.h"
#include "base/log.h"
#include "model/model.h"
#include "model/select.h"

const JnKey jn_probe_keys[] = {
	{.name = "name",
	 .kind = JN_TEXT,
	 .field = offsetof(JnProbeDef, name),
	 .required = true,
	 .meaning = "names the columns probe.<name>.x, .y, .z"},
	{.name = "at",
	 .kind = JN_REAL3,
	 .field = offsetof(JnProbeDef, at),
	 .absent_allowed = true,
	 .unit = "m",
	 .meaning = "rest position; the nearest node is followed"},
	{.name = "where",
	 .kind = JN_OPTIONAL,
	 .field = offsetof(JnProbeDef, where),
	 .keys = jn_select_keys,
	 .size = sizeof(JnSelectDef),
	 .meaning = "nodes whose mean position is followed, instead of 'at': exactly one of the entries"},
	{.name = "body",
	 .kind = JN_TEXT,
	 .field = offsetof(JnProbeDef, body),
	 .meaning = "name of the body whose nodes are meant; needed by 'where' when there are several"},
	{0},
};

static const JnBodyDef* body_def(const JnItems* bodies, const char* name) {
	const JnBodyDef* defs = bodies->data;
	for (int i = 0; i < bodies->count; ++i)
		if (strcmp(defs[i].name, name) == 0) return &defs[i];
	return NULL;
}

static const char* body_name(void* bodies, int index) {
	const JnItems* items = bodies;
	return index < items->count ? ((const JnBodyDef*)items->data)[index].name : NULL;
}

static JnStatus complain_body(const JnItems* bodies, const char* name, const char* what) {
	const char* near = jn_suggest(name, body_name, (void*)bodies);
	return jn_error(JN_BAD_INPUT, "%s.body: there is no body '%.100s'%s%s%s", what, name,
					near != NULL ? "; did you mean '" : "; use the name of one of the bodies", near != NULL ? near : "",
					near != NULL ? "'?" : "");
}

static JnStatus check_probe(const JnProbeDef* def, int index, const JnItems* bodies) {
	const bool by_point = !isnan(def->at[0]);
	char what[64];
	snprintf(what, sizeof what, "probes[%d]", index);
	if (by_point == (def->where != NULL))
		return jn_error(JN_BAD_INPUT, "%s: %s; give exactly one of at, where", what,
						by_point ? "both a point and a choice of nodes are given" : "nothing says what to follow");
	if (def->body != NULL && body_def(bodies, def->body) == NULL) return complain_body(bodies, def->body, what);
	if (by_point) return JN_OK;
	if (def->body == NULL && bodies->count > 1)
		return jn_error(JN_BAD_INPUT, "%s: 'where' chooses nodes of one body, and there are %d; name one with 'body'",
						what, bodies->count);
	snprintf(what, sizeof what, "probes[%d].where", index);
	return jn_select_check(def->where, what);
}

JnStatus jn_probes_check(const JnSceneDef* def) {
	if (def->probes.count > 0 && def->sim.system.row != NULL)
		return jn_error(JN_BAD_INPUT, "probes: follow nodes of bodies, and '%s' has columns of its own; take them out",
						def->sim.system.row->name);
	for (int i = 0; i < def->probes.count; ++i)
		JN_TRY(check_probe((const JnProbeDef*)def->probes.data + i, i, &def->sim.model.bodies));
	return JN_OK;
}

static const JnBody* find_body(const JnModel* model, const char* name) {
	for (int b = 0; b < model->body_count; ++b)
		if (name != NULL && strcmp(model->bodies[b].name, name) == 0) return &model->bodies[b];
	return &model->bodies[0];
}

static JnStatus follow_point(const JnProbeDef* def, const JnModel* model, JnArena* arena, JnProbe* probe) {
	int* node;
	JN_NEW(arena, node, 1);
	const JnBody* body = find_body(model, def->body);
	*node = def->body == NULL ? jn_select_nearest(model->rest, model->node_count, def->at)
							  : body->first_node + jn_select_nearest(body->mesh.nodes, body->mesh.node_count, def->at);
	*probe = (JnProbe){.count = 1, .nodes = node};
	return JN_OK;
}

JnStatus jn_probe_create(const JnProbeDef* def, int index, const JnModel* model, JnArena* arena, JnProbe* probe) {
	if (def->where == NULL) return follow_point(def, model, arena, probe);
	const JnBody* body = find_body(model, def->body);
	char what[64];
	bool* chosen;
	int *nodes, count = 0;
	snprintf(what, sizeof what, "probes[%d].where", index);
	JN_NEW(arena, chosen, body->mesh.node_count);
	JN_TRY(jn_select_nodes(def->where, &body->mesh, what, chosen));
	for (int i = 0; i < body->mesh.node_count; ++i) count += chosen[i];
	JN_NEW(arena, nodes, count);
	for (int i = 0, k = 0; i < body->mesh.node_count; ++i)
		if (chosen[i]) nodes[k++] = body->first_node + i;
	*probe = (JnProbe){.count = count, .nodes = nodes};
	return JN_OK;
}

void jn_probe_position(const JnProbe* probe, const double* x, double position[3]) {
	for (int axis = 0; axis < 3; ++axis) {
		double sum = 0;
		for (int i = 0; i < probe->count; ++i) sum += x[3 * (size_t)probe->nodes[i] + (size_t)axis];
		position[axis] = sum / probe->count;
	}
}
