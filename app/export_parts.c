// Bodies and obstacles as parts with vertices. A thread is a tube of eight sides about its axis, or the axis itself.
#include <math.h>
#include <string.h>

#include "export.h"
#include "math/vec3.h"
#include "recording_surface.h"

enum { SIDES = 8 };

// ---- threads ----

/// Values at the point of a frame that lies on the axis, from those of all points.
static void axis_value(const RecordingBody* body, int frame, int components, const double* values, double* out) {
	const ptrdiff_t first = (ptrdiff_t)body->first_point + JN_FRAME_NODES * (ptrdiff_t)frame;
	for (int a = 0; a < components; ++a) {
		out[a] = 0;
		for (int i = 0; i < JN_FRAME_NODES; ++i) out[a] += body->thread->axis[i] * values[(first + i) * components + a];
	}
}

static void axis_point(const Export* export, const RecordingBody* body, int frame, double out[3]) {
	axis_value(body, frame, 3, export->points, out);
}

/// Unit vectors across the thread at a frame, the first turning with it.
static void across(const Export* export, const RecordingBody* body, int frame, double out[2][3]) {
	const JnThread* thread = body->thread;
	const int count = thread->frame_count;
	const int before = frame > 0 ? frame - 1 : thread->is_closed ? count - 1 : 0;
	const int behind = frame + 1 < count ? frame + 1 : thread->is_closed ? 0 : frame;
	const double* nodes = export->points + 3 * ((ptrdiff_t)body->first_point + JN_FRAME_NODES * (ptrdiff_t)frame);
	double from[3], to[3], along[3];
	axis_point(export, body, before, from);
	axis_point(export, body, behind, to);
	for (int a = 0; a < 3; ++a) along[a] = to[a] - from[a];
	vec3_normalize(along);
	for (int a = 0; a < 3; ++a) out[0][a] = nodes[3 * JN_THREAD_P + a] - nodes[3 * JN_THREAD_R + a];
	const double share = vec3_dot(out[0], along);
	for (int a = 0; a < 3; ++a) out[0][a] -= share * along[a];
	vec3_normalize(out[0]);
	vec3_cross(along, out[0], out[1]);
}

static void tube(const Export* export, const ExportPart* part, double* out) {
	const double turn = 2 * 3.14159265358979323846 / SIDES;
	for (int frame = 0; frame < part->body->thread->frame_count; ++frame) {
		double middle[3], directions[2][3];
		axis_point(export, part->body, frame, middle);
		across(export, part->body, frame, directions);
		for (int side = 0; side < SIDES; ++side) {
			const double c = part->radius * cos(turn * side), s = part->radius * sin(turn * side);
			for (int a = 0; a < 3; ++a) *out++ = middle[a] + c * directions[0][a] + s * directions[1][a];
		}
	}
}

/// Two triangles for each side of each link, and the two ends of an open tube.
static JnStatus tube_triangles(const JnThread* thread, JnArena* arena, ExportPart* part) {
	const int links = jn_thread_links(thread), last = SIDES * (thread->frame_count - 1);
	int* to;
	part->vertex_count = SIDES * thread->frame_count;
	part->triangle_count = 2 * SIDES * links + (thread->is_closed ? 0 : 2 * (SIDES - 2));
	JN_NEW(arena, to, 3 * (size_t)part->triangle_count);
	part->triangles = to;
	for (int i = 0; i < links * SIDES; ++i) {
		const int side = i % SIDES, next = (side + 1) % SIDES;
		const int a = i - side, b = SIDES * jn_thread_end(thread, i / SIDES);
		const int quad[6] = {a + side, a + next, b + side, a + next, b + next, b + side};
		memcpy(to, quad, sizeof quad);
		to += 6;
	}
	for (int side = 1; side + 1 < SIDES && !thread->is_closed; ++side) {
		const int caps[6] = {0, side + 1, side, last, last + side, last + side + 1};
		memcpy(to, caps, sizeof caps);
		to += 6;
	}
	return JN_OK;
}

// ---- parts ----

static JnStatus make_points(int first, int count, JnArena* arena, ExportPart* part) {
	int* points;
	JN_NEW(arena, points, count);
	for (int i = 0; i < count; ++i) points[i] = first + i;
	part->kind = EXPORT_POINTS;
	part->vertex_count = count;
	part->points = points;
	return JN_OK;
}

static JnStatus make_body(const RecordingBody* body, ExportKind thread_kind, JnArena* arena, ExportPart* part) {
	RecordingSurface surface;
	*part = (ExportPart){.name = body->name, .body = body};
	if (body->thread != NULL) {
		part->kind = thread_kind;
		part->radius = body->thread->radius;
		part->is_closed = body->thread->is_closed;
		part->vertex_count = body->thread->frame_count;
		return thread_kind == EXPORT_SURFACE ? tube_triangles(body->thread, arena, part) : JN_OK;
	}
	if (body->triangle_count == 0) {
		part->volumes = body->volumes;
		return make_points(body->first_point, body->point_count, arena, part);
	}
	JN_TRY(recording_surface(body, arena, &surface));
	part->vertex_count = surface.vertex_count;
	part->points = surface.points;
	part->triangle_count = surface.triangle_count;
	part->triangles = surface.triangles;
	return JN_OK;
}

static void make_obstacle(const RecordingObstacle* obstacle, ExportPart* part) {
	*part = (ExportPart){.name = obstacle->name,
						 .vertex_count = obstacle->surface.node_count,
						 .fixed = obstacle->surface.nodes,
						 .triangle_count = obstacle->surface.triangle_count,
						 .triangles = obstacle->surface.triangles};
}

JnStatus export_find_parts(Export* export, ExportKind thread_kind) {
	const Recording* recording = &export->recording;
	ExportPart* parts;
	int most = 0;
	JN_NEW(&export->arena, parts, recording->body_count + recording->obstacle_count + 1);
	for (int i = 0; i < recording->body_count; ++i)
		JN_TRY(make_body(&recording->bodies[i], thread_kind, &export->arena, &parts[export->part_count++]));
	if (recording->body_count == 0) { // a system of nodes alone
		parts[0].name = "nodes";
		JN_TRY(make_points(0, recording->point_count, &export->arena, &parts[export->part_count++]));
	}
	for (int i = 0; i < recording->obstacle_count; ++i)
		make_obstacle(&recording->obstacles[i], &parts[export->part_count++]);
	for (int i = 0; i < export->part_count; ++i)
		if (most < parts[i].vertex_count) most = parts[i].vertex_count;
	export->parts = parts;
	JN_NEW(&export->arena, export->points, 3 * (size_t)recording->point_count + 1);
	JN_NEW(&export->arena, export->vertices, 3 * (size_t)most + 1);
	return JN_OK;
}

void export_gather(const ExportPart* part, int components, const double* values, double* out) {
	for (int i = 0; i < part->vertex_count; ++i, out += components) {
		if (part->points == NULL)
			axis_value(part->body, i, components, values, out);
		else
			memcpy(out, values + (ptrdiff_t)part->points[i] * components, (size_t)components * sizeof *out);
	}
}

void export_vertices(const Export* export, const ExportPart* part, double* out) {
	if (part->fixed != NULL)
		memcpy(out, part->fixed, 3 * (size_t)part->vertex_count * sizeof *out);
	else if (part->points == NULL && part->kind == EXPORT_SURFACE)
		tube(export, part, out);
	else
		export_gather(part, 3, export->points, out);
}
