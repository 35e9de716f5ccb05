// A jello from a fluted mould, on a plate (Loeschner et al. 2020, figure 5). Both are one mesh: the plate is meant to be
// driven or fixed by its set.
//
//   disk point p at distance q <= 1 and angle a, height t in [0, 1]:
//     radius (1 - (1 - taper) t) (1 + flute_depth q^2 cos(flutes a)) (1 - s q^2 t^4) p   across
//     height t (1 - s q^4)                                                              up,   s = 0.1 rounding
#include "base/log.h"
#include "mesh/shape/disk.h"
#include "mesh/shape/shape_keys.h"

enum { RING_PARTS = 4, JELLO_BLOCKS = 2 * JN_DISK_PATCHES + RING_PARTS };

typedef struct JelloDef {
	double origin[3];
	double height, radius, taper;
	int flutes;
	double flute_depth, rounding;
	double plate_radius, plate_thickness;
	int cells[3]; // around, rings, up
	int element;
} JelloDef;

/// Point of the jello's disk at height t, as coordinates X.
static void mould(const JelloDef* def, const double p[2], double t, double X[3]) {
	const double square = p[0] * p[0] + p[1] * p[1];
	const double soft = 0.1 * def->rounding;
	const double flute = 1 + def->flute_depth * square * cos(def->flutes * atan2(p[1], p[0]));
	const double edge = 1 - soft * square * t * t * t * t;
	const double scale = def->radius * (1 - (1 - def->taper) * t) * flute * edge;
	const double across[2] = {scale * p[0], scale * p[1]};
	jn_shape_orient(1, def->origin, across, def->height * t * (1 - soft * square * square), X);
}

static void place_jello(const JnBlock* block, const int at[3], double X[3]) {
	double p[2];
	jn_disk_point(block->part, (double)at[0] / block->cells[0], (double)at[1] / block->cells[1], p);
	mould(block->options, p, (double)at[2] / block->cells[2], X);
}

/// The plate under the jello.
static void place_under(const JnBlock* block, const int at[3], double X[3]) {
	const JelloDef* def = block->options;
	double p[2];
	jn_disk_point(block->part, (double)at[0] / block->cells[0], (double)at[1] / block->cells[1], p);
	mould(def, p, 0, X);
	X[1] -= def->plate_thickness * at[2] / block->cells[2];
}

/// The plate around the jello: from its fluted foot to the circle.
static void place_rim(const JnBlock* block, const int at[3], double X[3]) {
	const JelloDef* def = block->options;
	const double u = (double)at[0] / block->cells[0];
	double p[2], foot[3], rim[3];
	jn_disk_point(block->part, 1, (double)at[1] / block->cells[1], p);
	mould(def, p, 0, foot);
	p[0] *= def->plate_radius;
	p[1] *= def->plate_radius;
	jn_shape_orient(1, def->origin, p, 0, rim);
	for (int axis = 0; axis < 3; ++axis) X[axis] = (1 - u) * foot[axis] + u * rim[axis];
	X[1] -= def->plate_thickness * at[2] / block->cells[2];
}

static const double most_rim_cells = 1000; // along the radius of the plate

static double cell_width(const JelloDef* def) {
	return 6.28 * def->radius / def->cells[0];
}

static double rim_cells(const JelloDef* def) {
	return fmax(1, round((def->plate_radius - def->radius) / (2 * cell_width(def))));
}

static JnStatus check(const JelloDef* def, const char* what) {
	JN_TRY(jn_disk_check(def->cells[0], what));
	const double foot = def->radius * (1 + def->flute_depth);
	if (!(def->plate_radius > foot))
		return jn_error(JN_BAD_INPUT,
						"%s.plate_radius: %g m does not reach beyond the foot of the jello; use more than %g m", what,
						def->plate_radius, foot);
	if (rim_cells(def) > most_rim_cells)
		return jn_error(
			JN_BAD_INPUT,
			"%s.plate_radius: %g m is %.3g cells beyond the jello, of the size of those at its foot; use %g m "
			"or less",
			what, def->plate_radius, rim_cells(def), def->radius + 2 * most_rim_cells * cell_width(def));
	if (def->flute_depth == 0 || def->cells[0] >= 4 * def->flutes) return JN_OK;
	return jn_error(JN_BAD_INPUT, "%s.cells[0]: %d cells around cannot show %d flutes; use %d or more", what,
					def->cells[0], def->flutes, 4 * def->flutes);
}

