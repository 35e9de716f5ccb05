#include "recording.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/log.h"
#include "record/text_file.h"
#include "recording_part.h"

// ---- opening ----

static JnStatus find_file(const char* folder, Recording* recording) {
	char path[JN_PATH_SIZE];
	struct stat facts;
	if (stat(folder, &facts) != 0)
		return jn_error(JN_BAD_INPUT, "%s: there is no such folder; give one into which 'jounce run' has written",
						folder);
	if (S_ISDIR(facts.st_mode)) {
		JN_TRY(jn_path_join(folder, "run.h5", path));
		if (stat(path, &facts) != 0)
			return jn_error(JN_BAD_INPUT,
							"%s: there is no run.h5 in this folder; give one into which 'jounce run' has written",
							folder);
		folder = path;
	}
	recording->path = jn_arena_text(&recording->arena, folder);
	return recording->path != NULL ? JN_OK : JN_OUT_OF_MEMORY;
}

static JnStatus open_file(Recording* recording) {
	const JnStatus status = recording_file_enter(recording->path, &recording->file);
	if (status != JN_IO_FAILED) return status;
	if (recording_file_is_hdf5(recording->path))
		return jn_error(
			JN_BAD_INPUT,
			"%s: the recording is cut short, damaged, or open elsewhere; copy it anew or run the scene again",
			recording->path);
	return jn_error(JN_BAD_INPUT, "%s: this is no HDF5 file, so no recording; give what 'jounce run' has written",
					recording->path);
}

static JnStatus read_all(Recording* recording) {
	const bool is_one = recording_has(recording, "/mesh/nodes") && recording_has(recording, "/frames");
	if (recording_file_has_failed(recording->file)) return JN_BAD_INPUT;
	if (!is_one)
		return jn_error(
			JN_BAD_INPUT,
			"%s: this HDF5 file is no recording: it has no /mesh/nodes and /frames; give what 'jounce run' has written",
			recording->path);
	JN_TRY(recording_read_facts(recording));
	JN_TRY(recording_read_bodies(recording));
	JN_TRY(recording_read_obstacles(recording));
	return recording_read_frames(recording);
}

JnStatus recording_open(const char* folder, Recording* recording) {
	*recording = (Recording){0};
	JN_TRY(find_file(folder, recording));
	JN_TRY(open_file(recording));
	JN_TRY(read_all(recording));
	return recording_file_has_failed(recording->file) ? JN_BAD_INPUT
													  : JN_OK; // what may be missing is not asked for twice
}

void recording_close(Recording* recording) {
	recording_file_close(&recording->file);
	jn_arena_free(&recording->arena);
}

int recording_up(const Recording* recording, bool* is_down) {
	int up = 1;
	for (int a = 0; a < 3; ++a)
		if (fabs(recording->gravity[a]) > fabs(recording->gravity[up])) up = a;
	*is_down = recording->gravity[up] > 0;
	return up;
}

// ---- reading frames ----

static JnStatus read_numbers(const Recording* recording, int frame, const char* name, size_t count, double* values) {
	char object[512];
	snprintf(object, sizeof object, "/frames/%08d/%s", frame, name);
	if (recording_file_array(recording->file, object, RECORDING_REAL, (int64_t)count, values) != JN_OK)
		return recording_damaged(recording, object);
	for (size_t i = 0; i < count; ++i)
		if (!isfinite(values[i]))
			return jn_error(JN_BAD_INPUT, "%s: %s holds %g; run the scene again", recording->path, object, values[i]);
	return JN_OK;
}

JnStatus recording_positions(const Recording* recording, int frame, double* x) {
	return read_numbers(recording, frame, "position", 3 * (size_t)recording->node_count, x);
}

JnStatus recording_velocities(const Recording* recording, int frame, double* v) {
	return read_numbers(recording, frame, "velocity", 3 * (size_t)recording->node_count, v);
}

JnStatus recording_points(const Recording* recording, int frame, double* points) {
	const char* name = recording->has_embedding ? "surface" : "position";
	return read_numbers(recording, frame, name, 3 * (size_t)recording->point_count, points);
}

static void carry(const RecordingBody* body, int components, const double* nodes, double* points) {
	for (int i = 0; i < body->point_count * components; ++i) {
		const size_t first = (size_t)(i / components) * (size_t)body->carrier_count;
		points[i] = 0;
		for (size_t k = first; k < first + (size_t)body->carrier_count; ++k)
			points[i] += body->weights[k] * nodes[(ptrdiff_t)body->carriers[k] * components + i % components];
	}
}

void recording_at_points(const Recording* recording, int components, const double* nodes, double* points) {
	if (!recording->has_embedding) {
		memcpy(points, nodes, (size_t)components * (size_t)recording->node_count * sizeof *points);
		return;
	}
	for (int i = 0; i < recording->body_count; ++i) {
		const RecordingBody* body = &recording->bodies[i];
		double* to = points + (ptrdiff_t)body->first_point * components;
		if (body->is_embedded)
			carry(body, components, nodes, to);
		else
			memcpy(to, nodes + (ptrdiff_t)body->first_node * components,
				   (size_t)components * (size_t)body->point_count * sizeof *to);
	}
}

JnStatus recording_field(const Recording* recording, int frame, int field, double* values) {
	const RecordingField* known = &recording->fields[field];
	return read_numbers(recording, frame, known->name, (size_t)known->components * (size_t)recording->node_count,
						values);
}

JnStatus recording_series(const Recording* recording, int column, double* values) {
	char object[512];
	snprintf(object, sizeof object, "/series/%s", recording->columns[column].name);
	if (recording_file_array(recording->file, object, RECORDING_REAL, recording->step_count, values) == JN_OK)
		return JN_OK;
	return recording_damaged(recording, object);
}
