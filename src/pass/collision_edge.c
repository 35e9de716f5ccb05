// Links of threads on edges of surfaces that stick out, between their frames.
#include <string.h>

#include "math/vec3.h"
#include "pass/collision.h"

static const double convex = 1e-3; // 1 - cosine between the sides of an edge that sticks out
static const double end = 1e-3;    // share of a link that belongs to its frames

/// Normals on both sides of an edge; whether the surface sticks out there. A rim has one side alone and never does.
static bool sides_of(const JnCollision* pass, const JnWatch* watch, double when, double sides[2][3]) {
	const JnHide* hide = &pass->hides[watch->hide];
	const int* edge = hide->edges[watch->second];
	for (int i = 0; i < 2; ++i) {
		if (edge[2 + i] < 0) return false;
		const JnWatch side = {.first = 0, .second = edge[2 + i], .hide = watch->hide};
		const JnCollisionPair pair = jn_collision_triangle_pair(pass, &side);
		jn_collision_normal(pass, &pair, when, sides[i]);
	}
	if (1 - vec3_dot(sides[0], sides[1]) < convex) return false;
	const int* other = hide->skin.triangles + 3 * (ptrdiff_t)edge[3];
	double from[3], to[3], wing[3] = {0};
	for (int i = 0; i < 3; ++i) {
		if (other[i] == edge[0] || other[i] == edge[1]) continue;
		jn_collision_at(pass, jn_collision_vertex(pass, watch->hide, edge[0]), when, from);
		jn_collision_at(pass, jn_collision_vertex(pass, watch->hide, other[i]), when, to);
		for (int a = 0; a < 3; ++a) wing[a] = to[a] - from[a];
	}
	return vec3_dot(sides[0], wing) < 0;
}

/// Whether a direction lies between the normals of the sides: only there the edge is the nearest of the surface.
static bool is_between(double sides[2][3], const double n[3]) {
	const double least = vec3_dot(sides[0], sides[1]) - convex;
	return vec3_dot(n, sides[0]) >= least && vec3_dot(n, sides[1]) >= least;
}

static JnCollisionPair pair_of(const JnCollision* pass, const JnWatch* watch) {
	const int *ends = pass->link_ends[watch->first], *edge = pass->hides[watch->hide].edges[watch->second];
	return (JnCollisionPair){
		.first = {ends[0], ends[1]},
		.second = {jn_collision_vertex(pass, watch->hide, edge[0]), jn_collision_vertex(pass, watch->hide, edge[1])},
		.first_count = 2,
		.second_count = 2};
}

/// Whether link and edge touch; then the normal, and at the end the way from the link's axis to the edge. What is within the
/// body at the start is left to the frames.
static bool touches(const JnCollision* pass, const JnWatch* watch, double touch, JnNearest* near, double n[3],
					double to_edge[3]) {
	const JnCollisionPair pair = pair_of(pass, watch);
	double when, sides[2][3], p[3], q[3];
	jn_collision_nearest(pass, &pair, 0, near);
	if (!sides_of(pass, watch, 0, sides)) return false;
	if (vec3_dot(near->offset, sides[0]) + vec3_dot(near->offset, sides[1]) < 0) return false;
	if (!jn_collision_advance(pass, &pair, touch, &when, near) || !(near->distance > 0)) return false;
	if (near->share < end || near->share > 1 - end || !sides_of(pass, watch, when, sides)) return false;
	jn_collision_first_at_end(pass, &pair, near, p);
	jn_collision_second_at_end(pass, &pair, near, q);
	for (int a = 0; a < 3; ++a) {
		n[a] = near->offset[a] / near->distance;
		to_edge[a] = q[a] - p[a];
	}
	return is_between(sides, n) && jn_collision_is_near(pass, n, p, q, touch);
}

JnStatus jn_collision_link_on_edge(JnCollision* pass, const JnStep* step, const JnWatch* watch) {
	const JnHide* hide = &pass->hides[watch->hide];
	const int strand = pass->link_strand[watch->first], *edge = hide->edges[watch->second];
	const double touch = pass->strands[strand].radius;
	JnNearest near;
	double n[3], to_edge[3];
	if (pass->guest.user != NULL && pass->guest.passes(pass->guest.user, watch->first, hide->body)) return JN_OK;
	if (!touches(pass, watch, touch, &near, n, to_edge)) return JN_OK;
	JnBlock* block;
	JN_TRY(jn_impulses_add(&pass->now, jn_collision_name(watch->kind, watch->hide, watch->first, watch->second),
						   JN_BLOCK_CONTACT, 8, &block));
	JnBlockEntry* entries = pass->now.entries + block->first;
	memcpy(block->frame[0], n, sizeof block->frame[0]);
	jn_collision_link_entries(pass, watch->first, near.share, 1, to_edge, step->end->x, entries);
	for (int i = 0; i < 2; ++i)
		entries[6 + i] =
			(JnBlockEntry){.node = hide->skin.nodes[edge[i]], .weight = {-near.weights[i], -near.weights[i]}};
	jn_collision_set_targets(pass, step, touch, near.before - touch,
							 jn_collision_hide_friction(pass, strand, watch->hide), block);
	return JN_OK;
}
