#include "view_field.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/log.h"
#include "recording_part.h"

static const char energy_name[] = "strain_energy_density", stress_name[] = "stress";

enum { COMPUTED_FIELDS = 3 };

// ---- the list ----

// What stands in the first frame beside position, velocity and surface.
static JnStatus list_recorded(ViewRun* run) {
	const Recording* recording = &run->recording;
	if (run->frame_count > 0) JN_TRY(recording_read_fields(&run->recording));
	JN_NEW(&run->arena, run->fields, recording->field_count + COMPUTED_FIELDS);
	for (int i = 0; i < recording->field_count; ++i) {
		ViewField* field = &run->fields[run->field_count++];
		field->components = recording->fields[i].components;
		snprintf(field->name, sizeof field->name, "%s", recording->fields[i].name);
		snprintf(field->unit, sizeof field->unit, "%s", recording->fields[i].unit);
	}
	return JN_OK;
}

// What can be told without building the model.
static void add_elastic(ViewRun* run) {
	bool has_volume = false, has_surface = false, has_solid = false, has_bonds = false;
	for (int b = 0; b < run->body_count; ++b) {
		const ViewBody* body = &run->bodies[b];
		const bool is_volume = strncmp(body->shape, "tet", 3) == 0 || strncmp(body->shape, "hex", 3) == 0;
		has_volume |= is_volume;
		has_surface |= strncmp(body->shape, "tri", 3) == 0;
		has_solid |= is_volume && body->kind != VIEW_THREAD;
	}
	for (int i = 0; i < run->field_count; ++i) has_bonds |= strcmp(run->fields[i].name, "damage") == 0;
	ViewField* energy = &run->fields[run->field_count++];
	ViewField* stress = &run->fields[run->field_count++];
	snprintf(energy->name, sizeof energy->name, "%s", energy_name);
	snprintf(energy->unit, sizeof energy->unit, has_volume || !has_surface ? "J/m³" : "J/m²");
	if (!has_volume && !has_surface)
		snprintf(energy->absent, sizeof energy->absent,
				 has_bonds ? "which bonds are whole is not recorded" : "no body with elements");
	snprintf(stress->name, sizeof stress->name, "%s", stress_name);
	snprintf(stress->unit, sizeof stress->unit, "Pa");
	if (!has_solid) snprintf(stress->absent, sizeof stress->absent, "no solid elements");
}

JnStatus view_fields_list(ViewRun* run) {
	JN_TRY(list_recorded(run));
	run->fields[run->field_count++] = (ViewField){.name = "speed", .unit = "m/s", .components = 3};
	add_elastic(run);
	return JN_OK;
}

// ---- values ----

static void keep_reason(void* user, JnLogLevel level, const char* message) {
	ViewRun* run = user;
	if (level == JN_LOG_ERROR) snprintf(run->elastic_reason, sizeof run->elastic_reason, "%s", message);
}

static JnStatus build_elastic(ViewRun* run) {
	const Recording* recording = &run->recording;
	return view_elastic_open(&run->elastic, recording->scene_path, recording->scene_text, recording->node_count,
							 recording->rest);
}

static JnStatus prepare_elastic(ViewRun* run) {
	if (run->has_tried_elastic) return run->elastic.buffer != NULL ? JN_OK : JN_BAD_INPUT;
	const JnLog log = jn_log_swap((JnLog){keep_reason, run});
	const JnStatus status = build_elastic(run);
	jn_log_swap(log);
	run->has_tried_elastic = true;
	if (status == JN_OK) return JN_OK;
	view_elastic_close(&run->elastic);
	if (run->elastic_reason[0] == '\0')
		snprintf(run->elastic_reason, sizeof run->elastic_reason, "the model cannot be built: %s",
				 jn_status_name(status));
	for (int i = 0; i < run->field_count; ++i)
		if (run->fields[i].components == 0 && run->fields[i].absent[0] == '\0')
			snprintf(run->fields[i].absent, sizeof run->fields[i].absent, "%s", run->elastic_reason);
	return JN_BAD_INPUT;
}

// values at nodes, into run->values
static JnStatus compute(ViewRun* run, const char* name, long frame) {
	JN_TRY(prepare_elastic(run));
	JN_TRY(view_run_read(run, frame, "position", run->recording.node_count, 3, run->scratch));
	(strcmp(name, stress_name) == 0 ? view_elastic_stress : view_elastic_energy)(&run->elastic, run->scratch,
																				 run->values);
	return JN_OK;
}

static JnStatus look_up(ViewRun* run, const ViewField* field, long frame) {
	const char* dataset = strcmp(field->name, "speed") == 0 ? "velocity" : field->name;
	JN_TRY(view_run_read(run, frame, dataset, run->recording.node_count, field->components, run->scratch));
	for (int i = 0; i < run->recording.node_count; ++i) {
		const double* at = run->scratch + (ptrdiff_t)field->components * i;
		run->values[i] = field->components == 3 ? hypot(hypot(at[0], at[1]), at[2]) : at[0];
	}
	return JN_OK;
}

// What no bond holds has no piece, number -1, and no damage either.
static JnStatus hide_the_unbonded(ViewRun* run, long frame) {
	JN_TRY(view_run_read(run, frame, "fragment", run->recording.node_count, 1, run->scratch));
	for (int i = 0; i < run->recording.node_count; ++i)
		if (run->scratch[i] < 0) run->values[i] = VIEW_ABSENT;
	return JN_OK;
}

static bool is_of_bonds(const char* name) {
	return strcmp(name, "damage") == 0 || strcmp(name, "fragment") == 0;
}

JnStatus view_field_read(ViewRun* run, const char* name, long frame, float* out) {
	const ViewField* field = NULL;
	for (int i = 0; i < run->field_count; ++i)
		if (strcmp(run->fields[i].name, name) == 0) field = &run->fields[i];
	if (field == NULL || field->absent[0] != '\0') return JN_BAD_INPUT;
	JN_TRY(field->components > 0 ? look_up(run, field, frame) : compute(run, name, frame));
	if (is_of_bonds(name)) JN_TRY(hide_the_unbonded(run, frame));
	view_map_apply(&run->nodes, 1, run->values, out);
	for (int i = 0; i < run->points.count; ++i)
		if (out[i] < 0.01f * (float)VIEW_ABSENT) out[i] = (float)VIEW_ABSENT; // some of its nodes have no value
	return JN_OK;
}
