/// @file view_live.h
/// A scene that runs while it is viewed: `jounce run` as a process of its own.
#ifndef JN_APP_VIEW_LIVE_H
#define JN_APP_VIEW_LIVE_H

#include <sys/types.h>

#include "record/text_file.h"
#include "view_options.h"
#include "view_routes.h"

typedef struct ViewLive {
	pid_t process; ///< 0: none, or it has ended
	bool has_failed;
	char folder[JN_PATH_SIZE], log[JN_PATH_SIZE]; ///< the folder is "" where no scene is run
} ViewLive;

/// Check the scene, make its folder without an earlier recording, and start. JN_BAD_INPUT, JN_IO_FAILED or JN_RUN_FAILED
/// after a message.
JnStatus view_live_start(ViewLive* live, const ViewOptions* options);

/// See whether it has ended; then says so, and if it failed, gives the reason to a source that has nothing to show.
void view_live_look(ViewLive* live, ViewSource* source);

/// Let it run to its end, or until Ctrl-C; its files are complete then.
void view_live_wait(ViewLive* live, ViewSource* source);

/// Ask it to finish its files, and wait for that.
void view_live_stop(ViewLive* live);

#endif
