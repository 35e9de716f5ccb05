/// @file curve.h
/// A smooth curve through points, with frames that do not twist about it.
#ifndef JN_MESH_SHAPE_CURVE_H
#define JN_MESH_SHAPE_CURVE_H

#include "base/arena.h"
#include "jounce/base.h"

/// A place on a curve: its position, and three directions of length 1, right-handed: along = across[0] x across[1].
typedef struct JnStation {
	double X[3];
	double across[2][3], along[3];
} JnStation;

/// Put stations[0 .. count - 1], count >= 2, at equal distances along the centripetal Catmull-Rom curve through
/// points[3 * point_count], point_count >= 2, no two neighbours at one place (a straight line for two points). Frames
/// minimise rotation by double reflection (Wang, Juettler, Zheng, Liu 2008).
JnStatus jn_curve_stations(int point_count, const double* points, int count, JnStation* stations, JnArena* scratch);

/// Point at a share, 0 to 1 or a little beyond, of the way from points[segment] to the next one, of the same curve or of the
/// closed one through three points or more.
void jn_curve_point(int count, const double* points, bool is_closed, int segment, double share, double out[3]);

/// The frame of a station whose X and `along` are there: any across, or that of another station carried along.
void jn_station_begin(JnStation* station);
void jn_station_carry(const JnStation* from, JnStation* to);

/// Turn the frame about `along`, right-handed [rad].
void jn_station_turn(JnStation* station, double angle);

#endif
