/// @file h5_driver.h
/// How HDF5 reaches the disk, such that the file is whole at any moment, whatever happens to the program or the disk.
///
/// HDF5 writes over parts of a file in an order of its own, and is not journaled. Here bytes behind the committed part of the
/// file are written at once, where nobody looks for them yet. Those that change the committed part wait in memory, page by
/// page, until a commit writes them to a journal beside the file, then into the file, and then empties the journal:
///
///   file      [ committed ............. ][ new, not yet referred to ... ]
///   journal   magic, count, check sum, page numbers, pages              whole: to be applied; else: of no use
///
/// After a kill the file is that of the last commit, or the journal makes it so (jn_h5_recover). HDF5 1.10 does not get over a
/// write that fails either: H5Fclose leaves objects behind on which its exit handler crashes or loops. So the driver keeps the
/// reason, lets HDF5 believe that all is well, and writes nothing more.
#ifndef JN_RECORD_H5_DRIVER_H
#define JN_RECORD_H5_DRIVER_H

#include <hdf5.h>

#include "jounce/base.h"

/// A page that differs from what the file holds.
typedef struct JnH5Page {
	uint64_t number;
	unsigned char* bytes;
} JnH5Page;

/// A file as its driver knows it. All zero before it is opened; the address must not change until it is closed.
typedef struct JnH5Disk {
	bool is_rehearsal;  ///< set before it is opened: nothing reaches the disk
	int error;          ///< errno of the first failure to reach the disk, or 0
	int file, journal;  ///< -1: not open
	char* journal_path; ///< owned
	uint64_t end;       ///< of the file as HDF5 sees it [bytes]
	uint64_t committed; ///< pages below this one change by the journal alone
	bool is_cut;        ///< its end has to be set at the next commit
	bool is_applying;   ///< the journal is whole, and perhaps not yet in the file
	int page_count;
	JnH5Page* pages; ///< ascending numbers
	size_t page_capacity;
} JnH5Disk;

/// Register the driver and choose it in a file access list; the caller ends with H5FDunregister. Returns a negative number
/// when HDF5 refuses.
hid_t jn_h5_driver_choose(hid_t access_list, JnH5Disk* disk);

/// What HDF5 has flushed becomes the file. Failures are kept in disk->error.
void jn_h5_commit(JnH5Disk* disk);

/// The same, and it survives a loss of power.
void jn_h5_sync_disk(JnH5Disk* disk);

/// Bring a file to its last commit, if a writer that is no more has left a journal. JN_IO_FAILED after a message when that
/// cannot be done.
JnStatus jn_h5_recover(const char* path);

#endif
