// Where the tip of a thread goes through the surface of a body in an accepted step: both move on straight lines.
#include <math.h>
#include <string.h>

#include "detect/touch.h"
#include "math/vec3.h"
#include "pass/suture.h"

enum { PASSAGES = 8 }; // a step, at most

/// A passage through a triangle.
typedef struct Passage {
	int triangle;
	double when, weights[3];
} Passage;

/// Whether all points lie beyond one side of the tip's way along some axis, by more than the slack.
static bool is_clear(const JnTouchPath* path, double slack) {
	for (int a = 0; a < 3; ++a) {
		const double from = path->start[0][a], to = path->end[0][a];
		const double low = (from < to ? from : to) - slack, high = (from < to ? to : from) + slack;
		bool is_below = true, is_above = true;
		for (int i = 1; i < 4; ++i) {
			is_below &= path->start[i][a] < low && path->end[i][a] < low;
			is_above &= path->start[i][a] > high && path->end[i][a] > high;
		}
		if (is_below || is_above) return true;
	}
	return false;
}

/// Whether the tip comes from the front of the triangle.
static bool is_from_front(const JnTouchPath* path, const JnTouch* touch) {
	double corner[3][3], normal[3];
	for (int i = 0; i < 3; ++i)
		for (int a = 0; a < 3; ++a)
			corner[i][a] = (1 - touch->when) * path->start[1 + i][a] + touch->when * path->end[1 + i][a];
	vec3_triangle(corner[0], corner[1], corner[2], normal);
	return vec3_dot(normal, touch->normal) > 0;
}

/// The first passage after `after`: in where the tip is outside, out where it is inside.
static bool find_passage(const JnSuture* pass, double after, Passage* out) {
	const JnCollision* collision = pass->collision;
	const JnSkin* skin = &collision->hides[pass->hide].skin;
	const int tip = jn_suture_frame(pass, 0);
	JnTouchPath path = {.start = {collision->start[tip]}, .end = {collision->end[tip]}};
	const double slack = 1e-3 * collision->strands[pass->strand].radius;
	*out = (Passage){.when = INFINITY};
	for (int t = 0; t < skin->triangle_count; ++t) {
		JnTouch touch;
		for (int i = 0; i < 3; ++i) {
			const int point = jn_collision_vertex(collision, pass->hide, skin->triangles[3 * (ptrdiff_t)t + i]);
			path.start[1 + i] = collision->start[point];
			path.end[1 + i] = collision->end[point];
		}
		if (is_clear(&path, slack) || !jn_touch_first(&path, JN_TOUCH_BOTH, &touch)) continue;
		if (touch.when <= after || touch.when >= out->when || is_from_front(&path, &touch) == pass->is_tip_inside)
			continue;
		out->when = touch.when;
		out->triangle = t;
		memcpy(out->weights, touch.weights, sizeof out->weights);
	}
	return isfinite(out->when);
}

// tan(half of it) = a . (b x c) / (abc + (a . b) c + (b . c) a + (c . a) b)  (van Oosterom, Strackee 1983)
static double solid_angle(const double a[3], const double b[3], const double c[3]) {
	const double la = vec3_length(a), lb = vec3_length(b), lc = vec3_length(c);
	double cross[3];
	vec3_cross(b, c, cross);
	return 2 *
		   atan2(vec3_dot(a, cross), la * lb * lc + vec3_dot(a, b) * lc + vec3_dot(b, c) * la + vec3_dot(c, a) * lb);
}

bool jn_suture_begins_inside(const JnSuture* pass) {
	const JnCollision* collision = pass->collision;
	const JnSkin* skin = &collision->hides[pass->hide].skin;
	const double* tip = collision->start[jn_suture_frame(pass, 0)];
	double sum = 0, away[3][3];
	jn_collision_points(collision, pass->model->rest, collision->start);
	for (int t = 0; t < skin->triangle_count; ++t) {
		for (int i = 0; i < 3; ++i) {
			const int vertex = skin->triangles[3 * (ptrdiff_t)t + i];
			for (int a = 0; a < 3; ++a)
				away[i][a] = collision->start[jn_collision_vertex(collision, pass->hide, vertex)][a] - tip[a];
		}
		sum += solid_angle(away[0], away[1], away[2]);
	}
	return sum > 2 * 3.14159265358979; // 4 pi within, 0 without
}

void jn_suture_puncture(JnSuture* pass, const JnStep* step) {
	const JnSkin* skin = &pass->collision->hides[pass->hide].skin;
	Passage passage;
	double after = -1, beyond;
	jn_collision_points(pass->collision, step->end->x, pass->collision->end); // as accepted
	for (int k = 0; k < PASSAGES && pass->count < JN_SITES_MOST && find_passage(pass, after, &passage); ++k) {
		JnSite* site = &pass->sites[pass->count++];
		*site = (JnSite){.number = pass->made++};
		memcpy(site->weights, passage.weights, sizeof site->weights);
		for (int i = 0; i < 3; ++i) site->nodes[i] = skin->nodes[skin->triangles[3 * (ptrdiff_t)passage.triangle + i]];
		jn_suture_slide(pass, site, step->end->x, &site->s, &beyond);
		pass->is_tip_inside = !pass->is_tip_inside;
		after = passage.when;
	}
}
