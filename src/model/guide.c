// x(t) = y(s(t)):  v = y' s',  a = y'' s'^2 + y' s''.
#include "model/guide.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/log.h"
#include "math/vec3.h"
#include "mesh/thread.h"
#include "model/model.h"

enum { LEADS_START, LEADS_END };

/// The plane of a frame at rest: `along` to the frames with higher numbers, across[0] from R to P.
static JnStation station_of(const JnMesh* mesh, int frame) {
	const JnThread* thread = mesh->thread;
	const double* R = mesh->nodes + 9 * (ptrdiff_t)frame;
	JnStation s = {0};
	for (int i = 0; i < 9; ++i) s.X[i % 3] += thread->axis[i / 3] * R[i];
	vec3_triangle(R, R + 3, R + 6, s.along);
	vec3_normalize(s.along);
	for (int a = 0; a < 3; ++a) s.across[0][a] = R[3 + a] - R[a];
	vec3_normalize(s.across[0]);
	vec3_cross(s.along, s.across[0], s.across[1]);
	return s;
}

static double angle_between(const JnStation* from, const double direction[3]) {
	return atan2(vec3_dot(direction, from->across[1]), vec3_dot(direction, from->across[0]));
}

// Frames at rest may twist about the thread: the angle of one against that of the head, carried along.
static double twist_from(const JnMesh* mesh, int head, int frame) {
	JnStation carried = station_of(mesh, head);
	for (int k = head; k != frame;) {
		k += frame > head ? 1 : -1;
		JnStation next = station_of(mesh, k);
		const JnStation here = next;
		jn_station_carry(&carried, &next);
		carried = next;
		if (k == frame) return angle_between(&carried, here.across[0]);
	}
	return 0;
}

// Offsets in the directions of the track: the frame is turned about its normal by `angle`, and faces along the track or,
// where its numbers rise away from the head, against it.
static void place_node(const JnStation* rest, const double X[3], double angle, double facing, double offset[2]) {
	const double d[3] = {X[0] - rest->X[0], X[1] - rest->X[1], X[2] - rest->X[2]};
	const double u = vec3_dot(d, rest->across[0]), w = facing * vec3_dot(d, rest->across[1]);
	offset[0] = u * cos(angle) - w * sin(angle);
	offset[1] = u * sin(angle) + w * cos(angle);
}

typedef struct Span {
	int first, last, head; // frames with chosen nodes
	double facing;
} Span;

static Span find_span(const JnAlongDef* def, const JnMesh* mesh, const bool* chosen) {
	Span span = {.first = -1};
	for (int i = 0; i < mesh->node_count; ++i) {
		if (!chosen[i]) continue;
		if (span.first < 0) span.first = i / JN_FRAME_NODES;
		span.last = i / JN_FRAME_NODES;
	}
	span.head = def->leads == LEADS_END ? span.last : span.first;
	span.facing = def->leads == LEADS_END ? 1 : -1;
	return span;
}

// The turn of the head's frame that leaves it nearest to where it is at rest, when the track begins.
static double first_angle(const JnGuide* guide, const JnStation* rest) {
	const JnMotionValue head = ((const JnMotionType*)guide->head.row)->at(guide->head.options, 0);
	JnTrackPoint at;
	jn_track_at(&guide->track, head.x, &at);
	return atan2(vec3_dot(rest->across[0], at.value + 6), vec3_dot(rest->across[0], at.value + 3));
}

static JnStatus place_frames(const JnAlongDef* def, const JnBody* body, const bool* chosen, JnArena* arena,
							 JnGuide* guide) {
	const JnMesh* mesh = &body->mesh;
	const Span span = find_span(def, mesh, chosen);
	const JnStation first = station_of(mesh, span.head);
	const double angle = first_angle(guide, &first);
	JN_NEW(arena, guide->frames, span.last - span.first + 1);
	JN_NEW(arena, guide->nodes, JN_FRAME_NODES * (span.last - span.first + 1));
	for (int k = span.first; k <= span.last; ++k) {
		const JnStation rest = station_of(mesh, k);
		const double turned = angle + span.facing * twist_from(mesh, span.head, k);
		JnGuideFrame* frame = &guide->frames[guide->frame_count++];
		*frame = (JnGuideFrame){.behind = mesh->thread->link_length * abs(k - span.head), .first = guide->node_count};
		for (int i = JN_FRAME_NODES * k; i < JN_FRAME_NODES * (k + 1); ++i) {
			if (!chosen[i]) continue;
			JnGuideNode* node = &guide->nodes[guide->node_count++];
			*node = (JnGuideNode){.node = body->first_node + i, .held = {-1, -1, -1}};
			place_node(&rest, mesh->nodes + 3 * (ptrdiff_t)i, turned, span.facing, node->offset);
		}
		frame->end = guide->node_count;
	}
	return JN_OK;
}

