#include "support/moved.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "force/cloth/cloth.h"
#include "math/vec3.h"
#include "mesh/shape/shape.h"
#include "mesh/thread.h"
#include "model/motion.h"
#include "model/select.h"
#include "support/moved_mesh.h"
#include "support/units.h"

enum { SELECTIONS = 24 };

/// A shape that generates another one and moves it; stands in for it in the body.
typedef struct MovedShape {
	JnShapeType type;
	const JnShapeType* base;
	const void* options;
	const Move* move;
	JnBodyDef* body;
	Moved* moved;
	char names[SELECTIONS][20];
} MovedShape;

/// A motion along one axis that is the weighted sum of three.
typedef struct MovedMotion {
	JnVariant part[3];
	double weight[3];
} MovedMotion;

static JnMotionValue moved_motion_at(const void* options, double t) {
	const MovedMotion* motion = options;
	JnMotionValue sum = {0};
	for (int i = 0; i < 3; ++i) {
		const JnMotionType* type = (const JnMotionType*)motion->part[i].row;
		if (type == NULL || motion->weight[i] == 0) continue;
		const JnMotionValue value = type->at(motion->part[i].options, t);
		sum.x += motion->weight[i] * value.x;
		sum.v += motion->weight[i] * value.v;
		sum.a += motion->weight[i] * value.a;
	}
	return sum;
}

static const JnMotionType moved_motion = {.row = {.name = "moved", .options_size = sizeof(MovedMotion)},
										  .at = moved_motion_at};

static void turn_vector(const Move* move, const double x[3], double out[3]) {
	for (int a = 0; a < 3; ++a) out[a] = vec3_dot(move->turn[a], x);
}

void move_point(const Move* move, const double x[3], double out[3]) {
	double turned[3];
	turn_vector(move, x, turned);
	for (int a = 0; a < 3; ++a) out[a] = move->length * turned[a] + move->shift[a];
}

static void move_direction(const Move* move, double scale, double vector[3]) {
	double turned[3];
	turn_vector(move, vector, turned);
	for (int a = 0; a < 3; ++a) vector[a] = scale * turned[a];
}

// Selections by place are made before the body is moved, and become sets.
static void name_selection(MovedShape* shape, JnArena* arena, JnMesh* mesh, int number, JnSelectDef* where) {
	if (where->set != NULL) return;
	bool* chosen = malloc((size_t)mesh->node_count * sizeof *chosen);
	JnNodeSet* sets = jn_arena_take(arena, (size_t)mesh->set_count + 1, sizeof *sets);
	assert_true(chosen != NULL && sets != NULL && number < SELECTIONS);
	assert_int_equal(jn_select_nodes(where, mesh, "moved", chosen), JN_OK);
	if (mesh->set_count > 0) memcpy(sets, mesh->sets, (size_t)mesh->set_count * sizeof *sets);
	JnNodeSet* set = &sets[mesh->set_count++];
	*set = (JnNodeSet){.name = shape->names[number],
					   .nodes = jn_arena_take(arena, (size_t)mesh->node_count, sizeof *set->nodes)};
	for (int i = 0; i < mesh->node_count; ++i)
		if (chosen[i]) set->nodes[set->count++] = i;
	mesh->sets = sets;
	free(chosen);
	snprintf(shape->names[number], sizeof shape->names[number], "moved%d", number);
	*where = (JnSelectDef){.nearest = {NAN, NAN, NAN}, .set = shape->names[number]};
}

static void name_selections(MovedShape* shape, JnArena* arena, JnMesh* mesh) {
	JnBodyDef* body = shape->body;
	int number = 0;
	for (int i = 0; i < body->fix.count; ++i)
		name_selection(shape, arena, mesh, number++, &((JnFixDef*)body->fix.data)[i].where);
	for (int i = 0; i < body->drive.count; ++i)
		name_selection(shape, arena, mesh, number++, &((JnDriveDef*)body->drive.data)[i].where);
	for (int i = 0; i < body->loads.count; ++i)
		name_selection(shape, arena, mesh, number++, &((JnLoadDef*)body->loads.data)[i].where);
}

// The threads of a cloth run along its first edge; in the copy that edge need not come first.
static void move_grain(MovedShape* shape, const JnMesh* mesh) {
	JnVariant* material = &shape->body->material;
	const bool is_cloth = material->row == &jn_law_membrane.row || material->row == &jn_law_mass_spring.row;
	for (const JnKey* key = material->row->keys; is_cloth && key->name != NULL; ++key) {
		double* grain = (double*)((char*)material->options + key->field);
		if (strcmp(key->name, "grain") != 0) continue;
		if (isnan(grain[0]))
			for (int a = 0; a < 3; ++a)
				grain[a] = mesh->nodes[3 * mesh->cells[1] + a] - mesh->nodes[3 * mesh->cells[0] + a];
		move_direction(shape->move, 1, grain);
	}
}

static void scale_points(const Move* move, JnArena* arena, JnMesh* mesh) {
	mesh->thickness *= move->length;
	if (mesh->volumes == NULL) return;
	double* volumes = jn_arena_take(arena, (size_t)mesh->node_count, sizeof *volumes);
	assert_non_null(volumes);
	for (int i = 0; i < mesh->node_count; ++i)
		volumes[i] = mesh->volumes[i] * move->length * move->length * move->length; // all alike where they are shuffled
	mesh->volumes = volumes;
}

