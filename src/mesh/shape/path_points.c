// Curves through points: straight from one to the next, or smooth.
#include <stddef.h>

#include "base/log.h"
#include "math/vec3.h"
#include "mesh/shape/path_rows.h"

static const double fold = 1e-6; // angle [rad] to a turn by half a circle that counts as one

typedef struct PointDef {
	double at[3];
} PointDef;

typedef struct PointsDef {
	JnItems points; // PointDef
	bool closed;
} PointsDef;

typedef struct Points {
	int count;
	const double* list; // 3 * count
	bool is_closed;
} Points;

// Pieces are the ways from one point to the next; the first and the last go on beyond the ends.
static int split(const JnPath* path, double u, double* share) {
	const int count = path->pieces;
	int piece = (int)floor(u);
	if (!path->is_closed) piece = piece < 0 ? 0 : piece >= count ? count - 1 : piece;
	*share = u - piece;
	return path->is_closed ? (piece + count) % count : piece;
}

static void polyline_at(const JnPath* path, double u, double x[3]) {
	const Points* points = path->data;
	double share;
	const int piece = split(path, u, &share);
	const double *a = points->list + 3 * (ptrdiff_t)piece,
				 *b = points->list + 3 * (ptrdiff_t)((piece + 1) % points->count);
	for (int k = 0; k < 3; ++k) x[k] = (1 - share) * a[k] + share * b[k];
}

static void spline_at(const JnPath* path, double u, double x[3]) {
	const Points* points = path->data;
	double share;
	const int piece = split(path, u, &share);
	jn_curve_point(points->count, points->list, points->is_closed, piece, share, x);
}

// At a point where the way turns right round there is no direction, and none that frames could be carried into.
static JnStatus check_fold(const Points* points, int before, int at, int behind, const char* what) {
	const double *a = points->list + 3 * (ptrdiff_t)before, *b = points->list + 3 * (ptrdiff_t)at,
				 *c = points->list + 3 * (ptrdiff_t)behind;
	double in[3], out[3], both[3];
	for (int k = 0; k < 3; ++k) {
		in[k] = b[k] - a[k];
		out[k] = c[k] - b[k];
	}
	vec3_normalize(in);
	vec3_normalize(out);
	for (int k = 0; k < 3; ++k) both[k] = in[k] + out[k];
	if (!(vec3_dot(both, both) < fold * fold)) return JN_OK;
	return jn_error(JN_BAD_INPUT,
					"%s.points[%d]: the curve turns right round there and runs back along itself; move it aside, "
					"or go round in an arc",
					what, at);
}

static JnStatus check(const Points* points, const char* what) {
	const int least = points->is_closed ? 3 : 2;
	if (points->count < least)
		return jn_error(JN_BAD_INPUT, "%s.points: %d points make no %scurve; give %d or more", what, points->count,
						points->is_closed ? "closed " : "", least);
	for (int i = points->is_closed ? 0 : 1; i < points->count; ++i) {
		const int before = i > 0 ? i - 1 : points->count - 1;
		if (vec3_distance(points->list + 3 * (ptrdiff_t)i, points->list + 3 * (ptrdiff_t)before) > 0) continue;
		return jn_error(JN_BAD_INPUT, "%s.points[%d]: lies at the point before it; leave it out", what, i);
	}
	const int ends = points->is_closed ? 0 : 1;
	for (int i = ends; i < points->count - ends; ++i)
		JN_TRY(check_fold(points, i > 0 ? i - 1 : points->count - 1, i, (i + 1) % points->count, what));
	return JN_OK;
}

static JnStatus trace_points(const Points* points, const char* what, JnArena* arena, JnPath* path) {
	Points* kept;
	JN_TRY(check(points, what));
	JN_NEW(arena, kept, 1);
	*kept = *points;
	path->data = kept;
	path->pieces = points->count - !points->is_closed;
	path->is_closed = points->is_closed;
	return JN_OK;
}

static Points points_of(const PointsDef* def) {
	return (Points){def->points.count, def->points.data, def->closed}; // a PointDef is its three numbers
}

static JnStatus trace_polyline(const void* options, const char* what, JnArena* arena, JnPath* path) {
	const Points points = points_of(options);
	path->at = polyline_at;
	return trace_points(&points, what, arena, path);
}

static JnStatus trace_spline(const void* options, const char* what, JnArena* arena, JnPath* path) {
	const Points points = points_of(options);
	path->at = spline_at;
	return trace_points(&points, what, arena, path);
}

static const JnKey point_keys[] = {
	{.name = "at",
	 .kind = JN_REAL3,
	 .field = offsetof(PointDef, at),
	 .required = true,
	 .unit = "m",
	 .meaning = "where it passes"},
	{0},
};

#define POINTS_KEYS(words)                                                                                             \
	{                                                                                                                  \
		{.name = "points",                                                                                             \
		 .kind = JN_LIST,                                                                                              \
		 .field = offsetof(PointsDef, points),                                                                         \
		 .required = true,                                                                                             \
		 .keys = point_keys,                                                                                           \
		 .size = sizeof(PointDef),                                                                                     \
		 .meaning = (words)},                                                                                          \
			{.name = "closed",                                                                                         \
			 .kind = JN_SWITCH,                                                                                        \
			 .field = offsetof(PointsDef, closed),                                                                     \
			 .meaning = "from the last point back to the first"},                                                      \
			{0},                                                                                                       \
	}

static const JnKey polyline_keys[] = POINTS_KEYS("two or more, three when closed; straight from each to the next");
static const JnKey spline_keys[] =
	POINTS_KEYS("two or more, three when closed; a smooth curve goes through all of them");

const JnPathType jn_path_polyline = {
	.row = {"polyline", "Straight pieces between points.", polyline_keys, sizeof(PointsDef)},
	.trace = trace_polyline,
};

const JnPathType jn_path_spline = {
	.row = {"spline", "A smooth curve through points (centripetal Catmull-Rom).", spline_keys, sizeof(PointsDef)},
	.trace = trace_spline,
};

JnStatus jn_path_through(int count, const double* points, const char* what, JnArena* arena, JnPath* path) {
	PointsDef options = {.points = {count, (void*)points}};
	const JnPathDef def = {.curve = {&jn_path_spline.row, &options}};
	return jn_path_create(&def, what, arena, path);
}
