/// @file recording_file.h
/// Reading run.h5, whose layout is told in src/record/hdf5.c, whatever its bytes are: HDF5 works in a child process with limits of
/// memory and time, one for each open recording (recording_reader.h), and this process asks it. When the child crashes, or
/// passes its limits, that is said once, and the recording has failed: nothing can be read from it any more.
#ifndef JN_APP_RECORDING_FILE_H
#define JN_APP_RECORDING_FILE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/arena.h"

typedef struct RecordingFile RecordingFile;

/// Takes from an open file what it needs; JN_IO_FAILED, without a message, when something is not there.
typedef JnStatus RecordingRead(RecordingFile* file, void* user);

/// Numbers as they are wanted: a double, an int, a long.
typedef enum RecordingNumber { RECORDING_REAL, RECORDING_INTEGER, RECORDING_LONG } RecordingNumber;

/// Open a recording to read, at its last commit even if its run was killed. JN_IO_FAILED, without a message, when that is
/// not possible, JN_BAD_INPUT, after a message, when HDF5 crashes on it; *file is NULL then.
JnStatus recording_file_enter(const char* path, RecordingFile** file);

/// Open run.h5 in `folder` and let `read` work on it. JN_IO_FAILED after a message when either fails. `*file` is to be
/// closed with recording_file_close in any case.
JnStatus recording_file_open(const char* folder, RecordingRead* read, void* user, RecordingFile** file);

/// Close unless it is NULL, and make it so.
void recording_file_close(RecordingFile** file);

/// HDF5 has crashed on it, which has been said. False for NULL.
bool recording_file_has_failed(const RecordingFile* file);

/// Does the file begin as those of HDF5 do?
bool recording_file_is_hdf5(const char* path);

/// The folder of a recording that is named by its file, in place: "DIR/run.h5" becomes "DIR", and "run.h5" becomes ".".
void recording_file_fold(char** name);

/// Is there an object of this path, whose last group exists?
bool recording_file_has(RecordingFile* file, const char* object);

/// Read one attribute of an object. JN_IO_FAILED also when it is an array of values.
JnStatus recording_file_attribute(RecordingFile* file, const char* object, const char* name, RecordingNumber kind,
								  void* value);

/// A text attribute of an object, or a scalar text dataset (`attribute` NULL), copied into the arena.
JnStatus recording_file_text(RecordingFile* file, const char* object, const char* attribute, JnArena* arena,
							 char** text);

/// Names of what is in a group, in alphabetical order, from the arena. JN_IO_FAILED when there is no such group.
JnStatus recording_file_names(RecordingFile* file, const char* group, JnArena* arena, const char* const** names,
							  int* count);

/// How many numbers a dataset declares, -1 when there is none, and how many the bytes that it has in the file can hold: one
/// that was never written, or whose chunks are missing, may declare any number.
typedef struct RecordingSize {
	int64_t entries, most;
	int rank;
	int64_t lengths[2]; ///< of the first two dimensions
} RecordingSize;

RecordingSize recording_file_size(RecordingFile* file, const char* name);

/// Links in a group; -1 when there is none.
int64_t recording_file_links(RecordingFile* file, const char* group);

/// Entries of a dataset; -1 when there is none, or when the file has not the bytes for them.
int64_t recording_file_measure(RecordingFile* file, const char* name);

/// Read a dataset of `count` numbers into `data`. JN_IO_FAILED also when it has another count.
JnStatus recording_file_array(RecordingFile* file, const char* name, RecordingNumber kind, int64_t count, void* data);

/// Times of `count` frames from number `first` on [s].
JnStatus recording_file_times(RecordingFile* file, int64_t first, int64_t count, double* times);

#endif
