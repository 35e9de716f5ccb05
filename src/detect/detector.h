/// @file detector.h
/// Who touches whom in a step. Vertices of each skin against the triangles of the others (and of itself), and against
/// obstacles, while all move on straight lines from their positions at the start of the step to those at its end.
///
/// What is found, for each vertex and each other body:
/// - A vertex outside that reaches the surface within the step gives a contact with the triangle that it reaches first,
///   with the normal and the weights of that moment. So nothing passes through something thin, however fast.
/// - One within the margin at the start gives a contact with the nearest point. Gap > 0 outside, < 0 inside. The normal is
///   the gradient of that signed distance: from the nearest point to the vertex, or the other way inside a closed surface.
///   A vertex deeper in a closed body than the margin is found too.
/// - Further points of the surface that are locally nearest, in front and within the margin give contacts as well, nearest
///   first, if their normals are more than 45 degrees from those before: corners and clefts. JN_CONTACTS_MOST at most.
/// - When none of these exist, one within the margin at the end of the step gives a contact with the nearest point then,
///   if it comes nearer along the normal there.
/// A surface with a rim (a sheet) has no inside: its gaps are >= 0 and its normals point to the side of the vertex; exactly
/// on it, to the side that it faces. Keep vertices at a small distance from sheets, so that rounding cannot exchange sides.
/// An obstacle gives one contact, from the same moments, and a second one where it is not convex and the first would let
/// the vertex end inside. Triangles without area touch by the triangles beside them.
#ifndef JN_DETECT_DETECTOR_H
#define JN_DETECT_DETECTOR_H

#include "detect/obstacle.h"
#include "detect/skin.h"

enum {
	JN_CONTACTS_MOST = 4, ///< contacts of one vertex with one other body
	JN_OBSTACLE_SKIN = -1 ///< JnContact.other_skin of an obstacle
};

typedef struct JnContact {
	int vertex_skin, vertex;
	int other_skin;    ///< JN_OBSTACLE_SKIN: an obstacle
	int other;         ///< triangle of the other skin, or number of the obstacle
	double weights[3]; ///< of the triangle's vertices, at the point touched: >= 0, they sum to 1; 0 for an obstacle
	double point[3];   ///< touched on an obstacle [m]; 0 for a triangle
	double normal[3];  ///< unit vector from the other to the vertex
	double gap;        ///< at the start: normal . (vertex - point touched) [m]; < 0: overlap
	double gap_end;    ///< the same at the end of the step as given, with this normal and these weights
	double when;       ///< moment that normal and weights are of: 0 start, 1 end, between: first touch
} JnContact;

/// What a search has cost.
typedef struct JnContactCounts {
	int64_t pairs;      ///< vertices times triangles, over all pairs of bodies searched
	int64_t tested;     ///< of these, pairs whose boxes were compared
	int64_t candidates; ///< of these, pairs whose boxes touch: closest points were computed
	int64_t contacts;
	int rebuilt;     ///< trees that were built anew, not refitted
	int allocations; ///< buffers that had to grow
} JnContactCounts;

/// Contacts ordered by vertex_skin, vertex, other_skin, and then as found: touches first, then by gap.
typedef struct JnContactList {
	int count;
	const JnContact* contacts; ///< belong to the detector until its next search
	JnContactCounts counts;
} JnContactList;

typedef struct JnDetectorOptions {
	int threads;        ///< >= 1; the result is the same for any number
	const bool* self;   ///< one a skin: search it against itself; NULL: none
	const double* rest; ///< positions of the model's nodes at rest [m], read during creation; needed by `self` alone
	/// Vertices and triangles of a skin that are no farther apart at rest never touch each other [m]; nor does a vertex
	/// touch triangles that share a vertex with one of its own. Should exceed the margin, else a sheet finds itself.
	double neighborhood;
	/// A tree is built anew when its boxes have this many times the area that they had when built, both relative to the
	/// boxes of the triangles, so that motion and margin alone do not count. 0: 2.
	double degradation;
} JnDetectorOptions;

typedef struct JnDetector JnDetector;

/// Skins and obstacles are borrowed: they, and what they point to, must outlive the detector; options are copied.
/// JN_OUT_OF_MEMORY after a message. Free with jn_detector_destroy, which takes NULL too.
JnStatus jn_detector_create(int skin_count, const JnSkin* skins, int obstacle_count, const JnObstacle* obstacles,
							const JnDetectorOptions* options, JnDetector** out);
void jn_detector_destroy(JnDetector* detector);

/// Find the contacts within `margin` >= 0 [m] while the model's nodes move from x_start to x_end [m]; both may be the
/// same. JN_NOT_FINITE when a coordinate is not finite.
JnStatus jn_detector_find(JnDetector* detector, const double* x_start, const double* x_end, double margin,
						  JnContactList* out);

#endif
