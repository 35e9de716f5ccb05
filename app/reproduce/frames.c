// The layout of run.h5 is told in src/record/hdf5.c.
#include "reproduce/frames.h"

#include <math.h>
#include <stdio.h>

#include "base/log.h"
#include "record/text_file.h"

static JnStatus read_attribute(hid_t file, const char* object, const char* name, hid_t type, void* value) {
	const hid_t attribute = H5Aopen_by_name(file, object, name, H5P_DEFAULT, H5P_DEFAULT);
	if (attribute < 0) return JN_IO_FAILED;
	const herr_t outcome = H5Aread(attribute, type, value);
	H5Aclose(attribute);
	return outcome < 0 ? JN_IO_FAILED : JN_OK;
}

// Into `data`, which has room for `count` numbers.
static JnStatus read_into(hid_t file, const char* name, hid_t type, hssize_t count, void* data) {
	const hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT);
	if (dataset < 0) return JN_IO_FAILED;
	const hid_t space = H5Dget_space(dataset);
	const bool fits = H5Sget_simple_extent_npoints(space) == count;
	const herr_t outcome = fits ? H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) : -1;
	H5Sclose(space);
	H5Dclose(dataset);
	return outcome < 0 ? JN_IO_FAILED : JN_OK;
}

static hssize_t measure(hid_t file, const char* name) {
	const hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT);
	if (dataset < 0) return -1;
	const hid_t space = H5Dget_space(dataset);
	const hssize_t count = H5Sget_simple_extent_npoints(space);
	H5Sclose(space);
	H5Dclose(dataset);
	return count;
}

static JnStatus read_times(Frames* frames) {
	JN_TRY(read_attribute(frames->file, "/frames", "count", H5T_NATIVE_INT, &frames->count));
	if (frames->count < 1) return JN_IO_FAILED;
	JN_NEW(&frames->arena, frames->times, frames->count);
	for (int i = 0; i < frames->count; ++i) {
		char group[64];
		snprintf(group, sizeof group, "/frames/%08d", i);
		JN_TRY(read_attribute(frames->file, group, "time", H5T_NATIVE_DOUBLE, &frames->times[i]));
	}
	return JN_OK;
}

static JnStatus read_surface(Frames* frames) {
	const hid_t file = frames->file;
	const bool is_carried = H5Lexists(file, "/frames/00000000/surface", H5P_DEFAULT) > 0;
	const hssize_t numbers = measure(file, "/topology/surface");
	const hssize_t points = is_carried ? measure(file, "/frames/00000000/surface") : 3 * (hssize_t)frames->node_count;
	if (numbers < 0 || points < 0) return JN_IO_FAILED;
	frames->are_nodes = !is_carried;
	frames->point_count = (int)(points / 3);
	frames->triangle_count = (int)(numbers / 3);
	JN_NEW(&frames->arena, frames->triangles, numbers + 1);
	JN_NEW(&frames->arena, frames->bodies, frames->triangle_count + 1);
	JN_TRY(read_into(file, "/topology/surface", H5T_NATIVE_INT, numbers, frames->triangles));
	JN_TRY(read_into(file, "/topology/surface_body", H5T_NATIVE_INT, numbers / 3, frames->bodies));
	for (hssize_t i = 0; i < numbers; ++i)
		if (frames->triangles[i] < 0 || frames->triangles[i] >= frames->point_count) return JN_IO_FAILED;
	return JN_OK;
}

static JnStatus read_file(Frames* frames) {
	const hssize_t numbers = measure(frames->file, "/mesh/nodes");
	if (numbers < 3) return JN_IO_FAILED;
	frames->node_count = (int)(numbers / 3);
	JN_NEW(&frames->arena, frames->rest, numbers);
	JN_TRY(read_into(frames->file, "/mesh/nodes", H5T_NATIVE_DOUBLE, numbers, frames->rest));
	JN_TRY(read_times(frames));
	return read_surface(frames);
}

JnStatus frames_open(const char* folder, Frames* frames) {
	char path[JN_PATH_SIZE];
	H5E_auto2_t printer = NULL;
	void* printer_data = NULL;
	*frames = (Frames){.file = -1};
	JN_TRY(jn_path_join(folder, "run.h5", path));
	H5Eget_auto2(H5E_DEFAULT, &printer, &printer_data);
	H5Eset_auto2(H5E_DEFAULT, NULL, NULL); // the words are ours
	frames->file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
	const JnStatus status = frames->file < 0 ? JN_IO_FAILED : read_file(frames);
	H5Eset_auto2(H5E_DEFAULT, printer, printer_data);
	if (status != JN_IO_FAILED) return status;
	return jn_error(status, "%s: is no whole recording of a run; remove its folder to run it again", path);
}

void frames_close(Frames* frames) {
	if (frames->file >= 0) H5Fclose(frames->file);
	frames->file = -1;
	jn_arena_free(&frames->arena);
}

int frames_nearest(const Frames* frames, double t) {
	int nearest = 0;
	for (int i = 1; i < frames->count; ++i)
		if (fabs(frames->times[i] - t) < fabs(frames->times[nearest] - t)) nearest = i;
	return nearest;
}

JnStatus frames_read(const Frames* frames, int frame, double* points) {
	char name[80];
	snprintf(name, sizeof name, "/frames/%08d/%s", frame, frames->are_nodes ? "position" : "surface");
	const JnStatus status = read_into(frames->file, name, H5T_NATIVE_DOUBLE, 3 * (hssize_t)frames->point_count, points);
	return status == JN_OK ? status : jn_error(status, "frame %d of a recording cannot be read", frame);
}