static void scale_thread(const Move* move, JnArena* arena, JnMesh* mesh) {
	if (mesh->thread == NULL) return;
	JnThread* thread = jn_arena_take(arena, 1, sizeof *thread);
	assert_non_null(thread);
	*thread = *mesh->thread;
	thread->radius *= move->length;
	thread->link_length *= move->length;
	mesh->thread = thread;
}

static JnStatus generate(const void* options, const char* what, JnArena* arena, JnMesh* mesh) {
	MovedShape* shape = (MovedShape*)options; // its own, in the test's arena
	const Move* move = shape->move;
	Moved* moved = shape->moved;
	JN_TRY(shape->base->generate(shape->options, what, arena, mesh));
	name_selections(shape, arena, mesh);
	move_grain(shape, mesh);
	scale_points(move, arena, mesh);
	scale_thread(move, arena, mesh);
	for (int i = 0; i < mesh->node_count; ++i) move_point(move, mesh->nodes + 3 * i, mesh->nodes + 3 * i);
	if (move->mirrors) mirror_cells(mesh);
	if (move->renumbers) turn_cells(mesh);
	moved->order = realloc(moved->order, ((size_t)moved->nodes + (size_t)mesh->node_count) * sizeof *moved->order);
	assert_non_null(moved->order);
	int* order = moved->order + moved->nodes;
	shuffle_mesh(mesh, move->shuffle, order);
	for (int i = 0; i < mesh->node_count; ++i) order[i] += moved->nodes;
	moved->nodes += mesh->node_count;
	return JN_OK;
}

static void move_drive(JnDriveDef* drive, const Move* move, JnArena* arena) {
	JnVariant moved[3];
	for (int a = 0; a < 3; ++a) {
		MovedMotion* motion = jn_arena_take(arena, 1, sizeof *motion);
		assert_non_null(motion);
		memcpy(motion->part, drive->motion, sizeof motion->part);
		for (int i = 0; i < 3; ++i) motion->weight[i] = move->length * move->turn[a][i];
		moved[a] = (JnVariant){&moved_motion.row, motion};
	}
	memcpy(drive->motion, moved, sizeof moved);
}

static void move_body(JnBodyDef* body, const Move* move, JnArena* arena, Moved* moved) {
	MovedShape* shape = jn_arena_take(arena, 1, sizeof *shape);
	assert_non_null(shape);
	*shape = (MovedShape){.base = (const JnShapeType*)body->shape.row, .options = body->shape.options};
	shape->type = *shape->base;
	shape->type.generate = generate;
	shape->move = move;
	shape->body = body;
	shape->moved = moved;
	body->shape = (JnVariant){&shape->type.row, shape};
	scale_units(body->material.row->keys, move->length, move->mass, body->material.options);
	move_direction(move, move->length, body->velocity);
	move_direction(move, move->mirrors ? -1 : 1, body->spin);
	for (int i = 0; i < body->loads.count; ++i)
		move_direction(move, move->mass * move->length, ((JnLoadDef*)body->loads.data)[i].force);
	for (int i = 0; i < body->drive.count; ++i) move_drive((JnDriveDef*)body->drive.data + i, move, arena);
}

void move_scene(JnSceneDef* def, const Move* move, JnArena* arena, Moved* moved) {
	JnModelDef* model = &def->sim.model;
	*moved = (Moved){0};
	move_direction(move, move->length, model->gravity);
	for (int b = 0; b < model->bodies.count; ++b) move_body((JnBodyDef*)model->bodies.data + b, move, arena, moved);
	if (model->wind == NULL) return;
	move_direction(move, move->length, model->wind->velocity);
	model->wind->density *= move->mass / pow(move->length, 3);
}

// A body's surface of quadrilaterals, each of which becomes two triangles for the wind.
static bool has_quadrilaterals(const JnBodyDef* body) {
	const JnKey* key = body->shape.row->keys;
	while (key->name != NULL && strcmp(key->name, "element") != 0) ++key;
	return key->name != NULL && *(const int*)((const char*)body->shape.options + key->field) == JN_HEX8;
}

bool can_move(const JnSceneDef* def, const Move* move, const char** why) {
	const JnModelDef* model = &def->sim.model;
	*why = NULL;
	for (int b = 0; b < model->bodies.count && *why == NULL; ++b) {
		const JnBodyDef* body = (const JnBodyDef*)model->bodies.data + b;
		const JnDriveDef* drives = body->drive.data;
		const bool is_thread = strcmp(body->shape.row->name, "thread") == 0;
		if (is_thread && (move->mirrors || move->shuffle != 0 || move->renumbers))
			*why = "frames of a thread have a handedness and an order";
		if (model->wind != NULL && body->drag > 0 && has_quadrilaterals(body) &&
			(move->shuffle != 0 || move->renumbers))
			*why = "the numbers of its nodes say along which diagonal wind sees a quadrilateral bent";
		for (int i = 0; i < body->drive.count; ++i)
			if (drives[i].along != NULL || drives[i].input != NULL || drives[i].others != 0)
				*why = "its drives are not three motions along the axes";
	}
	return *why == NULL;
}
