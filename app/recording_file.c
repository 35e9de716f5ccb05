#include "recording_file.h"

#include <string.h>
#include <sys/stat.h>

#include "base/log.h"
#include "record/h5_driver.h"
#include "record/text_file.h"

hid_t recording_file_enter(const char* path) {
	return jn_h5_recover(path) == JN_OK ? H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT) : -1;
}

JnStatus recording_file_open(const char* folder, RecordingRead* read, void* user, hid_t* file) {
	char path[JN_PATH_SIZE];
	H5E_auto2_t printer = NULL;
	void* printer_data = NULL;
	*file = -1;
	JN_TRY(jn_path_join(folder, "run.h5", path));
	H5Eget_auto2(H5E_DEFAULT, &printer, &printer_data);
	H5Eset_auto2(H5E_DEFAULT, NULL, NULL); // the words are ours
	*file = recording_file_enter(path);
	const JnStatus status = *file < 0 ? JN_IO_FAILED : read(*file, user);
	H5Eset_auto2(H5E_DEFAULT, printer, printer_data);
	if (status != JN_IO_FAILED) return status;
	return jn_error(status, "%s: is no whole recording of a run; remove its folder to run it again", path);
}

void recording_file_fold(char** name) {
	static char here[] = ".";
	struct stat facts;
	char* slash = strrchr(*name, '/');
	if (strcmp(slash != NULL ? slash + 1 : *name, "run.h5") != 0) return;
	if (stat(*name, &facts) == 0 && S_ISDIR(facts.st_mode)) return;
	if (slash == NULL)
		*name = here;
	else
		slash[slash == *name ? 1 : 0] = '\0';
}

void recording_file_close(hid_t* file) {
	if (*file >= 0) H5Fclose(*file);
	*file = -1;
}

/// Is there one value, and not an array of them? Closes the space.
static bool is_single(hid_t space) {
	const bool is = H5Sget_simple_extent_npoints(space) == 1;
	H5Sclose(space);
	return is;
}

JnStatus recording_file_attribute(hid_t file, const char* object, const char* name, hid_t type, void* value) {
	const hid_t attribute = H5Aopen_by_name(file, object, name, H5P_DEFAULT, H5P_DEFAULT);
	if (attribute < 0) return JN_IO_FAILED;
	const herr_t outcome = is_single(H5Aget_space(attribute)) ? H5Aread(attribute, type, value) : -1;
	H5Aclose(attribute);
	return outcome < 0 ? JN_IO_FAILED : JN_OK;
}

// Texts have variable length: HDF5 makes room for them.
static herr_t read_text(hid_t object, bool is_attribute, hid_t type, char** text) {
	*text = NULL;
	if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) <= 0) return -1;
	if (!is_single(is_attribute ? H5Aget_space(object) : H5Dget_space(object))) return -1;
	return is_attribute ? H5Aread(object, type, text) : H5Dread(object, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text);
}

JnStatus recording_file_text(hid_t file, const char* object, const char* attribute, JnArena* arena, char** text) {
	char* read = NULL;
	const bool is_attribute = attribute != NULL;
	const hid_t source = is_attribute ? H5Aopen_by_name(file, object, attribute, H5P_DEFAULT, H5P_DEFAULT)
									  : H5Dopen2(file, object, H5P_DEFAULT);
	if (source < 0) return JN_IO_FAILED;
	const hid_t type = is_attribute ? H5Aget_type(source) : H5Dget_type(source);
	const herr_t outcome = read_text(source, is_attribute, type, &read);
	H5Tclose(type);
	is_attribute ? H5Aclose(source) : H5Dclose(source);
	if (outcome < 0 || read == NULL) return JN_IO_FAILED;
	*text = jn_arena_text(arena, read);
	H5free_memory(read);
	return *text != NULL ? JN_OK : JN_OUT_OF_MEMORY;
}

JnStatus recording_file_visit(hid_t file, const char* group, H5L_iterate_t visit, void* user) {
	const hid_t id = H5Gopen2(file, group, H5P_DEFAULT);
	if (id < 0) return JN_IO_FAILED;
	const herr_t outcome = H5Literate(id, H5_INDEX_NAME, H5_ITER_INC, NULL, visit, user);
	H5Gclose(id);
	return outcome < 0 ? JN_IO_FAILED : JN_OK;
}

/// Bytes that the numbers of a dataset can come from. No filter of HDF5's own makes more of a byte than zlib, 1032 of one.
static hsize_t bytes_behind(hid_t dataset) {
	enum { MOST_OF_A_BYTE = 1032 };
	const hid_t layout = H5Dget_create_plist(dataset);
	const bool is_filtered = H5Pget_nfilters(layout) > 0;
	H5Pclose(layout);
	return H5Dget_storage_size(dataset) * (is_filtered ? MOST_OF_A_BYTE : 1);
}

RecordingSize recording_file_size(hid_t file, const char* name) {
	RecordingSize size = {.entries = -1};
	const hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT);
	if (dataset < 0) return size;
	const hid_t space = H5Dget_space(dataset), type = H5Dget_type(dataset);
	size.entries = H5Sget_simple_extent_npoints(space);
	size.most = (hssize_t)(bytes_behind(dataset) / H5Tget_size(type));
	H5Tclose(type);
	H5Sclose(space);
	H5Dclose(dataset);
	return size;
}

hssize_t recording_file_measure(hid_t file, const char* name) {
	const RecordingSize size = recording_file_size(file, name);
	return size.entries <= size.most ? size.entries : -1;
}

hssize_t recording_file_links(hid_t file, const char* group) {
	H5G_info_t facts;
	return H5Gget_info_by_name(file, group, &facts, H5P_DEFAULT) >= 0 ? (hssize_t)facts.nlinks : -1;
}

JnStatus recording_file_array(hid_t file, const char* name, hid_t type, hssize_t count, void* data) {
	const hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT);
	if (dataset < 0) return JN_IO_FAILED;
	const hid_t space = H5Dget_space(dataset);
	const bool fits = H5Sget_simple_extent_npoints(space) == count;
	const herr_t outcome = fits ? H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) : -1;
	H5Sclose(space);
	H5Dclose(dataset);
	return outcome < 0 ? JN_IO_FAILED : JN_OK;
}
