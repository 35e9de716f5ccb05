/// @file meeting.h
/// One vertex against one other body during a step: from candidates to contacts. Inside detect/ only.
#ifndef JN_DETECT_MEETING_H
#define JN_DETECT_MEETING_H

#include "detect/adjacency.h"
#include "detect/detector.h"
#include "detect/tree.h"

/// A skin with all that the detector knows of it.
typedef struct JnMover {
	const JnSkin* skin;
	JnAdjacency adjacency;
	JnSkinMotion motion;
	JnSkinTree tree;
	double* rest; ///< 3 * vertex_count; NULL: no search against itself
} JnMover;

/// A candidate triangle and its point nearest to the vertex at one moment.
typedef struct JnNear {
	int triangle;
	double weights[3];
	double offset[3]; ///< from that point to the vertex [m]
	double distance;  ///< its length;
	double facing;    ///< offset along the outward pseudonormal (Baerentzen, Aanaes 2005): < 0 behind; 0: not known
	double rank;      ///< candidates are taken in this order; INFINITY: not at all
} JnNear;

/// A vertex of one skin and its candidates on another. The candidates hold every triangle of `other` that may come
/// within the margin of the vertex during the step.
typedef struct JnMeeting {
	const JnMover *mine, *other; ///< the same for self contact
	int vertex;
	double margin; ///< [m]
	int count;     ///< candidates, in any order: the contacts do not depend on it
	JnNear* nears; ///< `count`; .triangle is given, all else is work space
} JnMeeting;

/// Find the contacts, at most JN_CONTACTS_MOST, with all but vertex_skin and other_skin filled in. Returns how many.
int jn_meeting_contacts(JnMeeting* meeting, JnContact* contacts);

/// The same for an obstacle: one contact, or two where it is not convex.
int jn_meeting_obstacle(const JnMover* mine, int vertex, const JnObstacle* obstacle, double margin,
						JnContact* contacts);

/// Vector between two positions at share `when` of the step.
static inline void jn_motion_at(const JnSkinMotion* motion, int vertex, double when, double out[3]) {
	for (int a = 0; a < 3; a++) {
		const ptrdiff_t at = 3 * (ptrdiff_t)vertex + a;
		out[a] = (1 - when) * motion->start[at] + when * motion->end[at];
	}
}

/// Point of a triangle at share `when` of the step.
static inline void jn_mover_point(const JnMover* mover, int triangle, const double weights[3], double when,
								  double out[3]) {
	const int* t = mover->skin->triangles + 3 * (ptrdiff_t)triangle;
	for (int a = 0; a < 3; a++) out[a] = 0;
	for (int i = 0; i < 3; i++) {
		double corner[3];
		jn_motion_at(&mover->motion, t[i], when, corner);
		for (int a = 0; a < 3; a++) out[a] += weights[i] * corner[a];
	}
}

#endif
