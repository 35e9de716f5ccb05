// Pairs of points: found by cells, kept while no point moves far, and told apart by distance.
#include <math.h>
#include <string.h>

#include "base/grow.h"
#include "math/vec3.h"
#include "model/repulsion_meeting.h"

static double distance_at_rest(const JnRepulsion* self, int i, int j) {
	return vec3_distance(self->model->rest + 3 * (size_t)i, self->model->rest + 3 * (size_t)j);
}

static JnRepulsionPair pair_of(const JnRepulsion* self, int i, int j) {
	const JnRepulsionDef* def = self->def;
	const double by_spacing = def->reach * 0.5 * (self->spacing[i] + self->spacing[j]);
	return (JnRepulsionPair){
		.nodes = {i, j},
		.reach = fmin(def->rest_share * distance_at_rest(self, i, j), by_spacing),
		.kappa = fmin(self->modulus[i], self->modulus[j]) * self->volume[i] * self->volume[j],
	};
}

// Pairs that are too far apart to meet before some point has moved by half the margin are left out.
static JnStatus keep_pairs(JnRepulsion* self) {
	self->pair_count = 0;
	for (int a = 0; a < self->point_count; ++a)
		for (int k = self->near.starts[a]; k < self->near.starts[a + 1]; ++k) {
			const int b = self->near.list[k];
			const JnRepulsionPair pair = pair_of(self, self->points[a], self->points[b]);
			const double distance = vec3_distance(self->built + 3 * (size_t)a, self->built + 3 * (size_t)b);
			if (distance >= pair.reach + self->margin) continue;
			JN_TRY(jn_grow((void**)&self->pairs, &self->pair_capacity, (size_t)self->pair_count + 1, sizeof pair));
			self->pairs[self->pair_count++] = pair;
		}
	return JN_OK;
}

// A point that is not finite has no force here; whoever looks at the state finds out.
static bool serves(const JnRepulsion* self, const double* x) {
	const double most = 0.25 * self->margin * self->margin;
	double farthest = 0;
	for (int a = 0; a < self->point_count; ++a) {
		const double *now = x + 3 * (size_t)self->points[a], *then = self->built + 3 * (size_t)a;
		const double d[3] = {now[0] - then[0], now[1] - then[1], now[2] - then[2]};
		farthest = fmax(farthest, vec3_dot(d, d));
	}
	return self->is_built && farthest <= most;
}

JnStatus jn_repulsion_find_pairs(JnRepulsion* self, const double* x) {
	if (self->point_count == 0 || serves(self, x)) return JN_OK;
	for (int a = 0; a < self->point_count; ++a)
		memcpy(self->built + 3 * (size_t)a, x + 3 * (size_t)self->points[a], 3 * sizeof *x);
	JN_TRY(jn_neighbours_find(self->built, self->point_count, self->farthest + self->margin, "repulsion", &self->near));
	self->is_built = true;
	return keep_pairs(self);
}

JnStatus jn_repulsion_visit_points(JnRepulsion* self, const double* x, JnRepulsionVisit* visit, void* user) {
	JN_TRY(jn_repulsion_find_pairs(self, x));
	for (int k = 0; k < self->pair_count; ++k) {
		const JnRepulsionPair* pair = &self->pairs[k];
		const double *a = x + 3 * (size_t)pair->nodes[0], *b = x + 3 * (size_t)pair->nodes[1];
		JnRepulsionMeeting meeting = {.y = {a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
		const double square = vec3_dot(meeting.y, meeting.y);
		if (!(square < pair->reach * pair->reach && square > 0)) continue;
		memcpy(meeting.nodes, pair->nodes, sizeof meeting.nodes);
		meeting.r = sqrt(square);
		meeting.reach = pair->reach;
		meeting.kappa = pair->kappa;
		meeting.turning[0] = meeting.turning[2] = meeting.turning[5] = 1;
		JN_TRY(visit(self, &meeting, user));
	}
	return JN_OK;
}
