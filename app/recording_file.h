/// @file recording_file.h
/// Reading run.h5, whose layout is told in src/record/hdf5.c, without HDF5's own words about what is missing.
#ifndef JN_APP_RECORDING_FILE_H
#define JN_APP_RECORDING_FILE_H

#include <hdf5.h>

#include "jounce/base.h"

/// Takes from an open file what it needs; JN_IO_FAILED, without a message, when something is not there.
typedef JnStatus RecordingRead(hid_t file, void* user);

/// Open run.h5 in `folder` and let `read` work on it. JN_IO_FAILED after a message when either fails. `*file` is to be
/// closed with recording_file_close in any case.
JnStatus recording_file_open(const char* folder, RecordingRead* read, void* user, hid_t* file);

/// Close unless it is negative, and make it so.
void recording_file_close(hid_t* file);

/// Read one attribute of an object.
JnStatus recording_file_attribute(hid_t file, const char* object, const char* name, hid_t type, void* value);

/// Entries of a dataset; -1 when there is none.
hssize_t recording_file_measure(hid_t file, const char* name);

/// Read a dataset of `count` numbers into `data`. JN_IO_FAILED also when it has another count.
JnStatus recording_file_array(hid_t file, const char* name, hid_t type, hssize_t count, void* data);

#endif
