// Sheets: thin plates, such as a cloth of one layer of hexahedra.
#include <string.h>

#include "mesh/shape/blocks.h"
#include "mesh/shape/shape_keys.h"

typedef struct SheetDef {
	double origin[3], rotate[3];
	double size[2], thickness;
	int cells[2], layers;
	int plane; // 0 xy, 1 xz, 2 yz
	int element;
} SheetDef;

static const char* const planes[] = {"xy", "xz", "yz", NULL};

/// Axes along u, v and across, by plane.
static const int axes[3][3] = {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}};

static void place(const JnBlock* block, const int at[3], double X[3]) {
	const SheetDef* def = block->options;
	const double size[3] = {def->thickness, def->size[0], def->size[1]};
	for (int k = 0; k < 3; ++k) {
		const int axis = axes[def->plane][k > 0 ? k - 1 : 2];
		X[axis] = def->origin[axis] + size[k] * at[k] / block->cells[k];
	}
}

// The nodes that are in a set of both directions.
static JnStatus add_corners(JnArena* arena, JnMesh* mesh) {
	JnNodeSet* sets;
	int *seen, count = 0;
	JN_NEW(arena, sets, mesh->set_count + 1);
	JN_NEW(arena, seen, mesh->node_count);
	for (int s = 0; s < mesh->set_count; ++s) {
		sets[s] = mesh->sets[s];
		for (int i = 0; i < sets[s].count; ++i) count += ++seen[sets[s].nodes[i]] == 2;
	}
	JnNodeSet* corners = &sets[mesh->set_count];
	*corners = (JnNodeSet){.name = "corners"};
	JN_NEW(arena, corners->nodes, count);
	for (int i = 0; i < mesh->node_count; ++i)
		if (seen[i] == 2) corners->nodes[corners->count++] = i;
	mesh->sets = sets;
	++mesh->set_count;
	return JN_OK;
}

// About its middle; bit for bit as it was without turns.
static JnStatus turn(const SheetDef* def, const char* what, JnMesh* mesh) {
	if (def->rotate[0] == 0 && def->rotate[1] == 0 && def->rotate[2] == 0) return JN_OK;
	const double size[3] = {def->size[0], def->size[1], def->thickness};
	JnPlacementDef placement = {.scale = 1};
	memcpy(placement.rotate, def->rotate, sizeof def->rotate);
	for (int k = 0; k < 3; ++k) {
		const int axis = axes[def->plane][k];
		placement.translate[axis] = def->origin[axis] + size[k] / 2;
	}
	for (int k = 0; k < 3 * mesh->node_count; ++k) mesh->nodes[k] -= placement.translate[k % 3];
	return jn_placement_apply(&placement, what, mesh->node_count, mesh->nodes);
}

// Nodes across follow each other, so that threads, which own ranges of nodes, share no more than a row of elements.
static JnStatus generate(const void* options, const char* what, JnArena* arena, JnMesh* mesh) {
	const SheetDef* def = options;
	const JnBlock block = {.cells = {def->layers, def->cells[0], def->cells[1]},
						   .place = place,
						   .options = def,
						   .sets = {NULL, NULL, "left", "right", "lower", "upper"}};
	JN_TRY(jn_blocks_join(1, &block, (JnShape)def->element, what, arena, mesh));
	JN_TRY(add_corners(arena, mesh));
	return turn(def, what, mesh);
}

static const JnKey keys[] = {
	{.name = "plane",
	 .kind = JN_CHOICE,
	 .field = offsetof(SheetDef, plane),
	 .names = planes,
	 .meaning = "the axes along its two edges; it is thick along the third"},
	JN_POSITION_KEY(SheetDef, origin, "corner with the lowest coordinates, before it is turned"),
	JN_ROTATE_KEY(SheetDef),
	{.name = "size",
	 .kind = JN_REAL2,
	 .field = offsetof(SheetDef, size),
	 .high = INFINITY,
	 .open = JN_OPEN_LOW | JN_OPEN_HIGH,
	 .required = true,
	 .unit = "m",
	 .meaning = "edge lengths along the two axes of the plane"},
	JN_LENGTH_KEY(SheetDef, thickness, "edge length across"),
	{.name = "cells",
	 .kind = JN_INTEGER2,
	 .field = offsetof(SheetDef, cells),
	 .low = 1,
	 .high = 4096,
	 .required = true,
	 .meaning = "hexahedra along the two edges"},
	{.name = "layers",
	 .kind = JN_INTEGER,
	 .field = offsetof(SheetDef, layers),
	 .value = {1},
	 .low = 1,
	 .high = 4096,
	 .meaning = "hexahedra across the thickness"},
	JN_ELEMENT_KEY(SheetDef),
	{0},
};

const JnShapeType jn_shape_sheet = {
	.row = {"sheet",
			"A thin plate in a plane of two axes; its edges are the sets left, right (along the first axis), lower, "
			"upper, and its four corners the set corners.",
			keys, sizeof(SheetDef)},
	.generate = generate,
};
