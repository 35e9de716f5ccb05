// A flat sheet of triangles without thickness. In each of them the edge from node 0 to node 1 runs along the first axis.
//
//   d----c    diagonal a-c: (a b c) (c d a)        alternating: neighbouring squares are cut along different diagonals
//   |    |    diagonal b-d: (a b d) (c d b)        regular: all along a-c
//   a----b
#include <string.h>

#include "mesh/shape/shape_keys.h"

typedef struct ClothDef {
	double origin[3], rotate[3];
	double size[2];
	int cells[2];
	int plane; // 0 xy, 1 xz, 2 yz
	int pattern;
} ClothDef;

enum { ALTERNATING, REGULAR };

static const char* const planes[] = {"xy", "xz", "yz", NULL};
static const char* const patterns[] = {"alternating", "regular", NULL};

/// Axes along u, v and across, by plane.
static const int axes[3][3] = {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}};

static void place_nodes(const ClothDef* def, JnMesh* mesh) {
	const int row = def->cells[0] + 1;
	for (int node = 0; node < mesh->node_count; ++node) {
		const int at[2] = {node % row, node / row};
		double* X = mesh->nodes + 3 * (size_t)node;
		for (int a = 0; a < 3; ++a) X[a] = def->origin[a];
		for (int k = 0; k < 2; ++k) X[axes[def->plane][k]] += def->size[k] * at[k] / def->cells[k];
	}
}

static void cut_squares(const ClothDef* def, JnMesh* mesh) {
	const int row = def->cells[0] + 1;
	int* cell = mesh->cells;
	for (int j = 0; j < def->cells[1]; ++j)
		for (int i = 0; i < def->cells[0]; ++i, cell += 6) {
			const int a = j * row + i, b = a + 1, c = b + row, d = a + row;
			const bool falls = def->pattern == ALTERNATING && (i + j) % 2 == 1;
			const int triangles[6] = {a, b, falls ? d : c, c, d, falls ? b : a};
			memcpy(cell, triangles, sizeof triangles);
		}
}

// Bits of the edges that a node is on: left, right, lower, upper.
static int edges_of(const ClothDef* def, int node) {
	const int i = node % (def->cells[0] + 1), j = node / (def->cells[0] + 1);
	return (i == 0) | (i == def->cells[0]) << 1 | (j == 0) << 2 | (j == def->cells[1]) << 3;
}

static JnStatus put_sets(const ClothDef* def, JnArena* arena, JnMesh* mesh) {
	static const char* const names[] = {"left", "right", "lower", "upper", "corners"};
	mesh->set_count = sizeof names / sizeof *names;
	JN_NEW(arena, mesh->sets, mesh->set_count);
	for (int s = 0; s < mesh->set_count; ++s) {
		JnNodeSet* set = &mesh->sets[s];
		set->name = names[s];
		JN_NEW(arena, set->nodes, 2 + def->cells[0] + def->cells[1]);
		for (int node = 0; node < mesh->node_count; ++node) {
			const int edges = edges_of(def, node);
			const bool is_corner = (edges & 3) != 0 && (edges & 12) != 0;
			if (s < 4 ? (edges >> s & 1) != 0 : is_corner) set->nodes[set->count++] = node;
		}
	}
	return JN_OK;
}

// About its middle.
static JnStatus turn(const ClothDef* def, const char* what, JnMesh* mesh) {
	if (def->rotate[0] == 0 && def->rotate[1] == 0 && def->rotate[2] == 0) return JN_OK;
	JnPlacementDef placement = {.scale = 1};
	memcpy(placement.rotate, def->rotate, sizeof def->rotate);
	memcpy(placement.translate, def->origin, sizeof def->origin);
	for (int k = 0; k < 2; ++k) placement.translate[axes[def->plane][k]] += def->size[k] / 2;
	for (int k = 0; k < 3 * mesh->node_count; ++k) mesh->nodes[k] -= placement.translate[k % 3];
	return jn_placement_apply(&placement, what, mesh->node_count, mesh->nodes);
}

static JnStatus generate(const void* options, const char* what, JnArena* arena, JnMesh* mesh) {
	const ClothDef* def = options;
	*mesh = (JnMesh){.shape = JN_TRI3,
					 .node_count = (def->cells[0] + 1) * (def->cells[1] + 1),
					 .cell_count = 2 * def->cells[0] * def->cells[1]};
	JN_NEW(arena, mesh->nodes, 3 * (size_t)mesh->node_count);
	JN_NEW(arena, mesh->cells, 3 * (size_t)mesh->cell_count);
	place_nodes(def, mesh);
	cut_squares(def, mesh);
	JN_TRY(put_sets(def, arena, mesh));
	return turn(def, what, mesh);
}

static const JnKey keys[] = {
	{.name = "plane",
	 .kind = JN_CHOICE,
	 .field = offsetof(ClothDef, plane),
	 .names = planes,
	 .meaning = "the axes along its two edges"},
	JN_POSITION_KEY(ClothDef, origin, "corner with the lowest coordinates, before it is turned"),
	JN_ROTATE_KEY(ClothDef),
	{.name = "size",
	 .kind = JN_REAL2,
	 .field = offsetof(ClothDef, size),
	 .high = INFINITY,
	 .open = JN_OPEN_LOW | JN_OPEN_HIGH,
	 .required = true,
	 .unit = "m",
	 .meaning = "edge lengths along the two axes of the plane"},
	{.name = "cells",
	 .kind = JN_INTEGER2,
	 .field = offsetof(ClothDef, cells),
	 .low = 1,
	 .high = 4096,
	 .required = true,
	 .meaning = "squares along the two edges, two triangles each"},
	{.name = "pattern",
	 .kind = JN_CHOICE,
	 .field = offsetof(ClothDef, pattern),
	 .names = patterns,
	 .meaning =
		 "diagonals along which the squares are cut: alternating, which favours no direction; regular, all alike"},
	{0},
};

const JnShapeType jn_shape_cloth = {
	.row = {"cloth",
			"A flat sheet of triangles without thickness, for mass_spring and membrane; its edges are the sets left, "
			"right (along the first axis), lower, upper, and its four corners the set corners.",
			keys, sizeof(ClothDef)},
	.generate = generate,
};
