#include "detect/meeting.h"

#include "detect/near.h"
#include "detect/touch.h"
#include "math/vec3.h"

static const double ALIKE = 0.70710678118654752; // cosine of 45 degrees: normals nearer to each other are one direction
static const double SHALLOW = 1e-3;              // of the margin: less deep inside is on the surface
static const double OWN =
	0.5; // of their distance at rest: less far behind its own surface, a vertex is inside its body

typedef struct Found {
	JnContact* contacts;
	int count;
} Found;

/// Whether a contact with this normal says something new.
static bool is_wanted(const Found* found, const double normal[3]) {
	for (int i = 0; i < found->count; i++)
		if (vec3_dot(found->contacts[i].normal, normal) > ALIKE) return false;
	return found->count < JN_CONTACTS_MOST;
}

/// How far the vertex is from a point of the triangle, along a normal.
static double gap_at(const JnMeeting* meeting, const JnContact* contact, double when) {
	double vertex[3], point[3], apart[3];
	jn_motion_at(&meeting->mine->motion, meeting->vertex, when, vertex);
	jn_mover_point(meeting->other, contact->other, contact->weights, when, point);
	for (int a = 0; a < 3; a++) apart[a] = vertex[a] - point[a];
	return vec3_dot(contact->normal, apart);
}

static void add(Found* found, const JnMeeting* meeting, int triangle, const double weights[3], const double normal[3],
				double when) {
	if (!is_wanted(found, normal)) return;
	JnContact* contact = &found->contacts[found->count++];
	*contact = (JnContact){.vertex = meeting->vertex, .other = triangle, .when = when};
	for (int a = 0; a < 3; a++) {
		contact->weights[a] = weights[a];
		contact->normal[a] = normal[a];
	}
	contact->gap = gap_at(meeting, contact, 0);
	contact->gap_end = gap_at(meeting, contact, 1);
}

static void add_near(Found* found, const JnMeeting* meeting, JnNear* near, double when) {
	double normal[3];
	if (!jn_near_normal(meeting->other, when, near, normal)) return;
	add(found, meeting, near->triangle, near->weights, normal, when);
}

/// The candidate of the lowest rank, of the lowest number among equals; NULL when all are INFINITY.
static JnNear* first_ranked(const JnMeeting* meeting) {
	JnNear* best = NULL;
	for (int i = 0; i < meeting->count; i++) {
		JnNear* near = &meeting->nears[i];
		if (!(near->rank < INFINITY)) continue;
		const bool is_before = best != NULL && near->rank == best->rank && near->triangle < best->triangle;
		if (best == NULL || near->rank < best->rank || is_before) best = near;
	}
	return best;
}

static bool is_behind(const JnMeeting* meeting, JnNear* near, double when) {
	double pseudonormal[3];
	if (!meeting->other->adjacency.is_closed) return false;
	jn_near_face(meeting->other, when, near, pseudonormal);
	return near->facing < 0;
}

/// A vertex of the same closed body is behind most of its surface: it has gone through a triangle only if it is not as far
/// behind as it is from it at rest, or half of that.
static bool is_own_inside(const JnMeeting* meeting, JnNear* near) {
	if (meeting->mine != meeting->other || !is_behind(meeting, near, 0)) return false;
	const int* t = meeting->other->skin->triangles + 3 * (ptrdiff_t)near->triangle;
	const double *rest = meeting->other->rest, *p = rest + 3 * (ptrdiff_t)meeting->vertex;
	const double *a = rest + 3 * (ptrdiff_t)t[0], *b = rest + 3 * (ptrdiff_t)t[1], *c = rest + 3 * (ptrdiff_t)t[2];
	double weights[3], at[3];
	jn_triangle_nearest(a, b, c, p, weights);
	for (int k = 0; k < 3; k++) at[k] = weights[0] * a[k] + weights[1] * b[k] + weights[2] * c[k];
	return near->distance >= OWN * vec3_distance(at, p);
}

/// Measure all candidates at the start or the end.
static void measure(JnMeeting* meeting, double when) {
	double p[3];
	jn_motion_at(&meeting->mine->motion, meeting->vertex, when, p);
	for (int i = 0; i < meeting->count; i++) jn_near_find(meeting->other, p, when, &meeting->nears[i]);
}

/// Those measured within the margin are ranked by distance.
static void rank(JnMeeting* meeting, double when) {
	for (int i = 0; i < meeting->count; i++) {
		JnNear* near = &meeting->nears[i];
		near->rank = near->distance <= meeting->margin ? near->distance : INFINITY;
		if (near->rank < INFINITY && when == 0 && is_own_inside(meeting, near)) near->rank = INFINITY;
	}
}

