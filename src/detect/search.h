/// @file search.h
/// One thread's share of a search: candidates by the trees, then their contacts. Inside detect/ only.
#ifndef JN_DETECT_SEARCH_H
#define JN_DETECT_SEARCH_H

#include "detect/meeting.h"

/// Memory of a thread; it grows by doubling and is kept from step to step. All zero is valid.
typedef struct JnSearchMemory {
	int contact_count, contact_capacity;
	JnContact* contacts;
	int triangle_count, triangle_capacity, box_capacity;
	int* triangles;   ///< that may touch a vertex of the leaf at hand
	JnTreeBox* boxes; ///< theirs
	int near_capacity;
	JnNear* nears; ///< candidates of the vertex at hand
	JnContactCounts counts;
	JnStatus status; ///< of the first allocation that failed
} JnSearchMemory;

/// What all threads read.
typedef struct JnSearch {
	int mover_count;
	const JnMover* movers;
	const bool* self; ///< one a mover; NULL: none
	int obstacle_count;
	const JnObstacle* obstacles;
	double margin, neighborhood; ///< [m]
} JnSearch;

/// Find the contacts of the vertices below a box of a mover's tree: appended in the order of leaves, and for each vertex in
/// the order of obstacles and skins.
void jn_search_part(const JnSearch* search, int mover, int box, JnSearchMemory* memory);

/// Make room for `wanted` objects in *data. On failure nothing changes and memory->status tells.
bool jn_search_grow(JnSearchMemory* memory, void** data, int* capacity, int wanted, size_t size);

void jn_search_memory_free(JnSearchMemory* memory);

#endif
