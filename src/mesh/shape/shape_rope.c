// Ropes: a disk of quadrilaterals swept along a curve through points.
#include "base/log.h"
#include "mesh/shape/curve.h"
#include "mesh/shape/disk.h"
#include "mesh/shape/shape_keys.h"

typedef struct RopePointDef {
	double at[3];
} RopePointDef;

typedef struct RopeDef {
	JnItems points; // RopePointDef
	double radius;
	int cells[3]; // around, rings, along
	int element;
} RopeDef;

/// What its blocks see.
typedef struct Rope {
	double radius;
	const JnStation* stations; // cells[2] + 1
} Rope;

static void place(const JnBlock* block, const int at[3], double X[3]) {
	const Rope* rope = block->options;
	const JnStation* s = &rope->stations[at[2]];
	double p[2];
	jn_disk_point(block->part, (double)at[0] / block->cells[0], (double)at[1] / block->cells[1], p);
	for (int axis = 0; axis < 3; ++axis)
		X[axis] = s->X[axis] + rope->radius * (p[0] * s->across[0][axis] + p[1] * s->across[1][axis]);
}

static double distance(const double a[3], const double b[3]) {
	return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

static JnStatus check_points(const RopeDef* def, const char* what) {
	const RopePointDef* points = def->points.data;
	if (def->points.count < 2)
		return jn_error(JN_BAD_INPUT, "%s.points: %d points make no rope; give two or more", what, def->points.count);
	for (int i = 1; i < def->points.count; ++i)
		if (!(distance(points[i].at, points[i - 1].at) > 1e-3 * def->radius))
			return jn_error(JN_BAD_INPUT, "%s.points[%d]: lies at the point before it; leave it out", what, i);
	return JN_OK;
}

/// Where the curve bends by an angle over a distance, its inner side is shorter by radius * angle.
static JnStatus check_bends(const RopeDef* def, const JnStation* stations, const char* what) {
	for (int i = 1; i <= def->cells[2]; ++i) {
		const double chord = distance(stations[i].X, stations[i - 1].X);
		const double angle = distance(stations[i].along, stations[i - 1].along);
		if (def->radius * angle < 0.9 * chord) continue;
		const double* X = stations[i].X;
		return jn_error(
			JN_BAD_INPUT,
			"%s.points: near [%g, %g, %g] m the curve bends with a radius of %g m, too sharply for a rope of "
			"radius %g m; move the points or make it thinner",
			what, X[0], X[1], X[2], chord / angle, def->radius);
	}
	return JN_OK;
}

static JnStatus sweep(const RopeDef* def, const JnStation* stations, const char* what, JnArena* arena, JnMesh* mesh) {
	const Rope rope = {.radius = def->radius, .stations = stations};
	JnBlock blocks[JN_DISK_PATCHES];
	for (int i = 0; i < JN_DISK_PATCHES; ++i) {
		blocks[i] = (JnBlock){.place = place, .options = &rope, .part = i, .sets = {[4] = "start", "end"}};
		jn_disk_cells(i, def->cells[0], def->cells[1], blocks[i].cells);
		blocks[i].cells[2] = def->cells[2];
	}
	return jn_blocks_join(JN_DISK_PATCHES, blocks, (JnShape)def->element, what, arena, mesh);
}

static JnStatus generate_with(const RopeDef* def, const char* what, JnArena* scratch, JnArena* arena, JnMesh* mesh) {
	JnStation* stations;
	JN_NEW(scratch, stations, def->cells[2] + 1);
	const double* points = (const double*)def->points.data; // a RopePointDef is its three numbers
	JN_TRY(jn_curve_stations(def->points.count, points, def->cells[2] + 1, stations, scratch));
	JN_TRY(check_bends(def, stations, what));
	return sweep(def, stations, what, arena, mesh);
}

static JnStatus generate(const void* options, const char* what, JnArena* arena, JnMesh* mesh) {
	const RopeDef* def = options;
	JnArena scratch = {0};
	JN_TRY(jn_disk_check(def->cells[0], what));
	JN_TRY(check_points(def, what));
	const JnStatus status = generate_with(def, what, &scratch, arena, mesh);
	jn_arena_free(&scratch);
	return status;
}

static const JnKey point_keys[] = {
	{.name = "at",
	 .kind = JN_REAL3,
	 .field = offsetof(RopePointDef, at),
	 .required = true,
	 .unit = "m",
	 .meaning = "where it passes"},
	{0},
};

static const JnKey keys[] = {
	{.name = "points",
	 .kind = JN_LIST,
	 .field = offsetof(RopeDef, points),
	 .required = true,
	 .keys = point_keys,
	 .size = sizeof(RopePointDef),
	 .meaning = "two or more; a smooth curve goes through all of them"},
	JN_LENGTH_KEY(RopeDef, radius, "half its thickness"),
	JN_DISK_CELLS_KEY(RopeDef, 8, 1, 40,
					  "hexahedra around (a multiple of 4), in rings about its square core, and along its length"),
	JN_ELEMENT_KEY(RopeDef),
	{0},
};

const JnShapeType jn_shape_rope = {
	.row = {"rope", "A round rope along a curve; its ends are the sets start and end.", keys, sizeof(RopeDef)},
	.generate = generate,
};
