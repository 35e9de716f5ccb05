/// @file touch.h
/// When does a point first reach a triangle, while all four move on straight lines (Provot 1997).
#ifndef JN_DETECT_TOUCH_H
#define JN_DETECT_TOUCH_H

#include <stdbool.h>

typedef enum JnTouchSides {
	JN_TOUCH_FRONT, ///< only through the side that the triangle faces
	JN_TOUCH_BOTH
} JnTouchSides;

/// A point p and a triangle: p, a, b, c at the start and at the end of the step [m].
typedef struct JnTouchPath {
	const double *start[4], *end[4];
} JnTouchPath;

typedef struct JnTouch {
	double when;       ///< between 0 and 1
	double weights[3]; ///< of the triangle's corners
	double normal[3];  ///< unit normal of the triangle at that moment, towards where the point comes from
} JnTouch;

/// Find the first moment at which the point goes through the triangle; false when there is none. A point that passes
/// beside the triangle by less than 1e-6 of its longest edge counts, so that nothing slips through between two. A point
/// that moves within the plane of the triangle, and a triangle without area at that moment, give no touch. One that starts
/// in the plane counts as in front.
bool jn_touch_first(const JnTouchPath* path, JnTouchSides sides, JnTouch* out);

#endif
