#include "support/coarse_scene.h"

#include <glob.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "base/key.h"
#include "control/controller.h"
#include "mesh/shape/shape.h"

enum { MOST_CELLS = 32, KEPT_BODIES = 10 };

void add_set(Sets* sets, const char* format, ...) {
	va_list arguments;
	assert_true(sets->count < MOST_SETS);
	va_start(arguments, format);
	vsnprintf(sets->text[sets->count], SET_LENGTH, format, arguments);
	va_end(arguments);
	sets->list[sets->count] = sets->text[sets->count];
	++sets->count;
}

void copy_sets(const Sets* from, Sets* to) {
	*to = *from;
	for (int i = 0; i < to->count; ++i) to->list[i] = to->text[i];
}

bool is_kept(int body, int bodies) {
	return bodies <= KEPT_BODIES || body < KEPT_BODIES / 2 || body >= bodies - KEPT_BODIES / 2;
}

void drop_bodies(const JnScene* scene) {
	JnItems* bodies = (JnItems*)&jn_scene_def(scene)->sim.model.bodies;
	JnBodyDef* list = (JnBodyDef*)bodies->data;
	if (bodies->count <= KEPT_BODIES) return;
	const int half = KEPT_BODIES / 2;
	memmove(list + half, list + bodies->count - half, (size_t)half * sizeof *list);
	bodies->count = KEPT_BODIES;
}

static double first_step(const JnVariant* step) {
	for (const JnKey* key = step->row->keys; key->name != NULL; ++key)
		if (strcmp(key->name, "dt") == 0) return *(const double*)((const char*)step->options + key->field);
	return NAN;
}

// Halve the longest edge of cells until few are left.
static void coarsen_box(const JnBoxDef* box, int index, Sets* sets) {
	int cells[3];
	memcpy(cells, box->cells, sizeof cells);
	while (cells[0] * cells[1] * cells[2] > MOST_CELLS) {
		int longest = 0;
		for (int axis = 1; axis < 3; ++axis)
			if (cells[axis] > cells[longest]) longest = axis;
		cells[longest] /= 2;
	}
	add_set(sets, "bodies[%d].shape.cells=[%d, %d, %d]", index, cells[0], cells[1], cells[2]);
}

// Of the other generated shapes, the coarsest meshes that show what they are.
static void coarsen(const JnBodyDef* body, int index, Sets* sets) {
	static const char* const coarse[][2] = {
		{"sheet", "cells=[6, 6]"},       {"cloth", "cells=[6, 6]"},    {"ball", "cells=2"},
		{"cylinder", "cells=[8, 1, 4]"}, {"torus", "cells=[8, 1, 8]"}, {"rope", "cells=[4, 1, 10]"},
		{"jello", "cells=[32, 1, 2]"},   {"duck", "mesh=voxels"},      {"duck", "cell=6 cm"},
		{"beach_ball", "mesh=voxels"},   {"beach_ball", "cell=5 cm"},  {"points_box", "spacing=5 mm"},
	};
	const char* shape = body->shape.row->name;
	if (strcmp(shape, "box") == 0) coarsen_box(body->shape.options, index, sets);
	for (size_t i = 0; i < sizeof coarse / sizeof *coarse; ++i)
		if (strcmp(shape, coarse[i][0]) == 0) add_set(sets, "bodies[%d].shape.%s", index, coarse[i][1]);
	// Surfaces from elsewhere are not in a clean tree; and a scattered start is a test of its own.
	if (strcmp(shape, "file") == 0) add_set(sets, "bodies[%d].shape={type: ball, radius: 0.4, cells: 2}", index);
	if (body->scatter.amplitude > 0) add_set(sets, "bodies[%d].scatter.amplitude=1 mm", index);
}

void make_plan(const char* path, Plan* plan) {
	JnScene* scene = NULL;
	*plan = (Plan){0};
	assert_int_equal(jn_scene_load(path, 0, NULL, &scene), JN_OK);
	const JnSimDef* sim = &jn_scene_def(scene)->sim;
	plan->bodies = sim->model.bodies.count;
	plan->dt = first_step(&sim->step);
	for (int b = 0; b < plan->bodies; ++b)
		if (is_kept(b, plan->bodies)) coarsen((const JnBodyDef*)sim->model.bodies.data + b, b, &plan->coarse);
	jn_scene_destroy(scene);
}

void visit_scenes(void (*visit)(const char* path)) {
	glob_t found;
	assert_int_equal(glob(JN_SOURCE_DIR "/scenes/*.yaml", 0, NULL, &found), 0);
	assert_true(found.gl_pathc >= 2);
	for (size_t i = 0; i < found.gl_pathc; ++i)
		if (strstr(found.gl_pathv[i], "_large.yaml") == NULL) visit(found.gl_pathv[i]);
	globfree(&found);
}
