// First the cubes that a triangle passes through; then, along each row, those inside. Next to a cube that no triangle comes
// near, its faces included, the next one that is not touched is on the same side: few need to be asked about.
#include "mesh/fill/voxels.h"

#include <math.h>

#include "base/log.h"
#include "mesh/embed.h"
#include "mesh/fill/voxel_grid.h"
#include "mesh/triangle_tree.h"

static const double MOST_CUBES = 1e8; // of the grid: a byte each
static const int MOST_CELLS = 20000000;
static const double SLACK = 1e-6; // of the size: 0.3 m are three cubes of 0.1 m, whatever rounding says

static JnStatus lay_out(const JnSurface* surface, double size, const char* what, JnVoxelGrid* grid) {
	double counts[3];
	grid->size = size;
	for (int a = 0; a < 3; ++a) {
		double low = INFINITY, high = -INFINITY;
		for (int i = 0; i < 3 * surface->triangle_count; ++i) {
			const double x = surface->nodes[3 * (ptrdiff_t)surface->triangles[i] + a];
			low = fmin(low, x), high = fmax(high, x);
		}
		counts[a] = fmax(1, ceil((high - low) / size - SLACK));
		grid->low[a] = low + (high - low) / 2 - size * counts[a] / 2;
	}
	const double cubes = counts[0] * counts[1] * counts[2];
	if (!(cubes <= MOST_CUBES))
		return jn_error(
			JN_BAD_INPUT,
			"%s: cubes of %g m make a grid of %.0f x %.0f x %.0f around the surface, more than %.0f in all; "
			"make them larger than %.2g m",
			what, size, counts[0], counts[1], counts[2], MOST_CUBES, size * cbrt(cubes / MOST_CUBES));
	for (int a = 0; a < 3; ++a) grid->counts[a] = (int)counts[a];
	return JN_OK;
}

static void fill_row(JnVoxelGrid* grid, const JnTriangleTree* tree, int j, int k) {
	unsigned char* row = grid->cubes + ((ptrdiff_t)k * grid->counts[1] + j) * grid->counts[0];
	bool is_known = false, is_inside = false;
	for (int i = 0; i < grid->counts[0]; ++i) {
		const JnVoxel was = row[i];
		const double centre[3] = {grid->low[0] + (i + 0.5) * grid->size, grid->low[1] + (j + 0.5) * grid->size,
								  grid->low[2] + (k + 0.5) * grid->size};
		if (was != JN_VOXEL_TOUCHED) {
			if (!is_known) is_inside = jn_triangle_tree_is_inside(tree, centre);
			if (is_inside) row[i] = JN_VOXEL_INSIDE;
		}
		is_known = was == JN_VOXEL_CLEAR;
	}
}

static int count_full(const JnVoxelGrid* grid) {
	int count = 0;
	for (ptrdiff_t i = 0, end = (ptrdiff_t)grid->counts[0] * grid->counts[1] * grid->counts[2]; i < end; ++i)
		count += grid->cubes[i] >= JN_VOXEL_INSIDE;
	return count;
}

/// Is (i, j, k) a corner of a full cube?
static bool is_node(const JnVoxelGrid* grid, int i, int j, int k) {
	for (int c = 0; c < 8; ++c) {
		const int at[3] = {i - jn_hex_corner[c][0], j - jn_hex_corner[c][1], k - jn_hex_corner[c][2]};
		if (jn_voxel_is_full(grid, at)) return true;
	}
	return false;
}

/// Number the nodes of plane k from `next` on, in numbers[(counts[0] + 1) * (counts[1] + 1)]; returns what comes next.
/// Their coordinates go to `nodes`, unless it is NULL.
static int number_plane(const JnVoxelGrid* grid, int k, int next, int* numbers, double* nodes) {
	for (int j = 0; j <= grid->counts[1]; ++j) {
		for (int i = 0; i <= grid->counts[0]; ++i) {
			if (!is_node(grid, i, j, k)) continue;
			const int at[3] = {i, j, k};
			for (int a = 0; a < 3 && nodes != NULL; ++a)
				nodes[3 * (ptrdiff_t)next + a] = grid->low[a] + grid->size * at[a];
			numbers[j * (grid->counts[0] + 1) + i] = next++;
		}
	}
	return next;
}

