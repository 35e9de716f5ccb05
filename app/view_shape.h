/// @file view_shape.h
/// What the bodies and obstacles of a recording look like.
#ifndef JN_APP_VIEW_SHAPE_H
#define JN_APP_VIEW_SHAPE_H

#include "view_run.h"

/// Make what is drawn of the bodies and obstacles of a recording. JN_BAD_INPUT or JN_OUT_OF_MEMORY after a message.
JnStatus view_shape_make(ViewRun* run);

#endif
