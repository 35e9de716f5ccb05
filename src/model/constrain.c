// Which coordinates of a model do not follow the equations of motion: fixed ones, and those driven along paths.
#include "model/constrain.h"

#include <stdio.h>

#include "base/log.h"
#include "model/select.h"

// What the axes of a node do while constraints are collected: 0 free, 1 held at rest, 2 + i driven by motions[i].
typedef struct Axes {
	int* use;                  // 3 * node_count
	const JnVariant** motions; // those met so far
	int motion_count;
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

JnStatus jn_model_constrain(const JnItems* defs, JnModel* model, JnArena* scratch) {
	Axes axes = {0};
	int drives = 0;
	for (int b = 0; b < defs->count; ++b) drives += ((const JnBodyDef*)defs->data)[b].drive.count;
	JN_NEW(scratch, axes.use, 3 * (size_t)model->node_count);
	JN_NEW(scratch, axes.motions, 3 * drives + 1);
	for (int b = 0; b < defs->count; ++b)
		JN_TRY(constrain_body((const JnBodyDef*)defs->data + b, b, &model->bodies[b], scratch, &axes));
	return list_held(&axes, model);
}
