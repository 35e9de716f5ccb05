// Balls: a cube with bulging faces inside six shells that lead to the sphere (a cubed sphere: the sphere is divided at
// equal angles, Ronchi, Iacono, Paolucci 1996).
#include "mesh/shape/blocks.h"
#include "mesh/shape/shape_keys.h"

enum { BALL_BLOCKS = 7, CUBE = 0 };

typedef struct BallDef {
	double center[3];
	double radius;
	int cells, rings;
	int element;
} BallDef;

static const double quarter_pi = 0.78539816339744830962;
static const double CORE = 0.55; // corners of the cube lie at this share of the radius
static const double BULGE = 0.6; // of its faces: 0 flat, 1 parts of a sphere

/// Point of the unit sphere in the direction of q, whose largest component has size `reach` > 0.
static void sphere_point(const double q[3], double reach, double p[3]) {
	for (int axis = 0; axis < 3; ++axis) p[axis] = tan(quarter_pi * q[axis] / reach);
	const double length = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
	for (int axis = 0; axis < 3; ++axis) p[axis] /= length;
}

/// q in [-1, 1]^3, blended from a cube and a ball, both with corners at distance CORE.
static void core_point(const double q[3], double p[3]) {
	const double reach = fmax(fabs(q[0]), fmax(fabs(q[1]), fabs(q[2])));
	double round[3] = {0, 0, 0};
	if (reach > 0) sphere_point(q, reach, round);
	for (int axis = 0; axis < 3; ++axis)
		p[axis] = CORE * ((1 - BULGE) * sqrt(1.0 / 3) * q[axis] + BULGE * reach * round[axis]);
}

static void shell_point(int side, double u, double v, double w, double p[3]) {
	const int axis = side / 2;
	double q[3], inner[3], outer[3];
	q[axis] = side % 2 == 0 ? -1 : 1;
	q[(axis + 1) % 3] = 2 * v - 1;
	q[(axis + 2) % 3] = 2 * w - 1;
	core_point(q, inner);
	sphere_point(q, 1, outer);
	for (int k = 0; k < 3; ++k) p[k] = (1 - u) * inner[k] + u * outer[k];
}

static void place(const JnBlock* block, const int at[3], double X[3]) {
	const BallDef* def = block->options;
	const double u = (double)at[0] / block->cells[0], v = (double)at[1] / block->cells[1],
				 w = (double)at[2] / block->cells[2];
	double p[3];
	if (block->part == CUBE)
		core_point((double[3]){2 * u - 1, 2 * v - 1, 2 * w - 1}, p);
	else
		shell_point(block->part - 1, u, v, w, p);
	for (int axis = 0; axis < 3; ++axis) X[axis] = def->center[axis] + def->radius * p[axis];
}

static JnStatus generate(const void* options, const char* what, JnArena* arena, JnMesh* mesh) {
	const BallDef* def = options;
	JnBlock blocks[BALL_BLOCKS];
	for (int i = 0; i < BALL_BLOCKS; ++i)
		blocks[i] = (JnBlock){.cells = {i == CUBE ? def->cells : def->rings, def->cells, def->cells},
							  .place = place,
							  .options = def,
							  .part = i,
							  .sets = {[1] = i == CUBE ? NULL : "surface"}};
	return jn_blocks_join(BALL_BLOCKS, blocks, (JnShape)def->element, what, arena, mesh);
}

static const JnKey keys[] = {
	JN_POSITION_KEY(BallDef, center, "its middle"),
	JN_LENGTH_KEY(BallDef, radius, "half its diameter"),
	{.name = "cells",
	 .kind = JN_INTEGER,
	 .field = offsetof(BallDef, cells),
	 .value = {4},
	 .low = 1,
	 .high = 512,
	 .meaning = "hexahedra along each edge of the cube inside; four times as many go around"},
	{.name = "rings",
	 .kind = JN_INTEGER,
	 .field = offsetof(BallDef, rings),
	 .value = {2},
	 .low = 1,
	 .high = 512,
	 .meaning = "layers of hexahedra between the cube and the sphere"},
	JN_ELEMENT_KEY(BallDef),
	{0},
};

const JnShapeType jn_shape_ball = {
	.row = {"ball", "A solid ball; the nodes of its sphere are the set surface.", keys, sizeof(BallDef)},
	.generate = generate,
};
