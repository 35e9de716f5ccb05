// What meets: the surfaces of bodies, the obstacles, and the friction of each pair of contact materials.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/key.h"
#include "base/log.h"
#include "math/vec3.h"
#include "mesh/boundary.h"
#include "pass/contact.h"

static const double watched = 0.05; // margin, in mean edges of the finest surface
static const double clear = 0.05;   // offset of a cloth, in its mean edges: h^2/(8 R) for h of a diagonal, R of 5 edges

static JnStatus create_skin(JnContactPass* pass, int index, JnSkin* skin) {
	const JnBody* body = &pass->model->bodies[index];
	JnStatus status = JN_OK;
	if (body->mesh.embedding != NULL) {
		status = jn_skin_from_embedding(body->mesh.embedding, body->first_node, &pass->arena, skin);
	} else {
		int count, *triangles;
		JN_TRY(jn_mesh_boundary(&body->mesh, &pass->arena, &count, &triangles));
		for (int i = 0; i < 3 * count; ++i) triangles[i] += body->first_node;
		status = jn_skin_from_triangles(count, triangles, &pass->arena, skin);
	}
	skin->body = index;
	return status;
}

// A body of triangles alone has no inside: its skin may have a rim, and a node that rests exactly on it is on neither side,
// so that the next step could find it on the wrong one. Obstacles have an inside.
static JnStatus check_sheet(const JnModel* model, int sheet) {
	const JnBody* body = &model->bodies[sheet];
	if (body->mesh.shape != JN_TRI3 || !body->contact.active) return JN_OK;
	if (body->contact.self)
		return jn_error(JN_BAD_INPUT,
						"bodies[%d].contact.self: '%s' is a cloth without thickness, whose contact with itself is not "
						"there yet; leave this key out",
						sheet, body->name);
	for (int b = 0; b < model->body_count; ++b)
		if (b != sheet && model->bodies[b].contact.active)
			return jn_error(JN_BAD_INPUT,
							"bodies[%d].contact: '%s' is a cloth without thickness, which meets obstacles alone, not "
							"bodies such as '%s'; say `contact: {active: false}` for one of them",
							sheet, body->name, model->bodies[b].name);
	return JN_OK;
}

static JnStatus create_skins(JnContactPass* pass) {
	const JnModel* model = pass->model;
	for (int b = 0; b < model->body_count; ++b) JN_TRY(check_sheet(model, b));
	JN_NEW(&pass->arena, pass->skins, model->body_count);
	JN_NEW(&pass->arena, pass->skin_of, model->body_count);
	for (int b = 0; b < model->body_count; ++b) {
		pass->skin_of[b] = model->bodies[b].contact.active ? pass->skin_count : -1;
		if (model->bodies[b].contact.active) JN_TRY(create_skin(pass, b, &pass->skins[pass->skin_count++]));
	}
	return JN_OK;
}

static JnStatus list_obstacles(JnContactPass* pass) {
	const JnModel* model = pass->model;
	JN_NEW(&pass->arena, pass->obstacles, model->obstacle_count + 1);
	for (int i = 0; i < model->obstacle_count; ++i) pass->obstacles[i] = model->obstacles[i].shape;
	return JN_OK;
}

// ---- friction

// Skins first, obstacles behind them.
static JnStatus create_friction(JnContactPass* pass) {
	const JnModel* model = pass->model;
	const char** names;
	JN_NEW(&pass->arena, names, pass->skin_count + model->obstacle_count + 1);
	JN_NEW(&pass->arena, pass->skin_surface, pass->skin_count + model->obstacle_count + 1);
	pass->obstacle_surface = pass->skin_surface + pass->skin_count;
	for (int i = 0; i < pass->skin_count; ++i) names[i] = model->bodies[pass->skins[i].body].contact.surface;
	for (int i = 0; i < model->obstacle_count; ++i) names[pass->skin_count + i] = model->obstacles[i].surface;
	return jn_friction_create(&pass->def->pairs, pass->def->friction, "contact",
							  pass->skin_count + model->obstacle_count, names, &pass->arena, pass->skin_surface,
							  &pass->friction);
}

// ---- detector

static double mean_edge(const JnSkin* skin, const double* at) {
	double sum = 0;
	for (int i = 0; i < 3 * skin->triangle_count; ++i) {
		const int next = i % 3 == 2 ? i - 2 : i + 1;
		sum += vec3_distance(at + 3 * (ptrdiff_t)skin->triangles[i], at + 3 * (ptrdiff_t)skin->triangles[next]);
	}
	return skin->triangle_count > 0 ? sum / (3 * skin->triangle_count) : INFINITY;
}

static void set_offset(const JnBody* body, double edge, JnSkin* skin) {
	skin->offset = body->contact.offset;
	if (isnan(skin->offset)) skin->offset = body->mesh.shape == JN_TRI3 ? clear * edge : 0;
}

// And the offsets, which depend on edges too.
static JnStatus finest_edge(const JnContactPass* pass, double* edge) {
	JnArena scratch = {0};
	JnStatus status = JN_OK;
	*edge = INFINITY;
	for (int i = 0; i < pass->skin_count && status == JN_OK; ++i) {
		double* at = jn_arena_take(&scratch, 3 * (size_t)pass->skins[i].vertex_count, sizeof *at);
		status = at != NULL ? JN_OK : JN_OUT_OF_MEMORY;
		if (at == NULL) continue;
		jn_skin_positions(&pass->skins[i], pass->model->rest, at);
		const double mean = mean_edge(&pass->skins[i], at);
		set_offset(&pass->model->bodies[pass->skins[i].body], mean, &pass->skins[i]);
		*edge = fmin(*edge, mean);
	}
	jn_arena_free(&scratch);
	return status;
}

JnStatus jn_contact_surfaces_create(JnContactPass* pass) {
	const JnModel* model = pass->model;
	bool* self;
	double edge;
	JN_TRY(create_skins(pass));
	JN_TRY(list_obstacles(pass));
	JN_TRY(create_friction(pass));
	JN_TRY(finest_edge(pass, &edge));
	pass->margin = isnan(pass->def->margin) ? watched * (isfinite(edge) ? edge : 0) : pass->def->margin;
	JN_NEW(&pass->arena, self, pass->skin_count + 1);
	for (int i = 0; i < pass->skin_count; ++i) self[i] = model->bodies[pass->skins[i].body].contact.self;
	const JnDetectorOptions options = {.threads = model->threads,
									   .self = self,
									   .rest = model->rest,
									   .neighborhood = fmax(2 * pass->margin, isfinite(edge) ? edge : 0)};
	return jn_detector_create(pass->skin_count, pass->skins, model->obstacle_count, pass->obstacles, &options,
							  &pass->detector);
}
