// HDF5's C API with one way to fail. Files stay readable by HDF5 1.8 and later.
#include "record/h5_file.h"

#include <errno.h>
#include <string.h>

#include "base/log.h"

enum { CHUNK_LENGTH = 1024, REASON_BYTES = 256 };
enum { METADATA_BYTES = 256 << 10 };        // as in the file; in memory a frame's headers take ten times as much
enum { CACHE_SLOTS = 7, CACHE_CHUNKS = 2 }; // of each data set that grows: it is written at its end, and never read

// The innermost record knows the reason.
static herr_t copy_reason(unsigned depth, const H5E_error2_t* record, void* out) {
	if (depth == 0 && record->desc != NULL) snprintf(out, REASON_BYTES, "%s", record->desc);
	return 0;
}

static JnStatus failure_of(const JnH5File* file) {
	return file->disk.error == ENOMEM ? JN_OUT_OF_MEMORY : JN_IO_FAILED;
}

static JnStatus fail(JnH5File* file, const char* what) {
	char reason[REASON_BYTES] = "HDF5 gives no reason";
	H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, copy_reason, reason);
	file->is_broken = true;
	const int error = file->disk.error;
	return jn_error(failure_of(file), "%s: cannot write %s: %s", file->path, what,
					error == EWOULDBLOCK ? "another run writes to it; wait for it, or choose another folder"
					: error != 0         ? strerror(error)
										 : reason);
}

static JnStatus judge(JnH5File* file, bool is_good, const char* what) {
	return is_good && file->disk.error == 0 ? JN_OK : fail(file, what);
}

typedef enum Opening { CREATE, GO_ON, REHEARSE } Opening;

// HDF5 would keep 32 MiB of headers of frames, which nobody reads again.
static bool limit_metadata(hid_t access) {
	H5AC_cache_config_t config = {.version = H5AC__CURR_CACHE_CONFIG_VERSION};
	if (H5Pget_mdc_config(access, &config) < 0) return false;
	config.set_initial_size = 1;
	config.initial_size = config.min_size = config.max_size = METADATA_BYTES;
	return H5Pset_mdc_config(access, &config) >= 0;
}

static JnStatus open_file(JnH5File* file, const char* directory, const char* name, Opening opening) {
	*file = (JnH5File){.id = H5I_INVALID_HID, .link_list = H5I_INVALID_HID, .driver = H5I_INVALID_HID};
	JN_TRY(jn_path_join(directory, name, file->path));
	if (opening == GO_ON) JN_TRY(jn_h5_recover(file->path));
	H5Eget_auto2(H5E_DEFAULT, &file->printer, &file->printer_data);
	H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
	file->link_list = H5Pcreate(H5P_LINK_CREATE);
	const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
	file->disk.is_rehearsal = opening == REHEARSE;
	file->driver = jn_h5_driver_choose(access, &file->disk);
	const bool is_ready = file->driver >= 0 && file->link_list >= 0 && access >= 0 &&
						  H5Pset_create_intermediate_group(file->link_list, 1) >= 0 &&
						  H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_LATEST) >= 0 &&
						  limit_metadata(access) &&
						  H5Pset_cache(access, 0, CACHE_SLOTS, CACHE_CHUNKS * CHUNK_LENGTH * sizeof(double), 1) >= 0 &&
						  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG) >= 0;
	if (is_ready && opening == CREATE) file->id = H5Fcreate(file->path, H5F_ACC_TRUNC, H5P_DEFAULT, access);
	if (is_ready && opening != CREATE) file->id = H5Fopen(file->path, H5F_ACC_RDWR, access);
	const JnStatus status = judge(file, file->id >= 0, "the file");
	H5Pclose(access);
	if (status != JN_OK) jn_h5_close(file);
	return status;
}

JnStatus jn_h5_create(JnH5File* file, const char* directory, const char* name) {
	return open_file(file, directory, name, CREATE);
}

