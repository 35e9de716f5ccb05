// What blocks are made of: entries, targets and names.
#include "math/vec3.h"
#include "pass/collision.h"

static const double bounce_steps = 4; // steps of free fall: slower approaches do not bounce

/// A point off the axis is carried by the frames' nodes as if they were rigid: with r = x - mean, both weighted by masses,
/// the weights m r . A^-1 offset, A = sum of m r r^T, add nothing to the sum of weights, and `offset` to the point.
static void add_offset(const JnCollision* pass, const double offset[3], double sign, const double* x,
					   JnBlockEntry entries[6]) {
	double mean[3] = {0}, total = 0, A[6] = {0}, r[6][3], m[6], solved[3];
	for (int i = 0; i < 6; ++i) {
		m[i] = pass->model->nodal_mass[entries[i].node];
		total += m[i];
		for (int a = 0; a < 3; ++a) mean[a] += m[i] * x[3 * (ptrdiff_t)entries[i].node + a];
	}
	for (int i = 0; i < 6; ++i) {
		for (int a = 0; a < 3; ++a) r[i][a] = x[3 * (ptrdiff_t)entries[i].node + a] - mean[a] / total;
		for (int a = 0, k = 0; a < 3; ++a)
			for (int b = a; b < 3; ++b) A[k++] += m[i] * r[i][a] * r[i][b];
	}
	const double c0 = A[3] * A[5] - A[4] * A[4], c1 = A[2] * A[4] - A[1] * A[5], c2 = A[1] * A[4] - A[2] * A[3];
	const double c3 = A[0] * A[5] - A[2] * A[2], c4 = A[1] * A[2] - A[0] * A[4], c5 = A[0] * A[3] - A[1] * A[1];
	const double determinant = A[0] * c0 + A[1] * c1 + A[2] * c2, trace = A[0] + A[3] + A[5];
	if (!(determinant > 1e-9 * trace * trace * trace)) return; // flat: rubs at the axis
	solved[0] = (c0 * offset[0] + c1 * offset[1] + c2 * offset[2]) / determinant;
	solved[1] = (c1 * offset[0] + c3 * offset[1] + c4 * offset[2]) / determinant;
	solved[2] = (c2 * offset[0] + c4 * offset[1] + c5 * offset[2]) / determinant;
	for (int i = 0; i < 6; ++i) entries[i].weight[1] += sign * m[i] * vec3_dot(r[i], solved);
}

void jn_collision_link_entries(const JnCollision* pass, int link, double share, double sign, const double offset[3],
							   const double* x, JnBlockEntry entries[6]) {
	const double* axis = pass->strands[pass->link_strand[link]].axis;
	for (int i = 0; i < 6; ++i) {
		const int frame = pass->link_ends[link][i / 3];
		const double weight = sign * axis[i % 3] * (i < 3 ? 1 - share : share);
		entries[i] = (JnBlockEntry){.node = pass->frame_node[frame] + i % 3, .weight = {weight, weight}};
	}
	if (offset != NULL) add_offset(pass, offset, sign, x, entries);
}

void jn_collision_set_targets(JnCollision* pass, const JnStep* step, double touch, double gap, double friction,
							  JnBlock* block) {
	double at_start[3], velocity[3];
	jn_block_complete_frame(block->frame);
	jn_block_motion(&pass->now, block, step->start->x, at_start);
	block->touch = touch;
	block->target[JN_LEVEL_POSITION][0] = touch + fmin(0, gap + pass->def->push_out * step->dt);
	block->target[JN_LEVEL_POSITION][1] = at_start[1];
	block->target[JN_LEVEL_POSITION][2] = at_start[2];
	block->friction = friction;
	if (pass->def->restitution == 0) return;
	jn_block_motion(&pass->now, block, step->start->v, velocity);
	const double slow = bounce_steps * step->dt * vec3_length(pass->model->gravity);
	if (velocity[0] < -slow) block->target[JN_LEVEL_VELOCITY][0] = -pass->def->restitution * velocity[0];
}

uint64_t jn_collision_name(JnMeetingKind kind, int hide, int first, int second) {
	return (uint64_t)kind << 60 | (uint64_t)(hide & 0xfff) << 48 | (uint64_t)(first & 0xffffff) << 24 |
		   (uint64_t)(second & 0xffffff);
}

bool jn_collision_is_near(const JnCollision* pass, const double n[3], const double p[3], const double q[3],
						  double touch) {
	const double d[3] = {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
	return vec3_dot(n, d) - touch < pass->margin;
}
