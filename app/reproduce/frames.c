#include "reproduce/frames.h"

#include <math.h>
#include <stdio.h>

#include "base/log.h"

static JnStatus read_times(Frames* frames) {
	JN_TRY(recording_file_attribute(frames->file, "/frames", "count", RECORDING_INTEGER, &frames->count));
	if (frames->count < 1) return JN_IO_FAILED;
	JN_NEW(&frames->arena, frames->times, frames->count);
	return recording_file_times(frames->file, 0, frames->count, frames->times);
}

static JnStatus read_surface(Frames* frames) {
	RecordingFile* file = frames->file;
	const bool is_carried = recording_file_has(file, "/frames/00000000/surface");
	const int64_t numbers = recording_file_measure(file, "/topology/surface");
	const int64_t points =
		is_carried ? recording_file_measure(file, "/frames/00000000/surface") : 3 * (int64_t)frames->node_count;
	if (numbers < 0 || points < 0) return JN_IO_FAILED;
	frames->are_nodes = !is_carried;
	frames->point_count = (int)(points / 3);
	frames->triangle_count = (int)(numbers / 3);
	JN_NEW(&frames->arena, frames->triangles, numbers + 1);
	JN_NEW(&frames->arena, frames->bodies, frames->triangle_count + 1);
	JN_TRY(recording_file_array(file, "/topology/surface", RECORDING_INTEGER, numbers, frames->triangles));
	JN_TRY(recording_file_array(file, "/topology/surface_body", RECORDING_INTEGER, numbers / 3, frames->bodies));
	for (int64_t i = 0; i < numbers; ++i)
		if (frames->triangles[i] < 0 || frames->triangles[i] >= frames->point_count) return JN_IO_FAILED;
	return JN_OK;
}

static JnStatus read_obstacles(Frames* frames) {
	RecordingFile* file = frames->file;
	JnSurface* surface = &frames->obstacles;
	if (!recording_file_has(file, "/topology/obstacle_points")) return JN_OK;
	const int64_t points = recording_file_measure(file, "/topology/obstacle_points");
	const int64_t corners = recording_file_measure(file, "/topology/obstacle_triangles");
	if (points < 0 || corners < 0) return JN_IO_FAILED;
	surface->node_count = (int)(points / 3);
	surface->triangle_count = (int)(corners / 3);
	JN_NEW(&frames->arena, surface->nodes, points + 1);
	JN_NEW(&frames->arena, surface->triangles, corners + 1);
	JN_TRY(recording_file_array(file, "/topology/obstacle_points", RECORDING_REAL, points, surface->nodes));
	JN_TRY(recording_file_array(file, "/topology/obstacle_triangles", RECORDING_INTEGER, corners, surface->triangles));
	for (int64_t i = 0; i < corners; ++i)
		if (surface->triangles[i] < 0 || surface->triangles[i] >= surface->node_count) return JN_IO_FAILED;
	return JN_OK;
}

static JnStatus read_file(RecordingFile* file, void* user) {
	Frames* frames = user;
	const int64_t numbers = recording_file_measure(file, "/mesh/nodes");
	if (numbers < 3) return JN_IO_FAILED;
	frames->node_count = (int)(numbers / 3);
	JN_NEW(&frames->arena, frames->rest, numbers);
	JN_TRY(recording_file_array(file, "/mesh/nodes", RECORDING_REAL, numbers, frames->rest));
	JN_TRY(read_times(frames));
	JN_TRY(read_surface(frames));
	return read_obstacles(frames);
}

JnStatus frames_open(const char* folder, Frames* frames) {
	*frames = (Frames){0};
	return recording_file_open(folder, read_file, frames, &frames->file);
}

void frames_close(Frames* frames) {
	recording_file_close(&frames->file);
	jn_arena_free(&frames->arena);
}

int frames_nearest(const Frames* frames, double t) {
	int nearest = 0;
	for (int i = 1; i < frames->count; ++i)
		if (fabs(frames->times[i] - t) < fabs(frames->times[nearest] - t)) nearest = i;
	return nearest;
}

static JnStatus read_numbers(const Frames* frames, int frame, const char* what, int64_t count, double* numbers) {
	char name[160];
	snprintf(name, sizeof name, "/frames/%08d/%s", frame, what);
	const JnStatus status = recording_file_array(frames->file, name, RECORDING_REAL, count, numbers);
	return status == JN_OK ? status : jn_error(status, "%s in frame %d of a recording cannot be read", what, frame);
}

JnStatus frames_read(const Frames* frames, int frame, double* points) {
	const char* what = frames->are_nodes ? "position" : "surface";
	return read_numbers(frames, frame, what, 3 * (int64_t)frames->point_count, points);
}

JnStatus frames_read_nodes(const Frames* frames, int frame, double* positions) {
	return read_numbers(frames, frame, "position", 3 * (int64_t)frames->node_count, positions);
}

JnStatus frames_read_field(const Frames* frames, int frame, const char* field, double* values) {
	return read_numbers(frames, frame, field, frames->node_count, values);
}
