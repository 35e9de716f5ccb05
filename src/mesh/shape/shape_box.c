// Boxes: a grid of hexahedra, or each of them cut into six tetrahedra along its main diagonal (Kuhn), one for each order
// of walking from its lowest to its highest corner along the axes. All neighbours cut their common face alike.
//
// Nodes stand on a grid. That of tet10 is twice as fine: each of its points is a corner (all indices even) or the middle
// of exactly one edge.
#include "mesh/shape/shape.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "base/log.h"

static const double MOST_CELLS = 2e7;

/// Steps of the walks, for even orders first; the odd ones exchange two nodes to keep their volume positive.
static const int walks[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
static const int edges[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};

/// Grid points along each axis, and how many grid intervals make a hexahedron.
typedef struct Grid {
	int points[3];
	int refine;
} Grid;

static int grid_node(const Grid* grid, const int at[3]) {
	return (at[2] * grid->points[1] + at[1]) * grid->points[0] + at[0];
}

static void place_nodes(const JnBoxDef* def, const Grid* grid, JnMesh* mesh) {
	for (int node = 0; node < mesh->node_count; node++) {
		const int at[3] = {node % grid->points[0], node / grid->points[0] % grid->points[1],
						   node / grid->points[0] / grid->points[1]};
		for (int a = 0; a < 3; a++) {
			mesh->nodes[3 * (ptrdiff_t)node + a] = def->origin[a] + def->size[a] * at[a] / (grid->points[a] - 1);
		}
	}
}

/// The hexahedron whose lowest corner is `low` in units of hexahedra.
static int* put_hex(const Grid* grid, const int low[3], int* cells) {
	for (int i = 0; i < 8; i++) {
		const int at[3] = {low[0] + jn_hex_corner[i][0], low[1] + jn_hex_corner[i][1], low[2] + jn_hex_corner[i][2]};
		*cells++ = grid_node(grid, at);
	}
	return cells;
}

/// Six tetrahedra in place of a hexahedron, with mid-edge nodes when the grid is refined.
static int* put_tets(const Grid* grid, const int low[3], int* cells) {
	for (int tet = 0; tet < 6; tet++) {
		int corners[4][3];
		for (int a = 0; a < 3; a++) corners[0][a] = low[a] * grid->refine;
		for (int step = 0; step < 3; step++) {
			memcpy(corners[step + 1], corners[step], sizeof corners[step]);
			corners[step + 1][walks[tet][step]] += grid->refine;
		}
		const int order[4] = {0, tet < 3 ? 1 : 2, tet < 3 ? 2 : 1, 3};
		for (int i = 0; i < 4; i++) *cells++ = grid_node(grid, corners[order[i]]);
		for (int e = 0; e < 6 && grid->refine == 2; e++) {
			const int *p = corners[order[edges[e][0]]], *q = corners[order[edges[e][1]]];
			const int middle[3] = {(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2};
			*cells++ = grid_node(grid, middle);
		}
	}
	return cells;
}

static void put_cells(const JnBoxDef* def, const Grid* grid, JnMesh* mesh) {
	int* cells = mesh->cells;
	for (int k = 0; k < def->cells[2]; k++) {
		for (int j = 0; j < def->cells[1]; j++) {
			for (int i = 0; i < def->cells[0]; i++) {
				const int low[3] = {i, j, k};
				cells = mesh->shape == JN_HEX8 ? put_hex(grid, low, cells) : put_tets(grid, low, cells);
			}
		}
	}
}

static JnStatus generate(const JnBoxDef* def, const char* what, JnArena* arena, JnMesh* mesh) {
	const int cells_a_hex = def->element == JN_HEX8 ? 1 : 6;
	const double cells = (double)def->cells[0] * def->cells[1] * def->cells[2] * cells_a_hex;
	if (cells > MOST_CELLS) {
		return jn_error(
			JN_BAD_INPUT, "%s.cells: %d x %d x %d hexahedra are %.3g cells of %s, more than %.0g; use fewer", what,
			def->cells[0], def->cells[1], def->cells[2], cells, jn_shape_info[def->element].name, MOST_CELLS);
	}
	Grid grid = {.refine = def->element == JN_TET10 ? 2 : 1};
	for (int a = 0; a < 3; a++) grid.points[a] = def->cells[a] * grid.refine + 1;
	*mesh = (JnMesh){.shape = (JnShape)def->element,
					 .node_count = grid.points[0] * grid.points[1] * grid.points[2],
					 .cell_count = (int)cells};
	JN_NEW(arena, mesh->nodes, 3 * (size_t)mesh->node_count);
	JN_NEW(arena, mesh->cells, (size_t)mesh->cell_count * jn_shape_info[mesh->shape].nodes);
	place_nodes(def, &grid, mesh);
	put_cells(def, &grid, mesh);
	return JN_OK;
}

JnStatus jn_generate_box(const JnBoxDef* def, JnArena* arena, JnMesh* mesh) {
	return generate(def, "box", arena, mesh);
}

static const char* const element_names[] = {[JN_TET4] = "tet4", [JN_TET10] = "tet10", [JN_HEX8] = "hex8", NULL};

static const JnKey box_keys[] = {
	{.name = "origin",
	 .kind = JN_REAL3,
	 .field = offsetof(JnBoxDef, origin),
	 .unit = "m",
	 .meaning = "corner with the lowest coordinates"},
	{.name = "size",
	 .kind = JN_REAL3,
	 .field = offsetof(JnBoxDef, size),
	 .high = INFINITY,
	 .open = JN_OPEN_LOW | JN_OPEN_HIGH,
	 .required = true,
	 .unit = "m",
	 .meaning = "edge lengths along x, y and z"},
	{.name = "cells",
	 .kind = JN_INTEGER3,
	 .field = offsetof(JnBoxDef, cells),
	 .low = 1,
	 .high = 4096,
	 .required = true,
	 .meaning = "hexahedra along x, y and z; each is six tetrahedra for tet4 and tet10"},
	{.name = "element",
	 .kind = JN_CHOICE,
	 .field = offsetof(JnBoxDef, element),
	 .value = {JN_HEX8},
	 .names = element_names,
	 .meaning = "shape of the cells"},
	{.name = NULL},
};

static JnStatus generate_box(const void* options, const char* what, JnArena* arena, JnMesh* mesh) {
	return generate(options, what, arena, mesh);
}

const JnShapeType jn_shape_box = {
	.row = {"box", "A box along the axes.", box_keys, sizeof(JnBoxDef)},
	.generate = generate_box,
};
