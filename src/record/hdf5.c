// run.h5: everything of a run in one file.
//
//   /mesh/nodes [n,3]            rest positions [m]        /frames/00000000/position [n,3]  [m]
//   /mesh/<body>/...             see body.c                /frames/00000000/velocity [n,3]  [m/s]
//   /mesh/<body>/surface/...     see surface.c             /frames/00000000/surface [p,3]   [m], if one is embedded
//   /topology/cells, body        all bodies, for XDMF      /series/<column> [steps]         one value a step
//   /topology/surface, ..._body  their triangles           attributes of /: who, where, when, outcome
//   /obstacles/<name>/..., /topology/obstacle...: see obstacles.c, if there are any
//   /gravity [3]                 [m/s^2]
//   /scene                       the scene file's text     /frames/00000000/<field> [n,3] or [n], its unit an attribute
#include <stdlib.h>

#include "base/guard.h"
#include "base/log.h"
#include "base/timer.h"
#include "record/body.h"
#include "record/h5_file.h"
#include "record/host.h"
#include "record/obstacles.h"
#include "record/recorder.h"
#include "record/surface.h"
#include "record/topology.h"

enum { BUFFERED_STEPS = 256 };

typedef struct Hdf5 {
	JnRecorder base;
	JnH5File file;
	hid_t* datasets; // one a column
	double* values;  // [column][BUFFERED_STEPS]
	int64_t* counts; // BUFFERED_STEPS, for the columns that are counts
	double* points;  // positions of the surfaces' points; NULL when they are the nodes
	int buffered;    // steps in `values`
	hsize_t length;  // steps in the file
	long frame_count;
	double flushed; // clock at the last flush of the series [s]
} Hdf5;

// What XDMF shows: the cells of all bodies in one array, and the number of its body for each.
static JnStatus write_topology(JnH5File* file, const JnRecordInfo* info) {
	JnTopology topology;
	JN_TRY(jn_topology_create(&topology, info));
	const int rank = topology.is_mixed ? 1 : 2;
	const hsize_t cells[2] = {(hsize_t)topology.rows, (hsize_t)topology.row_length};
	const hsize_t bodies[1] = {(hsize_t)topology.cell_count};
	JnStatus status = jn_h5_array(file, "/topology/cells", H5T_STD_I32LE, H5T_NATIVE_INT, rank, cells, topology.cells);
	if (status == JN_OK) {
		status = jn_h5_array(file, "/topology/body", H5T_STD_I32LE, H5T_NATIVE_INT, 1, bodies, topology.bodies);
	}
	jn_topology_destroy(&topology);
	return status;
}

static JnStatus write_mesh(JnH5File* file, const JnRecordInfo* info) {
	const hsize_t dims[2] = {(hsize_t)info->node_count, 3};
	JN_TRY(jn_h5_array(file, "/mesh/nodes", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, 2, dims, info->nodes));
	JN_TRY(jn_h5_attribute_text(file, "/mesh/nodes", "unit", "m"));
	JN_TRY(jn_record_bodies_write(file, info));
	JN_TRY(write_topology(file, info));
	JN_TRY(jn_record_surface_write(file, info));
	return jn_record_obstacles_write(file, info);
}

static JnStatus write_facts(JnH5File* file, const JnRecordInfo* info) {
	const JnHost host = jn_host_describe();
	char machine[512], created[32];
	snprintf(machine, sizeof machine, "%s: %s, %d cores, %s", host.name, host.processor, host.cores, host.system);
	jn_host_time(created);
	const char* const texts[][2] = {
		{"jounce_version", JN_VERSION},
		{"scene_name", info->scene_name},
		{"scene_path", info->scene_path},
		{"method", info->method},
		{"host", machine},
		{"blas", info->blas},
		{"created", created},
		{"outcome", "running"},
	};
	for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
		JN_TRY(jn_h5_attribute_text(file, "/", texts[i][0], texts[i][1]));
	}
	JN_TRY(jn_h5_attribute_integer(file, "/", "threads", info->threads));
	JN_TRY(jn_h5_attribute_integer(file, "/", "simd_width", info->simd_width));
	JN_TRY(jn_h5_attribute_real(file, "/", "total_mass", info->total_mass));
	const hsize_t axes = 3;
	JN_TRY(jn_h5_array(file, "/gravity", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, 1, &axes, info->gravity));
	JN_TRY(jn_h5_attribute_text(file, "/gravity", "unit", "m/s^2"));
	return jn_h5_text(file, "/scene", info->scene_text);
}

