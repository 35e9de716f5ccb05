/// @file view_save.h
/// The viewer's page with recordings in it: one file that needs no server.
///
/// Each piece of data is a <script type="text/plain" id="..."> with base64 of deflated bytes: "runs" (JSON, as
/// /api/runs), "0" and "0/series" (packs), "0/frames/17" and "0/fields/speed/17" (view_code.h).
#ifndef JN_APP_VIEW_SAVE_H
#define JN_APP_VIEW_SAVE_H

#include "view_routes.h"

typedef struct ViewSaved {
	long frames, of_frames; ///< kept, and recorded, of the run that lost most
	size_t bytes;           ///< of the file
} ViewSaved;

/// Write the page. Frames are left out, evenly, until it has at most about `limit` bytes. JN_IO_FAILED after a message.
JnStatus view_save(const char* path, ViewSources* sources, size_t limit, ViewSaved* saved);

#endif
