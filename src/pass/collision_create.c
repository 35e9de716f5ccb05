// Making the collision pass of a model, and its memory.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/log.h"
#include "math/vec3.h"
#include "mesh/thread.h"
#include "pass/collision.h"

enum { RESERVED = 64 }; // blocks of the first steps

static const double bend = 3.14159265358979; // radii along a thread within which it cannot touch itself
static const double near = 0.05;             // margin in least radii

void jn_collision_destroy(JnPass* base) {
	JnCollision* pass = (JnCollision*)base;
	jn_impulses_release(&pass->now);
	jn_impulses_release(&pass->kept);
	jn_impulses_release(&pass->seen);
	free(pass->watches);
	JnArena arena = pass->arena; // holds the pass itself
	jn_arena_free(&arena);
}

static bool is_thread(const JnBody* body) {
	return body->mesh.thread != NULL && body->contact.active;
}

static void fill_links(JnCollision* pass, const JnStrand* strand) {
	for (int k = 0; k < strand->link_count; ++k) {
		const int next = k + 1 < strand->frame_count ? k + 1 : 0;
		pass->link_ends[strand->first_link + k][0] = strand->first_frame + k;
		pass->link_ends[strand->first_link + k][1] = strand->first_frame + next;
		pass->link_strand[strand->first_link + k] = (int)(strand - pass->strands);
	}
}

// Mean length of the links at rest.
static double mean_length(const JnCollision* pass, const JnStrand* strand) {
	double sum = 0;
	for (int link = strand->first_link; link < strand->first_link + strand->link_count; ++link) {
		double at[2][3] = {{0}};
		for (int i = 0; i < 6; ++i) {
			const double* x =
				pass->model->rest + 3 * ((ptrdiff_t)pass->frame_node[pass->link_ends[link][i / 3]] + i % 3);
			for (int a = 0; a < 3; ++a) at[i / 3][a] += strand->axis[i % 3] * x[a];
		}
		sum += vec3_distance(at[0], at[1]);
	}
	return sum / strand->link_count;
}

static void create_strand(JnCollision* pass, int body, JnStrand* strand) {
	const JnThread* thread = pass->model->bodies[body].mesh.thread;
	*strand = (JnStrand){.body = body,
						 .first_frame = pass->frame_count,
						 .frame_count = thread->frame_count,
						 .first_link = pass->link_count,
						 .link_count = jn_thread_links(thread),
						 .is_closed = thread->is_closed,
						 .radius = thread->radius};
	memcpy(strand->axis, thread->axis, sizeof strand->axis);
	for (int k = 0; k < strand->frame_count; ++k) {
		pass->frame_node[strand->first_frame + k] = pass->model->bodies[body].first_node + JN_FRAME_NODES * k;
		pass->frame_strand[strand->first_frame + k] = (int)(strand - pass->strands);
	}
	fill_links(pass, strand);
	strand->length = mean_length(pass, strand);
	const double neighbors = isnan(pass->def->neighbors) ? bend * strand->radius : pass->def->neighbors;
	const double links = fmin(ceil(neighbors / strand->length * (1 - 1e-9)), strand->link_count);
	strand->apart = 1 + (int)fmax(1, links);
	pass->frame_count += strand->frame_count;
	pass->link_count += strand->link_count;
}

static JnStatus create_strands(JnCollision* pass) {
	const JnModel* model = pass->model;
	int frames = 0;
	for (int b = 0; b < model->body_count; ++b)
		if (is_thread(&model->bodies[b])) ++pass->strand_count, frames += model->bodies[b].mesh.thread->frame_count;
	JN_NEW(&pass->arena, pass->strands, pass->strand_count + 1);
	JN_NEW(&pass->arena, pass->frame_node, frames + 1);
	JN_NEW(&pass->arena, pass->frame_strand, frames + 1);
	JN_NEW(&pass->arena, pass->link_ends, frames + 1);
	JN_NEW(&pass->arena, pass->link_strand, frames + 1);
	double least = INFINITY;
	pass->extent = INFINITY;
	for (int b = 0, s = 0; b < model->body_count; ++b) {
		if (!is_thread(&model->bodies[b])) continue;
		create_strand(pass, b, &pass->strands[s]);
		least = fmin(least, pass->strands[s].radius);
		pass->extent = fmin(pass->extent, pass->strands[s].length * pass->strands[s].link_count);
		pass->largest_radius = fmax(pass->largest_radius, pass->strands[s++].radius);
	}
	pass->margin = pass->strand_count > 0 ? near * least : 0;
	return JN_OK;
}

