/// @file view_page.h
/// The viewer's page, one file of HTML with its script, which the build puts into the command.
#ifndef JN_APP_VIEW_PAGE_H
#define JN_APP_VIEW_PAGE_H

#include <stddef.h>

/// The page and its size; NULL when the command was built without Node.
const char* view_page(size_t* size);

#endif
