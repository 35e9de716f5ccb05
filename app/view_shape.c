#include "view_shape.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "recording_file.h"
#include "view_bodies.h"
#include "view_obstacles.h"

typedef struct Reading {
	ViewRun* run;
	JnArena arena; // of what is needed while reading
	double* nodes; // rest positions of all nodes
	double* rows;  // of all rows of a frame
	int triangle_room;
} Reading;

// ---- arrays ----

// A dataset of `type`, H5T_NATIVE_INT or H5T_NATIVE_DOUBLE; `count` is the number of its entries.
static JnStatus read_array(ViewRun* run, JnArena* arena, hid_t type, const char* name, void** data, int* count) {
	const hssize_t entries = recording_file_measure(run->file, name);
	if (entries < 0 || entries > INT32_MAX) return JN_IO_FAILED;
	*data = jn_arena_take(arena, (size_t)entries + 1, H5Tget_size(type));
	if (*data == NULL) return JN_OUT_OF_MEMORY;
	*count = (int)entries;
	return recording_file_array(run->file, name, type, entries, *data);
}

static JnStatus read_reals(ViewRun* run, JnArena* arena, const char* name, double** data, int* count) {
	return read_array(run, arena, H5T_NATIVE_DOUBLE, name, (void**)data, count);
}

static JnStatus read_numbers(ViewRun* run, JnArena* arena, const char* name, int** data, int* count) {
	return read_array(run, arena, H5T_NATIVE_INT, name, (void**)data, count);
}

static bool exists(const ViewRun* run, const char* path) {
	return H5Lexists(run->file, path, H5P_DEFAULT) > 0;
}

// ---- bodies ----

// Where the rows of a body begin in a frame's positions, and how many they are.
typedef struct Rows {
	int first, count;
	bool is_embedded;
	int width; // nodes that carry a vertex
	int* nodes;
	double* weights;
} Rows;

static JnStatus read_embedding(Reading* reading, const char* group, Rows* rows) {
	char name[200];
	int nodes = 0, weights = 0, rest = 0;
	double* positions;
	ViewRun* run = reading->run;
	snprintf(name, sizeof name, "%s/nodes", group);
	JN_TRY(read_numbers(run, &reading->arena, name, &rows->nodes, &nodes));
	snprintf(name, sizeof name, "%s/weights", group);
	JN_TRY(read_reals(run, &reading->arena, name, &rows->weights, &weights));
	snprintf(name, sizeof name, "%s/rest", group);
	JN_TRY(read_reals(run, &reading->arena, name, &positions, &rest));
	if (nodes != weights || rest != 3 * rows->count || (rows->count > 0 && nodes % rows->count != 0))
		return JN_IO_FAILED;
	rows->width = rows->count > 0 ? nodes / rows->count : 0;
	for (int i = 0; i < nodes; ++i)
		if (rows->nodes[i] < 0 || rows->nodes[i] >= run->node_count) return JN_IO_FAILED;
	memcpy(reading->rows + 3 * (ptrdiff_t)rows->first, positions, (size_t)rest * sizeof *positions);
	return JN_OK;
}

static JnStatus read_rows(Reading* reading, const ViewBody* body, Rows* rows) {
	char group[160], *kind;
	ViewRun* run = reading->run;
	snprintf(group, sizeof group, "/mesh/%s/surface", body->name);
	*rows = (Rows){0};
	JN_TRY(recording_file_attribute(run->file, group, "first_point", H5T_NATIVE_INT, &rows->first));
	JN_TRY(recording_file_attribute(run->file, group, "point_count", H5T_NATIVE_INT, &rows->count));
	JN_TRY(recording_file_text(run->file, group, "kind", &reading->arena, &kind));
	if (rows->first < 0 || rows->count < 0 || rows->first > run->row_count - rows->count) return JN_IO_FAILED;
	rows->is_embedded = strcmp(kind, "embedded") == 0;
	if (rows->is_embedded) return read_embedding(reading, group, rows);
	if (rows->count != body->node_count) return JN_IO_FAILED;
	const size_t bytes = 3 * (size_t)rows->count * sizeof *reading->rows;
	memcpy(reading->rows + 3 * (ptrdiff_t)rows->first, reading->nodes + 3 * (ptrdiff_t)body->first_node, bytes);
	return JN_OK;
}

