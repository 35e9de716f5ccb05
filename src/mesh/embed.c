// A vertex belongs to the first cell that holds it. One outside of all cells belongs to the cell under the nearest point
// of the mesh's own surface, and moves along the slope that the shape functions have there.
#include "mesh/embed.h"

#include <math.h>
#include <string.h>

#include "base/log.h"
#include "mesh/boundary.h"
#include "mesh/cell_grid.h"
#include "mesh/cell_map.h"
#include "mesh/triangle_tree.h"

static const double ON_FACE = 1e-9; // natural coordinates this little outside are inside

/// What the search needs to know about the mesh; `scratch` owns it.
typedef struct Search {
	const JnMesh* mesh;
	JnArena scratch;
	JnCellGrid grid;
	bool has_tree; // made for the first vertex that is outside
	JnTriangleTree tree;
} Search;

/// Where a vertex was found.
typedef struct Place {
	int cell; // -1: none
	double xi[3];
	double distance, allowed; // outside the mesh, and how far is no mistake [m]
} Place;

static JnStatus make_tree(Search* search) {
	if (search->has_tree) return JN_OK;
	JnSurface outer = {.node_count = search->mesh->node_count, .nodes = search->mesh->nodes};
	JN_TRY(jn_mesh_boundary(search->mesh, &search->scratch, &outer.triangle_count, &outer.triangles));
	JN_TRY(jn_triangle_tree_create(&outer, &search->scratch, &search->tree));
	search->has_tree = true;
	return JN_OK;
}

static Place place_inside(const Search* search, const double point[3]) {
	const int* cells = NULL;
	const int count = jn_cell_grid_at(&search->grid, point, &cells);
	for (int i = 0; i < count; ++i) {
		Place place = {.cell = cells[i]};
		if (!jn_cell_grid_is_near(&search->grid, search->mesh, place.cell, point)) continue;
		if (!jn_cell_natural(search->mesh, place.cell, point, place.xi)) continue;
		if (jn_cell_clamp(search->mesh->shape, place.xi) <= ON_FACE) return place;
	}
	return (Place){.cell = -1};
}

static bool has_nodes(const JnMesh* mesh, int cell, const int wanted[3]) {
	const int count = jn_shape_info[mesh->shape].nodes;
	const int* nodes = mesh->cells + (ptrdiff_t)cell * count;
	int found = 0;
	for (int i = 0; i < count; ++i) found += nodes[i] == wanted[0] || nodes[i] == wanted[1] || nodes[i] == wanted[2];
	return found == 3;
}

static double longest_side(const JnMesh* mesh, int cell) {
	double low[3], high[3];
	jn_cell_box(mesh, cell, low, high);
	return fmax(fmax(high[0] - low[0], high[1] - low[1]), high[2] - low[2]);
}

/// The nearest point of the boundary, and the one cell behind its triangle.
static Place place_outside(const Search* search, const double point[3]) {
	const JnMesh* mesh = search->mesh;
	const JnSurfacePoint nearest = jn_triangle_tree_nearest(&search->tree, point);
	Place place = {.cell = -1, .distance = nearest.distance};
	const int* cells = NULL;
	const int count = nearest.triangle >= 0 ? jn_cell_grid_at(&search->grid, nearest.at, &cells) : 0;
	for (int i = 0; i < count && place.cell < 0; ++i) {
		if (has_nodes(mesh, cells[i], search->tree.surface.triangles + 3 * (ptrdiff_t)nearest.triangle))
			place.cell = cells[i];
	}
	if (place.cell < 0) return place;
	place.allowed = longest_side(mesh, place.cell);
	if (!jn_cell_natural(mesh, place.cell, nearest.at, place.xi))
		for (int r = 0; r < 3; ++r) place.xi[r] = mesh->shape == JN_TET4 ? 0.25 : 0.5;
	jn_cell_clamp(mesh->shape, place.xi);
	return place;
}

/// The first vertex that cannot be embedded, and how many.
typedef struct Offenders {
	int count, first;
	Place place;
} Offenders;

static JnStatus place_vertex(Search* search, int vertex, JnEmbedding* out, int* nodes, double* weights,
							 Offenders* offenders) {
	const JnMesh* mesh = search->mesh;
	const double* point = out->surface.nodes + 3 * (ptrdiff_t)vertex;
	Place place = place_inside(search, point);
	if (place.cell < 0) {
		JN_TRY(make_tree(search));
		place = place_outside(search, point);
	}
	double found[JN_CELL_MAP_NODES];
	const bool is_good =
		place.cell >= 0 && place.distance <= place.allowed && jn_cell_weights(mesh, place.cell, place.xi, point, found);
	if (!is_good) {
		if (offenders->count++ == 0) offenders->first = vertex, offenders->place = place;
		return JN_OK;
	}
	const ptrdiff_t start = (ptrdiff_t)vertex * out->cell_nodes;
	memcpy(nodes + start, mesh->cells + (ptrdiff_t)place.cell * out->cell_nodes,
		   (size_t)out->cell_nodes * sizeof *nodes);
	memcpy(weights + start, found, (size_t)out->cell_nodes * sizeof *weights);
	return JN_OK;
}

