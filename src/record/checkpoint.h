/// @file checkpoint.h
/// Saved states of a run as files: DIR/checkpoints/step-0000001200.jnc, written beside and renamed, with a version and a check
/// sum. What is in them is the caller's.
#ifndef JN_RECORD_CHECKPOINT_H
#define JN_RECORD_CHECKPOINT_H

#include "record/text_file.h"

/// What a saved state is good for.
typedef enum JnCheckpointKind {
	JN_CHECKPOINT_STEP, ///< the run itself went on from it: one that is resumed has its bits
	JN_CHECKPOINT_END,  ///< where a run ended; one that is resumed agrees to the accuracy of solvers
	JN_CHECKPOINT_KINDS
} JnCheckpointKind;

typedef struct JnCheckpointFile {
	JnCheckpointKind kind;
	long step;
	char path[JN_PATH_SIZE];
} JnCheckpointFile;

/// Write the state after a step, and remove all but the newest `keep` of its kind. JN_IO_FAILED after a message; those that were
/// there are then still there.
JnStatus jn_checkpoint_write(const char* directory, JnCheckpointKind kind, long step, const void* bytes, size_t size,
							 int keep);

/// Remove all of a folder: those of an earlier run.
void jn_checkpoints_remove(const char* directory);

/// The newest of a kind before step `before`. False: there is none.
bool jn_checkpoint_find(const char* directory, JnCheckpointKind kind, long before, JnCheckpointFile* out);

/// Read one; the caller frees *bytes. JN_BAD_INPUT after a message for a file that is damaged, of another version, or no
/// checkpoint; JN_IO_FAILED when it cannot be read.
JnStatus jn_checkpoint_read(const char* path, void** bytes, size_t* size);

/// The same from memory; *content points into `file`. `path` names it in messages.
JnStatus jn_checkpoint_check(const char* path, const void* file, size_t file_size, const void** content, size_t* size);

#endif
