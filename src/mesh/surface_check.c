// Does a surface bound a solid: every edge has two triangles that agree, and no two triangles cross.
#include "base/log.h"
#include "mesh/surface_edges.h"
#include "mesh/triangle_tree.h"

/// What may be wrong with the edges.
typedef struct EdgeFaults {
	JnOffenders open, crowded, twisted;
} EdgeFaults;

static void sort_edge(const JnSurface* surface, const JnEdgeSide* sides, int count, EdgeFaults* faults) {
	if (count == 1) jn_offenders_add_edge(&faults->open, surface, sides);
	if (count > 2) jn_offenders_add_edge(&faults->crowded, surface, sides);
	const bool is_twisted = count == 2 && jn_edge_goes_up(surface, &sides[0]) == jn_edge_goes_up(surface, &sides[1]);
	if (is_twisted) jn_offenders_add_edge(&faults->twisted, surface, sides);
}

static JnStatus judge_edges(const EdgeFaults* faults, const char* what) {
	const JnOffenders* bad = &faults->open;
	if (bad->count > 0) {
		return jn_error(JN_BAD_INPUT,
						"%s: the surface is open: edges of one triangle alone: %s%s (%d in all); close the holes in "
						"your modeller (in Blender: Mesh > Clean Up > Fill Holes)",
						what, bad->text, jn_offenders_rest(bad), bad->count);
	}
	bad = &faults->crowded;
	if (bad->count > 0) {
		return jn_error(JN_BAD_INPUT,
						"%s: edges of more than two triangles: %s%s (%d in all); remove inner walls and doubled faces "
						"in your modeller (in Blender: Select > All by Trait > Non Manifold shows them)",
						what, bad->text, jn_offenders_rest(bad), bad->count);
	}
	bad = &faults->twisted;
	if (bad->count == 0) return JN_OK;
	return jn_error(JN_BAD_INPUT,
					"%s: neighbouring triangles face opposite sides at %s%s (%d edges); recalculate the normals in "
					"your modeller (in Blender: Mesh > Normals > Recalculate Outside)",
					what, bad->text, jn_offenders_rest(bad), bad->count);
}

static JnStatus check_edges(const JnSurface* surface, const char* what, JnArena* scratch) {
	const int total = 3 * surface->triangle_count;
	EdgeFaults faults = {0};
	JnEdgeSide* sides;
	JN_TRY(jn_surface_edges(surface, scratch, &sides));
	for (int i = 0, count = 0; i < total; i += count) {
		count = jn_edge_side_count(sides, i, total);
		sort_edge(surface, sides + i, count, &faults);
	}
	return judge_edges(&faults, what);
}

typedef struct CrossingSearch {
	const JnSurface* surface;
	JnOffenders crossing;
} CrossingSearch;

static JnStatus look_at_pair(void* user, int first, int second) {
	CrossingSearch* search = user;
	const JnSurface* surface = search->surface;
	const double *p[3], *q[3];
	double near[3] = {0};
	for (int i = 0; i < 3; i++) {
		p[i] = surface->nodes + 3 * (ptrdiff_t)surface->triangles[3 * (ptrdiff_t)first + i];
		q[i] = surface->nodes + 3 * (ptrdiff_t)surface->triangles[3 * (ptrdiff_t)second + i];
		for (int a = 0; a < 3; a++) near[a] += p[i][a] / 3;
	}
	if (jn_triangles_cross(p, q))
		jn_offenders_add(&search->crossing, "%d and %d near (%.4g, %.4g, %.4g)", first, second, near[0], near[1],
						 near[2]);
	return JN_OK;
}

static JnStatus check_crossings(const JnSurface* surface, const char* what, JnArena* scratch) {
	JnTriangleTree tree;
	JN_TRY(jn_triangle_tree_create(surface, scratch, &tree));
	CrossingSearch search = {.surface = surface};
	JN_TRY(jn_triangle_tree_pairs(&tree, look_at_pair, &search));
	const JnOffenders* bad = &search.crossing;
	if (bad->count == 0) return JN_OK;
	return jn_error(JN_BAD_INPUT,
					"%s: triangles cross: %s%s (%d pairs in all); separate them in your modeller, or join the parts "
					"(in Blender: the modifiers Boolean, or Remesh > Voxel)",
					what, bad->text, jn_offenders_rest(bad), bad->count);
}

JnStatus jn_surface_check_closed(const JnSurface* surface, const char* what) {
	if (surface->triangle_count == 0) return jn_error(JN_BAD_INPUT, "%s: the surface has no triangles", what);
	JN_TRY(jn_surface_check_values(surface, what));
	JnArena scratch = {0};
	JnStatus status = check_edges(surface, what, &scratch);
	if (status == JN_OK) status = check_crossings(surface, what, &scratch);
	jn_arena_free(&scratch);
	return status;
}