static JnStatus allocate(JnCollision* pass) {
	JnArena* arena = &pass->arena;
	const size_t n = 3 * (size_t)pass->model->node_count;
	const int points = pass->frame_count + pass->vertex_count;
	JN_NEW(arena, pass->inverse_mass, n);
	for (size_t k = 0; k < n; ++k)
		pass->inverse_mass[k] = pass->model->held[k] ? 0 : 1 / pass->model->nodal_mass[k / 3];
	JN_NEW(arena, pass->load, n);
	JN_NEW(arena, pass->start, points);
	JN_NEW(arena, pass->end, points);
	JN_NEW(arena, pass->watched, points);
	JN_NEW(arena, pass->moved, points);
	JN_NEW(arena, pass->frame_distance, pass->frame_count);
	JN_NEW(arena, pass->travelled, pass->frame_count);
	int buckets = 16;
	while (buckets < 2 * pass->link_count) buckets *= 2;
	pass->cell_mask = buckets - 1;
	JN_NEW(arena, pass->cell_head, buckets);
	JN_NEW(arena, pass->cell_next, pass->link_count);
	JN_NEW(arena, pass->link_cell, pass->link_count);
	JN_TRY(jn_impulses_reserve(&pass->now, RESERVED, 12 * RESERVED));
	JN_TRY(jn_impulses_reserve(&pass->seen, RESERVED, 12 * RESERVED));
	return jn_impulses_reserve(&pass->kept, RESERVED, 12 * RESERVED);
}

// Threads first, then surfaces, then obstacles.
static JnStatus create_friction(JnCollision* pass) {
	const JnModel* model = pass->model;
	const int bodies = pass->strand_count + pass->hide_count, count = bodies + model->obstacle_count;
	const char** names;
	JN_NEW(&pass->arena, names, count);
	JN_NEW(&pass->arena, pass->strand_surface, count);
	pass->hide_surface = pass->strand_surface + pass->strand_count;
	pass->obstacle_surface = pass->strand_surface + bodies;
	for (int i = 0; i < pass->strand_count; ++i) names[i] = model->bodies[pass->strands[i].body].contact.surface;
	for (int i = pass->strand_count; i < bodies; ++i)
		names[i] = model->bodies[pass->hides[i - pass->strand_count].body].contact.surface;
	for (int i = bodies; i < count; ++i) names[i] = model->obstacles[i - bodies].surface;
	return jn_friction_create(&pass->def->pairs, pass->def->friction, "collision", count, names, &pass->arena,
							  pass->strand_surface, &pass->friction);
}

static JnStatus check_count(const char* what, int count, int most) {
	if (count <= most) return JN_OK;
	return jn_error(JN_BAD_INPUT,
					"collision: the scene has %d %s, and pairs are named by numbers up to %d; say `contact: {active: "
					"false}` for what need not meet threads",
					count, what, most);
}

// What jn_collision_name() has room for; the ranks of triangles in names begin at 1.
static JnStatus check_counts(const JnCollision* pass) {
	JN_TRY(check_count("frames of threads", pass->frame_count, JN_NAMED_MOST));
	JN_TRY(check_count("surfaces of bodies", pass->hide_count, JN_NAMED_HIDES));
	JN_TRY(check_count("obstacles", pass->model->obstacle_count, JN_NAMED_MOST));
	for (int h = 0; h < pass->hide_count; ++h)
		JN_TRY(check_count("edges on one surface", pass->hides[h].edge_count, JN_NAMED_MOST));
	return JN_OK;
}

static JnStatus build(JnCollision* pass) {
	JN_TRY(create_strands(pass));
	if (pass->strand_count == 0)
		return jn_error(JN_BAD_INPUT,
						"collision: no thread is there that could collide; bodies of other shapes meet by "
						"`contact:`, or take 'collision' out");
	JN_TRY(jn_collision_hides_create(pass));
	JN_TRY(check_counts(pass));
	JN_TRY(create_friction(pass));
	return allocate(pass);
}

JnStatus jn_collision_create(const void* options, JnModel* model, JnPass** out) {
	JnArena arena = {0};
	JnCollision* pass;
	*out = NULL;
	JN_NEW(&arena, pass, 1);
	pass->arena = arena;
	pass->base.type = &jn_pass_collision;
	pass->def = options;
	pass->model = model;
	pass->sys = (JnModelSystem*)model->system;
	const JnStatus status = build(pass);
	if (status == JN_OK)
		*out = &pass->base;
	else
		jn_collision_destroy(&pass->base);
	return status;
}
