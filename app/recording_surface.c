#include "recording_surface.h"

#include <string.h>

#include "math/vec3.h"

JnStatus recording_surface(const RecordingBody* body, JnArena* arena, RecordingSurface* surface) {
	const size_t corners = 3 * (size_t)body->triangle_count;
	int *vertex, *points, *triangles; // vertex: of each point, from 1; 0: unused
	*surface = (RecordingSurface){.triangle_count = body->triangle_count};
	JN_NEW(arena, vertex, body->point_count + 1);
	JN_NEW(arena, triangles, corners + 1);
	for (size_t i = 0; i < corners; ++i) vertex[body->triangles[i] - body->first_point] = 1;
	for (int i = 0; i < body->point_count; ++i)
		if (vertex[i] != 0) vertex[i] = ++surface->vertex_count;
	JN_NEW(arena, points, surface->vertex_count + 1);
	for (int i = 0; i < body->point_count; ++i)
		if (vertex[i] != 0) points[vertex[i] - 1] = body->first_point + i;
	for (size_t i = 0; i < corners; ++i) triangles[i] = vertex[body->triangles[i] - body->first_point] - 1;
	surface->points = points;
	surface->triangles = triangles;
	return JN_OK;
}

void recording_normals(int vertex_count, const double* x, int triangle_count, const int* triangles, double* normals) {
	memset(normals, 0, 3 * (size_t)vertex_count * sizeof *normals);
	for (int t = 0; t < triangle_count; ++t) {
		const int* corner = triangles + 3 * (ptrdiff_t)t;
		double normal[3];
		vec3_triangle(x + 3 * (ptrdiff_t)corner[0], x + 3 * (ptrdiff_t)corner[1], x + 3 * (ptrdiff_t)corner[2], normal);
		for (int k = 0; k < 9; ++k) normals[3 * (ptrdiff_t)corner[k / 3] + k % 3] += normal[k % 3];
	}
	for (int i = 0; i < vertex_count; ++i) {
		double* normal = normals + 3 * (ptrdiff_t)i;
		vec3_normalize(normal);
		if (vec3_dot(normal, normal) == 0) normal[2] = 1;
	}
}