// Draw a row; its fields are those of its node, or of the nodes that carry it.
static JnStatus draw_row(ViewRun* run, const ViewBody* body, const Rows* rows, int k) {
	JN_TRY(view_map_add_row(&run->points, rows->first + k));
	if (!rows->is_embedded) return view_map_add_row(&run->nodes, body->first_node + k);
	const ptrdiff_t first = (ptrdiff_t)k * rows->width;
	return view_map_add(&run->nodes, rows->width, rows->nodes + first, rows->weights + first);
}

// Only rows that a triangle uses are drawn: the inside of a solid is not.
static JnStatus draw_surface(Reading* reading, ViewBody* body, const Rows* rows, int* triangles, int corners) {
	ViewRun* run = reading->run;
	const int base = rows->is_embedded ? 0 : body->first_node;
	int* drawn;
	if (corners / 3 > reading->triangle_room - run->triangle_count) return JN_IO_FAILED;
	JN_NEW(&reading->arena, drawn, rows->count + 1);
	for (int i = 0; i < corners; ++i) {
		triangles[i] -= base;
		if (triangles[i] < 0 || triangles[i] >= rows->count) return JN_IO_FAILED;
		drawn[triangles[i]] = 1;
	}
	for (int k = 0; k < rows->count; ++k) {
		if (drawn[k] == 0) continue;
		drawn[k] = run->points.count;
		JN_TRY(draw_row(run, body, rows, k));
	}
	int* out = run->triangles + 3 * (ptrdiff_t)run->triangle_count;
	for (int i = 0; i < corners; ++i) out[i] = drawn[triangles[i]];
	body->triangle_count = corners / 3;
	run->triangle_count += body->triangle_count;
	return JN_OK;
}

// The points of the axis, each from the three nodes of its frame.
static JnStatus draw_thread(ViewRun* run, ViewBody* body, const Rows* rows, const double axis[3]) {
	body->kind = VIEW_THREAD;
	for (int k = 0; k + 2 < body->node_count; k += 3) {
		const int in_rows[3] = {rows->first + k, rows->first + k + 1, rows->first + k + 2};
		const int in_nodes[3] = {body->first_node + k, body->first_node + k + 1, body->first_node + k + 2};
		JN_TRY(view_map_add(&run->points, 3, in_rows, axis));
		JN_TRY(view_map_add(&run->nodes, 3, in_nodes, axis));
	}
	return JN_OK;
}

static JnStatus draw_points(ViewRun* run, ViewBody* body, const Rows* rows) {
	body->kind = VIEW_POINTS;
	for (int k = 0; k < rows->count; ++k) JN_TRY(draw_row(run, body, rows, k));
	return JN_OK;
}

// What says that a body is a thread, or how large its points are; see src/record/hdf5.c.
static JnStatus read_look(Reading* reading, ViewBody* body, double axis[3], bool* is_thread) {
	char name[160];
	ViewRun* run = reading->run;
	snprintf(name, sizeof name, "/mesh/%s/axis", body->name);
	*is_thread = exists(run, name);
	if (*is_thread) {
		int closed = 0;
		JN_TRY(recording_file_array(run->file, name, H5T_NATIVE_DOUBLE, 3, axis));
		JN_TRY(recording_file_attribute(run->file, name, "radius", H5T_NATIVE_DOUBLE, &body->radius));
		JN_TRY(recording_file_attribute(run->file, name, "is_closed", H5T_NATIVE_INT, &closed));
		body->is_closed = closed != 0;
	}
	snprintf(name, sizeof name, "/mesh/%s/volumes", body->name);
	if (!exists(run, name)) return JN_OK;
	int count;
	double *volumes, sum = 0;
	JN_TRY(read_reals(run, &reading->arena, name, &volumes, &count));
	for (int i = 0; i < count; ++i) sum += volumes[i];
	body->radius = count > 0 ? 0.5 * cbrt(sum / count) : 0;
	return JN_OK;
}

