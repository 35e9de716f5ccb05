// The verbs of suture, and its blocks. In the prediction of an attempt each site slides to where the thread is nearest, from
// where it was in the last accepted step; only `commit` keeps that, makes sites and releases them.
#include "pass/suture.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "base/log.h"
#include "math/vec3.h"

static JnSuture* of(JnPass* pass) {
	return (JnSuture*)pass;
}

static const JnStrand* strand_of(const JnSuture* pass) {
	return &pass->collision->strands[pass->strand];
}

int jn_suture_frame(const JnSuture* pass, int index) {
	const JnStrand* strand = strand_of(pass);
	return pass->def->tip == 0 ? strand->first_frame + index : strand->first_frame + strand->frame_count - 1 - index;
}

static void axis_at(const JnSuture* pass, int index, const double* x, double out[3]) {
	const double *w = strand_of(pass)->axis,
				 *at = x + 3 * (ptrdiff_t)pass->collision->frame_node[jn_suture_frame(pass, index)];
	for (int a = 0; a < 3; ++a) out[a] = w[0] * at[a] + w[1] * at[3 + a] + w[2] * at[6 + a];
}

static void site_at(const JnSite* site, const double* x, double out[3]) {
	out[0] = out[1] = out[2] = 0;
	for (int i = 0; i < 3; ++i)
		for (int a = 0; a < 3; ++a) out[a] += site->weights[i] * x[3 * (ptrdiff_t)site->nodes[i] + a];
}

// ---- sliding

// Where a link is nearest to a point: a share of it, which may be outside of 0 .. 1.
static double foot(const JnSuture* pass, int link, const double q[3], const double* x, double ends[2][3]) {
	double along[3], from[3];
	axis_at(pass, link, x, ends[0]);
	axis_at(pass, link + 1, x, ends[1]);
	for (int a = 0; a < 3; ++a) {
		along[a] = ends[1][a] - ends[0][a];
		from[a] = q[a] - ends[0][a];
	}
	const double square = vec3_dot(along, along);
	return square > 0 ? vec3_dot(from, along) / square : 0;
}

double jn_suture_slide(const JnSuture* pass, const JnSite* site, const double* x, double* s, double* beyond) {
	const int links = strand_of(pass)->link_count;
	double q[3], ends[2][3], c[3], share = 0;
	int link = (int)fmin(fmax(floor(*s), 0), links - 1), came_from = -1;
	assert(links > 0); // or no end of a link would be known
	site_at(site, x, q);
	*beyond = 0;
	for (int k = 0; k <= links; ++k) {
		share = foot(pass, link, q, x, ends);
		const int next = share < 0 ? link - 1 : share > 1 ? link + 1 : link;
		if (next < 0) *beyond = share;
		if (next >= links) *beyond = share - 1;
		if (next == link || next == came_from || next < 0 || next >= links) break;
		came_from = link;
		link = next;
	}
	share = fmin(fmax(share, 0), 1);
	*s = link + share;
	for (int a = 0; a < 3; ++a) c[a] = ends[0][a] + share * (ends[1][a] - ends[0][a]);
	return vec3_distance(c, q);
}

// ---- blocks

static double lever_of(const JnStep* step) {
	return step->method->order > 1 ? 0.5 : 1; // of a force on positions: as in collision.c
}

