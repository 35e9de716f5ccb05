// Frames of threads on the surfaces of bodies: each meets the triangles that it is in front of, at points inside of them, and the
// nearest point of the surface, wherever that is; what is within the body at the start is pushed out by the nearest way.
#include <string.h>

#include "math/vec3.h"
#include "mesh/triangle_tree.h"
#include "pass/collision.h"

static const double same = 1e-9;  // relative difference of distances that counts as none
static const double inner = 1e-9; // weight of a corner from which a point counts as inside the triangle

/// A place on the surface that a frame may touch.
typedef struct Place {
	int triangle;
	double gap;       // at the end [m]
	double before;    // and at the start
	double normal[3]; // out of the body
	double weights[3];
} Place;

JnCollisionPair jn_collision_triangle_pair(const JnCollision* pass, const JnWatch* watch) {
	const JnHide* hide = &pass->hides[watch->hide];
	JnCollisionPair pair = {.first = {watch->first}, .first_count = 1, .second_count = 3};
	for (int i = 0; i < 3; ++i)
		pair.second[i] = jn_collision_vertex(pass, watch->hide, hide->skin.triangles[3 * (ptrdiff_t)watch->second + i]);
	return pair;
}

void jn_collision_normal(const JnCollision* pass, const JnCollisionPair* pair, double when, double normal[3]) {
	double corner[3][3];
	for (int i = 0; i < 3; ++i) jn_collision_at(pass, pair->second[i], when, corner[i]);
	vec3_triangle(corner[0], corner[1], corner[2], normal);
	vec3_normalize(normal);
}

static double gap_at_end(const JnCollision* pass, const JnCollisionPair* pair, const JnNearest* near, const double n[3],
						 double touch) {
	double p[3], q[3];
	jn_collision_first_at_end(pass, pair, near, p);
	jn_collision_second_at_end(pass, pair, near, q);
	return n[0] * (p[0] - q[0]) + n[1] * (p[1] - q[1]) + n[2] * (p[2] - q[2]) - touch;
}

/// The nearest place of a frame's triangles. Where several share the nearest point, as at an edge, the one that sees the
/// frame most from above or below tells which side it is on. Returns whether that is outside.
static bool find_nearest(const JnCollision* pass, int count, const JnWatch* watches, double when, double touch,
						 Place* out) {
	double least = INFINITY, steepest = 0;
	for (int i = 0; i < count; ++i) {
		const JnCollisionPair pair = jn_collision_triangle_pair(pass, &watches[i]);
		JnNearest near;
		double normal[3];
		jn_collision_nearest(pass, &pair, when, &near);
		jn_collision_normal(pass, &pair, when, normal);
		const double slope = near.distance > 0 ? vec3_dot(normal, near.offset) / near.distance : 1;
		const bool ties = near.distance <= least * (1 + same) && near.distance >= least * (1 - same);
		if (ties ? fabs(slope) <= fabs(steepest) : near.distance > least) continue;
		least = near.distance;
		steepest = slope;
		const double sign = slope < 0 ? -1 : 1;
		for (int a = 0; a < 3; ++a)
			out->normal[a] = near.distance > 0 ? sign * near.offset[a] / near.distance : normal[a];
		out->triangle = watches[i].second;
		memcpy(out->weights, near.weights, sizeof out->weights);
		out->gap = gap_at_end(pass, &pair, &near, out->normal, touch);
		out->before = sign * near.distance - touch;
	}
	return steepest >= 0;
}

