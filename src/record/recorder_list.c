// The recorders in the order in which they run, and the guard before them: what is not finite reaches no file.
#include "record/recorder.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "base/log.h"

extern const JnRecorderType jn_recorder_hdf5, jn_recorder_xdmf, jn_recorder_obstacles, jn_recorder_series,
	jn_recorder_summary, jn_recorder_plots;

// xdmf and obstacles name what hdf5 has written; plots read what series has written.
const JnRecorderType* const jn_recorder_list[] = {
	&jn_recorder_hdf5,
	&jn_recorder_xdmf,
	&jn_recorder_obstacles,
	&jn_recorder_series,
	&jn_recorder_summary,
	&jn_recorder_plots,
	NULL,
};

// What to do about numbers that are none, or beyond all bounds.
static const char* remedy(double t) {
	return t > 0 ? "Try a smaller step.dt, or a more robust method (backward_euler)"
				 : "Look at the sizes, velocities and materials of the scene";
}

static JnStatus check_nodes(const double* numbers, int node_count, JnField field, double t) {
	const size_t components = (size_t)field.components;
	for (size_t i = 0; i < components * (size_t)node_count; i++) {
		if (isfinite(numbers[i])) continue;
		char axis[] = " along x";
		axis[sizeof axis - 2] = "xyz"[i % components];
		return jn_error(JN_NOT_FINITE, "the %s of node %zu is %g %s%s at t = %g s; it was not recorded. %s", field.name,
						i / components, numbers[i], field.unit, components > 1 ? axis : "", t, remedy(t));
	}
	return JN_OK;
}

static JnStatus check_frame(const JnRecordInfo* info, const JnRecordStep* step) {
	assert(info->field_count == 0 || step->fields != NULL);
	JN_TRY(check_nodes(step->x, info->node_count, (JnField){"position", "m", 3}, step->t));
	JN_TRY(check_nodes(step->v, info->node_count, (JnField){"velocity", "m/s", 3}, step->t));
	for (int i = 0; i < info->field_count; i++)
		JN_TRY(check_nodes(step->fields[i], info->node_count, info->fields[i], step->t));
	return JN_OK;
}

static JnStatus check_values(const JnRecordInfo* info, const JnRecordStep* step) {
	for (int i = 0; step->values != NULL && i < info->column_count; i++) {
		if (isfinite(step->values[i])) continue;
		return jn_error(JN_NOT_FINITE, "the value of %s is %g at step %ld, t = %g s; it was not recorded. %s",
						info->columns[i].name, step->values[i], step->step, step->t, remedy(step->t));
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

// A field becomes a dataset of each frame.
static JnStatus check_field(const JnRecordInfo* info, int index) {
	static const char* const taken[] = {"position", "velocity", "surface"};
	const char* name = info->fields[index].name;
	assert(info->fields[index].components == 1 || info->fields[index].components == 3);
	JN_TRY(check_name("field", name));
	bool is_taken = false;
	for (size_t i = 0; i < sizeof taken / sizeof *taken; i++) is_taken |= strcmp(name, taken[i]) == 0;
	for (int i = 0; i < index; i++) is_taken |= strcmp(name, info->fields[i].name) == 0;
	if (!is_taken) return JN_OK;
	return jn_error(JN_BAD_INPUT, "the field \"%s\" cannot be recorded: frames have one of that name; use another",
					name);
}

static JnStatus check_info(const JnRecordInfo* info) {
	for (int i = 0; i < info->body_count; i++) JN_TRY(check_name("body", info->bodies[i].name));
	for (int i = 0; i < info->obstacle_count; i++) JN_TRY(check_name("obstacle", info->obstacles[i].name));
	for (int i = 0; i < info->column_count; i++) JN_TRY(check_name("column", info->columns[i].name));
	for (int i = 0; i < info->field_count; i++) JN_TRY(check_field(info, i));
	return check_nodes(info->nodes, info->node_count, (JnField){"rest position", "m", 3}, 0);
}

static JnStatus start(JnRecorder* recorder, const JnRecordInfo* info, JnArchive* resumed) {
	if (resumed == NULL || recorder->type->resume == NULL) return recorder->type->open(recorder, info);
	return recorder->type->resume(recorder, info, resumed);
}

JnStatus jn_recorders_open(JnRecorders* recorders, JnArena* arena, const JnRecordInfo* info, JnArchive* resumed) {
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
			status = start(recorder, info, resumed);
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
	if (step->is_frame) JN_TRY(check_frame(info, step));
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

void jn_recorders_archive(JnRecorders* recorders, JnArchive* archive) {
	for (int i = 0; i < recorders->count; i++)
		if (recorders->list[i]->type->archive != NULL) recorders->list[i]->type->archive(recorders->list[i], archive);
}

JnStatus jn_recorders_sync(JnRecorders* recorders) {
	for (int i = 0; i < recorders->count; i++)
		if (recorders->list[i]->type->sync != NULL) JN_TRY(recorders->list[i]->type->sync(recorders->list[i]));
	return JN_OK;
}
