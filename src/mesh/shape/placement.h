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

extern const JnKey jn_placement_keys[];

/// Move points[3 * count]. JN_BAD_INPUT, after a message, when all lie at one place and `fit` is asked for.
JnStatus jn_placement_apply(const JnPlacementDef* def, const char* what, int count, double* points);

#endif
