// Threads on obstacles: each frame, and between two of them the point that is nearest.
#include <math.h>
#include <string.h>

#include "math/vec3.h"
#include "pass/collision.h"

enum { ADVANCES = 32 };
static const double half = 0.5, close_by = 1e-3; // as in collision_near.c
static const double level = 1e-3;                // slope along a link that is none

/// A block of a point of a link with an obstacle: `n` at a place whose distance is `distance`; the point's is `before` at the
/// start.
static JnStatus add_obstacle(JnCollision* pass, const JnStep* step, const JnWatch* watch, int link, double share,
							 const double place[3], double distance, const double n[3], double before) {
	const double radius = pass->strands[pass->link_strand[link]].radius;
	const double target = vec3_dot(n, place) - distance + radius,
				 offset[3] = {-radius * n[0], -radius * n[1], -radius * n[2]};
	double at[3], end[2][3];
	jn_collision_segment_at(pass, pass->link_ends[link], 1, end);
	for (int a = 0; a < 3; ++a) at[a] = end[0][a] + share * (end[1][a] - end[0][a]);
	if (vec3_dot(n, at) - target >= pass->margin) return JN_OK;
	JnBlock* block;
	JN_TRY(jn_impulses_add(&pass->now, jn_collision_name(watch->kind, 0, watch->first, watch->second), JN_BLOCK_CONTACT,
						   6, &block));
	memcpy(block->frame[0], n, sizeof block->frame[0]);
	jn_collision_link_entries(pass, link, share, 1, offset, step->end->x, pass->now.entries + block->first);
	jn_collision_set_targets(pass, step, target, before - radius,
							 jn_friction_of(&pass->friction, pass->strand_surface[pass->link_strand[link]],
											pass->obstacle_surface[watch->second]),
							 block);
	return JN_OK;
}

int jn_collision_link_of_frame(const JnCollision* pass, int frame, double* share) {
	const JnStrand* strand = &pass->strands[pass->frame_strand[frame]];
	const int own = frame - strand->first_frame;
	*share = own < strand->link_count ? 0 : 1;
	return strand->first_link + (own < strand->link_count ? own : own - 1);
}

JnStatus jn_collision_frame_on_obstacle(JnCollision* pass, const JnStep* step, const JnWatch* watch) {
	const JnObstacle* shape = &pass->model->obstacles[watch->second].shape;
	const double radius = pass->strands[pass->frame_strand[watch->first]].radius;
	const double travel = vec3_distance(pass->start[watch->first], pass->end[watch->first]);
	double place[3], n[3], when = 0, share;
	jn_collision_at(pass, watch->first, 0, place);
	double distance = jn_obstacle_distance(shape, place, n);
	const double before = distance;
	if (distance - travel > radius + pass->margin) return JN_OK;
	for (int k = 0; k < ADVANCES && when < 1; ++k) {
		const double room = distance - half * radius;
		if (room <= close_by * radius) break;
		when = travel > 0 ? fmin(1, when + room / travel) : 1;
		jn_collision_at(pass, watch->first, when, place);
		distance = jn_obstacle_distance(shape, place, n);
	}
	const int link = jn_collision_link_of_frame(pass, watch->first, &share);
	return add_obstacle(pass, step, watch, link, share, place, distance, n, before);
}

/// The point of a link that is nearest to an obstacle.
typedef struct Lowest {
	double share, place[3], n[3];
	double distance; // [m]; where nothing is within reach, less than it
} Lowest;

/// Whether that is between the frames: where the slope of the distance along the link changes its sign (regula falsi,
/// Illinois). False where it is not, or not within `reach`: then only `distance` is known.
static bool lowest_between(const JnObstacle* shape, double end[2][3], double reach, Lowest* out) {
	double low = 0, high = 1, along[3], slope[2], far[2], normal[3];
	for (int a = 0; a < 3; ++a) along[a] = end[1][a] - end[0][a];
	const double length = vec3_length(along);
	for (int i = 0; i < 2; ++i) {
		far[i] = jn_obstacle_distance(shape, end[i], normal);
		slope[i] = vec3_dot(normal, along);
	}
	const bool is_far = 0.5 * (far[0] + far[1] - length) > reach;
	out->distance = is_far ? 0.5 * (far[0] + far[1] - length) : fmin(far[0], far[1]);
	if (slope[0] >= 0 || slope[1] <= 0 || is_far) return false;
	for (int k = 0; k < ADVANCES; ++k) {
		out->share = low + (high - low) * slope[0] / (slope[0] - slope[1]);
		for (int a = 0; a < 3; ++a) out->place[a] = end[0][a] + out->share * along[a];
		out->distance = jn_obstacle_distance(shape, out->place, out->n);
		const double here = vec3_dot(out->n, along);
		if (fabs(here) <= level * length) break;
		const int side = here < 0 ? 0 : 1;
		*(side == 0 ? &low : &high) = out->share;
		slope[side] = here;
		if (k > 0) slope[1 - side] *= 0.5;
	}
	return true;
}

/// The same at the end of the step, or, of what is fast, as late as its side is certain.
static bool lowest_on_way(const JnCollision* pass, const JnObstacle* shape, const int ends[2], double radius,
						  Lowest* out) {
	const double reach = radius + pass->margin, travel = fmax(vec3_distance(pass->start[ends[0]], pass->end[ends[0]]),
															  vec3_distance(pass->start[ends[1]], pass->end[ends[1]]));
	double at[2][3], when = 0;
	jn_collision_segment_at(pass, ends, 0, at);
	bool is_between = lowest_between(shape, at, reach, out);
	if (out->distance - travel > reach) return false;
	for (int k = 0; k < ADVANCES && when < 1; ++k) {
		const double room = out->distance - half * radius;
		if (room <= close_by * radius) break;
		when = travel > 0 ? fmin(1, when + room / travel) : 1;
		jn_collision_segment_at(pass, ends, when, at);
		is_between = lowest_between(shape, at, reach, out);
	}
	return is_between;
}

JnStatus jn_collision_link_on_obstacle(JnCollision* pass, const JnStep* step, const JnWatch* watch) {
	const JnObstacle* shape = &pass->model->obstacles[watch->second].shape;
	const int* ends = pass->link_ends[watch->first];
	Lowest low = {0};
	if (!lowest_on_way(pass, shape, ends, pass->strands[pass->link_strand[watch->first]].radius, &low)) return JN_OK;
	double start[2][3], at[3], normal[3];
	jn_collision_segment_at(pass, ends, 0, start);
	for (int a = 0; a < 3; ++a) at[a] = start[0][a] + low.share * (start[1][a] - start[0][a]);
	const double before = jn_obstacle_distance(shape, at, normal);
	return add_obstacle(pass, step, watch, watch->first, low.share, low.place, low.distance, low.n, before);
}
