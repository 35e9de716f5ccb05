#include "view_pack.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/log.h"
#include "json.h"

enum { ALIGNMENT = 8, FORMAT = 1, HEAD_BYTES = 8, MOST_ARRAYS = 512 };

typedef struct Array {
	char name[96];
	const char* type;
	const void* data;
	size_t bytes, at;
} Array;

typedef struct Pack {
	FILE* json;
	int count;
	Array arrays[MOST_ARRAYS];
	size_t bytes; // of all arrays
} Pack;

static size_t align(size_t size) {
	return (size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
}

static void add(Pack* pack, const char* name, const char* type, size_t count, const void* data) {
	if (pack->count == MOST_ARRAYS) return;
	Array* array = &pack->arrays[pack->count++];
	*array = (Array){.type = type, .data = data, .at = pack->bytes};
	array->bytes = count * (strcmp(type, "f64") == 0 ? 8 : 4);
	snprintf(array->name, sizeof array->name, "%s", name);
	pack->bytes += align(array->bytes);
}

static void print_arrays(const Pack* pack) {
	fputs("\"arrays\": {", pack->json);
	for (int i = 0; i < pack->count; ++i) {
		const Array* array = &pack->arrays[i];
		const size_t size = strcmp(array->type, "f64") == 0 ? 8 : 4;
		fputs(i > 0 ? ",\n" : "\n", pack->json);
		json_print_text(pack->json, array->name);
		fprintf(pack->json, ": {\"type\": \"%s\", \"at\": %zu, \"length\": %zu}", array->type, array->at,
				array->bytes / size);
	}
	fputs("}}\n", pack->json);
}

static void copy_arrays(const Pack* pack, char* out) {
	for (int i = 0; i < pack->count; ++i)
		if (pack->arrays[i].bytes > 0) memcpy(out + pack->arrays[i].at, pack->arrays[i].data, pack->arrays[i].bytes);
}

// The text and the arrays of a finished pack, one behind the other.
static JnStatus join(const Pack* pack, const char* text, size_t length, ViewBytes* out) {
	const size_t head = align(HEAD_BYTES + length);
	out->size = head + pack->bytes;
	out->data = calloc(out->size, 1);
	if (out->data == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: no room for what the page reads");
	const uint32_t padded = (uint32_t)(head - HEAD_BYTES);
	const unsigned char number[4] = {padded & 255, padded >> 8 & 255, padded >> 16 & 255, padded >> 24};
	memcpy(out->data, "JNPK", 4);
	memcpy(out->data + 4, number, 4);
	memset(out->data + HEAD_BYTES, ' ', padded);
	memcpy(out->data + HEAD_BYTES, text, length);
	copy_arrays(pack, out->data + head);
	return JN_OK;
}

typedef void PrintPack(Pack* pack, const void* user);

static JnStatus make(PrintPack* print, const void* user, ViewBytes* out) {
	char* text = NULL;
	size_t length = 0;
	*out = (ViewBytes){0};
	Pack* pack = calloc(1, sizeof *pack);
	if (pack != NULL) pack->json = open_memstream(&text, &length);
	if (pack == NULL || pack->json == NULL) {
		free(pack);
		return jn_error(JN_OUT_OF_MEMORY, "out of memory: no room for what the page reads");
	}
	fputs("{\n", pack->json);
	print(pack, user);
	print_arrays(pack);
	const bool is_written = fclose(pack->json) == 0;
	const JnStatus status = is_written ? join(pack, text, length, out) : JN_OUT_OF_MEMORY;
	free(text);
	free(pack);
	return status;
}

// ---- state ----

static void print_state(FILE* json, const ViewRun* run, long known) {
	json_print_integer_entry(json, "frame_count", run->frame_count);
	json_print_integer_entry(json, "first", known);
	fputs("\"times\": [", json);
	for (long i = known; i < run->frame_count; ++i) {
		if (i > known) fputc(',', json);
		json_print_real(json, run->times[i]);
	}
	fputs("],\n", json);
	json_print_text_entry(json, "outcome", run->recording.outcome);
	json_print_text_entry(json, "message", run->recording.message);
	fprintf(json, "\"is_running\": %s,\n", view_run_is_running(run) ? "true" : "false");
	fputs("\"summary\": ", json);
	json_print_text(json, run->summary); // as a text: what is in that file is none of ours
}

JnStatus view_pack_state(const ViewRun* run, long known, ViewBytes* out) {
	*out = (ViewBytes){0};
	FILE* json = open_memstream(&out->data, &out->size);
	if (json == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: no room for what the page reads");
	fputs("{\n", json);
	print_state(json, run, known < 0 ? 0 : known > run->frame_count ? run->frame_count : known);
	fputs("}\n", json);
	return fclose(json) == 0 ? JN_OK : JN_OUT_OF_MEMORY;
}

// ---- run ----

static void print_body(FILE* json, const ViewBody* body) {
	static const char* const kinds[] = {[VIEW_SURFACE] = "surface", [VIEW_THREAD] = "thread", [VIEW_POINTS] = "points"};
	fputs("{", json);
	json_print_text_entry(json, "name", body->name);
	json_print_text_entry(json, "shape", body->shape);
	json_print_text_entry(json, "kind", kinds[body->kind]);
	json_print_integer_entry(json, "nodes", body->node_count);
	json_print_integer_entry(json, "cells", body->cell_count);
	json_print_real_entry(json, "radius", body->radius);
	fprintf(json, "\"is_closed\": %s,\n\"points\": [%d, %d],\n\"triangles\": [%d, %d]}",
			body->is_closed ? "true" : "false", body->first_point, body->point_count, body->first_triangle,
			body->triangle_count);
}

static void print_shapes(FILE* json, const ViewRun* run) {
	fputs("\"bodies\": [", json);
	for (int b = 0; b < run->body_count; ++b) {
		if (b > 0) fputs(",\n", json);
		print_body(json, &run->bodies[b]);
	}
	fputs("],\n\"obstacles\": [", json);
	for (int i = 0; i < run->obstacle_count; ++i) {
		const ViewObstacle* obstacle = &run->obstacles[i];
		fputs(i > 0 ? ",\n{" : "{", json);
		json_print_text_entry(json, "name", obstacle->name);
		fprintf(json, "\"points\": [%d, %d], \"triangles\": [%d, %d]}", obstacle->first_point, obstacle->point_count,
				obstacle->first_triangle, obstacle->triangle_count);
	}
	fputs("],\n", json);
}

static void print_fields(FILE* json, const ViewRun* run) {
	fputs("\"fields\": [", json);
	for (int i = 0; i < run->field_count; ++i) {
		const ViewField* field = &run->fields[i];
		fputs(i > 0 ? ",\n{\"name\": " : "{\"name\": ", json);
		json_print_text(json, field->name);
		fputs(", \"unit\": ", json);
		json_print_text(json, field->unit);
		if (field->absent[0] != '\0') {
			fputs(", \"absent\": ", json);
			json_print_text(json, field->absent);
		}
		fputs("}", json);
	}
	fputs("],\n", json);
}

static void print_run(Pack* pack, const void* user) {
	const ViewRun* run = user;
	const Recording* facts = &run->recording;
	const struct {
		const char *name, *text;
	} texts[] = {{"name", facts->scene_name}, {"folder", run->folder},     {"scene_path", facts->scene_path},
				 {"method", facts->method},   {"host", facts->host},       {"version", facts->version},
				 {"created", facts->created}, {"scene", facts->scene_text}};
	json_print_integer_entry(pack->json, "format", FORMAT);
	for (size_t i = 0; i < sizeof texts / sizeof *texts; ++i)
		json_print_text_entry(pack->json, texts[i].name, texts[i].text);
	json_print_real_entry(pack->json, "total_mass", facts->total_mass);
	fputs("\"gravity\": [", pack->json);
	for (int i = 0; i < 3; ++i) {
		if (i > 0) fputc(',', pack->json);
		json_print_real(pack->json, facts->gravity[i]);
	}
	fputs("],\n", pack->json);
	json_print_integer_entry(pack->json, "node_count", facts->node_count);
	json_print_integer_entry(pack->json, "point_count", run->points.count);
	print_shapes(pack->json, run);
	print_fields(pack->json, run);
	print_state(pack->json, run, 0);
	fputs(",\n", pack->json);
	add(pack, "rest", "f32", 3 * (size_t)run->points.count, run->rest);
	add(pack, "triangles", "i32", 3 * (size_t)run->triangle_count, run->triangles);
	add(pack, "obstacle_points", "f32", 3 * (size_t)run->obstacle_point_count, run->obstacle_points);
	add(pack, "obstacle_triangles", "i32", 3 * (size_t)run->obstacle_triangle_count, run->obstacle_triangles);
}

JnStatus view_pack_run(const ViewRun* run, ViewBytes* out) {
	return make(print_run, run, out);
}

// ---- series ----

static void print_series(Pack* pack, const void* user) {
	const ViewSeries* series = user;
	fputs("\"columns\": [", pack->json);
	for (int i = 0; i < series->count; ++i) {
		fputs(i > 0 ? ",\n{\"name\": " : "{\"name\": ", pack->json);
		json_print_text(pack->json, series->columns[i].name);
		fputs(", \"unit\": ", pack->json);
		json_print_text(pack->json, series->columns[i].unit);
		fputs("}", pack->json);
		add(pack, series->columns[i].name, "f64", (size_t)series->rows, series->columns[i].values);
	}
	fputs("],\n", pack->json);
}

JnStatus view_pack_series(ViewRun* run, ViewBytes* out) {
	ViewSeries series;
	JnStatus status = view_run_series(run, &series);
	if (status == JN_OK) status = make(print_series, &series, out);
	jn_arena_free(&series.arena);
	return status;
}
