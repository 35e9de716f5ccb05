/// @file view_routes.h
/// What `jounce view` serves: a fixed table of names, nothing from the file system.
///
///   /                                  the page
///   /api/runs                          {"runs": [{"name", "folder", "error"}]}
///   /api/runs/0                        view_pack_run        503: being written, ask again
///   /api/runs/0/state?known=12         view_pack_state, after a look for new frames
///   /api/runs/0/series                 view_pack_series
///   /api/runs/0/frames/17              positions of the drawn points, f32
///   /api/runs/0/fields/speed/17        a field at the drawn points, f32   409: why there is none
#ifndef JN_APP_VIEW_ROUTES_H
#define JN_APP_VIEW_ROUTES_H

#include "view_run.h"
#include "view_server.h"

enum { VIEW_MESSAGE_BYTES = 1024 };

/// A folder that is viewed.
typedef struct ViewSource {
	const char* folder;
	bool is_open;
	JnStatus status; ///< of opening it
	bool is_awaited; ///< a process that writes it has been started
	ViewRun run;
	char error[VIEW_MESSAGE_BYTES]; ///< why it is not open; "" when it is
} ViewSource;

typedef struct ViewSources {
	int count;
	ViewSource* list;
} ViewSources;

/// Open what is not open; `error` says what is wrong.
void view_source_open(ViewSource* source);

/// A ViewHandler whose user is a ViewSources.
void view_answer(void* sources, const char* path, const char* (*query)(void* request, const char* name), void* request,
				 ViewAnswer* answer);

#endif