JnStatus jn_h5_open(JnH5File* file, const char* directory, const char* name) {
	return open_file(file, directory, name, GO_ON);
}

JnStatus jn_h5_open_rehearsal(JnH5File* file, const char* directory, const char* name) {
	return open_file(file, directory, name, REHEARSE);
}

JnStatus jn_h5_find(JnH5File* file, const char* name, bool* is_found) {
	*is_found =
		H5Lexists(file->id, name, H5P_DEFAULT) > 0; // below 0 where the group that should have it is not there either
	return judge(file, true, name);
}

JnStatus jn_h5_remove(JnH5File* file, const char* name) {
	return judge(file, H5Ldelete(file->id, name, H5P_DEFAULT) >= 0, name);
}

JnStatus jn_h5_group(JnH5File* file, const char* name) {
	const hid_t group = H5Gcreate2(file->id, name, file->link_list, H5P_DEFAULT, H5P_DEFAULT);
	return judge(file, group >= 0 && H5Gclose(group) >= 0, name);
}

// Create, write and close a dataset over `space`, which is closed too.
static bool write_dataset(JnH5File* file, const char* name, hid_t file_type, hid_t memory_type, hid_t space,
						  const void* data) {
	const bool is_empty = H5Sget_simple_extent_npoints(space) == 0;
	const hid_t dataset = H5Dcreate2(file->id, name, file_type, space, file->link_list, H5P_DEFAULT, H5P_DEFAULT);
	const bool is_written =
		dataset >= 0 && (is_empty || H5Dwrite(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0);
	H5Sclose(space);
	return is_written && H5Dclose(dataset) >= 0;
}

JnStatus jn_h5_array(JnH5File* file, const char* name, hid_t file_type, hid_t memory_type, int rank,
					 const hsize_t dims[], const void* data) {
	const hid_t space = H5Screate_simple(rank, dims, NULL);
	return judge(file, space >= 0 && write_dataset(file, name, file_type, memory_type, space, data), name);
}

// Texts of variable length: h5py and h5wasm read them as strings.
static hid_t make_text_type(void) {
	const hid_t type = H5Tcopy(H5T_C_S1);
	H5Tset_size(type, H5T_VARIABLE);
	H5Tset_cset(type, H5T_CSET_UTF8);
	return type;
}

JnStatus jn_h5_text(JnH5File* file, const char* name, const char* text) {
	const hid_t type = make_text_type();
	const hid_t space = H5Screate(H5S_SCALAR);
	const JnStatus status = judge(file, space >= 0 && write_dataset(file, name, type, type, space, &text), name);
	H5Tclose(type);
	return status;
}

// The object stays open meanwhile: HDF5 1.10 cannot rewrite what H5Aopen_by_name opened.
static bool write_attribute_of(hid_t object, const char* key, hid_t file_type, hid_t memory_type, const void* value) {
	hid_t attribute = H5I_INVALID_HID;
	const htri_t exists = H5Aexists(object, key);
	if (exists > 0) attribute = H5Aopen(object, key, H5P_DEFAULT);
	if (exists == 0) {
		const hid_t space = H5Screate(H5S_SCALAR);
		attribute = H5Acreate2(object, key, file_type, space, H5P_DEFAULT, H5P_DEFAULT);
		H5Sclose(space);
	}
	const bool is_written = attribute >= 0 && H5Awrite(attribute, memory_type, value) >= 0;
	return is_written && H5Aclose(attribute) >= 0;
}

static JnStatus write_attribute(JnH5File* file, const char* name, const char* key, hid_t file_type, hid_t memory_type,
								const void* value) {
	const hid_t object = H5Oopen(file->id, name, H5P_DEFAULT);
	const bool is_written = object >= 0 && write_attribute_of(object, key, file_type, memory_type, value);
	const JnStatus status = judge(file, is_written, key);
	if (object >= 0) H5Oclose(object);
	return status;
}

JnStatus jn_h5_attribute_text(JnH5File* file, const char* name, const char* key, const char* value) {
	const hid_t type = make_text_type();
	const JnStatus status = write_attribute(file, name, key, type, type, &value);
	H5Tclose(type);
	return status;
}

JnStatus jn_h5_attribute_real(JnH5File* file, const char* name, const char* key, double value) {
	return write_attribute(file, name, key, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}

JnStatus jn_h5_attribute_integer(JnH5File* file, const char* name, const char* key, int64_t value) {
	return write_attribute(file, name, key, H5T_STD_I64LE, H5T_NATIVE_INT64, &value);
}

JnStatus jn_h5_extendible(JnH5File* file, const char* name, hid_t file_type, hid_t* dataset) {
	const hsize_t length = 0, limit = H5S_UNLIMITED, chunk = CHUNK_LENGTH;
	const hid_t space = H5Screate_simple(1, &length, &limit);
	const hid_t layout = H5Pcreate(H5P_DATASET_CREATE);
	H5Pset_chunk(layout, 1, &chunk);
	*dataset = H5Dcreate2(file->id, name, file_type, space, file->link_list, layout, H5P_DEFAULT);
	const JnStatus status = judge(file, *dataset >= 0, name);
	H5Pclose(layout);
	H5Sclose(space);
	return status;
}

JnStatus jn_h5_reopen(JnH5File* file, const char* name, hsize_t length, hid_t* dataset) {
	hsize_t found[H5S_MAX_RANK];
	*dataset = H5Dopen2(file->id, name, H5P_DEFAULT);
	const hid_t space = *dataset >= 0 ? H5Dget_space(*dataset) : H5I_INVALID_HID;
	const int rank = space >= 0 ? H5Sget_simple_extent_dims(space, found, NULL) : -1;
	if (space >= 0) H5Sclose(space);
	JN_TRY(judge(file, rank >= 0, name));
	if (rank != 1 || found[0] < length)
		return jn_error(JN_BAD_INPUT,
						"%s: %s has fewer than the %llu rows that the checkpoint tells of; it is that of another run",
						file->path, name, (unsigned long long)length);
	return judge(file, H5Dset_extent(*dataset, &length) >= 0, name);
}

JnStatus jn_h5_append(JnH5File* file, hid_t dataset, hid_t memory_type, hsize_t length, hsize_t count,
					  const void* data) {
	const hsize_t new_length = length + count;
	if (H5Dset_extent(dataset, &new_length) < 0) return fail(file, "the series");
	const hid_t target = H5Dget_space(dataset);
	const hid_t source = H5Screate_simple(1, &count, NULL);
	const bool is_written = H5Sselect_hyperslab(target, H5S_SELECT_SET, &length, NULL, &count, NULL) >= 0 &&
							H5Dwrite(dataset, memory_type, source, target, H5P_DEFAULT, data) >= 0;
	const JnStatus status = judge(file, is_written, "the series");
	H5Sclose(source);
	H5Sclose(target);
	return status;
}

// What HDF5 flushes is a whole file; only as such does it reach the disk.
JnStatus jn_h5_flush(JnH5File* file) {
	JN_TRY(judge(file, H5Fflush(file->id, H5F_SCOPE_LOCAL) >= 0, "the file"));
	jn_h5_commit(&file->disk);
	return judge(file, true, "the file");
}

JnStatus jn_h5_sync(JnH5File* file) {
	JN_TRY(jn_h5_flush(file));
	jn_h5_sync_disk(&file->disk);
	return judge(file, true, "the file");
}

JnStatus jn_h5_close(JnH5File* file) {
	const bool is_closed = file->id < 0 || H5Fclose(file->id) >= 0;
	if (!file->is_broken) judge(file, is_closed, "the file");
	if (file->driver >= 0) H5FDunregister(file->driver);
	if (file->link_list >= 0) H5Pclose(file->link_list);
	H5Eset_auto2(H5E_DEFAULT, file->printer, file->printer_data);
	return file->is_broken ? failure_of(file) : JN_OK;
}
