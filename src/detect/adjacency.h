/// @file adjacency.h
/// Which triangles of a skin meet at an edge and at a vertex, and whether the skin is closed.
#ifndef JN_DETECT_ADJACENCY_H
#define JN_DETECT_ADJACENCY_H

#include "detect/skin.h"

typedef struct JnAdjacency {
	int* across; ///< 3 * triangle_count: the triangle beyond the edge opposite each corner; -1: rim, or more than one
	int* round_start; ///< vertex_count + 1
	int* round;     ///< triangles round vertex v: round[round_start[v]] up to round[round_start[v + 1] - 1], ascending
	bool is_closed; ///< every edge has two triangles, which run along it in opposite directions
} JnAdjacency;

JnStatus jn_adjacency_create(const JnSkin* skin, JnArena* arena, JnAdjacency* out);

/// Whether a triangle shares a vertex with one of those round `vertex`, or holds it.
bool jn_adjacency_is_near(const JnAdjacency* adjacency, const JnSkin* skin, int vertex, int triangle);

#endif
