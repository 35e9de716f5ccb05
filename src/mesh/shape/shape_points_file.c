// Points that fill a closed surface from a file: those of a lattice around it that lie inside.
#include <math.h>

#include "base/log.h"
#include "mesh/shape/points.h"
#include "mesh/shape/shape_file.h"
#include "mesh/shape/shape_keys.h"
#include "mesh/triangle_tree.h"

typedef struct PointsFileDef {
	const char* path;
	JnPlacementDef placement;
	double spacing; // [m]
	JnJitterDef jitter;
} PointsFileDef;

static const JnKey keys[] = {
	{.name = "path",
	 .kind = JN_PATH,
	 .field = offsetof(PointsFileDef, path),
	 .required = true,
	 .meaning = "a closed surface (.obj .ply .stl .off .gltf .glb); from the scene file's folder"},
	JN_PLACEMENT_KEY_ROWS(PointsFileDef, placement.),
	JN_LENGTH_KEY(PointsFileDef, spacing, "distance of neighbouring points"),
	JN_JITTER_KEY_ROWS(PointsFileDef, jitter.),
	{.name = NULL},
};

/// The lattice around the surface, whose middle is that of its bounding box.
static JnStatus lay_out(const JnSurface* surface, double spacing, const char* what, JnLattice* lattice) {
	double total = 1;
	for (int a = 0; a < 3; a++) {
		double low = INFINITY, high = -INFINITY;
		for (int i = 0; i < surface->node_count; i++) {
			low = fmin(low, surface->nodes[3 * (ptrdiff_t)i + a]);
			high = fmax(high, surface->nodes[3 * (ptrdiff_t)i + a]);
		}
		const double count = fmax(1, ceil((high - low) / spacing - 1e-6));
		total *= count;
		lattice->spacing[a] = spacing;
		lattice->low[a] = 0.5 * (low + high) - 0.5 * spacing * count;
		lattice->counts[a] = (int)fmin(count, jn_lattice_most);
	}
	if (total <= jn_lattice_most) return JN_OK;
	return jn_error(JN_BAD_INPUT,
					"%s.spacing: the lattice around the surface has %.3g points, more than %.0g; make it larger than "
					"%.2g m",
					what, total, jn_lattice_most, spacing * cbrt(total / jn_lattice_most));
}

static JnStatus mark_inside(const JnSurface* surface, const JnLattice* lattice, const char* what, JnArena* scratch,
							bool** is_full) {
	const int* n = lattice->counts;
	JnTriangleTree tree;
	JN_TRY(jn_triangle_tree_create(surface, scratch, &tree));
	JN_NEW(scratch, *is_full, (size_t)n[0] * (size_t)n[1] * (size_t)n[2]);
	bool any = false;
	for (ptrdiff_t cell = 0; cell < (ptrdiff_t)n[0] * n[1] * n[2]; cell++) {
		const ptrdiff_t at[3] = {cell % n[0], cell / n[0] % n[1], cell / n[0] / n[1]};
		double x[3];
		for (int a = 0; a < 3; a++) x[a] = lattice->low[a] + lattice->spacing[a] * ((double)at[a] + 0.5);
		(*is_full)[cell] = jn_triangle_tree_is_inside(&tree, x);
		any |= (*is_full)[cell];
	}
	if (any) return JN_OK;
	return jn_error(JN_BAD_INPUT,
					"%s.spacing: no point of a lattice of %g m lies inside the surface; use a smaller one", what,
					lattice->spacing[0]);
}

static JnStatus fill(const PointsFileDef* def, const char* what, JnArena* scratch, JnArena* arena, JnMesh* mesh) {
	const JnFileDef file = {.path = def->path, .placement = def->placement};
	JnFileMesh read;
	JnLattice lattice;
	bool* is_full = NULL;
	JN_TRY(jn_file_mesh(&file, what, scratch, &read));
	if (read.has_volume)
		return jn_error(JN_BAD_INPUT, "%s.path: %s holds cells, not a surface; give a surface to be filled with points",
						what, def->path);
	JN_TRY(jn_surface_check_closed(&read.surface, def->path));
	JN_TRY(lay_out(&read.surface, def->spacing, what, &lattice));
	JN_TRY(mark_inside(&read.surface, &lattice, what, scratch, &is_full));
	return jn_lattice_points(&lattice, is_full, &def->jitter, false, arena, mesh);
}

static JnStatus generate(const void* options, const char* what, JnArena* arena, JnMesh* mesh) {
	JnArena scratch = {0};
	const JnStatus status = fill(options, what, &scratch, arena, mesh);
	jn_arena_free(&scratch);
	return status;
}

const JnShapeType jn_shape_points_file = {
	.row = {"points_file", "Points on a lattice that fill a closed surface from a file, for peridynamic bodies.", keys,
			sizeof(PointsFileDef)},
	.generate = generate,
};
