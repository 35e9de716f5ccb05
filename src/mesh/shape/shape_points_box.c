// A box of points on a cubic lattice, or one layer of them: a plate under plane stress.
#include <math.h>
#include <string.h>

#include "base/log.h"
#include "mesh/shape/points.h"
#include "mesh/shape/shape_keys.h"

typedef struct PointsBoxDef {
	double origin[3]; // lowest corner [m]
	double size[3];   // edges [m]
	double spacing;   // [m]; NAN when `counts` is given
	int counts[3];    // points along each axis; 0 when `spacing` is given
	bool layer;
	JnJitterDef jitter;
} PointsBoxDef;

static const JnKey keys[] = {
	JN_POSITION_KEY(PointsBoxDef, origin, "corner with the lowest coordinates"),
	{.name = "size",
	 .kind = JN_REAL3,
	 .field = offsetof(PointsBoxDef, size),
	 .high = INFINITY,
	 .open = JN_OPEN_LOW | JN_OPEN_HIGH,
	 .required = true,
	 .unit = "m",
	 .meaning = "edge lengths along x, y and z; the points fill it, the outermost half a spacing inside"},
	{.name = "spacing",
	 .kind = JN_REAL,
	 .field = offsetof(PointsBoxDef, spacing),
	 .high = INFINITY,
	 .open = JN_OPEN_LOW | JN_OPEN_HIGH,
	 .absent_allowed = true,
	 .unit = "m",
	 .meaning = "distance of neighbouring points, made to fit the edges; or give counts"},
	{.name = "counts",
	 .kind = JN_INTEGER3,
	 .field = offsetof(PointsBoxDef, counts),
	 .low = 0,
	 .high = 100000,
	 .meaning = "points along x, y and z; or give spacing"},
	{.name = "layer",
	 .kind = JN_SWITCH,
	 .field = offsetof(PointsBoxDef, layer),
	 .meaning = "one layer of points, of the thickness size[2] whatever the spacing: a plate under plane stress in the "
				"plane of x and y"},
	JN_JITTER_KEY_ROWS(PointsBoxDef, jitter.),
	{.name = NULL},
};

static JnStatus count_points(const PointsBoxDef* def, const char* what, double counts[3]) {
	const bool has_counts = def->counts[0] != 0 || def->counts[1] != 0 || def->counts[2] != 0;
	if (has_counts != isnan(def->spacing))
		return jn_error(JN_BAD_INPUT, "%s: %s; give exactly one of spacing and counts", what,
						has_counts ? "both spacing and counts are given" : "nothing says how many points there are");
	for (int a = 0; a < 3; a++)
		counts[a] = has_counts ? def->counts[a] : fmax(1, nearbyint(def->size[a] / def->spacing));
	if (def->layer && !has_counts) counts[2] = 1;
	if (def->layer && counts[2] != 1)
		return jn_error(JN_BAD_INPUT, "%s.counts: a layer has one point along z, not %d; leave `layer` out, or give 1",
						what, def->counts[2]);
	for (int a = 0; a < 3; a++)
		if (counts[a] < 1)
			return jn_error(JN_BAD_INPUT, "%s.counts: [%d, %d, %d] has a zero; give at least 1 along each axis", what,
							def->counts[0], def->counts[1], def->counts[2]);
	return JN_OK;
}

static JnStatus generate(const void* options, const char* what, JnArena* arena, JnMesh* mesh) {
	const PointsBoxDef* def = options;
	double counts[3];
	JN_TRY(count_points(def, what, counts));
	const double total = counts[0] * counts[1] * counts[2];
	if (total > jn_lattice_most)
		return jn_error(JN_BAD_INPUT, "%s: %.0f x %.0f x %.0f points are %.3g, more than %.0g; use a larger spacing",
						what, counts[0], counts[1], counts[2], total, jn_lattice_most);
	JnLattice lattice;
	memcpy(lattice.low, def->origin, sizeof lattice.low);
	for (int a = 0; a < 3; a++) {
		lattice.counts[a] = (int)counts[a];
		lattice.spacing[a] = def->size[a] / counts[a];
	}
	return jn_lattice_points(&lattice, NULL, &def->jitter, def->layer, arena, mesh);
}

const JnShapeType jn_shape_points_box = {
	.row = {"points_box", "A box of points on a lattice, for peridynamic bodies.", keys, sizeof(PointsBoxDef)},
	.generate = generate,
};
