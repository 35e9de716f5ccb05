// An open overhand knot: a loose trefoil whose ends go out straight along x. Between them it is a cubic B-spline, which
// has no jump of curvature. Its control points, turned by half a turn about y, are themselves in reverse order; they were
// chosen by a search for wide bends and wide distances: for a size of 1, no bend has a radius below 0.21, and strands pass
// each other at 0.43 or more.
#include <stddef.h>

#include "mesh/shape/path_rows.h"
#include "mesh/shape/shape_keys.h"

typedef struct OverhandDef {
	double size, tail;
} OverhandDef;

enum { HALF = 10, SPANS = 2 * HALF + 1 - 3 };

static const double span = 2.7; // of the numbers below

// As far as the middle, which lies on the y axis.
static const double half[HALF + 1][3] = {
	{-3.3, 0, 0},       {-2.7, 0, 0},        {-2.1, 0, 0},      {-1.5, 0, 0},
	{-1.12, 0.37, 0.3}, {-0.4, 0.83, -0.32}, {0, -0.33, -1.31}, {0.98, -1.18, 0.55},
	{1.4, 0.23, 1.61},  {0.78, 1.78, 1.1},   {0, 1.75, 0},
};

static double control(int index, int axis) {
	if (index <= HALF) return half[index][axis];
	const double value = half[2 * HALF - index][axis];
	return axis == 1 ? value : -value;
}

static void spline_at(double t, double x[3]) {
	int i = (int)floor(t);
	i = i < 0 ? 0 : i >= SPANS ? SPANS - 1 : i;
	const double s = t - i, r = 1 - s;
	const double weight[4] = {r * r * r / 6, (3 * s * s * s - 6 * s * s + 4) / 6, (3 * r * r * r - 6 * r * r + 4) / 6,
							  s * s * s / 6};
	for (int a = 0; a < 3; ++a) {
		x[a] = 0;
		for (int k = 0; k < 4; ++k) x[a] += weight[k] * control(i + k, a);
	}
}

// Piece 0 and the last one are the tails, which may have no length.
static void overhand_at(const JnPath* path, double u, double x[3]) {
	const OverhandDef* def = path->data;
	const int first = def->tail > 0;
	const double t = u - first, scale = def->size / span;
	const double beyond = t < 0 ? -t : t > SPANS ? t - SPANS : 0;
	spline_at(beyond > 0 && first ? (t < 0 ? 0 : SPANS) : t, x);
	for (int a = 0; a < 3; ++a) x[a] *= scale;
	if (first) x[0] += (t < 0 ? -1 : 1) * beyond * def->tail;
}

static JnStatus trace(const void* options, const char* what, JnArena* arena, JnPath* path) {
	OverhandDef* kept;
	(void)what;
	JN_NEW(arena, kept, 1);
	*kept = *(const OverhandDef*)options;
	path->at = overhand_at;
	path->data = kept;
	path->pieces = SPANS + 2 * (kept->tail > 0);
	return JN_OK;
}

static const JnKey keys[] = {
	JN_LENGTH_KEY(OverhandDef, size,
				  "edge of the cube that the knot fills, about; bends have radii of a fifth of it or more"),
	{.name = "tail",
	 .kind = JN_REAL,
	 .field = offsetof(OverhandDef, tail),
	 .required = true,
	 .low = 0,
	 .high = INFINITY,
	 .open = JN_OPEN_HIGH,
	 .unit = "m",
	 .meaning = "length of each of the two straight ends, along x"},
	{0},
};

const JnPathType jn_path_overhand = {
	.row = {"overhand", "An open, loose overhand knot with straight ends.", keys, sizeof(OverhandDef)},
	.trace = trace,
};
