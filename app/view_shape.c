#include "view_shape.h"

#include <math.h>
#include <string.h>

#include "view_obstacles.h"

// Draw a point of the recording; its fields are those of its node, or of the nodes that carry it.
static JnStatus draw_point(ViewRun* run, const RecordingBody* from, int k) {
	JN_TRY(view_map_add_row(&run->points, from->first_point + k));
	if (!from->is_embedded) return view_map_add_row(&run->nodes, from->first_node + k);
	const ptrdiff_t first = (ptrdiff_t)k * from->carrier_count;
	return view_map_add(&run->nodes, from->carrier_count, from->carriers + first, from->weights + first);
}

// Only points that a triangle uses are drawn: the inside of a solid is not.
static JnStatus draw_surface(ViewRun* run, const RecordingBody* from, ViewBody* body) {
	const int corners = 3 * from->triangle_count;
	int* out = run->triangles + 3 * (ptrdiff_t)run->triangle_count;
	int* drawn;
	JN_NEW(&run->arena, drawn, from->point_count + 1);
	for (int i = 0; i < corners; ++i) drawn[from->triangles[i] - from->first_point] = 1;
	for (int k = 0; k < from->point_count; ++k) {
		if (drawn[k] == 0) continue;
		drawn[k] = run->points.count;
		JN_TRY(draw_point(run, from, k));
	}
	for (int i = 0; i < corners; ++i) out[i] = drawn[from->triangles[i] - from->first_point];
	body->triangle_count = from->triangle_count;
	run->triangle_count += from->triangle_count;
	return JN_OK;
}

// The points of the axis, each from the three nodes of its frame.
static JnStatus draw_thread(ViewRun* run, const RecordingBody* from, ViewBody* body) {
	body->kind = VIEW_THREAD;
	body->radius = from->thread->radius;
	body->is_closed = from->thread->is_closed;
	for (int k = 0; k + 2 < from->node_count; k += 3) {
		const int in_points[3] = {from->first_point + k, from->first_point + k + 1, from->first_point + k + 2};
		const int in_nodes[3] = {from->first_node + k, from->first_node + k + 1, from->first_node + k + 2};
		JN_TRY(view_map_add(&run->points, 3, in_points, from->thread->axis));
		JN_TRY(view_map_add(&run->nodes, 3, in_nodes, from->thread->axis));
	}
	return JN_OK;
}

static JnStatus draw_points(ViewRun* run, const RecordingBody* from, ViewBody* body) {
	double sum = 0;
	body->kind = VIEW_POINTS;
	for (int k = 0; k < from->point_count; ++k) JN_TRY(draw_point(run, from, k));
	for (int k = 0; from->volumes != NULL && k < from->node_count; ++k) sum += from->volumes[k];
	body->radius = from->node_count > 0 ? 0.5 * cbrt(sum / from->node_count) : 0;
	return JN_OK;
}

static JnStatus draw_body(ViewRun* run, const RecordingBody* from, ViewBody* body) {
	*body = (ViewBody){.name = from->name,
					   .shape = jn_shape_info[from->shape].name,
					   .first_node = from->first_node,
					   .node_count = from->node_count,
					   .cell_count = from->cell_count,
					   .first_point = run->points.count,
					   .first_triangle = run->triangle_count};
	const bool is_thread = from->thread != NULL && !from->is_embedded;
	const JnStatus status = is_thread                  ? draw_thread(run, from, body)
							: from->triangle_count > 0 ? draw_surface(run, from, body)
													   : draw_points(run, from, body);
	body->point_count = run->points.count - body->first_point;
	return status;
}

// A model without bodies, such as a pendulum, is drawn as its nodes.
static JnStatus draw_bodies(ViewRun* run) {
	const Recording* recording = &run->recording;
	const RecordingBody nodes = {
		.name = "nodes", .shape = JN_POINT1, .node_count = recording->node_count, .point_count = recording->node_count};
	const RecordingBody* bodies = recording->body_count > 0 ? recording->bodies : &nodes;
	const int count = recording->body_count > 0 ? recording->body_count : 1;
	size_t triangles = 0;
	for (int b = 0; b < count; ++b) triangles += (size_t)bodies[b].triangle_count;
	run->body_count = count;
	JN_NEW(&run->arena, run->bodies, count);
	JN_NEW(&run->arena, run->triangles, 3 * triangles + 1);
	for (int b = 0; b < count; ++b) JN_TRY(draw_body(run, &bodies[b], &run->bodies[b]));
	return JN_OK;
}

// Positions at rest of all points of the recording.
static void find_rest(const Recording* recording, double* rest) {
	memcpy(rest, recording->rest, 3 * (size_t)recording->node_count * sizeof *rest);
	for (int b = 0; recording->has_embedding && b < recording->body_count; ++b) {
		const RecordingBody* body = &recording->bodies[b];
		const double* from = body->is_embedded ? body->point_rest : recording->rest + 3 * (ptrdiff_t)body->first_node;
		memcpy(rest + 3 * (ptrdiff_t)body->first_point, from, 3 * (size_t)body->point_count * sizeof *rest);
	}
}

JnStatus view_shape_make(ViewRun* run) {
	const Recording* recording = &run->recording;
	const int nodes = recording->node_count, points = recording->point_count, most = nodes > points ? nodes : points;
	JN_NEW(&run->arena, run->scratch, 3 * (size_t)most + 1);
	JN_NEW(&run->arena, run->values, (size_t)nodes + 1);
	JN_TRY(draw_bodies(run));
	JN_NEW(&run->arena, run->rest, 3 * (size_t)run->points.count + 1);
	find_rest(recording, run->scratch);
	view_map_apply(&run->points, 3, run->scratch, run->rest);
	return view_obstacles_join(run);
}
