/// @file view_bodies.h
/// Names, shapes and nodes of the bodies of a recording.
#ifndef JN_APP_VIEW_BODIES_H
#define JN_APP_VIEW_BODIES_H

#include "view_run.h"

/// Fill run->bodies, in the order of their nodes, but for what is drawn of them. JN_IO_FAILED without a message.
JnStatus view_bodies_list(ViewRun* run);

#endif
