// Which coordinates of a model do not follow the equations of motion: fixed ones, and those driven along paths.
#include "model/constrain.h"

#include <stdio.h>
#include <string.h>

#include "base/log.h"
#include "model/guide.h"
#include "model/input.h"
#include "model/select.h"

// What moves a coordinate: one of these is there.
typedef struct Source {
	const JnVariant* motion;
	JnGuide* guide;
	const char* input; // its name
} Source;

// What the axes of a node do while constraints are collected: 0 free, 1 held at rest, 2 + i driven by sources[i].
typedef struct Axes {
	int* use; // 3 * node_count
	Source* sources;
	int source_count;
} Axes;

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

static int add_source(Axes* axes, Source source) {
	axes->sources[axes->source_count] = source;
	return 2 + axes->source_count++;
}

static JnStatus drive_by_motions(const JnDriveDef* def, const char* what, const JnBody* body, const bool* chosen,
								 Axes* axes) {
	char where[128];
	for (int axis = 0; axis < 3; ++axis) {
		const JnMotionType* type = (const JnMotionType*)def->motion[axis].row;
		if (type == NULL) {
			if (def->others == 0) use_axis(axes, body, chosen, axis, 1);
			continue;
		}
		snprintf(where, sizeof where, "%s.%c", what, 'x' + axis);
		if (type->check != NULL) JN_TRY(type->check(def->motion[axis].options, where));
		use_axis(axes, body, chosen, axis, add_source(axes, (Source){.motion = &def->motion[axis]}));
	}
	return JN_OK;
}

static JnStatus check_ways(const JnDriveDef* def, const char* what) {
	const bool has_motion = def->motion[0].row != NULL || def->motion[1].row != NULL || def->motion[2].row != NULL;
	const int ways = has_motion + (def->along != NULL) + (def->input != NULL);
	if (ways == 1) return JN_OK;
	if (ways > 1)
		return jn_error(JN_BAD_INPUT, "%s: several things move it; give one of motions (x, y, z), along, input", what);
	return jn_error(JN_BAD_INPUT, "%s: no axis has a motion; give x, y or z, or along, or input, or use fix", what);
}

static JnStatus drive_nodes(const JnDriveDef* def, const char* what, const JnBody* body, bool* chosen, JnModel* model,
							Axes* axes) {
	char where[128];
	Source source = {.input = def->input};
	snprintf(where, sizeof where, "%s.where", what);
	JN_TRY(jn_select_nodes(&def->where, &body->mesh, where, chosen));
	JN_TRY(check_ways(def, what));
	if (def->along == NULL && def->input == NULL) return drive_by_motions(def, what, body, chosen, axes);
	snprintf(where, sizeof where, "%s.along", what);
	if (def->along != NULL) {
		source.guide = &model->guides[model->guide_count++];
		JN_TRY(jn_guide_create(def->along, where, body, chosen, &model->arena, source.guide));
	}
	const int use = add_source(axes, source);
	for (int axis = 0; axis < 3; ++axis) use_axis(axes, body, chosen, axis, use);
	return JN_OK;
}

static JnStatus constrain_body(const JnBodyDef* def, int index, JnModel* model, JnArena* scratch, Axes* axes) {
	const JnBody* body = &model->bodies[index];
	bool* chosen;
	char what[96];
	JN_NEW(scratch, chosen, body->mesh.node_count);
	for (int i = 0; i < def->fix.count; ++i) {
		snprintf(what, sizeof what, "bodies[%d].fix[%d]", index, i);
		JN_TRY(fix_nodes((const JnFixDef*)def->fix.data + i, what, body, chosen, axes));
	}
	for (int i = 0; i < def->drive.count; ++i) {
		snprintf(what, sizeof what, "bodies[%d].drive[%d]", index, i);
		JN_TRY(drive_nodes((const JnDriveDef*)def->drive.data + i, what, body, chosen, model, axes));
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
	JN_NEW(&model->arena, motions, axes->source_count + 1);
	for (int i = 0; i < axes->source_count; ++i)
		if (axes->sources[i].motion != NULL) motions[i] = *axes->sources[i].motion;
	int place = 0;
	for (int k = 0; k < entries; ++k) {
		if (axes->use[k] == 0) continue;
		const int source = axes->use[k] - 2;
		const bool has_motion = source >= 0 && axes->sources[source].motion != NULL;
		model->held[k] = true;
		model->held_list[place++] = (JnHeld){.entry = k, .motion = has_motion ? &motions[source] : NULL};
	}
	return JN_OK;
}

// A guide moves what no later entry has taken from it.
static void connect_guides(const Axes* axes, const int* place, JnModel* model) {
	for (int g = 0; g < model->guide_count; ++g)
		for (int i = 0; i < model->guides[g].node_count; ++i) {
			JnGuideNode* node = &model->guides[g].nodes[i];
			for (int axis = 0; axis < 3; ++axis) {
				const int source = axes->use[3 * node->node + axis] - 2;
				const bool is_mine = source >= 0 && axes->sources[source].guide == &model->guides[g];
				node->held[axis] = is_mine ? place[3 * node->node + axis] : -1;
			}
		}
}

static JnInput* find_input(JnModel* model, const char* name) {
	for (int i = 0; i < model->input_count; ++i)
		if (strcmp(model->inputs[i].name, name) == 0) return &model->inputs[i];
	JnInput* input = &model->inputs[model->input_count++];
	input->name = name;
	return input;
}

static JnStatus connect_inputs(const Axes* axes, JnModel* model) {
	JN_NEW(&model->arena, model->inputs, axes->source_count + 1);
	for (int i = 0; i < axes->source_count; ++i) {
		if (axes->sources[i].input == NULL) continue;
		JnInput* input = find_input(model, axes->sources[i].input);
		if (input->held == NULL) JN_NEW(&model->arena, input->held, model->held_count);
		for (int k = 0; k < model->held_count; ++k)
			if (axes->use[model->held_list[k].entry] == 2 + i) input->held[input->count++] = k;
	}
	return JN_OK;
}

static JnStatus connect(const Axes* axes, JnModel* model, JnArena* scratch) {
	int* place;
	JN_NEW(scratch, place, 3 * (size_t)model->node_count);
	for (int k = 0; k < model->held_count; ++k) place[model->held_list[k].entry] = k;
	connect_guides(axes, place, model);
	return connect_inputs(axes, model);
}

JnStatus jn_model_constrain(const JnItems* defs, JnModel* model, JnArena* scratch) {
	Axes axes = {0};
	int drives = 0;
	for (int b = 0; b < defs->count; ++b) drives += ((const JnBodyDef*)defs->data)[b].drive.count;
	JN_NEW(scratch, axes.use, 3 * (size_t)model->node_count);
	JN_NEW(scratch, axes.sources, 3 * drives + 1);
	JN_NEW(&model->arena, model->guides, drives + 1);
	for (int b = 0; b < defs->count; ++b)
		JN_TRY(constrain_body((const JnBodyDef*)defs->data + b, b, model, scratch, &axes));
	JN_TRY(list_held(&axes, model));
	return connect(&axes, model, scratch);
}
