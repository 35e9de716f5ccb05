// Along the surface: remeshing of the triangles that are there. Large triangles cut through thin parts that are bent; where
// two of them cross, smaller ones are asked for, and all is done anew. Around it: the isosurface of its signed distance.
#include "mesh/fill/resurface.h"

#include <math.h>
#include <string.h>

#include "base/log.h"
#include "math/vec3.h"
#include "mesh/fill/isosurface.h"
#include "mesh/fill/remesh.h"
#include "mesh/surface_edges.h"
#include "mesh/triangle_tree.h"

static const double CREASE_ANGLE = 40 * M_PI / 180;
static const double SHORTEST_CREASE = 6; ///< a chain of creases shorter than this many sizes is smoothed over

static const double SHRINK = 0.6; ///< of triangles that crossed, at each attempt
static const double GROWTH = 0.4; ///< of the edge length, a metre away from where it is small
enum { ATTEMPTS = 7, MOST_SPOTS = 2000 };

/// Where triangles crossed.
typedef struct Spot {
	double at[3], size; ///< place, and edge length that is asked for there [m]
} Spot;

/// A remeshing of a surface along itself.
typedef struct Along {
	const JnTriangleTree* tree; ///< of the surface as it was given
	double size;                ///< [m]
	int spot_count;
	Spot* spots; ///< MOST_SPOTS at most
} Along;

static void project(const void* shape, double point[3]) {
	const JnSurfacePoint nearest = jn_triangle_tree_nearest(((const Along*)shape)->tree, point);
	for (int a = 0; a < 3; a++) point[a] = nearest.at[a];
}

static double size_near(const void* shape, const double point[3]) {
	const Along* along = shape;
	double size = along->size;
	for (int i = 0; i < along->spot_count; i++) {
		const Spot* spot = &along->spots[i];
		const double away = fmax(vec3_distance(point, spot->at) - along->size, 0);
		size = fmin(size, spot->size + GROWTH * away);
	}
	return size;
}

static int find_root(int* parent, int node) {
	while (parent[node] != node) {
		parent[node] = parent[parent[node]];
		node = parent[node];
	}
	return node;
}

/// Forget the creases that hang together with too few others to be more than a bump.
static JnStatus drop_short_creases(JnHalfEdges* mesh, double shortest, JnArena* scratch) {
	int* parent;
	double* length;
	JN_NEW(scratch, parent, mesh->node_count);
	JN_NEW(scratch, length, mesh->node_count);
	for (int i = 0; i < mesh->node_count; i++) parent[i] = i;
	for (int h = 0; h < mesh->count; h++)
		if (mesh->crease[h]) parent[find_root(parent, mesh->from[h])] = find_root(parent, jn_to(mesh, h));
	for (int h = 0; h < mesh->count; h++) {
		if (!mesh->crease[h] || mesh->twin[h] < h) continue;
		const double* nodes = mesh->nodes;
		length[find_root(parent, mesh->from[h])] +=
			vec3_distance(nodes + 3 * (ptrdiff_t)mesh->from[h], nodes + 3 * (ptrdiff_t)jn_to(mesh, h));
	}
	for (int h = 0; h < mesh->count; h++)
		if (mesh->crease[h] && length[find_root(parent, mesh->from[h])] < shortest) mesh->crease[h] = false;
	return JN_OK;
}

static JnStatus remesh(const Along* along, const char* what, JnArena* scratch, JnSurface* out) {
	const JnGuide guide = {.project = project, .size = size_near, .shape = along};
	JnHalfEdges mesh = {0};
	JnStatus status = jn_half_edges_create(&along->tree->surface, what, &mesh);
	if (status == JN_OK && jn_half_edges_crease(&mesh, CREASE_ANGLE) > 0)
		status = drop_short_creases(&mesh, SHORTEST_CREASE * along->size, scratch);
	if (status == JN_OK) status = jn_remesh(&mesh, along->size, &guide);
	if (status == JN_OK) status = jn_half_edges_surface(&mesh, scratch, out);
	jn_half_edges_free(&mesh);
	return status;
}

/// A search for triangles that cross.
typedef struct Crossings {
	const JnSurface* surface;
	Along* along;
	int known; ///< spots before the search
} Crossings;

