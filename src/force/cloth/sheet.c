#include "force/cloth/sheet.h"

#include <math.h>
#include <string.h>

#include "base/log.h"
#include "math/vec3.h"
#include "mesh/surface_edges.h"

static void subtract(const double* a, const double* b, double out[3]) {
	for (int i = 0; i < 3; ++i) out[i] = a[i] - b[i];
}

static void find_grain(const JnClothDef* def, const JnMesh* mesh, double grain[3]) {
	memcpy(grain, def->grain, 3 * sizeof *grain);
	if (isnan(grain[0]))
		subtract(mesh->nodes + 3 * (ptrdiff_t)mesh->cells[1], mesh->nodes + 3 * (ptrdiff_t)mesh->cells[0], grain);
	vec3_normalize(grain);
}

// The frame of a triangle: grain laid into its plane, and across.
static JnStatus fill_cell(const JnSheet* sheet, const double grain[3], int index, const char* what, JnSheetCell* cell) {
	const int* nodes = sheet->mesh->cells + 3 * (ptrdiff_t)index;
	double d[2][3], normal[3];
	for (int k = 0; k < 2; ++k) subtract(jn_sheet_node(sheet, nodes[k + 1]), jn_sheet_node(sheet, nodes[0]), d[k]);
	vec3_cross(d[0], d[1], normal);
	cell->area = 0.5 * vec3_length(normal);
	if (!(cell->area > 0) || !isfinite(cell->area))
		return jn_error(JN_BAD_INPUT, "%s: triangle %d of its mesh has the area %g m^2, which must be > 0; remove it",
						what, index, cell->area);
	vec3_normalize(normal);
	vec3_cross(normal, grain, cell->v);
	if (!(vec3_length(cell->v) > 1e-3))
		return jn_error(JN_BAD_INPUT,
						"%s.material.grain: it is across triangle %d of the mesh, where it names no direction of "
						"threads; use one that lies along the surface",
						what, index);
	vec3_normalize(cell->v);
	vec3_cross(cell->v, normal, cell->u);
	return JN_OK;
}

static JnStatus fill_cells(const JnClothDef* def, const char* what, JnArena* arena, JnSheet* sheet) {
	double grain[3];
	find_grain(def, sheet->mesh, grain);
	JN_NEW(arena, sheet->cells, sheet->mesh->cell_count);
	for (int i = 0; i < sheet->mesh->cell_count; ++i) JN_TRY(fill_cell(sheet, grain, i, what, &sheet->cells[i]));
	return JN_OK;
}

// Add a triangle to its edge.
static JnStatus add_side(const JnSheet* sheet, const JnSurface* surface, const JnEdgeSide* side, const char* what,
						 JnSheetEdge* edge) {
	const JnSheetCell* cell = &sheet->cells[side->place / 3];
	const int wing = jn_edge_goes_up(surface, side) ? 0 : 1, corner = (side->place % 3 + 2) % 3;
	if (edge->wings[wing] >= 0)
		return jn_error(JN_BAD_INPUT,
						"%s: the mesh has two triangles on one side of the edge between its nodes %d and %d; a cloth "
						"has one on either side, and all triangles face the same way",
						what, side->low, side->high);
	edge->wings[wing] = surface->triangles[side->place - side->place % 3 + corner];
	edge->area += cell->area;
	double d[3];
	subtract(jn_sheet_node(sheet, side->high), jn_sheet_node(sheet, side->low), d);
	edge->length = vec3_length(d);
	vec3_normalize(d);
	const double share = edge->wings[1 - wing] < 0 ? 1 : 0.5, u = vec3_dot(d, cell->u), v = vec3_dot(d, cell->v);
	edge->along[0] += share * (u * u - edge->along[0]);
	edge->along[1] += share * (v * v - edge->along[1]);
	return JN_OK;
}

static JnStatus fill_edges(const char* what, JnArena* arena, JnSheet* sheet) {
	const JnMesh* mesh = sheet->mesh;
	const JnSurface surface = {.node_count = mesh->node_count,
							   .nodes = mesh->nodes,
							   .triangle_count = mesh->cell_count,
							   .triangles = mesh->cells};
	const int total = 3 * mesh->cell_count;
	JnEdgeSide* sides;
	JN_TRY(jn_surface_edges(&surface, arena, &sides));
	JN_NEW(arena, sheet->edges, total);
	for (int first = 0, count = 0; first < total; first += count) {
		count = jn_edge_side_count(sides, first, total);
		JnSheetEdge* edge = &sheet->edges[sheet->edge_count++];
		*edge = (JnSheetEdge){.nodes = {sides[first].low, sides[first].high}, .wings = {-1, -1}};
		for (int i = first; i < first + count; ++i) JN_TRY(add_side(sheet, &surface, &sides[i], what, edge));
	}
	return JN_OK;
}

JnStatus jn_sheet_create(const JnLaw* law, const JnClothDef* def, const JnMesh* mesh, const char* what, JnArena* arena,
						 JnSheet* sheet) {
	*sheet = (JnSheet){.mesh = mesh};
	if (mesh->shape != JN_TRI3)
		return jn_error(JN_BAD_INPUT,
						"%s.material.law: '%s' is a law of cloth and does not run on %s elements; use `shape: {type: "
						"cloth}`, or a law of solids",
						what, law->row.name, jn_shape_info[mesh->shape].name);
	JN_TRY(fill_cells(def, what, arena, sheet));
	return fill_edges(what, arena, sheet);
}

JnStatus jn_cloth_build(JnClothFill* fill, const JnLaw* law, const void* options, const JnMesh* mesh, int first_node,
						const char* what, JnArena* arena, JnGroups* out) {
	const JnClothDef* def = options;
	JnArena scratch = {0};
	JnSheet sheet;
	*out = (JnGroups){.density = def->density};
	JN_NEW(arena, out->list, 3);
	JnStatus status = jn_sheet_create(law, def, mesh, what, &scratch, &sheet);
	if (status == JN_OK) status = fill(def, &sheet, first_node, &scratch, arena, out);
	jn_arena_free(&scratch);
	return status;
}
