#include "model/select.h"

#include <math.h>

#include "base/log.h"

enum { FACE_ALL = 7 };

typedef struct Bounds {
	double min[3], max[3], slack; // slack: what counts as "on" a face
} Bounds;

static Bounds bounds_of(const JnMesh* mesh) {
	Bounds b = {.min = {INFINITY, INFINITY, INFINITY}, .max = {-INFINITY, -INFINITY, -INFINITY}};
	for (int i = 0; i < 3 * mesh->node_count; ++i) {
		b.min[i % 3] = fmin(b.min[i % 3], mesh->nodes[i]);
		b.max[i % 3] = fmax(b.max[i % 3], mesh->nodes[i]);
	}
	const double size = fmax(b.max[0] - b.min[0], fmax(b.max[1] - b.min[1], b.max[2] - b.min[2]));
	b.slack = 1e-9 * size; // rounding of generated coordinates is 1e-16 of the size
	return b;
}

static bool is_inside(const double min[3], const double max[3], double slack, const double* p) {
	for (int axis = 0; axis < 3; ++axis)
		if (p[axis] < min[axis] - slack || p[axis] > max[axis] + slack) return false;
	return true;
}

static bool is_chosen(const JnSelectDef* def, const Bounds* bounds, const double* p) {
	if (def->face == FACE_ALL) return true;
	if (def->face != 0) {
		const int axis = (def->face - 1) / 2;
		const double side = def->face % 2 == 1 ? bounds->min[axis] : bounds->max[axis];
		return fabs(p[axis] - side) <= bounds->slack;
	}
	if (def->box != NULL) return is_inside(def->box->min, def->box->max, bounds->slack, p);
	const double* c = def->sphere->center;
	return hypot(hypot(p[0] - c[0], p[1] - c[1]), p[2] - c[2]) <= def->sphere->radius + bounds->slack;
}

int jn_select_nearest(const double* points, int count, const double point[3]) {
	int best = 0;
	double smallest = INFINITY;
	for (int i = 0; i < count; ++i) {
		const double* p = points + 3 * (size_t)i;
		const double d[3] = {p[0] - point[0], p[1] - point[1], p[2] - point[2]};
		const double distance = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
		if (distance < smallest) {
			smallest = distance;
			best = i;
		}
	}
	return best;
}

JnStatus jn_select_nodes(const JnSelectDef* def, const JnMesh* mesh, const char* what, bool* chosen) {
	const bool by_point = !isnan(def->nearest[0]);
	const int ways = (def->face != 0) + (def->box != NULL) + (def->sphere != NULL) + by_point;
	if (ways != 1)
		return jn_error(JN_BAD_INPUT, "%s: %s; give exactly one of face, box, sphere, nearest", what,
						ways == 0 ? "nothing says which nodes" : "several ways of choosing nodes are given");
	const Bounds bounds = bounds_of(mesh);
	int count = 0;
	for (int i = 0; i < mesh->node_count; ++i) {
		chosen[i] = !by_point && is_chosen(def, &bounds, mesh->nodes + 3 * (size_t)i);
		count += chosen[i];
	}
	if (by_point) chosen[jn_select_nearest(mesh->nodes, mesh->node_count, def->nearest)] = true;
	if (by_point || count > 0) return JN_OK;
	return jn_error(
		JN_BAD_INPUT,
		"%s: no node lies there; choose nodes of the body, which spans [%g, %g] x [%g, %g] x [%g, %g] m at rest", what,
		bounds.min[0], bounds.max[0], bounds.min[1], bounds.max[1], bounds.min[2], bounds.max[2]);
}
