#include "view_routes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/log.h"
#include "json.h"
#include "view_field.h"
#include "view_pack.h"
#include "view_page.h"

enum { HTTP_OK = 200, HTTP_NOT_FOUND = 404, HTTP_ABSENT = 409, HTTP_BROKEN = 500, HTTP_LATER = 503, NAME_BYTES = 80 };

static const char binary[] = "application/octet-stream", json[] = "application/json", words[] = "text/plain";

static void keep_error(void* user, JnLogLevel level, const char* message) {
	ViewSource* source = user;
	if (level == JN_LOG_ERROR) snprintf(source->error, sizeof source->error, "%s", message);
}

void view_source_open(ViewSource* source) {
	if (source->is_open) return;
	source->error[0] = '\0';
	const JnLog log = jn_log_swap((JnLog){keep_error, source});
	source->status = view_run_open(&source->run, source->folder);
	source->is_open = source->status == JN_OK;
	if (source->is_awaited && source->run.frame_count == 0) source->is_open = false; // its fields are not known yet
	if (!source->is_open) view_run_close(&source->run);
	jn_log_swap(log);
}

static void print_source(FILE* out, const ViewSource* source) {
	fputs("{", out);
	json_print_text_entry(out, "name", source->is_open ? source->run.recording.scene_name : source->folder);
	fputs("\"folder\": ", out);
	json_print_text(out, source->folder);
	if (!source->is_open) {
		fputs(", \"error\": ", out);
		json_print_text(out, source->is_awaited ? "" : source->error);
	}
	fputs("}", out);
}

static void answer_list(ViewSources* sources, ViewAnswer* answer) {
	FILE* out = open_memstream(&answer->data, &answer->size);
	if (out == NULL) return;
	fputs("{\"runs\": [", out);
	for (int i = 0; i < sources->count; ++i) {
		if (i > 0) fputs(",\n", out);
		view_source_open(&sources->list[i]);
		print_source(out, &sources->list[i]);
	}
	fputs("]}\n", out);
	answer->status = fclose(out) == 0 ? HTTP_OK : HTTP_BROKEN;
	answer->type = json;
}

static void answer_bytes(JnStatus status, const char* type, ViewBytes bytes, ViewAnswer* answer) {
	answer->status = status == JN_OK ? HTTP_OK : status == JN_BAD_INPUT ? HTTP_NOT_FOUND : HTTP_LATER;
	answer->type = status == JN_OK ? type : words;
	if (status == JN_OK)
		*answer = (ViewAnswer){.status = HTTP_OK, .type = type, .data = bytes.data, .size = bytes.size};
	else
		free(bytes.data);
}

// Numbers at the drawn points in one frame: a field, or positions when `field` is NULL.
static void answer_frame(ViewRun* run, const char* field, long frame, ViewAnswer* answer) {
	if (frame >= run->frame_count) view_run_refresh(run);
	if (frame < 0 || frame >= run->frame_count) return;
	const size_t components = field == NULL ? 3 : 1;
	float* numbers = malloc(((size_t)run->points.count * components + 1) * sizeof *numbers);
	if (numbers == NULL) return;
	const JnStatus status =
		field == NULL ? view_run_positions(run, frame, numbers) : view_field_read(run, field, frame, numbers);
	const size_t size = (size_t)run->points.count * components * sizeof *numbers;
	answer_bytes(status, binary, (ViewBytes){(char*)numbers, size}, answer);
	if (status == JN_BAD_INPUT && run->elastic_reason[0] != '\0') {
		answer->status = HTTP_ABSENT;
		answer->page = run->elastic_reason;
		answer->size = strlen(run->elastic_reason);
	}
}

static void answer_state(ViewRun* run, const char* known, ViewAnswer* answer) {
	ViewBytes bytes;
	view_run_refresh(run);
	const JnStatus status = view_pack_state(run, known != NULL ? strtol(known, NULL, 10) : 0, &bytes);
	answer_bytes(status, json, bytes, answer);
}

// What follows "/api/runs/<number>".
static void answer_run(ViewRun* run, const char* path, const char* known, ViewAnswer* answer) {
	ViewBytes bytes = {0};
	char name[NAME_BYTES];
	long frame;
	int end = 0;
	if (*path == '\0')
		answer_bytes(view_pack_run(run, &bytes), binary, bytes, answer);
	else if (strcmp(path, "/state") == 0)
		answer_state(run, known, answer);
	else if (strcmp(path, "/series") == 0)
		answer_bytes(view_pack_series(run, &bytes), binary, bytes, answer);
	else if (sscanf(path, "/frames/%9ld%n", &frame, &end) == 1 && path[end] == '\0')
		answer_frame(run, NULL, frame, answer);
	else if (sscanf(path, "/fields/%79[^/]/%9ld%n", name, &frame, &end) == 2 && path[end] == '\0')
		answer_frame(run, name, frame, answer);
}

static void answer_page(ViewAnswer* answer) {
	answer->page = view_page(&answer->size);
	answer->status = answer->page != NULL ? HTTP_OK : HTTP_NOT_FOUND;
	answer->type = "text/html; charset=utf-8";
}

// What is at "/api/runs/<number>...".
static void answer_source(ViewSources* sources, const char* path, const char* known, ViewAnswer* answer) {
	int index = -1, end = 0;
	if (sscanf(path, "/api/runs/%4d%n", &index, &end) != 1 || index < 0 || index >= sources->count) return;
	ViewSource* source = &sources->list[index];
	view_source_open(source);
	if (source->is_open)
		answer_run(&source->run, path + end, known, answer);
	else
		answer->status = HTTP_LATER;
}

void view_answer(void* user, const char* path, const char* (*query)(void* request, const char* name), void* request,
				 ViewAnswer* answer) {
	if (strcmp(path, "/") == 0)
		answer_page(answer);
	else if (strcmp(path, "/api/runs") == 0)
		answer_list(user, answer);
	else
		answer_source(user, path, query(request, "known"), answer);
}