static void fill_blocks(const JelloDef* def, JnBlock blocks[JELLO_BLOCKS]) {
	const int outer = (int)rim_cells(def);
	for (int i = 0; i < JELLO_BLOCKS; ++i) {
		const bool is_jello = i < JN_DISK_PATCHES, is_rim = i >= 2 * JN_DISK_PATCHES;
		JnBlock* block = &blocks[i];
		*block = (JnBlock){.options = def, .part = is_rim ? i - 2 * JN_DISK_PATCHES + 1 : i % JN_DISK_PATCHES};
		block->place = is_jello ? place_jello : is_rim ? place_rim : place_under;
		jn_disk_cells(block->part, def->cells[0], is_rim ? outer : def->cells[1], block->cells);
		block->cells[2] = is_jello ? def->cells[2] : 1;
		block->sets[4] = is_jello ? "bottom" : NULL;
		block->sets[5] = is_jello ? "top" : NULL;
		block->sets[JN_BLOCK_WHOLE] = is_jello ? NULL : "plate";
	}
}

static JnStatus generate(const void* options, const char* what, JnArena* arena, JnMesh* mesh) {
	const JelloDef* def = options;
	JnBlock blocks[JELLO_BLOCKS];
	JN_TRY(check(def, what));
	fill_blocks(def, blocks);
	return jn_blocks_join(JELLO_BLOCKS, blocks, (JnShape)def->element, what, arena, mesh);
}

#define LENGTH(field_name, metres, text)                                                                               \
	{                                                                                                                  \
		.name = #field_name, .kind = JN_REAL, .field = offsetof(JelloDef, field_name), .value = {metres},              \
		.high = INFINITY, .open = JN_OPEN_LOW | JN_OPEN_HIGH, .unit = "m", .meaning = (text)                           \
	}

#define SHARE(field_name, share, most, text)                                                                           \
	{                                                                                                                  \
		.name = #field_name, .kind = JN_REAL, .field = offsetof(JelloDef, field_name), .value = {share},               \
		.high = (most), .meaning = (text)                                                                              \
	}

static const JnKey keys[] = {
	JN_POSITION_KEY(JelloDef, origin, "middle of the jello's foot, on the plate; the jello stands along y"),
	LENGTH(height, 1, "of the jello, without the plate"),
	LENGTH(radius, 0.75, "of its foot, the mean over its flutes"),
	{.name = "taper",
	 .kind = JN_REAL,
	 .field = offsetof(JelloDef, taper),
	 .value = {0.7},
	 .low = 0.4,
	 .high = 1.5,
	 .meaning = "radius at the top over radius at the foot"},
	{.name = "flutes",
	 .kind = JN_INTEGER,
	 .field = offsetof(JelloDef, flutes),
	 .value = {8},
	 .low = 1,
	 .high = 64,
	 .meaning = "waves around its side"},
	SHARE(flute_depth, 0.09, 0.2, "height of the waves, a share of the radius"),
	SHARE(rounding, 0.9, 1, "how soft its upper edge is: 0 sharp, 1 round"),
	LENGTH(plate_radius, 1.15, "of the plate"),
	LENGTH(plate_thickness, 0.08, "of the plate, which lies below the origin"),
	JN_DISK_CELLS_KEY(
		JelloDef, 48, 4, 8,
		"hexahedra around the jello (a multiple of 4, six a flute look round), in rings about its square core, and "
		"upwards; the plate has one layer"),
	JN_ELEMENT_KEY(JelloDef),
	{0},
};

const JnShapeType jn_shape_jello = {
	.row = {"jello",
			"A jello from a fluted mould, grown together with its plate; sets plate (with the jello's foot), bottom "
			"and top.",
			keys, sizeof(JelloDef)},
	.generate = generate,
};
