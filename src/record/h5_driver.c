// A virtual file driver over pread and pwrite, without the locks and the seeks of HDF5's own.
#include "record/h5_driver.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct Choice {
	int* error; // where the file's user looks for failures
} Choice;

typedef struct Driver {
	H5FD_t base; // HDF5's part, must be first
	int file;
	int* error;
	haddr_t allocated; // end of what HDF5 has given out
	haddr_t end;       // end of what is in the file
} Driver;

static void keep_error(int* error) {
	if (*error == 0) *error = errno != 0 ? errno : EIO;
}

static H5FD_t* open_driver(const char* name, unsigned flags, hid_t access_list, haddr_t limit) {
	const Choice* choice = H5Pget_driver_info(access_list);
	Driver* driver = calloc(1, sizeof *driver);
	(void)limit;
	if (choice == NULL || driver == NULL) {
		free(driver);
		return NULL;
	}
	const int writing = flags & H5F_ACC_RDWR ? O_RDWR : O_RDONLY;
	const int creating = (flags & H5F_ACC_CREAT ? O_CREAT : 0) | (flags & H5F_ACC_TRUNC ? O_TRUNC : 0) |
						 (flags & H5F_ACC_EXCL ? O_EXCL : 0);
	driver->error = choice->error;
	driver->file = open(name, writing | creating | O_CLOEXEC, 0666);
	struct stat facts;
	if (driver->file < 0 || fstat(driver->file, &facts) != 0) {
		keep_error(driver->error);
		if (driver->file >= 0) close(driver->file);
		free(driver);
		return NULL;
	}
	driver->end = (haddr_t)facts.st_size;
	return &driver->base;
}

static herr_t close_driver(H5FD_t* base) {
	Driver* driver = (Driver*)base;
	if (close(driver->file) != 0) keep_error(driver->error);
	free(driver);
	return 0;
}

static herr_t query(const H5FD_t* base, unsigned long* features) {
	(void)base;
	*features = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
				H5FD_FEAT_AGGREGATE_SMALLDATA;
	return 0;
}

static haddr_t get_allocated(const H5FD_t* base, H5FD_mem_t type) {
	(void)type;
	return ((const Driver*)base)->allocated;
}

static herr_t set_allocated(H5FD_t* base, H5FD_mem_t type, haddr_t address) {
	(void)type;
	((Driver*)base)->allocated = address;
	return 0;
}

static haddr_t get_end(const H5FD_t* base, H5FD_mem_t type) {
	(void)type;
	return ((const Driver*)base)->end;
}

// What lies behind the end of the file reads as zeros.
static herr_t read_bytes(H5FD_t* base, H5FD_mem_t type, hid_t transfer, haddr_t address, size_t size, void* out) {
	Driver* driver = (Driver*)base;
	char* at = out;
	(void)type, (void)transfer;
	while (size > 0) {
		const ssize_t count = pread(driver->file, at, size, (off_t)address);
		if (count < 0 && errno == EINTR) continue;
		if (count < 0) keep_error(driver->error);
		if (count <= 0) break;
		at += count;
		address += (haddr_t)count;
		size -= (size_t)count;
	}
	memset(at, 0, size);
	return 0;
}

static herr_t write_bytes(H5FD_t* base, H5FD_mem_t type, hid_t transfer, haddr_t address, size_t size,
						  const void* data) {
	Driver* driver = (Driver*)base;
	const char* at = data;
	(void)type, (void)transfer;
	if (address + size > driver->end) driver->end = address + size;
	while (size > 0 && *driver->error == 0) {
		const ssize_t count = pwrite(driver->file, at, size, (off_t)address);
		if (count < 0 && errno == EINTR) continue;
		if (count <= 0) {
			keep_error(driver->error);
			break;
		}
		at += count;
		address += (haddr_t)count;
		size -= (size_t)count;
	}
	return 0;
}

static herr_t truncate_file(H5FD_t* base, hid_t transfer, hbool_t is_closing) {
	Driver* driver = (Driver*)base;
	(void)transfer, (void)is_closing;
	if (driver->end == driver->allocated) return 0;
	if (*driver->error == 0 && ftruncate(driver->file, (off_t)driver->allocated) != 0) keep_error(driver->error);
	driver->end = driver->allocated;
	return 0;
}

static const H5FD_class_t driver_class = {
#if H5_VERSION_GE(1, 13, 2)
	.version = H5FD_CLASS_VERSION,
	.value = H5_VFD_RESERVED,
#endif
	.name = "jounce",
	.maxaddr = (haddr_t)1 << 62,
	.fc_degree = H5F_CLOSE_WEAK,
	.fapl_size = sizeof(Choice),
	.open = open_driver,
	.close = close_driver,
	.query = query,
	.get_eoa = get_allocated,
	.set_eoa = set_allocated,
	.get_eof = get_end,
	.read = read_bytes,
	.write = write_bytes,
	.truncate = truncate_file,
	.fl_map = H5FD_FLMAP_DICHOTOMY,
};

hid_t jn_h5_driver_choose(hid_t access_list, int* error) {
	const hid_t driver = H5FDregister(&driver_class);
	const Choice choice = {.error = error};
	if (driver >= 0 && H5Pset_driver(access_list, driver, &choice) >= 0) return driver;
	if (driver >= 0) H5FDunregister(driver);
	return H5I_INVALID_HID;
}
