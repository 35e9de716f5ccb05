/// @file text_file.h
/// A text file of a recording that is either whole or an error: every failure names the path and the reason.
#ifndef JN_RECORD_TEXT_FILE_H
#define JN_RECORD_TEXT_FILE_H

#include <stdbool.h>
#include <stdio.h>

#include "jounce/base.h"

enum { JN_PATH_SIZE = 4096 };

typedef enum JnTextMode {
	JN_TEXT_DIRECT,  ///< written under its own name, readable while it grows
	JN_TEXT_REPLACE, ///< written beside it, synced and renamed on close: readers see the old file or the new one
} JnTextMode;

/// An open file; all zero when closed.
typedef struct JnTextFile {
	FILE* stream;
	JnTextMode mode;
	int error;                    ///< errno of the first write that failed, or 0
	bool is_told;                 ///< in a message
	char path[JN_PATH_SIZE];      ///< the name that readers use
	char temporary[JN_PATH_SIZE]; ///< the name while it is being written
} JnTextFile;

/// "directory/name" in `path`; JN_IO_FAILED when it is too long.
JnStatus jn_path_join(const char* directory, const char* name, char path[JN_PATH_SIZE]);

/// Create or empty the file `name` in `directory`. JN_IO_FAILED when that is not possible.
JnStatus jn_text_open(JnTextFile* file, const char* directory, const char* name, JnTextMode mode);

/// Open the file `name` in `directory` to go on behind its first `size` bytes; what follows them is cut off. JN_BAD_INPUT
/// when it has not so many, JN_IO_FAILED when it cannot be read or cut.
JnStatus jn_text_resume(JnTextFile* file, const char* directory, const char* name, long size);

/// Append. A failure is kept in `file` and told by the next flush or close.
void jn_text_print(JnTextFile* file, const char* format, ...) __attribute__((format(printf, 2, 3)));
void jn_text_write(JnTextFile* file, const char* text, size_t length);

/// Hand what was written to the system. JN_IO_FAILED after any failure so far, which is told once.
JnStatus jn_text_flush(JnTextFile* file);

/// The same, and it survives a loss of power.
JnStatus jn_text_sync(JnTextFile* file);

/// Close; a JN_TEXT_REPLACE file takes its name now. JN_IO_FAILED after any failure so far, and then the file under
/// that name is still the old one. Without effect on a closed file.
JnStatus jn_text_close(JnTextFile* file);

/// Close without a word, after a failure that has been told; what was written beside the file is removed.
void jn_text_abandon(JnTextFile* file);

#endif
