/// @file view_shape.h
/// What the bodies and obstacles of a recording look like.
#ifndef JN_APP_VIEW_SHAPE_H
#define JN_APP_VIEW_SHAPE_H

#include "view_run.h"

/// Read bodies, obstacles and rest positions of an open recording. JN_IO_FAILED without a message.
JnStatus view_shape_read(ViewRun* run);

#endif
