// From watched pairs to blocks: links with links here, the others in files of their own.
#include <string.h>

#include "math/vec3.h"
#include "pass/collision.h"

static JnStatus find_links(JnCollision* pass, const JnStep* step, const JnWatch* watch) {
	const double radius[2] = {pass->strands[pass->link_strand[watch->first]].radius,
							  pass->strands[pass->link_strand[watch->second]].radius};
	const double touch = radius[0] + radius[1];
	const int *a = pass->link_ends[watch->first], *b = pass->link_ends[watch->second];
	const JnCollisionPair pair = {{a[0], a[1]}, {b[0], b[1]}, 2, 2};
	JnNearest near;
	double when, p[3], q[3], n[3], to_middle[2][3];
	if (!jn_collision_advance(pass, &pair, touch, &when, &near) || !(near.distance > 0)) return JN_OK;
	for (int k = 0; k < 3; ++k) n[k] = near.offset[k] / near.distance;
	jn_collision_first_at_end(pass, &pair, &near, p);
	jn_collision_second_at_end(pass, &pair, &near, q);
	if (!jn_collision_is_near(pass, n, p, q, touch)) return JN_OK;
	for (int k = 0; k < 3; ++k) {
		to_middle[0][k] = (q[k] - p[k]) * radius[0] / touch;
		to_middle[1][k] = (p[k] - q[k]) * radius[1] / touch;
	}
	JnBlock* block;
	JN_TRY(jn_impulses_add(&pass->now, jn_collision_name(watch->kind, 0, watch->first, watch->second), JN_BLOCK_CONTACT,
						   12, &block));
	JnBlockEntry* entries = pass->now.entries + block->first;
	memcpy(block->frame[0], n, sizeof n);
	jn_collision_link_entries(pass, watch->first, near.share, 1, to_middle[0], step->end->x, entries);
	jn_collision_link_entries(pass, watch->second, near.weights[1], -1, to_middle[1], step->end->x, entries + 6);
	jn_collision_set_targets(pass, step, touch, near.before - touch,
							 jn_friction_of(&pass->friction, pass->strand_surface[pass->link_strand[watch->first]],
											pass->strand_surface[pass->link_strand[watch->second]]),
							 block);
	return JN_OK;
}

// The triangles of a frame stand beside each other.
static int run_length(const JnCollision* pass, int first) {
	const JnWatch* watches = pass->watches;
	int next = first + 1;
	if (watches[first].kind != JN_MEETING_FRAME_TRIANGLE) return 1;
	while (next < pass->watch_count && watches[next].kind == watches[first].kind &&
		   watches[next].hide == watches[first].hide && watches[next].first == watches[first].first)
		++next;
	return next - first;
}

static JnStatus find_watch(JnCollision* pass, const JnStep* step, const JnWatch* watch, int count) {
	switch (watch->kind) {
	case JN_MEETING_LINKS:
		return find_links(pass, step, watch);
	case JN_MEETING_FRAME_OBSTACLE:
		return jn_collision_frame_on_obstacle(pass, step, watch);
	case JN_MEETING_LINK_OBSTACLE:
		return jn_collision_link_on_obstacle(pass, step, watch);
	case JN_MEETING_FRAME_TRIANGLE:
		return jn_collision_frame_on_surface(pass, step, count, watch);
	case JN_MEETING_LINK_EDGE:
		return jn_collision_link_on_edge(pass, step, watch);
	case JN_MEETING_SITE:
		break;
	}
	return JN_OK;
}

static double travel_of_link(const JnCollision* pass, int link) {
	const double a = pass->travelled[pass->link_ends[link][0]], b = pass->travelled[pass->link_ends[link][1]];
	return a > b ? a : b;
}

// Whether the two have surely not come near since they are watched.
static bool is_clear(const JnCollision* pass, const JnWatch* watch) {
	if (watch->clear <= 0) return false;
	if (watch->kind == JN_MEETING_FRAME_OBSTACLE) return pass->travelled[watch->first] < watch->clear;
	const double own = travel_of_link(pass, watch->first);
	return (watch->kind == JN_MEETING_LINKS ? own + travel_of_link(pass, watch->second) : own) < watch->clear;
}

JnStatus jn_collision_find(JnCollision* pass, const JnStep* step) {
	pass->now.count = pass->now.entry_count = 0;
	pass->now.dt = step->dt;
	for (int i = 0, count; i < pass->watch_count; i += count) {
		count = run_length(pass, i);
		if (!is_clear(pass, &pass->watches[i])) JN_TRY(find_watch(pass, step, &pass->watches[i], count));
	}
	return JN_OK;
}
