// How near two watched things come. Two on straight paths advance by as much as their distance surely allows (conservative
// advancement) until the step ends or the distance has come down to half of that at which they touch: which side each is on
// is then never in doubt, however fast they are. Normal and points are taken there, the gap at the end of the step.
#include "detect/segment.h"
#include "math/vec3.h"
#include "mesh/triangle_tree.h"
#include "pass/collision.h"

enum { ADVANCES = 32 };
static const double half = 0.5;      // share of the touching distance down to which things advance
static const double close_by = 1e-3; // of the touching distance: advanced enough

void jn_collision_at(const JnCollision* pass, int point, double when, double out[3]) {
	for (int a = 0; a < 3; ++a) out[a] = (1 - when) * pass->start[point][a] + when * pass->end[point][a];
}

void jn_collision_segment_at(const JnCollision* pass, const int ends[2], double when, double out[2][3]) {
	for (int i = 0; i < 2; ++i) jn_collision_at(pass, ends[i], when, out[i]);
}

static void nearest_segments(const JnCollision* pass, const JnCollisionPair* pair, double when, JnNearest* out) {
	double a[2][3], b[2][3], share[2];
	jn_collision_segment_at(pass, pair->first, when, a);
	jn_collision_segment_at(pass, pair->second, when, b);
	out->distance = sqrt(jn_segments_nearest(a, b, share, out->offset));
	out->share = share[0];
	out->weights[0] = 1 - share[1];
	out->weights[1] = share[1];
}

static void nearest_triangle(const JnCollision* pass, const JnCollisionPair* pair, double when, JnNearest* out) {
	double p[3], c[3][3];
	jn_collision_at(pass, pair->first[0], when, p);
	for (int i = 0; i < 3; ++i) jn_collision_at(pass, pair->second[i], when, c[i]);
	jn_triangle_nearest(c[0], c[1], c[2], p, out->weights);
	for (int a = 0; a < 3; ++a) {
		out->offset[a] = p[a];
		for (int i = 0; i < 3; ++i) out->offset[a] -= out->weights[i] * c[i][a];
	}
	out->distance = vec3_length(out->offset);
	out->share = 0;
}

void jn_collision_nearest(const JnCollision* pass, const JnCollisionPair* pair, double when, JnNearest* out) {
	(pair->second_count == 3 ? nearest_triangle : nearest_segments)(pass, pair, when, out);
}

static double relative_travel(const JnCollision* pass, const JnCollisionPair* pair) {
	double most = 0;
	for (int i = 0; i < pair->first_count; ++i)
		for (int k = 0; k < pair->second_count; ++k) {
			const int p = pair->first[i], q = pair->second[k];
			double moved[3];
			for (int a = 0; a < 3; ++a)
				moved[a] = pass->end[p][a] - pass->start[p][a] - (pass->end[q][a] - pass->start[q][a]);
			most = fmax(most, vec3_dot(moved, moved));
		}
	return sqrt(most);
}

bool jn_collision_advance(const JnCollision* pass, const JnCollisionPair* pair, double touch, double* when,
						  JnNearest* out) {
	const double travel = relative_travel(pass, pair);
	*when = 0;
	jn_collision_nearest(pass, pair, 0, out);
	out->before = out->distance;
	if (out->distance - travel > touch + pass->margin) return false;
	for (int k = 0; k < ADVANCES && *when < 1; ++k) {
		const double room = out->distance - half * touch;
		if (room <= close_by * touch) break;
		*when = travel > 0 ? fmin(1, *when + room / travel) : 1;
		jn_collision_nearest(pass, pair, *when, out);
	}
	return true;
}

void jn_collision_first_at_end(const JnCollision* pass, const JnCollisionPair* pair, const JnNearest* near,
							   double out[3]) {
	double other[3];
	jn_collision_at(pass, pair->first[0], 1, out);
	if (pair->first_count == 1) return;
	jn_collision_at(pass, pair->first[1], 1, other);
	for (int a = 0; a < 3; ++a) out[a] += near->share * (other[a] - out[a]);
}

void jn_collision_second_at_end(const JnCollision* pass, const JnCollisionPair* pair, const JnNearest* near,
								double out[3]) {
	out[0] = out[1] = out[2] = 0;
	for (int i = 0; i < pair->second_count; ++i)
		for (int a = 0; a < 3; ++a) out[a] += near->weights[i] * pass->end[pair->second[i]][a];
}