static JnStatus tell(const Offenders* offenders, const JnSurface* surface, const char* what) {
	if (offenders->count == 0) return JN_OK;
	const double* at = surface->nodes + 3 * (ptrdiff_t)offenders->first;
	if (offenders->place.cell >= 0 && offenders->place.distance <= offenders->place.allowed)
		return jn_error(JN_BAD_INPUT,
						"%s: cell %d has no volume where vertex %d of the surface lies (%g, %g, %g); %d vertices like "
						"this",
						what, offenders->place.cell, offenders->first, at[0], at[1], at[2], offenders->count);
	return jn_error(JN_BAD_INPUT,
					"%s: vertex %d of the surface at (%g, %g, %g) lies %g m outside of the cells, whose nearest one is "
					"%g m large; %d vertices like this; place cells and surface upon each other",
					what, offenders->first, at[0], at[1], at[2], offenders->place.distance, offenders->place.allowed,
					offenders->count);
}

static JnStatus place_all(Search* search, const char* what, JnArena* arena, JnEmbedding* out) {
	const size_t entries = (size_t)out->surface.node_count * (size_t)out->cell_nodes;
	int* nodes;
	double* weights;
	Offenders offenders = {0};
	JN_NEW(arena, nodes, entries + 1);
	JN_NEW(arena, weights, entries + 1);
	JN_TRY(jn_cell_grid_create(search->mesh, &search->scratch, &search->grid));
	for (int i = 0; i < out->surface.node_count; ++i) JN_TRY(place_vertex(search, i, out, nodes, weights, &offenders));
	out->nodes = nodes;
	out->weights = weights;
	return tell(&offenders, &out->surface, what);
}

static JnStatus copy_surface(const JnSurface* from, JnArena* arena, JnSurface* to) {
	*to = *from;
	JN_NEW(arena, to->nodes, 3 * (size_t)from->node_count + 1);
	JN_NEW(arena, to->triangles, 3 * (size_t)from->triangle_count + 1);
	if (from->node_count > 0) memcpy(to->nodes, from->nodes, 3 * (size_t)from->node_count * sizeof *to->nodes);
	if (from->triangle_count > 0)
		memcpy(to->triangles, from->triangles, 3 * (size_t)from->triangle_count * sizeof *to->triangles);
	return JN_OK;
}

JnStatus jn_embedding_create(const JnSurface* surface, const JnMesh* mesh, const char* what, JnArena* arena,
							 JnEmbedding** embedding) {
	const JnShapeInfo* info = &jn_shape_info[mesh->shape];
	if (mesh->shape != JN_HEX8 && mesh->shape != JN_TET4)
		return jn_error(JN_BAD_INPUT, "%s: %s cells cannot carry a surface; use hex8 or tet4", what, info->name);
	if (mesh->cell_count == 0) return jn_error(JN_BAD_INPUT, "%s: there are no cells to carry the surface", what);
	JnEmbedding* out;
	JN_NEW(arena, out, 1);
	out->cell_nodes = info->nodes;
	JN_TRY(copy_surface(surface, arena, &out->surface));
	Search search = {.mesh = mesh};
	const JnStatus status = place_all(&search, what, arena, out);
	jn_arena_free(&search.scratch);
	if (status == JN_OK) *embedding = out;
	return status;
}

void jn_embedding_positions(const JnEmbedding* embedding, const double* x, double* positions) {
	const int count = embedding->cell_nodes;
	for (int i = 0; i < embedding->surface.node_count; ++i) {
		const int* nodes = embedding->nodes + (ptrdiff_t)i * count;
		const double* weights = embedding->weights + (ptrdiff_t)i * count;
		double sum[3] = {0};
		if (embedding->offsets != NULL) memcpy(sum, embedding->offsets + 3 * (ptrdiff_t)i, sizeof sum);
		for (int k = 0; k < count; ++k)
			for (int a = 0; a < 3; ++a) sum[a] += weights[k] * x[3 * (ptrdiff_t)nodes[k] + a];
		memcpy(positions + 3 * (ptrdiff_t)i, sum, sizeof sum);
	}
}
