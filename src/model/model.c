// From definitions to a model: meshes, numbering, constraints, elements, pattern, mass, system.
#include "model/model.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/log.h"
#include "mesh/shape/shape.h"
#include "model/constrain.h"
#include "model/load.h"
#include "model/mass.h"
#include "model/obstacles.h"
#include "model/repulsion.h"
#include "model/select.h"
#include "model/system.h"
#include "model/wind.h"

static JnStatus mesh_body(const JnBodyDef* def, int index, JnModel* model) {
	JnBody* body = &model->bodies[index];
	*body =
		(JnBody){.name = def->name, .damping = def->damping, .mass_form = def->mass, .first_node = model->node_count};
	body->drag = def->drag;
	memcpy(body->velocity, def->velocity, sizeof body->velocity);
	memcpy(body->spin, def->spin, sizeof body->spin);
	body->scatter = def->scatter;
	body->contact = def->contact;
	body->contact.surface = jn_surface_name(def->contact.surface);
	const JnShapeType* shape = (const JnShapeType*)def->shape.row;
	char what[96];
	snprintf(what, sizeof what, "bodies[%d].shape", index);
	JN_TRY(shape->generate(def->shape.options, what, &model->arena, &body->mesh));
	if (body->mesh.cell_count == 0 || body->mesh.node_count == 0)
		return jn_error(JN_BAD_INPUT, "%s: the mesh of '%s' has no cells; give it some", what, def->name);
	snprintf(what, sizeof what, "bodies[%d].sets", index);
	JN_TRY(jn_select_add_sets(&def->sets, what, &model->arena, &body->mesh));
	const size_t entries = (size_t)body->mesh.cell_count * (size_t)jn_shape_info[body->mesh.shape].nodes;
	JN_NEW(&model->arena, body->cells, entries);
	for (size_t k = 0; k < entries; ++k) body->cells[k] = body->mesh.cells[k] + body->first_node;
	model->node_count += body->mesh.node_count;
	return JN_OK;
}

static JnStatus check_names(const JnItems* bodies) {
	const JnBodyDef* defs = bodies->data;
	for (int i = 0; i < bodies->count; ++i)
		for (int j = 0; j < i; ++j)
			if (strcmp(defs[i].name, defs[j].name) == 0)
				return jn_error(JN_BAD_INPUT, "bodies[%d].name: '%s' is the name of bodies[%d] already; use another", i,
								defs[i].name, j);
	return JN_OK;
}

static JnStatus build_meshes(const JnItems* defs, JnModel* model) {
	JN_TRY(check_names(defs));
	model->body_count = defs->count;
	JN_NEW(&model->arena, model->bodies, defs->count);
	for (int b = 0; b < defs->count; ++b) JN_TRY(mesh_body((const JnBodyDef*)defs->data + b, b, model));
	JN_NEW(&model->arena, model->rest, 3 * (size_t)model->node_count);
	for (int b = 0; b < defs->count; ++b) {
		const JnBody* body = &model->bodies[b];
		memcpy(model->rest + 3 * (size_t)body->first_node, body->mesh.nodes,
			   3 * (size_t)body->mesh.node_count * sizeof *model->rest);
	}
	return JN_OK;
}

static JnStatus build_elements(const JnItems* defs, JnModel* model, JnArena* scratch) {
	JnGroups* made;
	JN_NEW(scratch, made, model->body_count);
	for (int b = 0; b < defs->count; ++b) {
		const JnBodyDef* def = (const JnBodyDef*)defs->data + b;
		const JnLaw* law = (const JnLaw*)def->material.row;
		JnBody* body = &model->bodies[b];
		char what[96];
		snprintf(what, sizeof what, "bodies[%d]", b);
		JN_TRY(law->build(law, def->material.options, &body->mesh, body->first_node, what, &model->arena, &made[b]));
		body->law = law;
		body->density = made[b].density;
		body->first_group = model->group_count;
		body->group_count = made[b].count;
		model->group_count += made[b].count;
	}
	JN_NEW(&model->arena, model->groups, model->group_count + 1);
	for (int b = 0; b < model->body_count; ++b)
		for (int g = 0; g < made[b].count; ++g) model->groups[model->bodies[b].first_group + g] = made[b].list[g];
	return JN_OK;
}

// The cells of a group's elements, which stand in batches of lanes.
static JnStatus list_elements(const JnGroup* group, JnArena* arena, JnCellList* list) {
	const int nodes = group->kernel->nodes;
	int* cells;
	JN_NEW(arena, cells, (size_t)group->count * (size_t)nodes);
	for (int e = 0; e < group->count; ++e)
		for (int i = 0; i < nodes; ++i) cells[(size_t)e * (size_t)nodes + (size_t)i] = jn_group_node(group, e, i);
	*list = (JnCellList){.count = group->count, .nodes = nodes, .cells = cells};
	return JN_OK;
}