static JnStatus draw_body(Reading* reading, ViewBody* body) {
	Rows rows;
	int corners = 0, *triangles;
	bool is_thread = false;
	double axis[3];
	char name[160];
	ViewRun* run = reading->run;
	snprintf(name, sizeof name, "/mesh/%s/surface/triangles", body->name);
	body->first_point = run->points.count;
	body->first_triangle = run->triangle_count;
	JN_TRY(read_rows(reading, body, &rows));
	JN_TRY(read_look(reading, body, axis, &is_thread));
	JN_TRY(read_numbers(run, &reading->arena, name, &triangles, &corners));
	JnStatus status = is_thread     ? draw_thread(run, body, &rows, axis)
					  : corners > 0 ? draw_surface(reading, body, &rows, triangles, corners)
									: draw_points(run, body, &rows);
	body->point_count = run->points.count - body->first_point;
	return status;
}

// ---- all ----

// A model without bodies, such as a pendulum: its nodes.
static JnStatus draw_nodes(ViewRun* run) {
	JN_NEW(&run->arena, run->bodies, 1);
	run->body_count = 1;
	run->bodies[0] = (ViewBody){.name = "nodes", .shape = "point1", .node_count = run->node_count};
	const JnStatus status = draw_points(run, &run->bodies[0], &(Rows){.count = run->node_count});
	run->bodies[0].point_count = run->points.count;
	return status;
}

static JnStatus count_rows(ViewRun* run) {
	int last = 0;
	for (int b = 0; b < run->body_count; ++b) {
		char group[160], *kind;
		int first, count;
		snprintf(group, sizeof group, "/mesh/%s/surface", run->bodies[b].name);
		JN_TRY(recording_file_attribute(run->file, group, "first_point", H5T_NATIVE_INT, &first));
		JN_TRY(recording_file_attribute(run->file, group, "point_count", H5T_NATIVE_INT, &count));
		JN_TRY(recording_file_text(run->file, group, "kind", &run->arena, &kind));
		if (first < 0 || count < 0 || first > INT32_MAX / 4 - count) return JN_IO_FAILED;
		run->has_surface |= strcmp(kind, "embedded") == 0;
		if (first + count > last) last = first + count;
	}
	run->row_count = run->has_surface ? last : run->node_count;
	return JN_OK;
}

static JnStatus read_shape(Reading* reading) {
	int reals = 0;
	ViewRun* run = reading->run;
	JN_TRY(read_reals(run, &reading->arena, "/mesh/nodes", &reading->nodes, &reals));
	run->node_count = reals / 3;
	JN_TRY(view_bodies_list(run));
	JN_TRY(count_rows(run));
	const int most = run->row_count > run->node_count ? run->row_count : run->node_count;
	const hssize_t corners = recording_file_measure(run->file, "/topology/surface");
	reading->triangle_room = corners > 0 ? (int)(corners / 3) : 0;
	JN_NEW(&run->arena, run->triangles, 3 * (size_t)reading->triangle_room + 1);
	JN_NEW(&run->arena, run->scratch, 3 * (size_t)most + 1);
	JN_NEW(&run->arena, run->values, (size_t)run->node_count + 1);
	JN_NEW(&reading->arena, reading->rows, 3 * (size_t)most + 1);
	if (run->body_count == 0) memcpy(reading->rows, reading->nodes, (size_t)reals * sizeof *reading->nodes);
	for (int b = 0; b < run->body_count; ++b) JN_TRY(draw_body(reading, &run->bodies[b]));
	if (run->body_count == 0) JN_TRY(draw_nodes(run));
	JN_NEW(&run->arena, run->rest, 3 * (size_t)run->points.count + 1);
	view_map_apply(&run->points, 3, reading->rows, run->rest);
	return view_obstacles_read(run);
}

JnStatus view_shape_read(ViewRun* run) {
	Reading reading = {.run = run};
	const JnStatus status = read_shape(&reading);
	jn_arena_free(&reading.arena);
	return status;
}
