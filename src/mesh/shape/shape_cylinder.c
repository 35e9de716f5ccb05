// Cylinders: a disk of quadrilaterals swept along an axis.
#include "mesh/shape/disk.h"
#include "mesh/shape/shape_keys.h"

typedef struct CylinderDef {
	double origin[3];
	double radius, length;
	int axis;
	int cells[3]; // around, rings, along
	int element;
} CylinderDef;

static void place(const JnBlock* block, const int at[3], double X[3]) {
	const CylinderDef* def = block->options;
	double p[2];
	jn_disk_point(block->part, (double)at[0] / block->cells[0], (double)at[1] / block->cells[1], p);
	p[0] *= def->radius;
	p[1] *= def->radius;
	jn_shape_orient(def->axis, def->origin, p, def->length * at[2] / block->cells[2], X);
}

static JnStatus generate(const void* options, const char* what, JnArena* arena, JnMesh* mesh) {
	const CylinderDef* def = options;
	JnBlock blocks[JN_DISK_PATCHES];
	JN_TRY(jn_disk_check(def->cells[0], what));
	for (int i = 0; i < JN_DISK_PATCHES; ++i) {
		blocks[i] = (JnBlock){.place = place, .options = def, .part = i, .sets = {[4] = "bottom", "top"}};
		jn_disk_cells(i, def->cells[0], def->cells[1], blocks[i].cells);
		blocks[i].cells[2] = def->cells[2];
	}
	return jn_blocks_join(JN_DISK_PATCHES, blocks, (JnShape)def->element, what, arena, mesh);
}

static const JnKey keys[] = {
	JN_POSITION_KEY(CylinderDef, origin, "middle of its bottom"),
	JN_LENGTH_KEY(CylinderDef, radius, "radius of its circle"),
	JN_LENGTH_KEY(CylinderDef, length, "from bottom to top"),
	JN_AXIS_KEY(CylinderDef, "direction from bottom to top"),
	JN_DISK_CELLS_KEY(CylinderDef, 16, 2, 8,
					  "hexahedra around the circle (a multiple of 4), in rings about a square core, and along"),
	JN_ELEMENT_KEY(CylinderDef),
	{0},
};

const JnShapeType jn_shape_cylinder = {
	.row = {"cylinder", "A cylinder along an axis; its ends are the sets bottom and top.", keys, sizeof(CylinderDef)},
	.generate = generate,
};