static JnStatus collect_site(JnSuture* pass, const JnStep* step, const JnSite* site, double s, JnImpulses* out) {
	const JnStrand* strand = strand_of(pass);
	const int from_tip = (int)fmin(floor(s), strand->link_count - 1);
	const bool is_first = pass->def->tip == 0;
	const int link = strand->first_link + (is_first ? from_tip : strand->link_count - 1 - from_tip);
	const double share = is_first ? s - from_tip : 1 - (s - from_tip);
	double ends[2][3], along[3], at_start[3];
	JnBlock* block;
	JN_TRY(jn_impulses_add(out, jn_collision_name(JN_MEETING_SITE, 0, 0, site->number), JN_BLOCK_SITE, 9, &block));
	JnBlockEntry* entries = out->entries + block->first;
	axis_at(pass, from_tip, step->end->x, ends[0]);
	axis_at(pass, from_tip + 1, step->end->x, ends[1]);
	for (int a = 0; a < 3; ++a) along[a] = ends[1][a] - ends[0][a];
	vec3_normalize(along);
	memcpy(block->frame, along, sizeof along);
	jn_block_complete_frame(block->frame);
	jn_collision_link_entries(pass->collision, link, share, 1, NULL, step->end->x, entries);
	for (int i = 0; i < 3; ++i)
		entries[6 + i] = (JnBlockEntry){.node = site->nodes[i], .weight = {-site->weights[i], -site->weights[i]}};
	jn_block_motion(out, block, step->start->x, at_start);
	const double apart = hypot(at_start[1], at_start[2]), closes = pass->collision->def->push_out * step->dt;
	const double left = apart > closes ? 1 - closes / apart : 0; // of a distance across that is there at the start
	block->target[JN_LEVEL_POSITION][0] = at_start[0];
	block->target[JN_LEVEL_POSITION][1] = left * at_start[1];
	block->target[JN_LEVEL_POSITION][2] = left * at_start[2];
	block->friction = pass->def->friction;
	block->hold[JN_LEVEL_VELOCITY] = pass->def->hold * step->dt;
	block->hold[JN_LEVEL_POSITION] = pass->def->hold * step->dt * step->dt * lever_of(step);
	return JN_OK;
}

static JnStatus collect(void* user, const JnStep* step, JnImpulses* out) {
	JnSuture* pass = user;
	double beyond;
	for (int i = 0; i < pass->count; ++i) {
		pass->tried[i] = pass->sites[i].s;
		jn_suture_slide(pass, &pass->sites[i], step->end->x, &pass->tried[i], &beyond);
		JN_TRY(collect_site(pass, step, &pass->sites[i], pass->tried[i], out));
	}
	return JN_OK;
}

// Links within the body, those near a site, and the needle's first ones, do not collide with it.
static bool passes(void* user, int link, int body) {
	const JnSuture* pass = user;
	const JnStrand* strand = strand_of(pass);
	if (body != pass->collision->hides[pass->hide].body || pass->collision->link_strand[link] != pass->strand)
		return false;
	const int own = link - strand->first_link, index = pass->def->tip == 0 ? own : strand->link_count - 1 - own;
	if (index < pass->def->needle) return true;
	const double near = pass->clear;
	bool is_inside = pass->is_tip_inside;
	for (int i = pass->count - 1; i >= 0; --i) {
		const double s = pass->sites[i].s;
		if (index + 1 > s - near && index < s + near) return true;
		if (index + 1 <= s) return is_inside;
		is_inside = !is_inside;
	}
	return is_inside;
}

// ---- verbs

// A site whose thread has been drawn through to its end is released, and one out of which the tip has been drawn back.
static void slide_all(JnSuture* pass, const JnStep* step) {
	int kept = 0;
	pass->error = 0;
	for (int i = 0; i < pass->count; ++i) {
		JnSite* site = &pass->sites[i];
		double beyond;
		const double distance = jn_suture_slide(pass, site, step->end->x, &site->s, &beyond);
		if (beyond < 0) pass->is_tip_inside = !pass->is_tip_inside;
		if (beyond != 0) continue;
		pass->error = fmax(pass->error, distance);
		pass->sites[kept++] = *site;
	}
	pass->count = kept;
}

static void commit(JnPass* base, const JnStep* step) {
	JnSuture* pass = of(base);
	slide_all(pass, step);
	jn_suture_puncture(pass, step);
}

static JnStatus check_strand(const JnSuture* pass) {
	const JnStrand* strand = strand_of(pass);
	if (strand->is_closed)
		return jn_error(JN_BAD_INPUT, "suture.thread: the loop '%s' has no tip that could pierce; name an open thread",
						pass->def->thread);
	if (pass->def->needle > strand->link_count)
		return jn_error(JN_BAD_INPUT, "suture.needle: %d links are more than the thread '%s' has, %d; give fewer",
						pass->def->needle, pass->def->thread, strand->link_count);
	return JN_OK;
}

