// A virtual file driver over pread and pwrite, without the locks and the seeks of HDF5's own.
#include "record/h5_driver.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>

#include "record/h5_journal.h"

typedef struct Choice {
	JnH5Disk* disk;
} Choice;

typedef struct Driver {
	H5FD_t base; // HDF5's part, must be first
	JnH5Disk* disk;
	haddr_t allocated; // end of what HDF5 has given out
} Driver;

static H5FD_t* open_driver(const char* name, unsigned flags, hid_t access_list, haddr_t limit) {
	const Choice* choice = H5Pget_driver_info(access_list);
	Driver* driver = calloc(1, sizeof *driver);
	(void)limit;
	if (choice == NULL || driver == NULL) {
		if (choice != NULL && choice->disk->error == 0) choice->disk->error = ENOMEM;
		free(driver);
		return NULL;
	}
	const int writing = flags & H5F_ACC_RDWR ? O_RDWR : O_RDONLY;
	const int creating = (flags & H5F_ACC_CREAT ? O_CREAT : 0) | (flags & H5F_ACC_TRUNC ? O_TRUNC : 0) |
						 (flags & H5F_ACC_EXCL ? O_EXCL : 0);
	driver->disk = choice->disk;
	if (jn_h5_disk_open(choice->disk, name, writing | creating)) return &driver->base;
	free(driver);
	return NULL;
}

static herr_t close_driver(H5FD_t* base) {
	jn_h5_disk_close(((Driver*)base)->disk);
	free(base);
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
	return ((const Driver*)base)->disk->end;
}

static herr_t read_bytes(H5FD_t* base, H5FD_mem_t type, hid_t transfer, haddr_t address, size_t size, void* out) {
	(void)type, (void)transfer;
	jn_h5_disk_read(((Driver*)base)->disk, address, size, out);
	return 0;
}

static herr_t write_bytes(H5FD_t* base, H5FD_mem_t type, hid_t transfer, haddr_t address, size_t size,
						  const void* data) {
	(void)type, (void)transfer;
	jn_h5_disk_write(((Driver*)base)->disk, address, size, data);
	return 0;
}

static herr_t truncate_file(H5FD_t* base, hid_t transfer, hbool_t is_closing) {
	const Driver* driver = (const Driver*)base;
	(void)transfer, (void)is_closing;
	driver->disk->is_cut |= driver->disk->end != driver->allocated;
	driver->disk->end = driver->allocated;
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

hid_t jn_h5_driver_choose(hid_t access_list, JnH5Disk* disk) {
	const hid_t driver = H5FDregister(&driver_class);
	const Choice choice = {.disk = disk};
	if (driver >= 0 && H5Pset_driver(access_list, driver, &choice) >= 0) return driver;
	if (driver >= 0) H5FDunregister(driver);
	return H5I_INVALID_HID;
}
