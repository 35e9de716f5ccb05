/// @file recording_surface.h
/// The points of the recording that the triangles of a body use, numbered anew from 0 in ascending order.
#ifndef JN_APP_RECORDING_SURFACE_H
#define JN_APP_RECORDING_SURFACE_H

#include "recording.h"

typedef struct RecordingSurface {
	int vertex_count;
	const int* points; ///< vertex_count numbers of points of the recording
	int triangle_count;
	const int* triangles; ///< 3 * triangle_count numbers of vertices
} RecordingSurface;

/// Arrays are from the arena. JN_OUT_OF_MEMORY.
JnStatus recording_surface(const RecordingBody* body, JnArena* arena, RecordingSurface* surface);

/// Unit normals [3 * vertex_count] of a surface whose vertices are at x: the mean of its triangles, weighted by area;
/// along z where there is none.
void recording_normals(int vertex_count, const double* x, int triangle_count, const int* triangles, double* normals);

#endif
