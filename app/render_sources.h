/// @file render_sources.h
/// The recordings that are drawn or reported.
#ifndef JN_APP_RENDER_SOURCES_H
#define JN_APP_RENDER_SOURCES_H

#include "view_routes.h"

/// Open them all. Returns EXIT_DONE, or EXIT_BAD_INPUT after a message when one cannot be opened or has no frame yet. To be
/// closed in any case.
int render_sources_open(int count, char** folders, ViewSources* sources);
void render_sources_close(ViewSources* sources);

/// Can the recordings be coloured by a field (NULL: none)? Returns EXIT_DONE, or EXIT_BAD_INPUT after a message that says
/// what there is, or why not.
int render_sources_check_field(ViewSources* sources, const char* field);

#endif