static JnStatus create_series(Hdf5* hdf5, const JnRecordInfo* info) {
	JN_TRY(jn_h5_group(&hdf5->file, "/series"));
	for (int i = 0; i < info->column_count; i++) {
		const JnColumn* column = &info->columns[i];
		char name[512];
		snprintf(name, sizeof name, "/series/%s", column->name);
		const hid_t type = column->is_count ? H5T_STD_I64LE : H5T_IEEE_F64LE;
		JN_TRY(jn_h5_extendible(&hdf5->file, name, type, &hdf5->datasets[i]));
		JN_TRY(jn_h5_attribute_text(&hdf5->file, name, "unit", column->unit));
	}
	return JN_OK;
}

static JnStatus write_start(Hdf5* hdf5, const JnRecordInfo* info) {
	JnH5File* file = &hdf5->file;
	JN_TRY(write_facts(file, info));
	JN_TRY(write_mesh(file, info));
	JN_TRY(jn_h5_group(file, "/frames"));
	JN_TRY(jn_h5_attribute_integer(file, "/frames", "count", 0));
	JN_TRY(create_series(hdf5, info));
	return jn_h5_flush(file);
}

static void free_buffers(Hdf5* hdf5) {
	free(hdf5->datasets);
	free(hdf5->values);
	free(hdf5->counts);
	free(hdf5->points);
}

static JnStatus take_buffers(Hdf5* hdf5, const JnRecordInfo* info) {
	const size_t columns = (size_t)info->column_count + 1; // never a malloc of nothing
	const bool has_points = jn_record_has_embedding(info);
	hdf5->datasets = malloc(columns * sizeof *hdf5->datasets);
	hdf5->values = malloc(columns * BUFFERED_STEPS * sizeof *hdf5->values);
	hdf5->counts = malloc(BUFFERED_STEPS * sizeof *hdf5->counts);
	if (has_points) hdf5->points = malloc((3 * (size_t)jn_record_points(info) + 1) * sizeof *hdf5->points);
	if (hdf5->datasets != NULL && hdf5->values != NULL && hdf5->counts != NULL && has_points == (hdf5->points != NULL))
		return JN_OK;
	return jn_error(JN_OUT_OF_MEMORY, "out of memory: no room for the series and surfaces of run.h5");
}

static JnStatus open_hdf5(JnRecorder* recorder, const JnRecordInfo* info) {
	Hdf5* hdf5 = (Hdf5*)recorder;
	JnStatus status = take_buffers(hdf5, info);
	if (status == JN_OK) status = jn_h5_create(&hdf5->file, info->directory, "run.h5");
	if (status == JN_OK) {
		status = write_start(hdf5, info);
		if (status != JN_OK) jn_h5_close(&hdf5->file);
	}
	if (status != JN_OK) free_buffers(hdf5);
	hdf5->flushed = jn_seconds();
	return status;
}

static void archive_hdf5(JnRecorder* recorder, JnArchive* archive) {
	Hdf5* hdf5 = (Hdf5*)recorder;
	long rows = (long)hdf5->length + hdf5->buffered;
	jn_archive_long(archive, "run.h5 frames", &hdf5->frame_count);
	jn_archive_long(archive, "run.h5 rows", &rows);
	hdf5->length = (hsize_t)rows - (hsize_t)hdf5->buffered;
}

static void name_frame(char name[64], long frame) {
	snprintf(name, 64, "/frames/%08ld", frame);
}

// Frames and rows that come after those noted go: they will be written again.
static JnStatus cut(Hdf5* hdf5, const JnRecordInfo* info) {
	JnH5File* file = &hdf5->file;
	char name[512];
	bool is_found = true;
	name_frame(name, hdf5->frame_count - 1);
	if (hdf5->frame_count > 0) JN_TRY(jn_h5_find(file, name, &is_found));
	if (!is_found)
		return jn_error(JN_BAD_INPUT,
						"%s: has fewer than the %ld frames that the checkpoint tells of; it is that of another run",
						file->path, hdf5->frame_count);
	for (long frame = hdf5->frame_count;; frame++) {
		name_frame(name, frame);
		JN_TRY(jn_h5_find(file, name, &is_found));
		if (!is_found) break;
		JN_TRY(jn_h5_remove(file, name));
	}
	for (int i = 0; i < info->column_count; i++) {
		snprintf(name, sizeof name, "/series/%s", info->columns[i].name);
		JN_TRY(jn_h5_reopen(file, name, hdf5->length, &hdf5->datasets[i]));
	}
	JN_TRY(jn_h5_attribute_integer(file, "/frames", "count", hdf5->frame_count));
	JN_TRY(jn_h5_attribute_text(file, "/", "outcome", "running"));
	JN_TRY(jn_h5_attribute_text(file, "/", "message", ""));
	return jn_h5_flush(file);
}

