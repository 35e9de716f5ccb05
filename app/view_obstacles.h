/// @file view_obstacles.h
/// Obstacles of a recording.
#ifndef JN_APP_VIEW_OBSTACLES_H
#define JN_APP_VIEW_OBSTACLES_H

#include "view_run.h"

/// Read what never moves into run->obstacles and the arrays beside it. JN_IO_FAILED without a message.
JnStatus view_obstacles_read(ViewRun* run);

#endif
