/// @file view_map.h
/// What is drawn, as weighted sums of what is recorded: point = sum of weight * row of an array.
#ifndef JN_APP_VIEW_MAP_H
#define JN_APP_VIEW_MAP_H

#include <stddef.h>

#include "jounce/base.h"

/// Sparse rows; all zero is empty.
typedef struct ViewMap {
	int count;                        ///< points
	int* ends;                        ///< where each point's entries end
	int* rows;                        ///< one an entry: a row of the array
	float* weights;                   ///< one an entry
	size_t point_room, entry_room[2]; ///< capacities of `ends`, and of `rows` and `weights`
} ViewMap;

/// Append a point of `count` entries. JN_OUT_OF_MEMORY.
JnStatus view_map_add(ViewMap* map, int count, const int rows[], const double weights[]);

/// Append a point that is a row of the array.
JnStatus view_map_add_row(ViewMap* map, int row);

/// out[components * map->count] from the array's rows of as many components.
void view_map_apply(const ViewMap* map, int components, const double* array, float* out);

void view_map_free(ViewMap* map);

#endif
