#include "model/repulsion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/grow.h"
#include "base/log.h"
#include "force/bond.h"
#include "force/rigid.h"
#include "model/repulsion_meeting.h"

static JnStatus check_bodies(const JnRepulsionDef* def, const JnModel* model) {
	for (int b = 0; b < model->body_count; ++b) {
		const JnBody* body = &model->bodies[b];
		if (def == NULL && body->mesh.rigid != NULL)
			return jn_error(JN_BAD_INPUT, "bodies[%d]: '%s' is rigid and acts by repulsion alone; add `repulsion: {}`",
							b, body->name);
		if (def != NULL && body->mesh.shape != JN_POINT1)
			return jn_error(
				JN_BAD_INPUT,
				"repulsion: '%s' is a mesh of %s elements, but repulsion knows points and rigid bodies alone, and "
				"contact knows no points; simulate them apart",
				body->name, jn_shape_info[body->mesh.shape].name);
	}
	return JN_OK;
}

static void add_body(JnRepulsion* self, const JnBody* body, const JnGroup* group) {
	const double* constants = group->constants;
	const double spacing = constants[JN_BOND_SPACING];
	for (int i = 0; i < body->mesh.node_count; ++i) {
		const int node = body->first_node + i;
		self->spacing[node] = spacing;
		self->modulus[node] = self->def->stiffness * constants[JN_BOND_MODULUS] / constants[JN_BOND_HORIZON];
		self->push[node] = constants[JN_BOND_STIFFNESS];
		self->volume[node] = body->mesh.volumes[i];
		self->points[self->point_count++] = node;
	}
	self->farthest = fmax(self->farthest, self->def->reach * spacing);
	self->margin = fmax(self->margin, self->def->margin * spacing);
}

static void add_rigid(JnRepulsion* self, const JnBody* body, const JnRigidDef* def) {
	const JnRigid* shape = body->mesh.rigid;
	self->spacing[body->first_node] = 2 * shape->radius;
	self->rigids[self->rigid_count++] =
		(JnRepulsionRigid){.node = body->first_node, .shape = shape, .stiffness = def->stiffness};
}

// Between rigid bodies that say nothing, the stiffest of the points decides.
static JnStatus complete_rigids(JnRepulsion* self) {
	double most = 0;
	for (int k = 0; k < self->point_count; ++k) most = fmax(most, self->push[self->points[k]]);
	for (int k = 0; k < self->rigid_count; ++k) {
		self->push[self->rigids[k].node] = most;
		if (most == 0 && isnan(self->rigids[k].stiffness))
			return jn_error(JN_BAD_INPUT,
							"repulsion: nothing says how stiff rigid bodies are; give material.stiffness");
	}
	return JN_OK;
}

static JnStatus fill(JnRepulsion* self, const JnModelDef* def, JnModel* model) {
	JN_NEW(&self->arena, self->points, model->node_count);
	JN_NEW(&self->arena, self->built, 3 * (size_t)model->node_count);
	JN_NEW(&self->arena, self->rigids, model->body_count);
	JN_NEW(&self->arena, self->spacing, model->node_count);
	JN_NEW(&self->arena, self->modulus, model->node_count);
	JN_NEW(&self->arena, self->push, model->node_count);
	JN_NEW(&self->arena, self->volume, model->node_count);
	for (int b = 0; b < model->body_count; ++b) {
		const JnBody* body = &model->bodies[b];
		if (body->mesh.rigid != NULL)
			add_rigid(self, body, ((const JnBodyDef*)def->bodies.data)[b].material.options);
		else
			add_body(self, body, &model->groups[body->first_group]);
	}
	return complete_rigids(self);
}