static JnStatus join(JnPass* base, JnPass* const* others, int count) {
	JnSuture* pass = of(base);
	const JnModel* model = pass->model;
	for (int i = 0; i < count; ++i)
		if (others[i]->type == &jn_pass_collision) pass->collision = (JnCollision*)others[i];
	if (pass->collision == NULL)
		return jn_error(JN_BAD_INPUT, "suture: its impulses are found with those of collisions; add `collision: {}`");
	JnCollision* collision = pass->collision;
	pass->strand = pass->hide = -1;
	for (int s = 0; s < collision->strand_count; ++s)
		if (strcmp(model->bodies[collision->strands[s].body].name, pass->def->thread) == 0) pass->strand = s;
	for (int h = 0; h < collision->hide_count; ++h)
		if (strcmp(model->bodies[collision->hides[h].body].name, pass->def->body) == 0) pass->hide = h;
	if (pass->strand < 0)
		return jn_error(JN_BAD_INPUT,
						"suture.thread: no thread that collides is named '%s'; name a body of shape thread",
						pass->def->thread);
	JN_TRY(check_strand(pass));
	if (pass->hide < 0)
		return jn_error(JN_BAD_INPUT, "suture.body: no body with a surface that collides is named '%s'",
						pass->def->body);
	if (jn_suture_begins_inside(pass))
		return jn_error(JN_BAD_INPUT, "suture.thread: the tip of '%s' lies within '%s' at rest; let it begin outside",
						pass->def->thread, pass->def->body);
	pass->clear = isnan(pass->def->clear) ? 2 : pass->def->clear / strand_of(pass)->length;
	collision->guest = (JnCollisionGuest){.user = pass, .collect = collect, .passes = passes};
	return JN_OK;
}

static void archive_site(const JnSuture* pass, JnArchive* archive, JnSite* site) {
	jn_archive_integer(archive, "number", &site->number);
	jn_archive_indices(archive, "triangle", site->nodes, 3, 0, pass->model->node_count);
	jn_archive_reals(archive, "weights", site->weights, 3);
	jn_archive_real(archive, "s", &site->s);
}

static void archive_sites(JnPass* base, JnArchive* archive) {
	JnSuture* pass = of(base);
	const int count = jn_archive_count(archive, "sites", pass->count, sizeof *pass->sites);
	if (count > JN_SITES_MOST) jn_archive_refuse(archive, "sites", "are more than there can be");
	pass->count = count <= JN_SITES_MOST ? count : 0;
	for (int i = 0; i < pass->count; ++i) archive_site(pass, archive, &pass->sites[i]);
	jn_archive_integer(archive, "made", &pass->made);
	jn_archive_switch(archive, "is_tip_inside", &pass->is_tip_inside);
	jn_archive_real(archive, "error", &pass->error);
}

static void destroy(JnPass* base) {
	JnArena arena = of(base)->arena;
	jn_arena_free(&arena);
}

static JnStatus create(const void* options, JnModel* model, JnPass** out) {
	JnArena arena = {0};
	JnSuture* pass;
	JN_NEW(&arena, pass, 1);
	pass->arena = arena;
	pass->base.type = &jn_pass_suture;
	pass->def = options;
	pass->model = model;
	pass->sites = jn_arena_take(&pass->arena, JN_SITES_MOST, sizeof *pass->sites);
	pass->tried = jn_arena_take(&pass->arena, JN_SITES_MOST, sizeof *pass->tried);
	*out = &pass->base;
	return pass->sites != NULL && pass->tried != NULL ? JN_OK : JN_OUT_OF_MEMORY;
}

static const JnPassColumn columns[] = {
	{"suture_sites", "", true}, {"suture_drawn", "m", false}, {"suture_error", "m", false}};

static void measure(const JnPass* base, double* values) {
	const JnSuture* pass = (const JnSuture*)base;
	values[0] = pass->count;
	values[1] = pass->count > 0 ? pass->sites[0].s * strand_of(pass)->length : 0;
	values[2] = pass->error;
}

const JnPassType jn_pass_suture = {
	.row = {.name = "suture",
			.doc = "sites where a thread goes through the surface of a body",
			.keys = jn_suture_keys,
			.options_size = sizeof(JnSutureDef)},
	.definition = offsetof(JnSimDef, suture),
	.create = create,
	.join = join,
	.destroy = destroy,
	.commit = commit,
	.archive = archive_sites,
	.column_count = sizeof columns / sizeof *columns,
	.columns = columns,
	.measure = measure,
};
