// Faces are sorted by their nodes; those that come once are the boundary.
#include "mesh/boundary.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_CORNERS = 4 };

typedef struct Face {
	int key[MOST_CORNERS]; // corners, ascending; -1 behind them
	int place;             // cell * faces + face
} Face;

static int corners_of(JnShape shape) {
	return shape == JN_HEX8 ? 4 : 3;
}

static const int* local_face(const JnShapeInfo* info, int face) {
	return info->face + face * info->face_nodes;
}

static Face face_at(const JnMesh* mesh, int cell, int face) {
	const JnShapeInfo* info = &jn_shape_info[mesh->shape];
	const int* nodes = mesh->cells + (ptrdiff_t)cell * info->nodes;
	Face out = {.key = {-1, -1, -1, -1}, .place = cell * info->faces + face};
	for (int i = 0; i < corners_of(mesh->shape); ++i) {
		const int node = nodes[local_face(info, face)[i]];
		int k = i;
		for (; k > 0 && out.key[k - 1] > node; --k) out.key[k] = out.key[k - 1];
		out.key[k] = node;
	}
	return out;
}

static int by_nodes(const void* left, const void* right) {
	const Face *a = left, *b = right;
	for (int i = 0; i < MOST_CORNERS; ++i)
		if (a->key[i] != b->key[i]) return a->key[i] < b->key[i] ? -1 : 1;
	return 0;
}

static int by_place(const void* left, const void* right) {
	const Face *a = left, *b = right;
	return (a->place > b->place) - (a->place < b->place);
}

/// Move the faces that come once to the front, in the order of cells; returns how many.
static int keep_outer(Face* faces, int count) {
	qsort(faces, (size_t)count, sizeof *faces, by_nodes);
	int kept = 0;
	for (int i = 0, next = 0; i < count; i = next) {
		for (next = i + 1; next < count && by_nodes(&faces[i], &faces[next]) == 0;) ++next;
		if (next == i + 1) faces[kept++] = faces[i];
	}
	qsort(faces, (size_t)kept, sizeof *faces, by_place);
	return kept;
}

static int* put(int* out, int a, int b, int c) {
	*out++ = a;
	*out++ = b;
	*out++ = c;
	return out;
}

static int* put_quad(int* out, const int* q) {
	int low = 0;
	for (int i = 1; i < 4; ++i)
		if (q[i] < q[low]) low = i;
	const int a = q[low], b = q[(low + 1) % 4], c = q[(low + 2) % 4], d = q[(low + 3) % 4];
	return put(put(out, a, b, c), a, c, d);
}

/// q: corners 0 1 2, then the middles of 01, 12, 20.
static int* put_six(int* out, const int* q) {
	out = put(put(out, q[0], q[3], q[5]), q[3], q[1], q[4]);
	return put(put(out, q[5], q[4], q[2]), q[3], q[4], q[5]);
}

static int* put_face(const JnMesh* mesh, int place, int* out) {
	const JnShapeInfo* info = &jn_shape_info[mesh->shape];
	const int* nodes = mesh->cells + (ptrdiff_t)(place / info->faces) * info->nodes;
	int q[6] = {0};
	for (int i = 0; i < info->face_nodes; ++i) q[i] = nodes[local_face(info, place % info->faces)[i]];
	if (mesh->shape == JN_HEX8) return put_quad(out, q);
	return mesh->shape == JN_TET10 ? put_six(out, q) : put(out, q[0], q[1], q[2]);
}

JnStatus jn_mesh_boundary(const JnMesh* mesh, JnArena* arena, int* count, int** triangles) {
	static const int triangles_a_face[JN_SHAPE_COUNT] = {[JN_TET4] = 1, [JN_TET10] = 4, [JN_HEX8] = 2, [JN_TRI3] = 1};
	const int faces = jn_shape_info[mesh->shape].faces;
	JnArena scratch = {0};
	Face* list = jn_arena_take(&scratch, (size_t)mesh->cell_count * (size_t)faces + 1, sizeof *list);
	if (list == NULL) return JN_OUT_OF_MEMORY;
	for (int i = 0; i < mesh->cell_count * faces; ++i) list[i] = face_at(mesh, i / faces, i % faces);
	const int outer = keep_outer(list, mesh->cell_count * faces);
	*count = outer * triangles_a_face[mesh->shape];
	*triangles = jn_arena_take(arena, 3 * (size_t)*count + 1, sizeof **triangles);
	if (*triangles != NULL) {
		int* out = *triangles;
		for (int i = 0; i < outer; ++i) out = put_face(mesh, list[i].place, out);
	}
	jn_arena_free(&scratch);
	return *triangles != NULL ? JN_OK : JN_OUT_OF_MEMORY;
}
