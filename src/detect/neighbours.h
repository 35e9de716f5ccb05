/// @file neighbours.h
/// All pairs of points within a distance of each other, by sorting the points into cells as wide as the distance: work
/// and memory grow with the number of points and pairs alone.
#ifndef JN_DETECT_NEIGHBOURS_H
#define JN_DETECT_NEIGHBOURS_H

#include "jounce/base.h"

/// The pairs i < j: of point i they are list[starts[i]] up to list[starts[i + 1]], ascending. All zero is valid and empty;
/// may be filled again, with memory that grows. Free with jn_neighbours_release.
typedef struct JnNeighbours {
	int point_count;
	int* starts; ///< point_count + 1
	int* list;   ///< starts[point_count] point numbers
	size_t starts_capacity, list_capacity;
	void* cells; ///< work space: the points by cell
	size_t cells_capacity;
} JnNeighbours;

/// Find the pairs at most `radius` apart [m], radius > 0 and finite; a pair at the radius is one, within a rounding of
/// 1e-9 of it. `points` has three coordinates each; one that is not finite is no neighbour of any. `what` is the key
/// path for messages. JN_BAD_INPUT when there are more pairs than an int counts, JN_OUT_OF_MEMORY.
JnStatus jn_neighbours_find(const double* points, int count, double radius, const char* what, JnNeighbours* out);

void jn_neighbours_release(JnNeighbours* neighbours);

#endif