static JnStatus add_place(JnCollision* pass, const JnStep* step, const JnWatch* watch, const Place* place, int rank) {
	const JnHide* hide = &pass->hides[watch->hide];
	double share, to_surface[3];
	if (place->gap >= pass->margin) return JN_OK;
	JnBlock* block;
	JN_TRY(jn_impulses_add(&pass->now, jn_collision_name(watch->kind, watch->hide, watch->first, rank),
						   JN_BLOCK_CONTACT, 9, &block));
	JnBlockEntry* entries = pass->now.entries + block->first;
	memcpy(block->frame[0], place->normal, sizeof place->normal);
	memcpy(to_surface, pass->end[watch->first], sizeof to_surface);
	for (int i = 0; i < 3; ++i) {
		const int vertex = hide->skin.triangles[3 * (ptrdiff_t)place->triangle + i];
		const double w = place->weights[i], *at = pass->end[jn_collision_vertex(pass, watch->hide, vertex)];
		entries[6 + i] = (JnBlockEntry){.node = hide->skin.nodes[vertex], .weight = {-w, -w}};
		for (int a = 0; a < 3; ++a) to_surface[a] -= w * at[a];
	}
	for (int a = 0; a < 3; ++a) to_surface[a] = -to_surface[a];
	const int link = jn_collision_link_of_frame(pass, watch->first, &share);
	jn_collision_link_entries(pass, link, share, 1, to_surface, step->end->x, entries);
	jn_collision_set_targets(pass, step, pass->strands[pass->frame_strand[watch->first]].radius, place->before,
							 jn_collision_hide_friction(pass, pass->frame_strand[watch->first], watch->hide), block);
	return JN_OK;
}

/// Advance to one triangle, from its front. Whether there is a place, and whether it is inside the triangle.
static bool approach(const JnCollision* pass, const JnWatch* watch, double touch, Place* place, bool* is_inner) {
	const JnCollisionPair pair = jn_collision_triangle_pair(pass, watch);
	JnNearest near;
	double when, normal[3], away[3];
	jn_collision_normal(pass, &pair, 0, normal);
	for (int a = 0; a < 3; ++a) away[a] = pass->start[watch->first][a] - pass->start[pair.second[0]][a];
	if (vec3_dot(normal, away) < 0) return false;
	if (!jn_collision_advance(pass, &pair, touch, &when, &near) || !(near.distance > 0)) return false;
	for (int a = 0; a < 3; ++a) place->normal[a] = near.offset[a] / near.distance;
	jn_collision_normal(pass, &pair, when, normal);
	if (vec3_dot(normal, place->normal) < 0) return false;
	*is_inner = near.weights[0] > inner && near.weights[1] > inner && near.weights[2] > inner;
	memcpy(place->weights, near.weights, sizeof place->weights);
	place->triangle = watch->second;
	place->gap = gap_at_end(pass, &pair, &near, place->normal, touch);
	place->before = near.before - touch;
	return true;
}

static bool frame_passes(const JnCollision* pass, int frame, int body) {
	const JnStrand* strand = &pass->strands[pass->frame_strand[frame]];
	const int own = frame - strand->first_frame;
	if (pass->guest.user == NULL) return false;
	const int last = strand->first_link + strand->link_count - 1, after = strand->first_link + own, before = after - 1;
	const int first = before >= strand->first_link ? before : strand->is_closed ? last : after;
	const int second = after <= last ? after : last;
	return pass->guest.passes(pass->guest.user, first, body) || pass->guest.passes(pass->guest.user, second, body);
}

JnStatus jn_collision_frame_on_surface(JnCollision* pass, const JnStep* step, int count, const JnWatch* watches) {
	const double touch = pass->strands[pass->frame_strand[watches->first]].radius;
	Place nearest = {.gap = INFINITY}, place = nearest;
	if (frame_passes(pass, watches->first, pass->hides[watches->hide].body)) return JN_OK;
	if (!find_nearest(pass, count, watches, 0, touch, &place)) {
		find_nearest(pass, count, watches, 1, touch, &nearest);
		nearest.before = place.before;
		return add_place(pass, step, watches, &nearest, 0);
	}
	for (int i = 0; i < count; ++i) {
		bool is_inner = false;
		if (approach(pass, &watches[i], touch, &place, &is_inner) && place.gap < nearest.gap) nearest = place;
	}
	if (nearest.gap < pass->margin) JN_TRY(add_place(pass, step, watches, &nearest, 0));
	for (int i = 0; i < count; ++i) {
		bool is_inner = false;
		if (watches[i].second == nearest.triangle) continue;
		if (approach(pass, &watches[i], touch, &place, &is_inner) && is_inner)
			JN_TRY(add_place(pass, step, &watches[i], &place, watches[i].second + 1));
	}
	return JN_OK;
}
