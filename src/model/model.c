// From definitions to a model: meshes, numbering, constraints, elements, pattern, mass, system.
#include "model/model.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/log.h"
#include "base/random.h"
#include "mesh/shape/shape.h"
#include "model/mass.h"
#include "model/obstacles.h"
#include "model/select.h"
#include "model/system.h"
#include "model/wind.h"

// What the axes of a node do while constraints are collected: 0 free, 1 held at rest, 2 + i driven by motions[i].
typedef struct Axes {
	int* use;                  // 3 * node_count
	const JnVariant** motions; // those met so far
	int motion_count;
} Axes;

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

static JnStatus axes_mask(const char* axes, const char* what, bool mask[3]) {
	for (const char* c = axes; *c != '\0'; ++c) {
		if (*c < 'x' || *c > 'z')
			return jn_error(JN_BAD_INPUT, "%s.axes: '%s' is more than x, y and z; use only these letters", what, axes);
		mask[*c - 'x'] = true;
	}
	return *axes != '\0' ? JN_OK : jn_error(JN_BAD_INPUT, "%s.axes: empty; name at least one of x, y, z", what);
}

static void use_axis(Axes* axes, const JnBody* body, const bool* chosen, int axis, int use) {
	for (int i = 0; i < body->mesh.node_count; ++i)
		if (chosen[i]) axes->use[3 * (body->first_node + i) + axis] = use;
}

static JnStatus fix_nodes(const JnFixDef* def, const char* what, const JnBody* body, bool* chosen, Axes* axes) {
	char where[128];
	bool mask[3] = {false, false, false};
	snprintf(where, sizeof where, "%s.where", what);
	JN_TRY(jn_select_nodes(&def->where, &body->mesh, where, chosen));
	JN_TRY(axes_mask(def->axes, what, mask));
	for (int axis = 0; axis < 3; ++axis)
		if (mask[axis]) use_axis(axes, body, chosen, axis, 1);
	return JN_OK;
}

static JnStatus drive_nodes(const JnDriveDef* def, const char* what, const JnBody* body, bool* chosen, Axes* axes) {
	char where[128];
	snprintf(where, sizeof where, "%s.where", what);
	JN_TRY(jn_select_nodes(&def->where, &body->mesh, where, chosen));
	int driven = 0;
	for (int axis = 0; axis < 3; ++axis) {
		const JnMotionType* type = (const JnMotionType*)def->motion[axis].row;
		if (type == NULL) {
			if (def->others == 0) use_axis(axes, body, chosen, axis, 1);
			continue;
		}
		snprintf(where, sizeof where, "%s.%c", what, 'x' + axis);
		if (type->check != NULL) JN_TRY(type->check(def->motion[axis].options, where));
		axes->motions[axes->motion_count] = &def->motion[axis];
		use_axis(axes, body, chosen, axis, 2 + axes->motion_count++);
		++driven;
	}
	return driven > 0 ? JN_OK : jn_error(JN_BAD_INPUT, "%s: no axis has a motion; give x, y or z, or use fix", what);
}

static JnStatus constrain_body(const JnBodyDef* def, int index, const JnBody* body, JnArena* scratch, Axes* axes) {
	bool* chosen;
	char what[96];
	JN_NEW(scratch, chosen, body->mesh.node_count);
	for (int i = 0; i < def->fix.count; ++i) {
		snprintf(what, sizeof what, "bodies[%d].fix[%d]", index, i);
		JN_TRY(fix_nodes((const JnFixDef*)def->fix.data + i, what, body, chosen, axes));
	}
	for (int i = 0; i < def->drive.count; ++i) {
		snprintf(what, sizeof what, "bodies[%d].drive[%d]", index, i);
		JN_TRY(drive_nodes((const JnDriveDef*)def->drive.data + i, what, body, chosen, axes));
	}
	return JN_OK;
}

static JnStatus list_held(const Axes* axes, JnModel* model) {
	const int entries = 3 * model->node_count;
	for (int k = 0; k < entries; ++k) model->held_count += axes->use[k] != 0;
	if (model->held_count == entries)
		return jn_error(JN_BAD_INPUT, "bodies: no node is free, all %d are fixed or driven; fix fewer, or fewer axes",
						model->node_count);
	JN_NEW(&model->arena, model->held, entries);
	JN_NEW(&model->arena, model->held_list, model->held_count + 1);
	JnVariant* motions;
	JN_NEW(&model->arena, motions, axes->motion_count + 1);
	for (int i = 0; i < axes->motion_count; ++i) motions[i] = *axes->motions[i];
	int place = 0;
	for (int k = 0; k < entries; ++k) {
		if (axes->use[k] == 0) continue;
		model->held[k] = true;
		model->held_list[place++] =
			(JnHeld){.entry = k, .motion = axes->use[k] >= 2 ? &motions[axes->use[k] - 2] : NULL};
	}
	return JN_OK;
}

static JnStatus constrain(const JnItems* defs, JnModel* model, JnArena* scratch) {
	Axes axes = {0};
	int drives = 0;
	for (int b = 0; b < defs->count; ++b) drives += ((const JnBodyDef*)defs->data)[b].drive.count;
	JN_NEW(scratch, axes.use, 3 * (size_t)model->node_count);
	JN_NEW(scratch, axes.motions, 3 * drives + 1);
	for (int b = 0; b < defs->count; ++b)
		JN_TRY(constrain_body((const JnBodyDef*)defs->data + b, b, &model->bodies[b], scratch, &axes));
	return list_held(&axes, model);
}

static JnStatus build_elements(const JnItems* defs, JnModel* model) {
	for (int b = 0; b < defs->count; ++b) {
		const JnBodyDef* def = (const JnBodyDef*)defs->data + b;
		JnBody* body = &model->bodies[b];
		const JnKernel* kernel = jn_kernel_find(body->mesh.shape, (const JnLaw*)def->material.row, 0);
		if (kernel == NULL)
			return jn_error(JN_BAD_INPUT, "bodies[%d].material.law: '%s' does not run on %s elements", b,
							def->material.row->name, jn_shape_info[body->mesh.shape].name);
		JN_TRY(
			jn_group_create(kernel, &body->mesh, body->first_node, def->material.options, &model->arena, &body->group));
	}
	return JN_OK;
}

static JnStatus build_pattern(JnModel* model, JnArena* scratch) {
	JnCellList* lists;
	JN_NEW(scratch, lists, model->body_count);
	for (int b = 0; b < model->body_count; ++b) {
		const JnBody* body = &model->bodies[b];
		lists[b] = (JnCellList){
			.count = body->mesh.cell_count, .nodes = jn_shape_info[body->mesh.shape].nodes, .cells = body->cells};
	}
	return jn_pattern_create(model->node_count, model->body_count, lists, &model->arena, &model->pattern);
}

static JnStatus build(const JnModelDef* def, JnModel* model, JnArena* scratch) {
	if (def->bodies.count == 0) return jn_error(JN_BAD_INPUT, "bodies: there are none; a scene needs at least one");
	memcpy(model->gravity, def->gravity, sizeof model->gravity);
	JN_TRY(build_meshes(&def->bodies, model));
	JN_TRY(jn_obstacles_create(&def->obstacles, model));
	JN_TRY(constrain(&def->bodies, model, scratch));
	JN_TRY(build_elements(&def->bodies, model));
	JN_TRY(build_pattern(model, scratch));
	JN_TRY(jn_mass_build(model));
	if (def->wind != NULL) JN_TRY(jn_wind_create(def->wind, model, &model->wind));
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
	jn_arena_free(&model->arena);
	free(model);
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
