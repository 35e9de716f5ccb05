// The nodes, the bodies in the order of their nodes, which is that of the scene, and the obstacles.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/log.h"
#include "recording_part.h"

typedef struct Object {
	char path[512]; // "/mesh/<body>/cells"
} Object;

static Object part_of(const char* group, const char* name, const char* part) {
	Object object;
	snprintf(object.path, sizeof object.path, "/%s/%s/%s", group, name, part);
	return object;
}

static JnStatus read_cells(Recording* recording, RecordingBody* body) {
	const Object cells = part_of("mesh", body->name, "cells");
	int* numbers;
	const char* shape = recording_attribute_text(recording, cells.path, "shape", "");
	if (shape == NULL) return JN_OUT_OF_MEMORY;
	while (body->shape < JN_SHAPE_COUNT && strcmp(jn_shape_info[body->shape].name, shape) != 0) body->shape++;
	if (body->shape == JN_SHAPE_COUNT) return recording_damaged(recording, cells.path);
	const int nodes = jn_shape_info[body->shape].nodes;
	JN_TRY(recording_attribute_count(recording, cells.path, "first_node", &body->first_node));
	JN_TRY(recording_attribute_count(recording, cells.path, "node_count", &body->node_count));
	JN_TRY(recording_numbers(recording, cells.path, nodes, &numbers, &body->cell_count));
	const long end = (long)body->first_node + body->node_count;
	const bool fits = body->first_node >= 0 && body->node_count >= 0 && end <= recording->node_count &&
					  recording_are_within(numbers, (size_t)body->cell_count * (size_t)nodes, body->first_node, end);
	body->cells = numbers;
	return fits ? JN_OK : recording_damaged(recording, cells.path);
}

static JnStatus read_volumes(Recording* recording, RecordingBody* body) {
	const Object object = part_of("mesh", body->name, "volumes");
	double* volumes;
	int count;
	if (!recording_has(recording, object.path)) return JN_OK;
	JN_TRY(recording_reals(recording, object.path, 1, &volumes, &count));
	body->volumes = volumes;
	return count == body->node_count ? JN_OK : recording_damaged(recording, object.path);
}

static JnStatus read_thread(Recording* recording, RecordingBody* body) {
	const Object object = part_of("mesh", body->name, "axis");
	JnThread* thread;
	double* axis;
	int count, is_closed;
	if (!recording_has(recording, object.path)) return JN_OK;
	JN_NEW(&recording->arena, thread, 1);
	JN_TRY(recording_reals(recording, object.path, 1, &axis, &count));
	JN_TRY(recording_attribute_count(recording, object.path, "is_closed", &is_closed));
	if (count != JN_FRAME_NODES || body->node_count < 2 * JN_FRAME_NODES || body->node_count % JN_FRAME_NODES != 0 ||
		recording_file_attribute(recording->file, object.path, "radius", RECORDING_REAL, &thread->radius) != JN_OK)
		return recording_damaged(recording, object.path);
	thread->frame_count = body->node_count / JN_FRAME_NODES;
	thread->is_closed = is_closed != 0;
	memcpy(thread->axis, axis, sizeof thread->axis);
	body->thread = thread;
	return JN_OK;
}

/// Triangles still have the numbers of the file: those of nodes, or of the vertices of the body alone.
static JnStatus read_surface(Recording* recording, RecordingBody* body) {
	const Object surface = part_of("mesh", body->name, "surface");
	const Object object = part_of("mesh", body->name, "surface/triangles");
	int* triangles;
	if (!recording_has(recording, surface.path)) return recording_damaged(recording, surface.path);
	const char* kind = recording_attribute_text(recording, surface.path, "kind", "");
	if (kind == NULL) return JN_OUT_OF_MEMORY;
	body->is_embedded = strcmp(kind, "embedded") == 0;
	JN_TRY(recording_attribute_count(recording, surface.path, "first_point", &body->first_point));
	JN_TRY(recording_attribute_count(recording, surface.path, "point_count", &body->point_count));
	JN_TRY(recording_numbers(recording, object.path, 3, &triangles, &body->triangle_count));
	const int first = body->is_embedded ? 0 : body->first_node;
	const size_t count = 3 * (size_t)body->triangle_count;
	const bool is_boundary = !body->is_embedded && body->point_count == body->node_count;
	if (body->first_point < 0 || body->point_count < 0 || !(body->is_embedded || is_boundary) ||
		!recording_are_within(triangles, count, first, (long)first + body->point_count))
		return recording_damaged(recording, object.path);
	for (size_t i = 0; i < count; ++i) triangles[i] += body->first_point - first;
	body->triangles = triangles;
	return JN_OK;
}

