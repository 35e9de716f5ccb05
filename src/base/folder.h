/// @file folder.h
/// Folders for results.
#ifndef JN_BASE_FOLDER_H
#define JN_BASE_FOLDER_H

#include "jounce/base.h"

/// Make a folder and those above it, and see that one can write there. JN_IO_FAILED after a message that says why not.
JnStatus jn_folder_make(const char* path);

#endif
