/// @file placement.h
/// How a mesh from a file comes into the scene: its units, its up-axis, its size and place.
#ifndef JN_MESH_SHAPE_PLACEMENT_H
#define JN_MESH_SHAPE_PLACEMENT_H

#include "jounce/extend.h"

/// Applied in this order: up, scale, rotate, fit, translate.
typedef struct JnPlacementDef {
	int up;              ///< axis of the file that becomes y: 0 y (as it is), 1 z, 2 x; a rotation, never a mirror
	double scale;        ///< metres of a unit of the file
	double rotate[3];    ///< turns about x, then y, then z [rad]
	double fit;          ///< largest edge of the bounding box afterwards [m]; 0: as it is
	double translate[3]; ///< [m]
} JnPlacementDef;

/// Rows for a table of keys; `path` is the place of a JnPlacementDef in `type`, such as
/// `placement.` or nothing. The table's file includes <math.h>.
#define JN_PLACEMENT_KEY_ROWS(type, path)                                                                              \
	{.name = "up",                                                                                                     \
	 .kind = JN_CHOICE,                                                                                                \
	 .field = offsetof(type, path up),                                                                                 \
	 .names = jn_placement_axes,                                                                                       \
	 .meaning = "axis of the file that points up, and becomes y here; applied first"},                                 \
		{.name = "scale",                                                                                              \
		 .kind = JN_REAL,                                                                                              \
		 .field = offsetof(type, path scale),                                                                          \
		 .value = {1},                                                                                                 \
		 .high = INFINITY,                                                                                             \
		 .open = JN_OPEN_LOW | JN_OPEN_HIGH,                                                                           \
		 .unit = "m",                                                                                                  \
		 .remedy = "write 1 mm when the file is in millimetres",                                                       \
		 .meaning = "length of a unit of the file, such as 1 mm; applied second"},                                     \
		{.name = "rotate",                                                                                             \
		 .kind = JN_REAL3,                                                                                             \
		 .field = offsetof(type, path rotate),                                                                         \
		 .unit = "rad",                                                                                                \
		 .meaning =                                                                                                    \
			 "turns about x, then y, then z, right-handed about the origin, such as [0 deg, 90 deg, 0 deg]; applied "  \
			 "third"},                                                                                                 \
		{.name = "fit",                                                                                                \
		 .kind = JN_REAL,                                                                                              \
		 .field = offsetof(type, path fit),                                                                            \
		 .high = INFINITY,                                                                                             \
		 .open = JN_OPEN_HIGH,                                                                                         \
		 .unit = "m",                                                                                                  \
		 .meaning = "largest edge of the bounding box afterwards, scaled about the origin; 0 leaves the size; "        \
					"applied fourth"},                                                                                 \
	{                                                                                                                  \
		.name = "translate", .kind = JN_REAL3, .field = offsetof(type, path translate), .unit = "m",                   \
		.meaning = "displacement; applied last"                                                                        \
	}

extern const char* const jn_placement_axes[]; ///< names of JnPlacementDef.up

/// Move points[3 * count]. JN_BAD_INPUT, after a message, when all lie at one place and `fit` is asked for, and
/// where they end up so far away that their digits do not suffice.
JnStatus jn_placement_apply(const JnPlacementDef* def, const char* what, int count, double* points);

#endif
