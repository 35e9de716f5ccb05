/// @file h5_journal.h
/// The file below HDF5's driver: pages that wait, and the journal. See h5_driver.h.
#ifndef JN_RECORD_H5_JOURNAL_H
#define JN_RECORD_H5_JOURNAL_H

#include "record/h5_driver.h"

/// False after a failure, whose reason is in disk->error.
bool jn_h5_disk_open(JnH5Disk* disk, const char* path, int flags);

/// Commit, unless something has failed, and close. What has failed leaves the file of the last commit.
void jn_h5_disk_close(JnH5Disk* disk);

/// What lies behind the end of the file reads as zeros.
void jn_h5_disk_read(JnH5Disk* disk, uint64_t address, size_t size, unsigned char* out);
void jn_h5_disk_write(JnH5Disk* disk, uint64_t address, size_t size, const unsigned char* data);

#endif