static JnStatus read_carriers(Recording* recording, RecordingBody* body) {
	const Object nodes = part_of("mesh", body->name, "surface/nodes");
	const Object weights = part_of("mesh", body->name, "surface/weights");
	const Object rest = part_of("mesh", body->name, "surface/rest");
	int *numbers, count, rows, points;
	double *shares, *point_rest;
	if (!body->is_embedded) return JN_OK;
	const int64_t entries = recording_file_measure(recording->file, nodes.path);
	if (body->point_count == 0 || entries <= 0 || entries % body->point_count != 0 || entries > INT32_MAX)
		return recording_damaged(recording, nodes.path);
	body->carrier_count = (int)(entries / body->point_count);
	JN_TRY(recording_numbers(recording, nodes.path, body->carrier_count, &numbers, &count));
	JN_TRY(recording_reals(recording, weights.path, body->carrier_count, &shares, &rows));
	JN_TRY(recording_reals(recording, rest.path, 3, &point_rest, &points));
	body->carriers = numbers;
	body->weights = shares;
	body->point_rest = point_rest;
	const long end = (long)body->first_node + body->node_count;
	const bool fits = count == body->point_count && rows == count && points == count &&
					  recording_are_within(numbers, (size_t)entries, body->first_node, end);
	return fits ? JN_OK : recording_damaged(recording, nodes.path);
}

static JnStatus read_body(Recording* recording, const char* name, RecordingBody* body) {
	*body = (RecordingBody){.name = name};
	JN_TRY(read_cells(recording, body));
	JN_TRY(read_volumes(recording, body));
	JN_TRY(read_thread(recording, body));
	JN_TRY(read_surface(recording, body));
	return read_carriers(recording, body);
}

static int compare_bodies(const void* a, const void* b) {
	const int first = ((const RecordingBody*)a)->first_node, second = ((const RecordingBody*)b)->first_node;
	return (first > second) - (first < second);
}

/// The points follow each other, body by body, unless they are the nodes.
static JnStatus count_points(Recording* recording) {
	long end = 0, all = 0;
	for (int i = 0; i < recording->body_count; ++i) {
		const RecordingBody* body = &recording->bodies[i];
		recording->has_embedding |= body->is_embedded;
		all += body->point_count;
		if (end < (long)body->first_point + body->point_count) end = (long)body->first_point + body->point_count;
	}
	if (end > INT32_MAX || (recording->has_embedding && end > all) ||
		(!recording->has_embedding && end > recording->node_count))
		return recording_damaged(recording, "/mesh");
	recording->point_count = recording->has_embedding ? (int)end : recording->node_count;
	return JN_OK;
}

JnStatus recording_read_bodies(Recording* recording) {
	const char* const* names;
	RecordingBody* bodies;
	double* rest;
	int count;
	JN_TRY(recording_reals(recording, "/mesh/nodes", 3, &rest, &recording->node_count));
	JN_TRY(recording_names(recording, "/mesh", &names, &count));
	if (recording->node_count == 0) return recording_damaged(recording, "/mesh/nodes");
	recording->rest = rest;
	JN_NEW(&recording->arena, bodies, count);
	for (int i = 0; i < count; ++i)
		if (strcmp(names[i], "nodes") != 0) JN_TRY(read_body(recording, names[i], &bodies[recording->body_count++]));
	qsort(bodies, (size_t)recording->body_count, sizeof *bodies, compare_bodies);
	recording->bodies = bodies;
	return count_points(recording);
}

JnStatus recording_read_obstacles(Recording* recording) {
	const char* const* names;
	RecordingObstacle* obstacles;
	JN_TRY(recording_names(recording, "/obstacles", &names, &recording->obstacle_count));
	JN_NEW(&recording->arena, obstacles, recording->obstacle_count + 1);
	for (int i = 0; i < recording->obstacle_count; ++i) {
		JnSurface* surface = &obstacles[i].surface;
		const Object points = part_of("obstacles", names[i], "points");
		const Object triangles = part_of("obstacles", names[i], "triangles");
		JN_TRY(recording_reals(recording, points.path, 3, &surface->nodes, &surface->node_count));
		JN_TRY(recording_numbers(recording, triangles.path, 3, &surface->triangles, &surface->triangle_count));
		if (!recording_are_within(surface->triangles, 3 * (size_t)surface->triangle_count, 0, surface->node_count))
			return recording_damaged(recording, triangles.path);
		obstacles[i].name = names[i];
	}
	recording->obstacles = obstacles;
	return JN_OK;
}
