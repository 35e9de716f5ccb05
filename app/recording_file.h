/// @file recording_file.h
/// Reading run.h5, whose layout is told in src/record/hdf5.c, without HDF5's own words about what is missing.
#ifndef JN_APP_RECORDING_FILE_H
#define JN_APP_RECORDING_FILE_H

#include <hdf5.h>

#include "base/arena.h"

/// Takes from an open file what it needs; JN_IO_FAILED, without a message, when something is not there.
typedef JnStatus RecordingRead(hid_t file, void* user);

/// Open a recording to read, at its last commit even if its run was killed; negative when that is not possible.
hid_t recording_file_enter(const char* path);

/// Open run.h5 in `folder` and let `read` work on it. JN_IO_FAILED after a message when either fails. `*file` is to be
/// closed with recording_file_close in any case.
JnStatus recording_file_open(const char* folder, RecordingRead* read, void* user, hid_t* file);

/// The folder of a recording that is named by its file, in place: "DIR/run.h5" becomes "DIR", and "run.h5" becomes ".".
void recording_file_fold(char** name);

/// Close unless it is negative, and make it so.
void recording_file_close(hid_t* file);

/// Read one attribute of an object. JN_IO_FAILED also when it is an array of values.
JnStatus recording_file_attribute(hid_t file, const char* object, const char* name, hid_t type, void* value);

/// A text attribute of an object, or a scalar text dataset (`attribute` NULL), copied into the arena.
JnStatus recording_file_text(hid_t file, const char* object, const char* attribute, JnArena* arena, char** text);

/// Let `visit` meet what is in a group, by name. JN_IO_FAILED when there is no such group, or `visit` returns below 0.
JnStatus recording_file_visit(hid_t file, const char* group, H5L_iterate_t visit, void* user);

/// How many numbers a dataset declares, -1 when there is none, and how many the bytes that it has in the file can hold: one
/// that was never written, or whose chunks are missing, may declare any number.
typedef struct RecordingSize {
	hssize_t entries, most;
} RecordingSize;

RecordingSize recording_file_size(hid_t file, const char* name);

/// Links in a group; -1 when there is none.
hssize_t recording_file_links(hid_t file, const char* group);

/// Entries of a dataset; -1 when there is none, or when the file has not the bytes for them.
hssize_t recording_file_measure(hid_t file, const char* name);

/// Read a dataset of `count` numbers into `data`. JN_IO_FAILED also when it has another count.
JnStatus recording_file_array(hid_t file, const char* name, hid_t type, hssize_t count, void* data);

#endif