/// Cells between two numbered planes; returns the place behind them.
static int* put_layer(const JnVoxelGrid* grid, int k, int* const planes[2], int* cells) {
	for (int j = 0; j < grid->counts[1]; ++j) {
		for (int i = 0; i < grid->counts[0]; ++i) {
			const int at[3] = {i, j, k};
			if (!jn_voxel_is_full(grid, at)) continue;
			for (int c = 0; c < 8; ++c) {
				const int place = (j + jn_hex_corner[c][1]) * (grid->counts[0] + 1) + i + jn_hex_corner[c][0];
				*cells++ = planes[jn_hex_corner[c][2]][place];
			}
		}
	}
	return cells;
}

static JnStatus make_mesh(const JnVoxelGrid* grid, JnArena* scratch, JnArena* arena, JnMesh* mesh) {
	const size_t plane = ((size_t)grid->counts[0] + 1) * ((size_t)grid->counts[1] + 1);
	int *below, *above;
	JN_NEW(scratch, below, plane);
	JN_NEW(scratch, above, plane);
	*mesh = (JnMesh){.shape = JN_HEX8, .cell_count = count_full(grid)};
	for (int k = 0; k <= grid->counts[2]; ++k) mesh->node_count = number_plane(grid, k, mesh->node_count, above, NULL);
	JN_NEW(arena, mesh->nodes, 3 * (size_t)mesh->node_count);
	JN_NEW(arena, mesh->cells, 8 * (size_t)mesh->cell_count);
	int next = number_plane(grid, 0, 0, below, mesh->nodes), *cells = mesh->cells;
	for (int k = 0; k < grid->counts[2]; ++k) {
		int* const planes[2] = {below, above};
		next = number_plane(grid, k + 1, next, above, mesh->nodes);
		cells = put_layer(grid, k, planes, cells);
		int* const swap = below;
		below = above, above = swap;
	}
	return JN_OK;
}

static JnStatus fill(const JnSurface* surface, JnVoxelGrid* grid, const char* what, JnArena* scratch, JnArena* arena,
					 JnMesh* mesh) {
	JnTriangleTree tree;
	JN_TRY(jn_triangle_tree_create(surface, scratch, &tree));
	JN_NEW(scratch, grid->cubes, (size_t)grid->counts[0] * (size_t)grid->counts[1] * (size_t)grid->counts[2]);
	jn_voxel_mark(grid, surface);
	for (int k = 0; k < grid->counts[2]; ++k)
		for (int j = 0; j < grid->counts[1]; ++j) fill_row(grid, &tree, j, k);
	const int count = count_full(grid);
	if (count > MOST_CELLS)
		return jn_error(JN_BAD_INPUT, "%s: cubes of %g m are %d cells, more than %d; make them larger than %.2g m",
						what, grid->size, count, MOST_CELLS, grid->size * cbrt((double)count / MOST_CELLS));
	if (count == 0) return jn_error(JN_BAD_INPUT, "%s: no cube touches the surface or lies inside it", what);
	return make_mesh(grid, scratch, arena, mesh);
}

JnStatus jn_voxels_fill(const JnSurface* surface, double size, const char* what, JnArena* arena, JnMesh* mesh) {
	JnVoxelGrid grid = {0};
	if (surface->triangle_count == 0) return jn_error(JN_BAD_INPUT, "%s: the surface has no triangles", what);
	JN_TRY(lay_out(surface, size, what, &grid));
	JnArena scratch = {0};
	const JnStatus status = fill(surface, &grid, what, &scratch, arena, mesh);
	jn_arena_free(&scratch);
	JN_TRY(status);
	JN_TRY(jn_voxel_warn_hinges(mesh, what));
	JnEmbedding* embedding = NULL;
	JN_TRY(jn_embedding_create(surface, mesh, what, arena, &embedding));
	mesh->embedding = embedding;
	return JN_OK;
}