// Products stand for matrices where the solver is content with them and no part of the model needs more: bodies without
// solid elements, whose blocks would be many. A kernel that freezes is left out: D may be of an earlier step, and its
// product would be that of the present one.
static bool can_be_matrix_free(const JnModelDef* def, const JnModel* model) {
	const JnSolverType* solver = (const JnSolverType*)def->solver.row;
	if (solver->takes_products == NULL || !solver->takes_products(def->solver.options)) return false;
	const bool is_auto = solver == &jn_solver_auto; // stiff threads and sheets need better than diagonal blocks
	for (int b = 0; b < model->body_count; ++b)
		if ((is_auto && model->bodies[b].mesh.shape != JN_POINT1) ||
			(model->bodies[b].mass_form == 0 && model->bodies[b].mesh.shape != JN_POINT1) ||
			model->bodies[b].law->build == jn_solid_build)
			return false;
	for (int g = 0; g < model->group_count; ++g)
		if (model->groups[g].kernel->product == NULL || model->groups[g].kernel->freeze != NULL) return false;
	return def->wind == NULL || def->wind->tangent == 0;
}

static JnStatus diagonal_pattern(JnModel* model, JnArena* scratch) {
	JnCellList list = {.count = model->node_count, .nodes = 1};
	int* cells;
	JN_NEW(scratch, cells, model->node_count);
	for (int i = 0; i < model->node_count; ++i) cells[i] = i;
	list.cells = cells;
	return jn_pattern_create(model->node_count, 1, &list, &model->arena, &model->pattern);
}

// Bonds of points reach far: their factor fills up as that of no mesh does.
static JnStatus check_size(const JnModelDef* def, const JnModel* model) {
	static const int most = 300000;
	for (int b = 0; b < model->body_count; ++b) {
		const JnBody* body = &model->bodies[b];
		long elements = 0;
		for (int g = 0; g < body->group_count; ++g) elements += model->groups[body->first_group + g].count;
		if (body->mesh.shape == JN_POINT1 && elements > most)
			return jn_error(
				JN_BAD_INPUT,
				"bodies[%d]: %ld bonds between %d points are too many for assembled matrices (solver.method: "
				"%s), whose limit is %d; use solver.method: cg",
				b, elements, body->mesh.node_count, def->solver.row->name, most);
	}
	return JN_OK;
}

// Neighbours are what shares a cell, for the mass, or an element.
static JnStatus build_pattern(const JnModelDef* def, JnModel* model, JnArena* scratch) {
	model->is_matrix_free = can_be_matrix_free(def, model);
	if (model->is_matrix_free) return diagonal_pattern(model, scratch);
	JN_TRY(check_size(def, model));
	JnCellList* lists;
	JN_NEW(scratch, lists, model->body_count + model->group_count);
	for (int b = 0; b < model->body_count; ++b) {
		const JnBody* body = &model->bodies[b];
		lists[b] = (JnCellList){
			.count = body->mesh.cell_count, .nodes = jn_shape_info[body->mesh.shape].nodes, .cells = body->cells};
	}
	int count = model->body_count;
	for (int b = 0; b < model->body_count; ++b) {
		const JnBody* body = &model->bodies[b];
		for (int g = 0; g < body->group_count && body->law->build != jn_solid_build; ++g)
			JN_TRY(list_elements(&model->groups[body->first_group + g], scratch, &lists[count++]));
	}
	return jn_pattern_create(model->node_count, count, lists, &model->arena, &model->pattern);
}

static JnStatus build(const JnModelDef* def, JnModel* model, JnArena* scratch) {
	if (def->bodies.count == 0) return jn_error(JN_BAD_INPUT, "bodies: there are none; a scene needs at least one");
	memcpy(model->gravity, def->gravity, sizeof model->gravity);
	JN_TRY(build_meshes(&def->bodies, model));
	JN_TRY(jn_obstacles_create(&def->obstacles, model));
	JN_TRY(jn_model_constrain(&def->bodies, model, scratch));
	JN_TRY(build_elements(&def->bodies, model, scratch));
	JN_TRY(build_pattern(def, model, scratch));
	JN_TRY(jn_mass_build(model));
	JN_TRY(jn_loads_build(&def->bodies, model, scratch));
	if (def->wind != NULL) JN_TRY(jn_wind_create(def->wind, model, &model->wind));
	JN_TRY(jn_repulsion_create(def->repulsion, def, model, &model->repulsion));
	return jn_model_system_create(model, &def->solver);
}

JnStatus jn_model_create(const JnModelDef* def, int threads, JnModel** out) {
	*out = NULL;
	JnModel* model = calloc(1, sizeof *model);
	if (model == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: model");
	model->threads = threads > 0 ? threads : 1;
	JnArena scratch = {0};
	const JnStatus status = build(def, model, &scratch);
	jn_arena_free(&scratch);
	if (status == JN_OK)
		*out = model;
	else
		jn_model_destroy(model);
	return status;
}

void jn_model_destroy(JnModel* model) {
	if (model == NULL) return;
	jn_model_system_destroy(model);
	jn_repulsion_destroy(model->repulsion);
	jn_arena_free(&model->arena);
	free(model);
}

double jn_group_beta(const JnModel* model, const JnBody* body, int group) {
	return body->damping.beta + model->groups[body->first_group + group].damping;
}

bool jn_body_has_beta(const JnModel* model, const JnBody* body) {
	for (int g = 0; g < body->group_count; ++g)
		if (jn_group_beta(model, body, g) > 0) return true;
	return false;
}

int jn_model_node_count(const JnModel* model) {
	return model->node_count;
}

double jn_model_mass(const JnModel* model) {
	return model->total_mass;
}

const double* jn_model_rest(const JnModel* model) {
	return model->rest;
}

int jn_model_nearest(const JnModel* model, const double point[3]) {
	return jn_select_nearest(model->rest, model->node_count, point);
}

JnSystem* jn_model_system(JnModel* model) {
	return model->system;
}
