/// @file h5_file.h
/// The few things that a recording asks of HDF5, by path inside the file. Every failure names the file, the object and
/// the reason; after the first one the file is broken and nothing more is written to it.
#ifndef JN_RECORD_H5_FILE_H
#define JN_RECORD_H5_FILE_H

#include <hdf5.h>

#include "record/h5_driver.h"
#include "record/text_file.h"

typedef struct JnH5File {
	hid_t id;
	hid_t link_list;     ///< property list that makes the groups on the way to an object
	hid_t driver;        ///< see h5_driver.h
	JnH5Disk disk;       ///< its side of the file: the struct must not move while it is open
	bool is_broken;      ///< a failure has been told
	H5E_auto2_t printer; ///< what HDF5 did with its own messages before
	void* printer_data;
	char path[JN_PATH_SIZE];
} JnH5File;

/// Create "directory/name" or empty it; without HDF5's file lock, so that others may look at a run in progress.
JnStatus jn_h5_create(JnH5File* file, const char* directory, const char* name);

/// Open "directory/name" to go on writing, at its last flush, whatever became of its writer.
JnStatus jn_h5_open(JnH5File* file, const char* directory, const char* name);

/// The same, but nothing of what is written reaches the disk: to see whether the file holds what it should before it is changed. A
/// journal of a run that was killed is looked for by jn_h5_open alone.
JnStatus jn_h5_open_rehearsal(JnH5File* file, const char* directory, const char* name);

/// Is there an object of that name?
JnStatus jn_h5_find(JnH5File* file, const char* name, bool* is_found);

/// Remove a group with all that is in it.
JnStatus jn_h5_remove(JnH5File* file, const char* name);

/// Open a 1-D dataset that grows, to be cut to `length`. JN_BAD_INPUT when it is none, or shorter.
JnStatus jn_h5_reopen(JnH5File* file, const char* name, hsize_t length, hid_t* dataset);

/// A group that may stay empty.
JnStatus jn_h5_group(JnH5File* file, const char* name);

/// A dataset of fixed shape; `rank` is 1 or 2. `memory_type` describes `data`, `file_type` what is stored.
JnStatus jn_h5_array(JnH5File* file, const char* name, hid_t file_type, hid_t memory_type, int rank,
					 const hsize_t dims[], const void* data);

/// A scalar dataset with a UTF-8 text.
JnStatus jn_h5_text(JnH5File* file, const char* name, const char* text);

/// Attributes of the object `name`; written anew when they exist.
JnStatus jn_h5_attribute_text(JnH5File* file, const char* name, const char* key, const char* value);
JnStatus jn_h5_attribute_real(JnH5File* file, const char* name, const char* key, double value);
JnStatus jn_h5_attribute_integer(JnH5File* file, const char* name, const char* key, int64_t value);

/// An empty 1-D dataset in chunks that grows; `*dataset` is the caller's, until jn_h5_close closes all that is open.
JnStatus jn_h5_extendible(JnH5File* file, const char* name, hid_t file_type, hid_t* dataset);

/// Put `count` values behind the `length` that the dataset has.
JnStatus jn_h5_append(JnH5File* file, hid_t dataset, hid_t memory_type, hsize_t length, hsize_t count,
					  const void* data);

/// Bring the file on disk into a state that readers understand, even if the run is killed after it.
JnStatus jn_h5_flush(JnH5File* file);

/// The same, and it survives a loss of power.
JnStatus jn_h5_sync(JnH5File* file);

/// Close the file and all its objects. A broken file is closed without a further word, with JN_IO_FAILED.
JnStatus jn_h5_close(JnH5File* file);

#endif
