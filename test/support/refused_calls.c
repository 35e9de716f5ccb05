// What closes something closes it before it says that it has failed, as close(2) does. Nothing reaches the disk sooner than
// the system likes: a test cannot see the difference, but it takes its time.
#include "support/refused_calls.h"

#include <errno.h>
#include <fcntl.h>
#include <hdf5.h>
#include <spawn.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

static int counted_kinds;
static long count, refused;
static const char *culprit, *last; // the name of the last one counted
static pid_t process;              // calls of its children are neither counted nor refused

void refused_call_set(int kinds, long number) {
	counted_kinds = kinds;
	count = 0;
	refused = number;
	culprit = last = NULL;
	process = getpid();
}

long refused_call_count(void) {
	return count;
}

const char* refused_call_name(void) {
	return culprit;
}

static bool refuses(CallKind kind, const char* name) {
	if ((counted_kinds & (int)kind) == 0 || getpid() != process) return false;
	const bool follows = kind == CALL_BYTES && name == last;
	last = name;
	if (follows || ++count != refused) return false;
	culprit = name;
	errno = EIO;
	return true;
}

#define REFUSED(kind, result, name, failure, parameters, arguments)                                                    \
	result __real_##name parameters;                                                                                   \
	result __wrap_##name parameters;                                                                                   \
	result __wrap_##name parameters {                                                                                  \
		return refuses(kind, #name) ? (failure) : __real_##name arguments;                                             \
	}

#define CLOSED(kind, result, name, failure, parameters, arguments)                                                     \
	result __real_##name parameters;                                                                                   \
	result __wrap_##name parameters;                                                                                   \
	result __wrap_##name parameters {                                                                                  \
		const result done = __real_##name arguments;                                                                   \
		return refuses(kind, #name) ? (failure) : done;                                                                \
	}

#define SYSTEM(...) REFUSED(CALL_SYSTEM, __VA_ARGS__)
#define BYTES(...) REFUSED(CALL_BYTES, __VA_ARGS__)
#define HDF5(...) REFUSED(CALL_HDF5, __VA_ARGS__)

BYTES(ssize_t, pwrite, -1, (int file, const void* data, size_t size, off_t at), (file, data, size, at))
BYTES(ssize_t, pread, -1, (int file, void* data, size_t size, off_t at), (file, data, size, at))
BYTES(int, vfprintf, -1, (FILE * file, const char* format, va_list values), (file, format, values))
SYSTEM(int, ftruncate, -1, (int file, off_t size), (file, size))
SYSTEM(int, fstat, -1, (int file, struct stat* facts), (file, facts))
SYSTEM(FILE*, fopen, NULL, (const char* path, const char* mode), (path, mode))
SYSTEM(int, fflush, EOF, (FILE * file), (file))
SYSTEM(size_t, fwrite, 0, (const void* data, size_t size, size_t number, FILE* file), (data, size, number, file))
SYSTEM(size_t, fread, 0, (void* data, size_t size, size_t number, FILE* file), (data, size, number, file))
SYSTEM(int, fseek, -1, (FILE * file, long at, int whence), (file, at, whence))
SYSTEM(int, rename, -1, (const char* from, const char* to), (from, to))
SYSTEM(int, mkdir, -1, (const char* path, mode_t mode), (path, mode))
SYSTEM(int, posix_spawn_file_actions_init, EIO, (posix_spawn_file_actions_t * actions), (actions))
SYSTEM(int, posix_spawn_file_actions_addopen, EIO,
	   (posix_spawn_file_actions_t * actions, int file, const char* path, int flags, mode_t mode),
	   (actions, file, path, flags, mode))
SYSTEM(int, posix_spawn_file_actions_adddup2, EIO, (posix_spawn_file_actions_t * actions, int from, int to),
	   (actions, from, to))
SYSTEM(int, posix_spawnp, EIO,
	   (pid_t * child, const char* name, const posix_spawn_file_actions_t* actions, const posix_spawnattr_t* attributes,
		char* const arguments[], char* const environment[]),
	   (child, name, actions, attributes, arguments, environment))
CLOSED(CALL_SYSTEM, pid_t, waitpid, -1, (pid_t child, int* outcome, int options), (child, outcome, options))
CLOSED(CALL_SYSTEM, int, close, -1, (int file), (file))
CLOSED(CALL_SYSTEM, int, fclose, EOF, (FILE * file), (file))

