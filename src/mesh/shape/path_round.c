// Curves by sines and cosines, about an axis through their origin.
//   helix       (r cos a, r sin a, pitch a / 2 pi)
//   torus knot  ((R + r cos q a) cos p a, (R + r cos q a) sin p a, r sin q a)      p times round the axis, q round the tube
#include <stddef.h>

#include "base/log.h"
#include "mesh/shape/path_rows.h"
#include "mesh/shape/shape_keys.h"

static const double pi = 3.14159265358979323846;

typedef struct HelixDef {
	double radius, pitch, turns, start;
	int axis;
} HelixDef;

typedef struct CircleDef {
	double radius, angle, start;
	int axis;
} CircleDef;

typedef struct KnotDef {
	int p, q;
	double ring, tube;
	int axis;
} KnotDef;

/// Both helix and circle: from `start`, `angle` over all pieces.
typedef struct Arc {
	double radius, start, angle, rise; // rise: a radian [m]
	int axis;
} Arc;

static void arc_at(const JnPath* path, double u, double x[3]) {
	const Arc* arc = path->data;
	const double turned = arc->angle * u / path->pieces, a = arc->start + turned;
	static const double center[3] = {0};
	jn_shape_orient(arc->axis, center, (double[2]){arc->radius * cos(a), arc->radius * sin(a)}, arc->rise * turned, x);
}

static JnStatus trace_arc(const Arc* arc, JnArena* arena, JnPath* path) {
	Arc* kept;
	JN_NEW(arena, kept, 1);
	*kept = *arc;
	path->at = arc_at;
	path->data = kept;
	path->pieces = 1 + (int)(fabs(arc->angle) / (0.5 * pi)); // a quarter turn or less
	return JN_OK;
}

static JnStatus trace_helix(const void* options, const char* what, JnArena* arena, JnPath* path) {
	const HelixDef* def = options;
	const Arc arc = {def->radius, def->start, 2 * pi * def->turns, def->pitch / (2 * pi), def->axis};
	if (def->pitch == 0 && def->turns >= 1)
		return jn_error(JN_BAD_INPUT, "%s.pitch: 0 with %g turns runs into itself; give it a pitch, or use circle",
						what, def->turns);
	return trace_arc(&arc, arena, path);
}

static JnStatus trace_circle(const void* options, const char* what, JnArena* arena, JnPath* path) {
	const CircleDef* def = options;
	const Arc arc = {def->radius, def->start, def->angle, 0, def->axis};
	(void)what;
	path->is_closed = def->angle > 2 * pi * (1 - 1e-12);
	return trace_arc(&arc, arena, path);
}

static void knot_at(const JnPath* path, double u, double x[3]) {
	const KnotDef* def = path->data;
	const double a = 2 * pi * u / path->pieces, r = def->ring + def->tube * cos(def->q * a);
	static const double center[3] = {0};
	const double across[2] = {r * cos(def->p * a), r * sin(def->p * a)};
	jn_shape_orient(def->axis, center, across, def->tube * sin(def->q * a), x);
}

static int common_factor(int a, int b) {
	while (b != 0) {
		const int rest = a % b;
		a = b;
		b = rest;
	}
	return a;
}

static JnStatus trace_knot(const void* options, const char* what, JnArena* arena, JnPath* path) {
	const KnotDef* def = options;
	KnotDef* kept;
	const int factor = common_factor(def->p, def->q);
	if (factor != 1)
		return jn_error(JN_BAD_INPUT,
						"%s.q: %d and p = %d have the common factor %d, which makes %d loops of one; "
						"choose numbers without, such as 2 and 3",
						what, def->q, def->p, factor, factor);
	if (!(def->tube < def->ring))
		return jn_error(JN_BAD_INPUT,
						"%s.tube: %g m is not smaller than the ring of %g m, so that the curve meets itself; "
						"use a third of it",
						what, def->tube, def->ring);
	JN_NEW(arena, kept, 1);
	*kept = *def;
	path->at = knot_at;
	path->data = kept;
	path->pieces = 4 * (def->p + def->q);
	path->is_closed = true;
	return JN_OK;
}

#define ANGLE_KEY(type, field_name, standard, least, most, edges, text)                                                \
	{                                                                                                                  \
		.name = #field_name, .kind = JN_REAL, .field = offsetof(type, field_name), .value = {standard},                \
		.low = (least), .high = (most), .open = (edges), .unit = "rad", .meaning = (text)                              \
	}

#define START_KEY(type) ANGLE_KEY(type, start, 0, -1000, 1000, JN_CLOSED, "angle about the axis at which it begins")

static const JnKey helix_keys[] = {
	JN_LENGTH_KEY(HelixDef, radius, "distance from the axis"),
	{.name = "pitch",
	 .kind = JN_REAL,
	 .field = offsetof(HelixDef, pitch),
	 .required = true,
	 .unit = "m",
	 .meaning = "rise along the axis in a turn; negative: left-handed"},
	{.name = "turns",
	 .kind = JN_REAL,
	 .field = offsetof(HelixDef, turns),
	 .required = true,
	 .low = 0,
	 .high = 10000,
	 .open = JN_OPEN_LOW,
	 .meaning = "how often it goes round"},
	JN_AXIS_KEY(HelixDef, "about which it turns"),
	START_KEY(HelixDef),
	{0},
};

static const JnKey circle_keys[] = {
	JN_LENGTH_KEY(CircleDef, radius, "distance from the axis"),
	ANGLE_KEY(CircleDef, angle, 6.28318530717958647692, 0, 6.2831853072, JN_OPEN_LOW,
			  "how far it goes round; all the way makes it a closed loop"),
	JN_AXIS_KEY(CircleDef, "about which it turns"),
	START_KEY(CircleDef),
	{0},
};

#define TURNS_KEY(field_name, standard, text)                                                                          \
	{                                                                                                                  \
		.name = #field_name, .kind = JN_INTEGER, .field = offsetof(KnotDef, field_name), .value = {standard},          \
		.low = 1, .high = 100, .meaning = (text)                                                                       \
	}

static const JnKey knot_keys[] = {
	TURNS_KEY(p, 2, "times round the axis"),
	TURNS_KEY(q, 3, "times round the tube; 2 and 3 make a trefoil"),
	JN_LENGTH_KEY(KnotDef, ring, "radius of the circle in the middle of the tube"),
	JN_LENGTH_KEY(KnotDef, tube, "radius of the tube, smaller than the ring"),
	JN_AXIS_KEY(KnotDef, "of the ring"),
	{0},
};

const JnPathType jn_path_helix = {
	.row = {"helix", "A screw about an axis.", helix_keys, sizeof(HelixDef)},
	.trace = trace_helix,
};

const JnPathType jn_path_circle = {
	.row = {"circle", "A circle about an axis, or an arc of one.", circle_keys, sizeof(CircleDef)},
	.trace = trace_circle,
};

const JnPathType jn_path_torus_knot = {
	.row = {"torus_knot", "A closed loop on a torus, with a knot when p and q are above 1.", knot_keys,
			sizeof(KnotDef)},
	.trace = trace_knot,
};