static JnStatus make_track(const JnAlongDef* def, const char* what, JnArena* scratch, JnArena* arena, JnTrack* track) {
	const JnPathDef path_def = {.curve = def->curve,
								.origin = {def->origin[0], def->origin[1], def->origin[2]},
								.rotate = {def->rotate[0], def->rotate[1], def->rotate[2]}};
	char where[128];
	JnPath path;
	snprintf(where, sizeof where, "%s.curve", what);
	JN_TRY(jn_path_create(&path_def, where, scratch, &path));
	return jn_track_create(&path, arena, scratch, track);
}

JnStatus jn_guide_create(const JnAlongDef* def, const char* what, const JnBody* body, const bool* chosen,
						 JnArena* arena, JnGuide* guide) {
	const JnMotionType* motion = (const JnMotionType*)def->head.row;
	char where[128];
	*guide = (JnGuide){.head = def->head};
	if (body->mesh.thread == NULL)
		return jn_error(JN_BAD_INPUT, "%s: '%s' is no thread, whose frames could follow a curve; use x, y and z", what,
						body->name);
	snprintf(where, sizeof where, "%s.head", what);
	if (motion->check != NULL) JN_TRY(motion->check(def->head.options, where));
	JnArena scratch = {0};
	const JnStatus status = make_track(def, what, &scratch, arena, &guide->track);
	jn_arena_free(&scratch);
	return status == JN_OK ? place_frames(def, body, chosen, arena, guide) : status;
}

static void set_node(const JnGuideNode* node, const JnTrackPoint* at, const JnMotionValue* head,
					 JnMotionValue* values) {
	for (int a = 0; a < 3; ++a) {
		if (node->held[a] < 0) continue;
		const double c = node->offset[0], d = node->offset[1];
		const double slope = at->slope[a] + c * at->slope[3 + a] + d * at->slope[6 + a];
		const double bend = at->bend[a] + c * at->bend[3 + a] + d * at->bend[6 + a];
		values[node->held[a]] = (JnMotionValue){
			.x = at->value[a] + c * at->value[3 + a] + d * at->value[6 + a],
			.v = slope * head->v,
			.a = bend * head->v * head->v + slope * head->a,
		};
	}
}

void jn_guide_at(const JnGuide* guide, double t, JnMotionValue* values) {
	const JnMotionValue head = ((const JnMotionType*)guide->head.row)->at(guide->head.options, t);
	for (int k = 0; k < guide->frame_count; ++k) {
		const JnGuideFrame* frame = &guide->frames[k];
		JnTrackPoint at;
		jn_track_at(&guide->track, head.x - frame->behind, &at);
		for (int i = frame->first; i < frame->end; ++i) set_node(&guide->nodes[i], &at, &head, values);
	}
}

static const char* const ends[] = {"start", "end", NULL};

const JnKey jn_along_keys[] = {
	JN_PATH_KEY_ROWS(JnAlongDef, , true),
	{.name = "head",
	 .kind = JN_VARIANT,
	 .field = offsetof(JnAlongDef, head),
	 .required = true,
	 .rows = &jn_motion_list,
	 .tag = "type",
	 .meaning =
		 "arc length of the foremost frame along the curve, as a motion in time; below 0 and beyond the end the curve "
		 "goes on straight"},
	{.name = "leads",
	 .kind = JN_CHOICE,
	 .field = offsetof(JnAlongDef, leads),
	 .names = ends,
	 .meaning = "which end of the chosen frames is foremost: that nearer to the thread's start, or to its end"},
	{0},
};