/// The nearest point of a closed surface far around the vertex; false when the vertex is not inside.
static bool find_deep(const JnMeeting* meeting, JnNear* near) {
	const JnTriangleTree* tree = &meeting->other->tree.tree;
	const double* p = meeting->mine->motion.start + 3 * (ptrdiff_t)meeting->vertex;
	if (!meeting->other->adjacency.is_closed || meeting->mine == meeting->other) return false;
	for (int a = 0; a < 3; a++)
		if (p[a] < tree->boxes[1].low[a] || p[a] > tree->boxes[1].high[a]) return false;
	if (jn_triangle_tree_winding(tree, p) <= 0) return false;
	const JnSurfacePoint found = jn_triangle_tree_nearest(tree, p);
	*near = (JnNear){.triangle = found.triangle};
	jn_near_find(meeting->other, p, 0, near);
	near->facing = -near->distance;
	return true;
}

/// Corners that the vertex and a triangle pass during the step, as jn_touch_first wants them.
static JnTouchPath path_of(const JnMeeting* meeting, int triangle) {
	const JnSkinMotion *mine = &meeting->mine->motion, *other = &meeting->other->motion;
	const int* t = meeting->other->skin->triangles + 3 * (ptrdiff_t)triangle;
	const ptrdiff_t own = 3 * (ptrdiff_t)meeting->vertex;
	JnTouchPath path = {.start = {mine->start + own}, .end = {mine->end + own}};
	for (int i = 0; i < 3; i++) {
		path.start[i + 1] = other->start + 3 * (ptrdiff_t)t[i];
		path.end[i + 1] = other->end + 3 * (ptrdiff_t)t[i];
	}
	return path;
}

static bool find_touch(const JnMeeting* meeting, int triangle, JnTouch* touch) {
	const JnTouchPath path = path_of(meeting, triangle);
	return jn_touch_first(&path, meeting->other->adjacency.is_closed ? JN_TOUCH_FRONT : JN_TOUCH_BOTH, touch);
}

static void add_touches(JnMeeting* meeting, Found* found) {
	JnTouch touch;
	for (int i = 0; i < meeting->count; i++) {
		JnNear* near = &meeting->nears[i];
		near->rank = find_touch(meeting, near->triangle, &touch) ? touch.when : INFINITY;
	}
	for (JnNear* near = first_ranked(meeting); near != NULL; near = first_ranked(meeting)) {
		near->rank = INFINITY;
		if (!find_touch(meeting, near->triangle, &touch)) continue;
		add(found, meeting, near->triangle, touch.weights, touch.normal, touch.when);
	}
}

/// Contacts of candidates in front that are locally nearest, nearest first.
static void add_nears(JnMeeting* meeting, Found* found, double when) {
	double p[3];
	jn_motion_at(&meeting->mine->motion, meeting->vertex, 0, p);
	for (JnNear* near = first_ranked(meeting); near != NULL; near = first_ranked(meeting)) {
		near->rank = INFINITY;
		if (found->count == JN_CONTACTS_MOST || is_behind(meeting, near, when)) continue;
		if (when == 0 && !jn_near_is_local_minimum(meeting->other, p, near)) continue;
		add_near(found, meeting, near, when);
		if (when > 0) return;
	}
}

int jn_meeting_contacts(JnMeeting* meeting, JnContact* contacts) {
	Found found = {.contacts = contacts};
	JnNear nearest = {.triangle = -1};
	measure(meeting, 0);
	rank(meeting, 0);
	const JnNear* first = first_ranked(meeting);
	if (first != NULL) nearest = *first;
	const bool is_near = first != NULL;
	const bool is_inside = is_near ? is_behind(meeting, &nearest, 0) : find_deep(meeting, &nearest);
	// On the surface within rounding, it may still meet other parts of it.
	if (!is_inside || (is_near && nearest.distance <= SHALLOW * meeting->margin)) add_touches(meeting, &found);
	if (is_near || is_inside) add_near(&found, meeting, &nearest, 0);
	if (is_near) {
		rank(meeting, 0);
		add_nears(meeting, &found, 0);
	}
	if (found.count > 0 || is_inside) return found.count;
	measure(meeting, 1);
	rank(meeting, 1);
	add_nears(meeting, &found, 1);
	// What comes out from behind the plane of that moment was no nearer before: it is on its way from somewhere else.
	const bool recedes = found.count > 0 && contacts[0].gap < contacts[0].gap_end;
	return recedes ? 0 : found.count;
}