static JnStatus append_series(Hdf5* hdf5) {
	const JnRecordInfo* info = hdf5->base.info;
	const hsize_t count = (hsize_t)hdf5->buffered;
	for (int i = 0; i < info->column_count && count > 0; i++) {
		const double* values = hdf5->values + (size_t)i * BUFFERED_STEPS;
		const bool is_count = info->columns[i].is_count;
		for (int k = 0; is_count && k < hdf5->buffered; k++) hdf5->counts[k] = (int64_t)values[k];
		const void* data = is_count ? (const void*)hdf5->counts : values;
		const hid_t type = is_count ? H5T_NATIVE_INT64 : H5T_NATIVE_DOUBLE;
		JN_TRY(jn_h5_append(&hdf5->file, hdf5->datasets[i], type, hdf5->length, count, data));
	}
	hdf5->length += count;
	hdf5->buffered = 0;
	hdf5->flushed = jn_seconds();
	return JN_OK;
}

static JnStatus write_points(Hdf5* hdf5, const char* group, const double* x) {
	if (hdf5->points == NULL) return JN_OK;
	const hsize_t dims[2] = {(hsize_t)jn_record_points(hdf5->base.info), 3};
	char name[80];
	snprintf(name, sizeof name, "%s/surface", group);
	jn_record_surface_positions(hdf5->base.info, x, hdf5->points);
	return jn_h5_array(&hdf5->file, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, 2, dims, hdf5->points);
}

static JnStatus write_fields(Hdf5* hdf5, const char* group, const double* const* fields) {
	const JnRecordInfo* info = hdf5->base.info;
	for (int i = 0; i < info->field_count; i++) {
		const JnField* field = &info->fields[i];
		const hsize_t dims[2] = {(hsize_t)info->node_count, (hsize_t)field->components};
		const int rank = field->components > 1 ? 2 : 1;
		char name[512];
		snprintf(name, sizeof name, "%s/%s", group, field->name);
		JN_TRY(jn_h5_array(&hdf5->file, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, rank, dims, fields[i]));
		JN_TRY(jn_h5_attribute_text(&hdf5->file, name, "unit", field->unit));
	}
	return JN_OK;
}

static JnStatus write_frame(Hdf5* hdf5, const JnRecordStep* step) {
	JnH5File* file = &hdf5->file;
	const hsize_t dims[2] = {(hsize_t)hdf5->base.info->node_count, 3};
	char group[64], position[80], velocity[80];
	name_frame(group, hdf5->frame_count);
	snprintf(position, sizeof position, "%s/position", group);
	snprintf(velocity, sizeof velocity, "%s/velocity", group);
	JN_TRY(jn_h5_array(file, position, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, 2, dims, step->x));
	JN_TRY(jn_h5_array(file, velocity, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, 2, dims, step->v));
	JN_TRY(write_points(hdf5, group, step->x));
	JN_TRY(write_fields(hdf5, group, step->fields));
	JN_TRY(jn_h5_attribute_real(file, group, "time", step->t));
	JN_TRY(jn_h5_attribute_integer(file, group, "step", step->step));
	hdf5->frame_count++;
	return jn_h5_attribute_integer(file, "/frames", "count", hdf5->frame_count);
}

static void buffer_row(Hdf5* hdf5, int column_count, const double* values) {
	for (int i = 0; i < column_count; i++) hdf5->values[i * BUFFERED_STEPS + hdf5->buffered] = values[i];
	hdf5->buffered++;
}

static JnStatus write_hdf5(JnRecorder* recorder, const JnRecordStep* step) {
	Hdf5* hdf5 = (Hdf5*)recorder;
	if (step->values != NULL) buffer_row(hdf5, recorder->info->column_count, step->values);
	const bool is_due = hdf5->buffered == BUFFERED_STEPS || jn_seconds() - hdf5->flushed >= 1;
	if (is_due) JN_TRY(append_series(hdf5));
	if (step->is_frame) JN_TRY(write_frame(hdf5, step));
	return is_due || step->is_frame ? jn_h5_flush(&hdf5->file) : JN_OK;
}

