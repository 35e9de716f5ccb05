// Edges of a surface by sorting, and sentences about them.
#include "mesh/surface_edges.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int by_nodes(const void* left, const void* right) {
	const JnEdgeSide *a = left, *b = right;
	if (a->low != b->low) return a->low < b->low ? -1 : 1;
	if (a->high != b->high) return a->high < b->high ? -1 : 1;
	return (a->place > b->place) - (a->place < b->place);
}

JnStatus jn_surface_edges(const JnSurface* surface, JnArena* arena, JnEdgeSide** sides) {
	const int count = 3 * surface->triangle_count;
	JN_NEW(arena, *sides, (size_t)count + 1);
	for (int place = 0; place < count; place++) {
		const int from = surface->triangles[place], to = surface->triangles[place % 3 == 2 ? place - 2 : place + 1];
		(*sides)[place] = (JnEdgeSide){from < to ? from : to, from < to ? to : from, place};
	}
	qsort(*sides, (size_t)count, sizeof **sides, by_nodes);
	return JN_OK;
}

int jn_edge_side_count(const JnEdgeSide* sides, int first, int total) {
	int next = first + 1;
	while (next < total && sides[next].low == sides[first].low && sides[next].high == sides[first].high) next++;
	return next - first;
}

bool jn_edge_goes_up(const JnSurface* surface, const JnEdgeSide* side) {
	return surface->triangles[side->place] == side->low;
}

void jn_offenders_add(JnOffenders* offenders, const char* format, ...) {
	if (offenders->count++ >= JN_OFFENDERS_NAMED) return;
	const size_t used = strlen(offenders->text);
	const int comma = snprintf(offenders->text + used, sizeof offenders->text - used, "%s", used > 0 ? ", " : "");
	const size_t start = used + (size_t)comma;
	if (start >= sizeof offenders->text) return;
	va_list arguments;
	va_start(arguments, format);
	vsnprintf(offenders->text + start, sizeof offenders->text - start, format, arguments);
	va_end(arguments);
}

void jn_offenders_add_edge(JnOffenders* offenders, const JnSurface* surface, const JnEdgeSide* side) {
	const double* a = surface->nodes + 3 * (ptrdiff_t)side->low;
	const double* b = surface->nodes + 3 * (ptrdiff_t)side->high;
	jn_offenders_add(offenders, "(%.4g, %.4g, %.4g)-(%.4g, %.4g, %.4g)", a[0], a[1], a[2], b[0], b[1], b[2]);
}

const char* jn_offenders_rest(const JnOffenders* offenders) {
	return offenders->count > JN_OFFENDERS_NAMED ? ", and more" : "";
}
