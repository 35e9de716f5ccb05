// Rigid balls and plates against points and against each other: nearest points of rectangles. A rigid body meets the
// points, which are many, and the balls among the rigid bodies, whose rectangle is a point.
#include <math.h>

#include "math/vec3.h"
#include "model/repulsion_meeting.h"

// y from the rectangle about `center` to x, and the directions in which it can turn: along those axes on which x lies
// beyond the rectangle.
static void from_rectangle(const JnRigid* shape, const double center[3], const double x[3], JnRepulsionMeeting* out) {
	const double d[3] = {x[0] - center[0], x[1] - center[1], x[2] - center[2]};
	for (int k = 0; k < 3; ++k) {
		const double* axis = shape->axes[k];
		const double along = vec3_dot(axis, d), excess = along - fmax(-shape->half[k], fmin(along, shape->half[k]));
		if (excess == 0 && shape->half[k] > 0) continue;
		for (int a = 0, entry = 0; a < 3; ++a) {
			out->y[a] += excess * axis[a];
			for (int b = 0; b <= a; ++b, ++entry) out->turning[entry] += axis[a] * axis[b];
		}
	}
}

static JnStatus visit_one(JnRepulsion* self, const double* x, const JnRepulsionRigid* rigid, int node, double kappa,
						  JnRepulsionVisit* visit, void* user) {
	const double *at = x + 3 * (size_t)node, *center = x + 3 * (size_t)rigid->node;
	JnRepulsionMeeting meeting = {.nodes = {node, rigid->node}, .kappa = kappa};
	meeting.reach = rigid->shape->radius + 0.5 * self->spacing[node];
	from_rectangle(rigid->shape, center, at, &meeting);
	const double square = vec3_dot(meeting.y, meeting.y);
	if (!(square < meeting.reach * meeting.reach && square > 0)) return JN_OK;
	meeting.r = sqrt(square);
	return visit(self, &meeting, user);
}

static double stiffness_of(const JnRepulsionRigid* rigid, double other) {
	return isnan(rigid->stiffness) ? other : rigid->stiffness;
}

// Farther than this from its middle, nothing meets it.
static double extent_of(const JnRigid* shape) {
	return vec3_length(shape->half) + shape->radius;
}

static JnStatus visit_balls(JnRepulsion* self, const double* x, int which, JnRepulsionVisit* visit, void* user) {
	const JnRepulsionRigid* rigid = &self->rigids[which];
	const bool is_ball = vec3_length(rigid->shape->half) == 0;
	for (int k = 0; k < self->rigid_count; ++k) {
		const JnRepulsionRigid* other = &self->rigids[k];
		const bool is_done = is_ball && k <= which; // two balls meet once
		if (k == which || is_done || vec3_length(other->shape->half) > 0) continue;
		const double kappa = stiffness_of(rigid, stiffness_of(other, self->push[other->node]));
		JN_TRY(visit_one(self, x, rigid, other->node, kappa, visit, user));
	}
	return JN_OK;
}

JnStatus jn_repulsion_visit_rigids(JnRepulsion* self, const double* x, JnRepulsionVisit* visit, void* user) {
	for (int which = 0; which < self->rigid_count; ++which) {
		const JnRepulsionRigid* rigid = &self->rigids[which];
		const double* center = x + 3 * (size_t)rigid->node;
		const double extent = extent_of(rigid->shape);
		for (int k = 0; k < self->point_count; ++k) {
			const int node = self->points[k];
			const double* at = x + 3 * (size_t)node;
			const double d[3] = {at[0] - center[0], at[1] - center[1], at[2] - center[2]};
			const double reach = extent + 0.5 * self->spacing[node];
			if (!(vec3_dot(d, d) < reach * reach)) continue;
			JN_TRY(visit_one(self, x, rigid, node, stiffness_of(rigid, self->push[node]), visit, user));
		}
		JN_TRY(visit_balls(self, x, which, visit, user));
	}
	return JN_OK;
}
