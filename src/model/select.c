#include "model/select.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/key.h"
#include "base/log.h"

enum { FACE_ALL = 7 };

typedef struct Bounds {
	double min[3], max[3], slack; // slack: what counts as "on" a face
	double size;                  // longest edge
} Bounds;

static Bounds bounds_of(const JnMesh* mesh) {
	Bounds b = {.min = {INFINITY, INFINITY, INFINITY}, .max = {-INFINITY, -INFINITY, -INFINITY}};
	for (int i = 0; i < 3 * mesh->node_count; ++i) {
		b.min[i % 3] = fmin(b.min[i % 3], mesh->nodes[i]);
		b.max[i % 3] = fmax(b.max[i % 3], mesh->nodes[i]);
	}
	b.size = fmax(b.max[0] - b.min[0], fmax(b.max[1] - b.min[1], b.max[2] - b.min[2]));
	b.slack = 1e-9 * b.size; // rounding of generated coordinates is 1e-16 of the size
	return b;
}

static bool is_inside(const double min[3], const double max[3], double slack, const double* p) {
	for (int axis = 0; axis < 3; ++axis)
		if (p[axis] < min[axis] - slack || p[axis] > max[axis] + slack) return false;
	return true;
}

static double length_of(const double v[3]) {
	return hypot(hypot(v[0], v[1]), v[2]);
}

static bool is_at_plane(const JnRegionPlaneDef* plane, double size, const double* p) {
	const double within = isnan(plane->within) ? 1e-6 * size : plane->within;
	double height = 0;
	for (int axis = 0; axis < 3; ++axis) height += (p[axis] - plane->point[axis]) * plane->normal[axis];
	height /= length_of(plane->normal);
	if (plane->side == 1) return height >= -within;
	return plane->side == 2 ? height <= within : fabs(height) <= within;
}