HDF5(hid_t, H5FDregister, -1, (const H5FD_class_t* type), (type))
HDF5(herr_t, H5Pset_driver, -1, (hid_t list, hid_t driver, const void* facts), (list, driver, facts))
HDF5(hid_t, H5Pcreate, -1, (hid_t type), (type))
HDF5(herr_t, H5Pset_create_intermediate_group, -1, (hid_t list, unsigned value), (list, value))
HDF5(herr_t, H5Pset_libver_bounds, -1, (hid_t list, H5F_libver_t low, H5F_libver_t high), (list, low, high))
HDF5(herr_t, H5Pget_mdc_config, -1, (hid_t list, H5AC_cache_config_t* config), (list, config))
HDF5(herr_t, H5Pset_cache, -1, (hid_t list, int a, size_t slots, size_t bytes, double w), (list, a, slots, bytes, w))
HDF5(herr_t, H5Pset_fclose_degree, -1, (hid_t list, H5F_close_degree_t degree), (list, degree))
HDF5(hid_t, H5Fcreate, -1, (const char* path, unsigned flags, hid_t a, hid_t b), (path, flags, a, b))
HDF5(hid_t, H5Fopen, -1, (const char* path, unsigned flags, hid_t list), (path, flags, list))
HDF5(herr_t, H5Fflush, -1, (hid_t file, H5F_scope_t scope), (file, scope))
HDF5(hid_t, H5Gcreate2, -1, (hid_t file, const char* name, hid_t a, hid_t b, hid_t c), (file, name, a, b, c))
HDF5(hid_t, H5Screate, -1, (H5S_class_t kind), (kind))
HDF5(hid_t, H5Screate_simple, -1, (int rank, const hsize_t* dims, const hsize_t* most), (rank, dims, most))
HDF5(herr_t, H5Sselect_hyperslab, -1,
	 (hid_t space, H5S_seloper_t how, const hsize_t* start, const hsize_t* stride, const hsize_t* number,
	  const hsize_t* block),
	 (space, how, start, stride, number, block))
HDF5(int, H5Sget_simple_extent_dims, -1, (hid_t space, hsize_t* dims, hsize_t* most), (space, dims, most))
HDF5(hid_t, H5Dcreate2, -1, (hid_t file, const char* name, hid_t type, hid_t space, hid_t a, hid_t b, hid_t c),
	 (file, name, type, space, a, b, c))
HDF5(hid_t, H5Dopen2, -1, (hid_t file, const char* name, hid_t list), (file, name, list))
HDF5(hid_t, H5Dget_space, -1, (hid_t data), (data))
HDF5(herr_t, H5Dset_extent, -1, (hid_t data, const hsize_t* size), (data, size))
HDF5(herr_t, H5Dwrite, -1, (hid_t data, hid_t type, hid_t memory, hid_t space, hid_t list, const void* from),
	 (data, type, memory, space, list, from))
HDF5(hid_t, H5Oopen, -1, (hid_t file, const char* name, hid_t list), (file, name, list))
HDF5(htri_t, H5Aexists, -1, (hid_t object, const char* name), (object, name))
HDF5(hid_t, H5Aopen, -1, (hid_t object, const char* name, hid_t list), (object, name, list))
HDF5(hid_t, H5Acreate2, -1, (hid_t object, const char* name, hid_t type, hid_t space, hid_t a, hid_t b),
	 (object, name, type, space, a, b))
HDF5(herr_t, H5Awrite, -1, (hid_t attribute, hid_t type, const void* from), (attribute, type, from))
HDF5(herr_t, H5Ldelete, -1, (hid_t file, const char* name, hid_t list), (file, name, list))
CLOSED(CALL_HDF5, herr_t, H5Fclose, -1, (hid_t file), (file))
CLOSED(CALL_HDF5, herr_t, H5Gclose, -1, (hid_t group), (group))
CLOSED(CALL_HDF5, herr_t, H5Dclose, -1, (hid_t data), (data))
CLOSED(CALL_HDF5, herr_t, H5Aclose, -1, (hid_t attribute), (attribute))

int __wrap_fsync(int file);
int __wrap_fdatasync(int file);
int __real_open(const char* path, int flags, ...);
int __wrap_open(const char* path, int flags, ...);

int __wrap_fsync(int file) {
	(void)file;
	return refuses(CALL_SYSTEM, "fsync") ? -1 : 0;
}

int __wrap_fdatasync(int file) {
	(void)file;
	return refuses(CALL_SYSTEM, "fdatasync") ? -1 : 0;
}

int __wrap_open(const char* path, int flags, ...) {
	va_list values;
	va_start(values, flags);
	const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(values, mode_t) : 0;
	va_end(values);
	return refuses(CALL_SYSTEM, "open") ? -1 : __real_open(path, flags, mode);
}
