// The recorders in the order in which they run, and the guard before them: what is not finite reaches no file.
#include "record/recorder.h"

#include <math.h>
#include <string.h>

#include "base/log.h"

extern const JnRecorderType jn_recorder_hdf5, jn_recorder_xdmf, jn_recorder_series, jn_recorder_summary,
	jn_recorder_plots;

// xdmf names what hdf5 has written; plots read what series has written.
const JnRecorderType* const jn_recorder_list[] = {
	&jn_recorder_hdf5, &jn_recorder_xdmf, &jn_recorder_series, &jn_recorder_summary, &jn_recorder_plots, NULL,
};

static JnStatus check_nodes(const double* vector, int node_count, const char* what, const char* unit, double t) {
	for (size_t i = 0; i < 3 * (size_t)node_count; i++) {
		if (isfinite(vector[i])) continue;
		return jn_error(JN_NOT_FINITE, "the %s of node %zu is %g %s along %c at t = %g s; it was not recorded", what,
						i / 3, vector[i], unit, "xyz"[i % 3], t);
	}
	return JN_OK;
}

static JnStatus check_values(const JnRecordInfo* info, const JnRecordStep* step) {
	for (int i = 0; step->values != NULL && i < info->column_count; i++) {
		if (isfinite(step->values[i])) continue;
		return jn_error(JN_NOT_FINITE, "the value of %s is %g at step %ld, t = %g s; it was not recorded",
						info->columns[i].name, step->values[i], step->step, step->t);
	}
	return JN_OK;
}

// Names become links in run.h5 and words in series.csv.
static JnStatus check_name(const char* noun, const char* name) {
	const bool is_reserved = strcmp(name, ".") == 0 || strcmp(name, "nodes") == 0;
	if (name[0] != '\0' && !is_reserved && strpbrk(name, "/,\"\n\r") == NULL) return JN_OK;
	return jn_error(
		JN_BAD_INPUT,
		"the %s cannot be recorded under the name \"%s\"; give it one without / , \" or line breaks that is "
		"not \"nodes\" or \".\"",
		noun, name);
}

static JnStatus check_info(const JnRecordInfo* info) {
	for (int i = 0; i < info->body_count; i++) JN_TRY(check_name("body", info->bodies[i].name));
	for (int i = 0; i < info->column_count; i++) JN_TRY(check_name("column", info->columns[i].name));
	return check_nodes(info->nodes, info->node_count, "rest position", "m", 0);
}

JnStatus jn_recorders_open(JnRecorders* recorders, JnArena* arena, const JnRecordInfo* info) {
	int count = 0;
	while (jn_recorder_list[count] != NULL) count++;
	*recorders = (JnRecorders){0};
	JN_TRY(check_info(info));
	JN_NEW(arena, recorders->list, count);
	for (int i = 0; i < count; i++) {
		const JnRecorderType* type = jn_recorder_list[i];
		JnRecorder* recorder = jn_arena_take(arena, 1, type->size);
		JnStatus status = JN_OUT_OF_MEMORY;
		if (recorder != NULL) {
			*recorder = (JnRecorder){.type = type, .info = info};
			status = type->open(recorder, info);
		}
		if (status != JN_OK) {
			jn_recorders_close(recorders, &(JnRecordEnd){.outcome = "failed", .message = "a recorder could not start"});
			return status;
		}
		recorders->list[recorders->count++] = recorder;
	}
	return JN_OK;
}

JnStatus jn_recorders_write(JnRecorders* recorders, const JnRecordStep* step) {
	if (recorders->count == 0) return JN_OK;
	const JnRecordInfo* info = recorders->list[0]->info;
	JN_TRY(check_values(info, step));
	if (step->is_frame) {
		JN_TRY(check_nodes(step->x, info->node_count, "position", "m", step->t));
		JN_TRY(check_nodes(step->v, info->node_count, "velocity", "m/s", step->t));
	}
	for (int i = 0; i < recorders->count; i++) JN_TRY(recorders->list[i]->type->write(recorders->list[i], step));
	return JN_OK;
}

JnStatus jn_recorders_close(JnRecorders* recorders, const JnRecordEnd* end) {
	JnStatus first = JN_OK;
	for (int i = 0; i < recorders->count; i++) {
		const JnStatus status = recorders->list[i]->type->close(recorders->list[i], end);
		if (first == JN_OK) first = status;
	}
	recorders->count = 0;
	return first;
}
