// A vertex on its straight way past an obstacle that does not move. As the distance is Lipschitz, a vertex at distance d
// may go on by d without touching anything (conservative advancement, Mirtich 1996): few steps for a frontal hit, more for
// a grazing one, and never past something thin.
#include "detect/meeting.h"
#include "math/vec3.h"

static const double SEEN = 0.5; // share of the overlap at the end that a plane must see to stand for the surface

enum {
	ADVANCES = 200
}; // then the vertex is so near, or so long on its way along the surface, that it counts as a touch

typedef struct Way {
	const double *start, *end; // [m]
	double length;             // [m]
	double offset;             // of the surface that is touched, from that of the obstacle [m]
} Way;

/// Distance and normal at share `when` of the way, and the point of the surface nearest there.
static double look(const JnObstacle* obstacle, const Way* way, double when, JnContact* contact) {
	double at[3];
	for (int a = 0; a < 3; a++) at[a] = (1 - when) * way->start[a] + when * way->end[a];
	const double distance = jn_obstacle_distance(obstacle, at, contact->normal) - way->offset;
	for (int a = 0; a < 3; a++) contact->point[a] = at[a] - distance * contact->normal[a];
	contact->when = when;
	return distance;
}

static double gap_from(const JnContact* contact, const double at[3]) {
	const double apart[3] = {at[0] - contact->point[0], at[1] - contact->point[1], at[2] - contact->point[2]};
	return vec3_dot(contact->normal, apart);
}

static void finish(const Way* way, JnContact* contact) {
	contact->gap = gap_from(contact, way->start);
	contact->gap_end = gap_from(contact, way->end);
}

/// Go on until the surface is reached; false when the end comes first. `near` is the distance that counts as reached.
static bool advance(const JnObstacle* obstacle, const Way* way, double distance, double near, JnContact* contact) {
	double when = 0;
	for (int i = 0; i < ADVANCES; i++) {
		if (!(distance > near)) return true;
		when += distance / way->length;
		if (!(when < 1)) return false;
		distance = look(obstacle, way, when, contact);
	}
	return true;
}

int jn_meeting_obstacle(const JnMover* mine, int vertex, const JnObstacle* obstacle, double margin,
						JnContact* contacts) {
	const ptrdiff_t own = 3 * (ptrdiff_t)vertex;
	Way way = {.start = mine->motion.start + own, .end = mine->motion.end + own, .offset = mine->skin->offset};
	way.length = vec3_distance(way.start, way.end);
	JnContact first = {.vertex = vertex}, last = {.vertex = vertex};
	const double at_start = look(obstacle, &way, 0, &first);
	if (at_start - way.length > margin) return 0;
	const bool is_near = at_start <= margin;
	const bool is_touched =
		!is_near && way.length > 0 && advance(obstacle, &way, at_start, fmax(0.01 * margin, 1e-9 * way.length), &first);
	const double at_end = look(obstacle, &way, 1, &last);
	finish(&way, &first);
	finish(&way, &last);
	int count = 0;
	if (is_near || is_touched) contacts[count++] = first;
	const bool is_unseen =
		at_end < 0 && first.gap_end > SEEN * at_end; // the first plane does not stand for the surface there
	const bool is_missed = count == 0 ? at_end <= margin : is_unseen;
	if (is_missed && last.gap >= last.gap_end) contacts[count++] = last;
	return count;
}
