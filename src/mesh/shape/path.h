/// @file path.h
/// Curves of many kinds by their arc length: each kind is a row that says where the curve is at a parameter u, and the rest
/// is common: lengths, places at equal distances, frames that do not twist.
#ifndef JN_MESH_SHAPE_PATH_H
#define JN_MESH_SHAPE_PATH_H

#include "base/arena.h"
#include "jounce/extend.h"
#include "mesh/shape/curve.h"

typedef struct JnPath JnPath;

/// A curve x(u), 0 <= u <= pieces, smooth between whole numbers, defined a little beyond, too; its own place in space.
struct JnPath {
	void (*at)(const JnPath* path, double u, double x[3]);
	const void* data; ///< of `at`
	int pieces;
	bool is_closed;   ///< x(pieces) = x(0)
	double map[4][3]; ///< from there to the scene: origin, and where the three axes go
	double* lengths;  ///< arc length at the samples of each piece, and at the end [m]
	double length;    ///< of all [m]
};

typedef struct JnPathType {
	JnRow row;
	/// Fill at, data, pieces and is_closed; `what` is the key path of the curve for messages.
	JnStatus (*trace)(const void* options, const char* what, JnArena* arena, JnPath* path);
} JnPathType;

extern const JnRowList jn_path_list; ///< rows are &JnPathType.row

/// A curve as scene files have it.
typedef struct JnPathDef {
	JnVariant curve;  ///< row of jn_path_list; row NULL: none
	double origin[3]; ///< where its own origin goes [m]
	double rotate[3]; ///< turns about x, then y, then z, about its own origin [rad]
} JnPathDef;

/// Rows for a table of keys; `path` is the place of a JnPathDef in `type`.
#define JN_PATH_KEY_ROWS(type, path, is_required)                                                                      \
	{.name = "curve",                                                                                                  \
	 .kind = JN_VARIANT,                                                                                               \
	 .field = offsetof(type, path curve),                                                                              \
	 .required = is_required,                                                                                          \
	 .rows = &jn_path_list,                                                                                            \
	 .tag = "type",                                                                                                    \
	 .meaning = "the curve that it follows"},                                                                          \
		{.name = "origin",                                                                                             \
		 .kind = JN_REAL3,                                                                                             \
		 .field = offsetof(type, path origin),                                                                         \
		 .unit = "m",                                                                                                  \
		 .meaning = "where the curve's own origin goes"},                                                              \
	{                                                                                                                  \
		.name = "rotate", .kind = JN_REAL3, .field = offsetof(type, path rotate), .unit = "rad",                       \
		.meaning = "turns of the curve about x, then y, then z, right-handed about its own origin, such as "           \
				   "[0 deg, 90 deg, 0 deg]"                                                                            \
	}

/// Trace a curve and measure its length. Everything lives in the arena. JN_BAD_INPUT, after a message that begins with
/// `what`, for curves without length and what the row refuses.
JnStatus jn_path_create(const JnPathDef* def, const char* what, JnArena* arena, JnPath* path);

/// The smooth curve through points[3 * count], count >= 2, as row `spline` makes it. The points are borrowed.
JnStatus jn_path_through(int count, const double* points, const char* what, JnArena* arena, JnPath* path);

/// Position [m], and direction of length 1, at arc length s [m]. Closed curves go round; others go on beyond their ends
/// as far as their rows do, which is a little.
void jn_path_place(const JnPath* path, double s, double X[3], double along[3]);

/// Put `count` stations at equal distances, from end to end, or once round a closed curve, whose first station is not
/// repeated. Their frames minimise rotation, and turn by `twist` turns over the whole length besides; on a closed curve
/// what is missing for a whole turn is spread evenly, so that the frames close when `twist` is a whole number.
void jn_path_stations(const JnPath* path, int count, double twist, JnStation* stations);

#endif
