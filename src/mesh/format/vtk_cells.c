// VTK cell types: 5 triangle, 10 tetrahedron, 24 quadratic tetrahedron, 12 hexahedron; those of two dimensions and less
// may stand beside them (markers, boundaries) and are left out of a volume.
#include "mesh/format/vtk_cells.h"

#include <limits.h>
#include <math.h>
#include <string.h>

#include "base/log.h"

enum { TRIANGLE = 5, QUADRATIC_EDGE = 21 };

/// Dimension of a VTK cell type; those of an unknown kind count as volumes, and are refused as such.
static int dimension_of(int64_t type) {
	static const int planar[] = {5, 6, 7, 8, 9, 22, 23, 28, 30, 34, 36};
	if ((type >= 1 && type <= 4) || type == QUADRATIC_EDGE) return 1;
	for (size_t i = 0; i < sizeof planar / sizeof planar[0]; ++i)
		if (planar[i] == type) return 2;
	return 3;
}

static int shape_of(int64_t type) {
	for (int shape = 0; shape < JN_SOLID_SHAPE_COUNT; ++shape)
		if (jn_shape_info[shape].vtk_type == type) return shape;
	return -1;
}

/// What is to be kept: one type, of the highest dimension there is.
typedef struct Kept {
	int64_t type;
	int dimension, nodes;
	size_t count;
} Kept;

static JnStatus choose(const char* path, const JnVtkCells* cells, Kept* kept) {
	*kept = (Kept){0};
	for (size_t i = 0; i < cells->cell_count; ++i) {
		const int64_t type = cells->types[i];
		const int dimension = dimension_of(type);
		if (dimension > kept->dimension) *kept = (Kept){.type = type, .dimension = dimension};
		if (dimension < kept->dimension) continue;
		if (type != kept->type)
			return jn_error(JN_BAD_INPUT, "%s: has cells of several types (VTK's %d and %d); all must be of one", path,
							(int)kept->type, (int)type);
		++kept->count;
	}
	const int shape = shape_of(kept->type);
	kept->nodes = shape >= 0 ? jn_shape_info[shape].nodes : 3;
	if (kept->dimension < 2) return jn_error(JN_BAD_INPUT, "%s: holds neither volume cells nor triangles", path);
	if (shape < 0 && kept->type != TRIANGLE)
		return jn_error(JN_BAD_INPUT,
						"%s: has cells of VTK's type %d; jounce knows 10 (tet4), 24 (tet10), 12 (hex8) and, "
						"for surfaces, 5 (triangle)",
						path, (int)kept->type);
	return JN_OK;
}

static JnStatus check_sizes(const char* path, const JnVtkCells* cells) {
	int64_t last = 0;
	for (size_t i = 0; i < cells->cell_count; ++i) {
		if (cells->offsets[i] < last || (uint64_t)cells->offsets[i] > cells->connectivity_count)
			return jn_error(JN_BAD_INPUT, "%s: the offset of cell %zu is out of range", path, i);
		last = cells->offsets[i];
	}
	if ((size_t)last != cells->connectivity_count)
		return jn_error(JN_BAD_INPUT, "%s: its cells have %lld point numbers in all, its connectivity %zu", path,
						(long long)last, cells->connectivity_count);
	if (cells->point_count > INT_MAX / 3 || cells->connectivity_count > INT_MAX)
		return jn_error(JN_BAD_INPUT, "%s: has more cells or points than jounce can number", path);
	for (size_t i = 0; i < 3 * cells->point_count; ++i)
		if (!isfinite(cells->points[i]))
			return jn_error(JN_BAD_INPUT, "%s: point %zu has a coordinate that is not finite", path, i / 3);
	return JN_OK;
}

static JnStatus copy_cell(const char* path, const JnVtkCells* cells, size_t cell, int nodes, int* out) {
	const int64_t start = cell > 0 ? cells->offsets[cell - 1] : 0;
	if (cells->offsets[cell] - start != nodes)
		return jn_error(JN_BAD_INPUT, "%s: cell %zu of VTK's type %d has %lld points instead of %d", path, cell,
						(int)cells->types[cell], (long long)(cells->offsets[cell] - start), nodes);
	for (int i = 0; i < nodes; ++i) {
		const int64_t point = cells->connectivity[start + i];
		if (point < 0 || (uint64_t)point >= cells->point_count)
			return jn_error(JN_BAD_INPUT, "%s: cell %zu names point %lld, which is not there", path, cell,
							(long long)point);
		out[i] = (int)point;
	}
	return JN_OK;
}

JnStatus jn_vtk_cells_import(const char* path, const JnVtkCells* cells, JnArena* arena, JnImport* out) {
	Kept kept;
	*out = (JnImport){0};
	JN_TRY(check_sizes(path, cells));
	JN_TRY(choose(path, cells, &kept));
	int *nodes, *next;
	JN_NEW(arena, nodes, kept.count * (size_t)kept.nodes);
	next = nodes;
	for (size_t i = 0; i < cells->cell_count; ++i) {
		if (cells->types[i] != kept.type) continue;
		JN_TRY(copy_cell(path, cells, i, kept.nodes, next));
		next += kept.nodes;
	}
	out->is_volume = kept.dimension == 3;
	if (!out->is_volume) {
		out->surface = (JnSurface){(int)cells->point_count, cells->points, (int)kept.count, nodes};
		return JN_OK;
	}
	out->volume = (JnMesh){.shape = (JnShape)shape_of(kept.type),
						   .node_count = (int)cells->point_count,
						   .nodes = cells->points,
						   .cell_count = (int)kept.count,
						   .cells = nodes,
						   .set_count = (int)cells->set_count,
						   .sets = cells->sets};
	return JN_OK;
}

JnStatus jn_vtk_set(const char* name, size_t name_length, const double* marks, size_t count, JnArena* arena,
					JnNodeSet* set) {
	char* text;
	JN_NEW(arena, text, name_length + 1);
	memcpy(text, name, name_length);
	*set = (JnNodeSet){.name = text};
	JN_NEW(arena, set->nodes, count + 1);
	for (size_t i = 0; i < count; ++i)
		if (marks[i] != 0) set->nodes[set->count++] = (int)i;
	return JN_OK;
}
