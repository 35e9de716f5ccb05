/// @file h5_driver.h
/// How HDF5 reaches the disk. HDF5 1.10 does not get over a write that fails: H5Fclose leaves objects behind on which
/// its exit handler crashes or loops. So this driver keeps the reason, and lets HDF5 believe that all is well.
#ifndef JN_RECORD_H5_DRIVER_H
#define JN_RECORD_H5_DRIVER_H

#include <hdf5.h>

/// Register the driver and choose it in a file access list; the caller ends with H5FDunregister. After any failure to
/// open, read, write or truncate, `*error` is the errno of the first one; it has to live as long as the file is open.
/// Returns a negative number when HDF5 refuses.
hid_t jn_h5_driver_choose(hid_t access_list, int* error);

#endif
