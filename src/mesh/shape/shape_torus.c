// Tori: a disk of quadrilaterals swept around an axis.
#include "base/log.h"
#include "mesh/shape/disk.h"
#include "mesh/shape/shape_keys.h"

typedef struct TorusDef {
	double center[3];
	double major, minor;
	int axis;
	int cells[3]; // around the tube, rings, along the ring
	int element;
} TorusDef;

static const double two_pi = 6.28318530717958647692;

static void place(const JnBlock* block, const int at[3], double X[3]) {
	const TorusDef* def = block->options;
	const double angle = two_pi * (at[2] % block->cells[2]) / block->cells[2]; // the end is the start
	double p[2];
	jn_disk_point(block->part, (double)at[0] / block->cells[0], (double)at[1] / block->cells[1], p);
	const double distance = def->major + def->minor * p[0];
	const double across[2] = {distance * cos(angle), distance * sin(angle)};
	jn_shape_orient(def->axis, def->center, across, def->minor * p[1], X);
}

static JnStatus check(const TorusDef* def, const char* what) {
	JN_TRY(jn_disk_check(def->cells[0], what));
	if (def->cells[2] < 3)
		return jn_error(JN_BAD_INPUT, "%s.cells[2]: %d hexahedra make no ring; use 3 or more", what, def->cells[2]);
	if (def->minor < def->major) return JN_OK;
	return jn_error(JN_BAD_INPUT, "%s.minor: %g m fills the hole of a ring of radius %g m; make it smaller than major",
					what, def->minor, def->major);
}

static JnStatus generate(const void* options, const char* what, JnArena* arena, JnMesh* mesh) {
	const TorusDef* def = options;
	JnBlock blocks[JN_DISK_PATCHES];
	JN_TRY(check(def, what));
	for (int i = 0; i < JN_DISK_PATCHES; ++i) {
		blocks[i] = (JnBlock){.place = place, .options = def, .part = i};
		jn_disk_cells(i, def->cells[0], def->cells[1], blocks[i].cells);
		blocks[i].cells[2] = def->cells[2];
	}
	return jn_blocks_join(JN_DISK_PATCHES, blocks, (JnShape)def->element, what, arena, mesh);
}

static const JnKey keys[] = {
	JN_POSITION_KEY(TorusDef, center, "its middle"),
	JN_LENGTH_KEY(TorusDef, major, "radius of the ring, from the axis to the middle of the tube"),
	JN_LENGTH_KEY(TorusDef, minor, "radius of the tube"),
	JN_AXIS_KEY(TorusDef, "the axis that it turns about"),
	JN_DISK_CELLS_KEY(
		TorusDef, 16, 2, 32,
		"hexahedra around the tube (a multiple of 4), in rings about its square core, and along the ring"),
	JN_ELEMENT_KEY(TorusDef),
	{0},
};

const JnShapeType jn_shape_torus = {
	.row = {"torus", "A ring with a round cross-section.", keys, sizeof(TorusDef)},
	.generate = generate,
};
