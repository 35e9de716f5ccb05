/// @file export_crease.h
/// Surfaces whose edges look sharp where they are: a vertex is doubled where triangles meet at more than 50 degrees.
#ifndef JN_APP_EXPORT_CREASE_H
#define JN_APP_EXPORT_CREASE_H

#include "base/arena.h"

/// The vertices of a surface, and behind them copies of some.
typedef struct ExportCrease {
	int vertex_count;
	const int* sources;   ///< of vertex_count vertices: which one of the surface each is; a copy or itself
	const int* triangles; ///< 3 numbers of vertices for each triangle of the surface, in the same order
} ExportCrease;

/// Cut a surface at the edges that are sharp when its vertices are at x[3 * vertex_count]. JN_OUT_OF_MEMORY.
JnStatus export_crease(int vertex_count, const double* x, int triangle_count, const int* triangles, JnArena* arena,
					   ExportCrease* crease);

#endif
