/// @file view_obstacles.h
/// Things that never move.
#ifndef JN_APP_VIEW_OBSTACLES_H
#define JN_APP_VIEW_OBSTACLES_H

#include "view_run.h"

/// Join the obstacles of a recording: all points, all triangles. JN_BAD_INPUT after a message.
JnStatus view_obstacles_join(ViewRun* run);

#endif
