/// @file track.h
/// A curve as a table of stations with cubics between them, twice differentiable with respect to arc length: what moves
/// along it has a position, a velocity and an acceleration at every time, without a search and without allocation.
#ifndef JN_MODEL_TRACK_H
#define JN_MODEL_TRACK_H

#include "mesh/shape/path.h"

enum { JN_TRACK_REALS = 9 }; ///< position [m], and the two directions across

typedef struct JnTrack {
	int count;   ///< places of the table
	double step; ///< arc length between two [m]
	double length;
	bool is_closed;
	double (*value)[JN_TRACK_REALS]; ///< at s = step * (place - margin)
	double (*bend)[JN_TRACK_REALS];  ///< second derivatives with respect to s there
	int margin;
} JnTrack;

/// Values and their derivatives with respect to arc length.
typedef struct JnTrackPoint {
	double value[JN_TRACK_REALS], slope[JN_TRACK_REALS], bend[JN_TRACK_REALS];
} JnTrackPoint;

/// Make the table, in the arena. `scratch` holds what is needed for that alone.
JnStatus jn_track_create(const JnPath* path, JnArena* arena, JnArena* scratch, JnTrack* track);

/// The curve at arc length s [m]: closed ones go round, others go on straight beyond their ends.
void jn_track_at(const JnTrack* track, double s, JnTrackPoint* out);

#endif
