/// @file compare_files.h
/// Files and folders of a comparison.
#ifndef JN_APP_COMPARE_FILES_H
#define JN_APP_COMPARE_FILES_H

#include <stdbool.h>

#include "jounce/base.h"
#include "record/text_file.h"

/// The text of a whole file, to be freed by the caller; NULL, with errno, when it cannot be read.
char* compare_file_read(const char* path);

/// The folder of a run in the comparison's output. JN_IO_FAILED when the path is too long.
JnStatus compare_run_folder(const char* directory, const char* name, char path[JN_PATH_SIZE]);

#endif
