#include "view_map.h"

#include <stdlib.h>

#include "base/grow.h"

JnStatus view_map_add(ViewMap* map, int count, const int rows[], const double weights[]) {
	const int first = map->count > 0 ? map->ends[map->count - 1] : 0;
	const size_t entries = (size_t)first + (size_t)count;
	JN_TRY(jn_grow((void**)&map->ends, &map->point_room, (size_t)map->count + 1, sizeof *map->ends));
	JN_TRY(jn_grow((void**)&map->rows, &map->entry_room[0], entries, sizeof *map->rows));
	JN_TRY(jn_grow((void**)&map->weights, &map->entry_room[1], entries, sizeof *map->weights));
	for (int i = 0; i < count; ++i) {
		map->rows[first + i] = rows[i];
		map->weights[first + i] = (float)weights[i];
	}
	map->ends[map->count++] = first + count;
	return JN_OK;
}

JnStatus view_map_add_row(ViewMap* map, int row) {
	return view_map_add(map, 1, &row, (const double[]){1});
}

void view_map_apply(const ViewMap* map, int components, const double* array, float* out) {
	for (int point = 0, entry = 0; point < map->count; ++point, out += components) {
		for (int c = 0; c < components; ++c) out[c] = 0;
		for (; entry < map->ends[point]; ++entry) {
			const double* row = array + (ptrdiff_t)components * map->rows[entry];
			for (int c = 0; c < components; ++c) out[c] += (float)(map->weights[entry] * row[c]);
		}
	}
}

void view_map_free(ViewMap* map) {
	free(map->ends);
	free(map->rows);
	free(map->weights);
	*map = (ViewMap){0};
}
