/// @file path_rows.h
/// The rows of jn_path_list, by file.
#ifndef JN_MESH_SHAPE_PATH_ROWS_H
#define JN_MESH_SHAPE_PATH_ROWS_H

#include "mesh/shape/path.h"

extern const JnPathType jn_path_polyline, jn_path_spline;                  // path_points.c
extern const JnPathType jn_path_helix, jn_path_circle, jn_path_torus_knot; // path_round.c
extern const JnPathType jn_path_overhand;                                  // path_overhand.c

#endif