static bool is_chosen(const JnSelectDef* def, const Bounds* bounds, const double* p) {
	if (def->face == FACE_ALL) return true;
	if (def->face != 0) {
		const int axis = (def->face - 1) / 2;
		const double side = def->face % 2 == 1 ? bounds->min[axis] : bounds->max[axis];
		return fabs(p[axis] - side) <= bounds->slack;
	}
	if (def->box != NULL) return is_inside(def->box->min, def->box->max, bounds->slack, p);
	if (def->plane != NULL) return is_at_plane(def->plane, bounds->size, p);
	assert(def->sphere != NULL); // jn_select_check: one of them is given
	const double* c = def->sphere->center;
	return length_of((double[3]){p[0] - c[0], p[1] - c[1], p[2] - c[2]}) <= def->sphere->radius + bounds->slack;
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

static int nearest_to_corner(const JnMesh* mesh, const Bounds* bounds, int corner) {
	double point[3];
	for (int axis = 0; axis < 3; ++axis)
		point[axis] = ((corner - 1) >> axis & 1) == 1 ? bounds->max[axis] : bounds->min[axis];
	return jn_select_nearest(mesh->nodes, mesh->node_count, point);
}

static const char* set_name(void* mesh, int index) {
	const JnMesh* m = mesh;
	return index < m->set_count ? m->sets[index].name : NULL;
}

static const JnNodeSet* find_set(const JnMesh* mesh, const char* name) {
	for (int i = 0; i < mesh->set_count; ++i)
		if (strcmp(mesh->sets[i].name, name) == 0) return &mesh->sets[i];
	return NULL;
}

static JnStatus complain_set(const JnMesh* mesh, const char* name, const char* what) {
	char list[600] = "";
	size_t length = 0;
	for (int i = 0; i < mesh->set_count && length < sizeof list; ++i) {
		const int added = snprintf(list + length, sizeof list - length, "%s%s", i > 0 ? ", " : "", mesh->sets[i].name);
		length += (size_t)added;
	}
	const char* near = jn_suggest(name, set_name, (void*)mesh);
	return jn_error(JN_BAD_INPUT, "%s.set: the body has no set '%.100s'%s%s%s Sets here: %s", what, name,
					near != NULL ? "; did you mean '" : ".", near != NULL ? near : "", near != NULL ? "'?" : "",
					mesh->set_count > 0 ? list : "none; name one in the body's 'sets'");
}

static JnStatus choose_set(const JnMesh* mesh, const char* name, const char* what, bool* chosen) {
	const JnNodeSet* set = find_set(mesh, name);
	if (set == NULL) return complain_set(mesh, name, what);
	memset(chosen, 0, (size_t)mesh->node_count * sizeof *chosen);
	for (int i = 0; i < set->count; ++i) chosen[set->nodes[i]] = true;
	if (set->count > 0) return JN_OK;
	return jn_error(JN_BAD_INPUT, "%s.set: the set '%s' has no nodes; choose another", what, name);
}

static void choose_one(const JnMesh* mesh, int node, bool* chosen) {
	memset(chosen, 0, (size_t)mesh->node_count * sizeof *chosen);
	chosen[node] = true;
}

static JnStatus choose_region(const JnSelectDef* def, const JnMesh* mesh, const Bounds* b, const char* what,
							  bool* chosen) {
	if (def->plane != NULL && !(length_of(def->plane->normal) > 0))
		return jn_error(JN_BAD_INPUT, "%s.plane.normal: has no direction; give one such as [0, 1, 0]", what);
	int count = 0;
	for (int i = 0; i < mesh->node_count; ++i) {
		chosen[i] = is_chosen(def, b, mesh->nodes + 3 * (size_t)i);
		count += chosen[i];
	}
	if (count > 0) return JN_OK;
	return jn_error(
		JN_BAD_INPUT,
		"%s: no node lies there; choose nodes of the body, which spans [%g, %g] x [%g, %g] x [%g, %g] m at rest", what,
		b->min[0], b->max[0], b->min[1], b->max[1], b->min[2], b->max[2]);
}

JnStatus jn_select_check(const JnSelectDef* def, const char* what) {
	const int ways = (def->face != 0) + (def->box != NULL) + (def->sphere != NULL) + !isnan(def->nearest[0]) +
					 (def->plane != NULL) + (def->corner != 0) + (def->set != NULL);
	if (ways == 1) return JN_OK;
	return jn_error(JN_BAD_INPUT, "%s: %s; give exactly one of face, box, sphere, nearest, plane, corner, set", what,
					ways == 0 ? "nothing says which nodes" : "several ways of choosing nodes are given");
}

JnStatus jn_select_nodes(const JnSelectDef* def, const JnMesh* mesh, const char* what, bool* chosen) {
	JN_TRY(jn_select_check(def, what));
	if (def->set != NULL) return choose_set(mesh, def->set, what, chosen);
	const Bounds bounds = bounds_of(mesh);
	if (def->corner == 0 && isnan(def->nearest[0])) return choose_region(def, mesh, &bounds, what, chosen);
	choose_one(mesh,
			   def->corner != 0 ? nearest_to_corner(mesh, &bounds, def->corner)
								: jn_select_nearest(mesh->nodes, mesh->node_count, def->nearest),
			   chosen);
	return JN_OK;
}

static JnStatus add_set(const JnSetDef* def, const char* what, const bool* chosen, JnArena* arena, JnMesh* mesh) {
	if (find_set(mesh, def->name) != NULL)
		return jn_error(JN_BAD_INPUT, "%s.name: the body has a set '%s' already; use another name", what, def->name);
	JnNodeSet set = {.name = def->name};
	for (int i = 0; i < mesh->node_count; ++i) set.count += chosen[i];
	JN_NEW(arena, set.nodes, set.count);
	for (int i = 0, k = 0; i < mesh->node_count; ++i)
		if (chosen[i]) set.nodes[k++] = i;
	mesh->sets[mesh->set_count++] = set;
	return JN_OK;
}

JnStatus jn_select_add_sets(const JnItems* defs, const char* what, JnArena* arena, JnMesh* mesh) {
	if (defs->count == 0) return JN_OK;
	const JnNodeSet* old = mesh->sets;
	bool* chosen;
	JN_NEW(arena, mesh->sets, mesh->set_count + defs->count);
	if (mesh->set_count > 0) memcpy(mesh->sets, old, (size_t)mesh->set_count * sizeof *old);
	JN_NEW(arena, chosen, mesh->node_count);
	for (int i = 0; i < defs->count; ++i) {
		const JnSetDef* def = (const JnSetDef*)defs->data + i;
		char entry[128], where[140];
		snprintf(entry, sizeof entry, "%s[%d]", what, i);
		snprintf(where, sizeof where, "%s.where", entry);
		JN_TRY(jn_select_nodes(&def->where, mesh, where, chosen));
		JN_TRY(add_set(def, entry, chosen, arena, mesh));
	}
	return JN_OK;
}