JnStatus jn_repulsion_create(const JnRepulsionDef* def, const JnModelDef* model_def, JnModel* model,
							 JnRepulsion** out) {
	*out = NULL;
	JN_TRY(check_bodies(def, model));
	if (def == NULL) return JN_OK;
	JnRepulsion* self = calloc(1, sizeof *self);
	if (self == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: repulsion");
	self->def = def;
	self->model = model;
	const JnStatus status = fill(self, model_def, model);
	if (status == JN_OK)
		*out = self;
	else
		jn_repulsion_destroy(self);
	return status;
}

void jn_repulsion_destroy(JnRepulsion* self) {
	if (self == NULL) return;
	jn_neighbours_release(&self->near);
	free(self->pairs);
	free(self->blocks);
	jn_arena_free(&self->arena);
	free(self);
}

void jn_repulsion_forget(JnRepulsion* self) {
	self->is_built = false;
}

static JnStatus visit_all(JnRepulsion* self, const double* x, JnRepulsionVisit* visit, void* user) {
	self->touching = 0;
	JN_TRY(jn_repulsion_visit_points(self, x, visit, user));
	return jn_repulsion_visit_rigids(self, x, visit, user);
}

static JnStatus add_force(JnRepulsion* self, const JnRepulsionMeeting* meeting, void* user) {
	double* f = user;
	const double scale = meeting->kappa * (meeting->reach / meeting->r - 1);
	for (int a = 0; a < 3; ++a) {
		f[3 * (size_t)meeting->nodes[0] + (size_t)a] += scale * meeting->y[a];
		f[3 * (size_t)meeting->nodes[1] + (size_t)a] -= scale * meeting->y[a];
	}
	++self->touching;
	return JN_OK;
}

JnStatus jn_repulsion_force(JnRepulsion* self, const double* x, double* f) {
	return visit_all(self, x, add_force, f);
}

static JnStatus add_energy(JnRepulsion* self, const JnRepulsionMeeting* meeting, void* user) {
	const double overlap = meeting->reach - meeting->r;
	*(double*)user += 0.5 * meeting->kappa * overlap * overlap;
	++self->touching;
	return JN_OK;
}

double jn_repulsion_energy(JnRepulsion* self, const double* x) {
	double sum = 0;
	return visit_all(self, x, add_energy, &sum) == JN_OK ? sum : NAN;
}

int jn_repulsion_touching(const JnRepulsion* self) {
	return self->touching;
}

static JnStatus add_block(JnRepulsion* self, const JnRepulsionMeeting* meeting, void* user) {
	(void)user;
	JN_TRY(jn_grow((void**)&self->blocks, &self->block_capacity, (size_t)self->block_count + 1, sizeof *self->blocks));
	JnRepulsionBlock* block = &self->blocks[self->block_count++];
	memcpy(block->nodes, meeting->nodes, sizeof block->nodes);
	const double w = 1 - meeting->reach / meeting->r;
	for (int a = 0, entry = 0; a < 3; ++a)
		for (int b = 0; b <= a; ++b, ++entry) {
			const double along = meeting->y[a] * meeting->y[b] / (meeting->r * meeting->r);
			block->definite[entry] = meeting->kappa * along;
			block->exact[entry] = meeting->kappa * (along + w * (meeting->turning[entry] - along));
		}
	++self->touching;
	return JN_OK;
}

JnStatus jn_repulsion_linearize(JnRepulsion* self, const double* x) {
	self->block_count = 0;
	return visit_all(self, x, add_block, NULL);
}

void jn_repulsion_product(const JnRepulsion* self, JnDefinite definite, double scale, const double* p, double* y) {
	for (int k = 0; k < self->block_count; ++k) {
		const JnRepulsionBlock* block = &self->blocks[k];
		const double* B = definite == JN_DEFINITE ? block->definite : block->exact;
		const double *left = p + 3 * (size_t)block->nodes[0], *right = p + 3 * (size_t)block->nodes[1];
		const double d[3] = {left[0] - right[0], left[1] - right[1], left[2] - right[2]};
		const double product[3] = {B[0] * d[0] + B[1] * d[1] + B[3] * d[2], B[1] * d[0] + B[2] * d[1] + B[4] * d[2],
								   B[3] * d[0] + B[4] * d[1] + B[5] * d[2]};
		for (int a = 0; a < 3; ++a) {
			y[3 * (size_t)block->nodes[0] + (size_t)a] += scale * product[a];
			y[3 * (size_t)block->nodes[1] + (size_t)a] -= scale * product[a];
		}
	}
}

void jn_repulsion_add_diagonal(const JnRepulsion* self, JnDefinite definite, double* blocks) {
	static const int entry_of[9] = {0, 1, 3, 1, 2, 4, 3, 4, 5};
	for (int k = 0; k < self->block_count; ++k) {
		const JnRepulsionBlock* block = &self->blocks[k];
		const double* B = definite == JN_DEFINITE ? block->definite : block->exact;
		for (int e = 0; e < 18; ++e) blocks[9 * (size_t)block->nodes[e / 9] + (size_t)(e % 9)] += B[entry_of[e % 9]];
	}
}

const JnKey jn_repulsion_keys[] = {
	{.name = "stiffness",
	 .kind = JN_REAL,
	 .field = offsetof(JnRepulsionDef, stiffness),
	 .value = {15},
	 .low = 0,
	 .high = 1e6,
	 .meaning =
		 "of two points: how much the force between their volumes grows a length, in micromoduli over the horizon"},
	{.name = "reach",
	 .kind = JN_REAL,
	 .field = offsetof(JnRepulsionDef, reach),
	 .value = {1.35},
	 .low = 0.1,
	 .high = 3,
	 .meaning = "distance at which two points meet, in spacings"},
	{.name = "rest_share",
	 .kind = JN_REAL,
	 .field = offsetof(JnRepulsionDef, rest_share),
	 .value = {0.9},
	 .low = 0.1,
	 .high = 1,
	 .meaning = "and at most, in their distance at rest: what is close from the start does not push"},
	{.name = "margin",
	 .kind = JN_REAL,
	 .field = offsetof(JnRepulsionDef, margin),
	 .value = {0.2},
	 .low = 0.001,
	 .high = 10,
	 .meaning = "pairs this much farther apart are watched, in spacings: a matter of speed alone"},
	{0},
};