static JnStatus sync_hdf5(JnRecorder* recorder) {
	Hdf5* hdf5 = (Hdf5*)recorder;
	JN_TRY(append_series(hdf5));
	return jn_h5_sync(&hdf5->file);
}

static JnStatus write_end(Hdf5* hdf5, const JnRecordEnd* end) {
	JN_TRY(append_series(hdf5));
	JN_TRY(jn_h5_attribute_text(&hdf5->file, "/", "outcome", end->outcome));
	JN_TRY(jn_h5_attribute_text(&hdf5->file, "/", "message", end->message));
	return jn_h5_flush(&hdf5->file);
}

static JnStatus write_zeros(Hdf5* hdf5, const JnRecordInfo* info, const double* zeros, const double** fields) {
	for (int i = 0; i < info->field_count; i++) fields[i] = zeros;
	buffer_row(hdf5, info->column_count, zeros);
	JN_TRY(append_series(hdf5));
	JN_TRY(write_frame(hdf5, &(JnRecordStep){.x = zeros, .v = zeros, .fields = fields}));
	return write_end(hdf5, &(JnRecordEnd){.outcome = "interrupted", .message = "a line of words"});
}

// HDF5 crashes on some damaged files. So what is to come is first tried in a child process that leaves the file as it is: the recording
// is cut, and gets a row, a frame and an end. The recorder is the child's own copy.
static JnStatus rehearse(void* user, FILE* result) {
	Hdf5* hdf5 = user;
	const JnRecordInfo* info = hdf5->base.info;
	(void)result;
	JN_TRY(take_buffers(hdf5, info));
	JN_TRY(jn_h5_open_rehearsal(&hdf5->file, info->directory, "run.h5"));
	JN_TRY(cut(hdf5, info));
	double* zeros = calloc(3 * (size_t)info->node_count + (size_t)info->column_count + 1, sizeof *zeros);
	const double** fields = calloc((size_t)info->field_count + 1, sizeof *fields);
	const JnStatus status = zeros != NULL && fields != NULL
								? write_zeros(hdf5, info, zeros, fields)
								: jn_error(JN_OUT_OF_MEMORY, "out of memory: no room to try run.h5");
	free(fields);
	free(zeros);
	JN_TRY(status);
	return jn_h5_close(&hdf5->file);
}

static JnStatus try_to_go_on(Hdf5* hdf5, const JnRecordInfo* info) {
	const size_t frame = 24 * (size_t)(info->node_count + jn_record_points(info)); // bytes of a vector for each
	const JnGuardLimits limits = {.memory = ((size_t)1 << 30) + 8 * frame,
								  .seconds = 60 + (int)(frame >> 20),
								  .remedy = "it is damaged: run the scene again"};
	char path[JN_PATH_SIZE];
	FILE* result;
	hdf5->base.info = info;
	JN_TRY(jn_path_join(info->directory, "run.h5", path));
	JN_TRY(jn_h5_recover(path));
	JN_TRY(jn_guard_run(path, limits, rehearse, hdf5, &result));
	fclose(result);
	return JN_OK;
}

static JnStatus resume_hdf5(JnRecorder* recorder, const JnRecordInfo* info, JnArchive* archive) {
	Hdf5* hdf5 = (Hdf5*)recorder;
	archive_hdf5(recorder, archive);
	JN_TRY(archive->status);
	JN_TRY(try_to_go_on(hdf5, info));
	JnStatus status = take_buffers(hdf5, info);
	if (status == JN_OK) status = jn_h5_open(&hdf5->file, info->directory, "run.h5");
	if (status == JN_OK) {
		status = cut(hdf5, info);
		if (status != JN_OK) jn_h5_close(&hdf5->file);
	}
	if (status != JN_OK) free_buffers(hdf5);
	hdf5->flushed = jn_seconds();
	return status;
}

static JnStatus close_hdf5(JnRecorder* recorder, const JnRecordEnd* end) {
	Hdf5* hdf5 = (Hdf5*)recorder;
	if (!hdf5->file.is_broken) write_end(hdf5, end);
	const JnStatus status = jn_h5_close(&hdf5->file);
	free_buffers(hdf5);
	return status;
}

const JnRecorderType jn_recorder_hdf5 = {
	.name = "hdf5",
	.doc = "run.h5: mesh, frames, series and scene",
	.size = sizeof(Hdf5),
	.open = open_hdf5,
	.write = write_hdf5,
	.close = close_hdf5,
	.resume = resume_hdf5,
	.archive = archive_hdf5,
	.sync = sync_hdf5,
};
