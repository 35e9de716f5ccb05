#include "render_sources.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "app.h"
#include "base/log.h"
#include "view_field.h"

static int open_one(ViewSource* source) {
	view_source_open(source);
	if (source->is_open && source->run.frame_count > 0) return EXIT_DONE;
	if (source->is_open)
		jn_error(JN_BAD_INPUT, "%s: has no frame yet; let the run go on", source->folder);
	else
		jn_error(JN_BAD_INPUT, "%s", source->error);
	return EXIT_BAD_INPUT;
}

int render_sources_open(int count, char** folders, ViewSources* sources) {
	*sources = (ViewSources){.list = calloc((size_t)count, sizeof *sources->list)};
	if (sources->list == NULL) return EXIT_RUN_FAILED;
	for (int i = 0; i < count; ++i) {
		sources->list[i] = (ViewSource){.folder = folders[i]};
		sources->count = i + 1;
		const int status = open_one(&sources->list[i]);
		if (status != EXIT_DONE) return status;
	}
	return EXIT_DONE;
}

void render_sources_close(ViewSources* sources) {
	for (int i = 0; i < sources->count; ++i) view_run_close(&sources->list[i].run);
	free(sources->list);
	*sources = (ViewSources){0};
}

// Some fields are computed, and only an attempt tells whether they can be.
static bool has_field(ViewRun* run, const char* field) {
	float* values = malloc(((size_t)run->points.count + 1) * sizeof *values);
	const bool is_read = values != NULL && view_field_read(run, field, run->frame_count - 1, values) == JN_OK;
	free(values);
	return is_read;
}

static JnStatus refuse(const ViewSources* sources, const char* field) {
	const ViewRun* run = &sources->list[0].run;
	char names[1024] = "displacement";
	for (int i = 0; i < run->field_count; ++i) {
		const size_t length = strlen(names);
		if (strcmp(run->fields[i].name, field) == 0 && run->elastic_reason[0] != '\0')
			return app_usage_error("render", "--color: %s: there is no %s: %s", run->folder, field,
								   run->elastic_reason);
		snprintf(names + length, sizeof names - length, ", %s", run->fields[i].name);
	}
	return jn_error(JN_BAD_INPUT, "--color: %s: there is no field '%s'; there are %s", run->folder, field, names);
}

int render_sources_check_field(ViewSources* sources, const char* field) {
	if (field == NULL || strcmp(field, "displacement") == 0) return EXIT_DONE;
	for (int i = 0; i < sources->count; ++i)
		if (has_field(&sources->list[i].run, field)) return EXIT_DONE;
	return app_exit_status(refuse(sources, field));
}