static JnStatus look_at_pair(void* user, int first, int second) {
	const Crossings* search = user;
	const JnSurface* surface = search->surface;
	Along* along = search->along;
	const double *p[3], *q[3];
	Spot spot = {0};
	for (int i = 0; i < 3; i++) {
		p[i] = surface->nodes + 3 * (ptrdiff_t)surface->triangles[3 * (ptrdiff_t)first + i];
		q[i] = surface->nodes + 3 * (ptrdiff_t)surface->triangles[3 * (ptrdiff_t)second + i];
		for (int a = 0; a < 3; a++) spot.at[a] += (p[i][a] + q[i][a]) / 6;
	}
	if (!jn_triangles_cross(p, q) || along->spot_count == MOST_SPOTS) return JN_OK;
	const Along before = {.size = along->size, .spots = along->spots, .spot_count = search->known};
	spot.size = SHRINK * size_near(&before, spot.at);
	along->spots[along->spot_count++] = spot;
	return JN_OK;
}

/// Note where triangles of `surface` cross; *count of them.
static JnStatus find_crossings(const JnSurface* surface, Along* along, JnArena* scratch, int* count) {
	JnTriangleTree tree;
	JN_TRY(jn_triangle_tree_create(surface, scratch, &tree));
	Crossings search = {.surface = surface, .along = along, .known = along->spot_count};
	JN_TRY(jn_triangle_tree_pairs(&tree, look_at_pair, &search));
	*count = along->spot_count - search.known;
	return JN_OK;
}

static JnStatus remesh_until_sound(const JnSurface* surface, double size, const char* what, JnArena* scratch,
								   JnSurface* out) {
	JnTriangleTree tree;
	Along along = {.tree = &tree, .size = size};
	JN_NEW(scratch, along.spots, MOST_SPOTS);
	JN_TRY(jn_triangle_tree_create(surface, scratch, &tree));
	for (int attempt = 0; attempt < ATTEMPTS && along.spot_count < MOST_SPOTS; attempt++) {
		int count;
		JN_TRY(remesh(&along, what, scratch, out));
		JN_TRY(find_crossings(out, &along, scratch, &count));
		if (count == 0) return JN_OK;
	}
	return jn_error(JN_BAD_INPUT, "%s: parts of the surface are too near to each other for triangles of %g m", what,
					size);
}

static JnStatus copy(const JnSurface* surface, JnArena* arena, JnSurface* out) {
	*out = *surface;
	JN_NEW(arena, out->nodes, 3 * (size_t)surface->node_count);
	JN_NEW(arena, out->triangles, 3 * (size_t)surface->triangle_count);
	memcpy(out->nodes, surface->nodes, 3 * (size_t)surface->node_count * sizeof *out->nodes);
	memcpy(out->triangles, surface->triangles, 3 * (size_t)surface->triangle_count * sizeof *out->triangles);
	return JN_OK;
}

JnStatus jn_resurface_along(const JnSurface* surface, double size, const char* what, JnArena* arena, JnSurface* out) {
	JnArena scratch = {0};
	JnSurface sound;
	JnStatus status = remesh_until_sound(surface, size, what, &scratch, &sound);
	if (status == JN_OK) status = copy(&sound, arena, out);
	jn_arena_free(&scratch);
	return status;
}

static double signed_distance(const void* shape, const double point[3]) {
	const double distance = jn_triangle_tree_nearest(shape, point).distance;
	return jn_triangle_tree_is_inside(shape, point) ? -distance : distance;
}

JnStatus jn_resurface_around(const JnSurface* surface, double size, const char* what, JnArena* arena, JnSurface* out) {
	JnArena scratch = {0};
	JnTriangleTree tree;
	JnStatus status = jn_triangle_tree_create(surface, &scratch, &tree);
	JnField field = {.at = signed_distance, .shape = &tree};
	for (int a = 0; a < 3 && status == JN_OK; a++) {
		field.min[a] = tree.boxes[1].low[a];
		field.max[a] = tree.boxes[1].high[a];
	}
	if (status == JN_OK) status = jn_isosurface(&field, size, what, arena, out);
	jn_arena_free(&scratch);
	return status == JN_OK ? jn_surface_check_closed(out, what) : status;
}
