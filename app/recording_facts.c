// The attributes of run.h5, the scene, the times of its frames, and what there is in them.
#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "base/log.h"
#include "recording_part.h"

JnStatus recording_read_facts(Recording* recording) {
	const struct {
		const char* name;
		const char** text;
	} texts[] = {
		{"scene_name", &recording->scene_name}, {"scene_path", &recording->scene_path},
		{"method", &recording->method},         {"host", &recording->host},
		{"created", &recording->created},       {"jounce_version", &recording->version},
		{"outcome", &recording->outcome},       {"message", &recording->message},
	};
	for (size_t i = 0; i < sizeof texts / sizeof *texts; ++i) {
		*texts[i].text = recording_attribute_text(recording, "/", texts[i].name, "");
		if (*texts[i].text == NULL) return JN_OUT_OF_MEMORY;
	}
	recording->scene_text = recording_attribute_text(recording, "/scene", NULL, "");
	recording_file_array(recording->file, "/gravity", RECORDING_REAL, 3, recording->gravity);
	recording_file_attribute(recording->file, "/", "total_mass", RECORDING_REAL, &recording->total_mass);
	return recording->scene_text != NULL ? JN_OK : JN_OUT_OF_MEMORY;
}

// ---- frames ----

static JnStatus read_times(Recording* recording) {
	double* times;
	JN_NEW(&recording->arena, times, recording->frame_count);
	if (recording_file_times(recording->file, 0, recording->frame_count, times) != JN_OK)
		return recording_damaged(recording, "the time of a frame in /frames");
	recording->times = times;
	return JN_OK;
}

/// What stands in the first frame beside position, velocity and surface.
JnStatus recording_read_fields(Recording* recording) {
	const char* const* names;
	RecordingField* fields;
	int count;
	JN_TRY(recording_names(recording, "/frames/00000000", &names, &count));
	JN_NEW(&recording->arena, fields, count + 1);
	for (int i = 0; i < count; ++i) {
		char object[512];
		snprintf(object, sizeof object, "/frames/00000000/%s", names[i]);
		const int64_t values = recording_file_measure(recording->file, object);
		const bool is_other =
			strcmp(names[i], "position") == 0 || strcmp(names[i], "velocity") == 0 || strcmp(names[i], "surface") == 0;
		if (is_other || values <= 0 || values % recording->node_count != 0) continue;
		const int64_t components = values / recording->node_count;
		const char* unit = recording_attribute_text(recording, object, "unit", "");
		if (unit == NULL) return JN_OUT_OF_MEMORY;
		if (components == 1 || components == 3)
			fields[recording->field_count++] = (RecordingField){names[i], unit, (int)components};
	}
	recording->fields = fields;
	return JN_OK;
}

static JnStatus read_columns(Recording* recording) {
	const char* const* names;
	RecordingColumn* columns;
	int64_t steps = 0;
	JN_TRY(recording_names(recording, "/series", &names, &recording->column_count));
	JN_NEW(&recording->arena, columns, recording->column_count + 1);
	for (int i = 0; i < recording->column_count; ++i) {
		char object[512];
		snprintf(object, sizeof object, "/series/%s", names[i]);
		columns[i] = (RecordingColumn){names[i], recording_attribute_text(recording, object, "unit", "")};
		if (columns[i].unit == NULL) return JN_OUT_OF_MEMORY;
		if (i == 0) steps = recording_file_measure(recording->file, object);
	}
	recording->columns = columns;
	recording->step_count = (int)steps;
	return steps >= 0 && steps <= INT_MAX ? JN_OK : recording_damaged(recording, "/series");
}

JnStatus recording_read_frames(Recording* recording) {
	JN_TRY(recording_attribute_count(recording, "/frames", "count", &recording->frame_count));
	if (recording->frame_count < 1)
		return jn_error(JN_BAD_INPUT, "%s: there are no frames yet; wait until the run has written one",
						recording->path);
	const int64_t frames = recording_file_links(recording->file, "/frames");
	if (recording_file_has_failed(recording->file)) return JN_BAD_INPUT;
	if (recording->frame_count > frames)
		return jn_error(JN_BAD_INPUT,
						"%s: /frames declares %d frames, but holds %lld: the recording is damaged; run the scene again",
						recording->path, recording->frame_count, (long long)frames);
	JN_TRY(read_times(recording));
	JN_TRY(recording_read_fields(recording));
	return read_columns(recording);
}
