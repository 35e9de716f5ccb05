#include "detect/skin.h"

#include "base/log.h"

static JnStatus check_numbers(int count, const int* triangles, int* highest) {
	*highest = -1;
	for (int i = 0; i < 3 * count; i++) {
		if (triangles[i] < 0)
			return jn_error(JN_BAD_INPUT, "triangle %d of a skin has the node %d; numbers begin at 0", i / 3,
							triangles[i]);
		if (triangles[i] > *highest) *highest = triangles[i];
	}
	return JN_OK;
}

JnStatus jn_skin_from_triangles(int count, const int* triangles, JnArena* arena, JnSkin* skin) {
	int highest;
	int *vertex_of, *nodes, *own;
	JN_TRY(check_numbers(count, triangles, &highest));
	JN_NEW(arena, vertex_of, (size_t)highest + 1); // first a mark of the nodes in use, then their vertex
	for (int i = 0; i < 3 * count; i++) vertex_of[triangles[i]] = 1;
	int used = 0;
	for (int node = 0; node <= highest; node++) used += vertex_of[node];
	JN_NEW(arena, nodes, used);
	JN_NEW(arena, own, 3 * (size_t)count);
	for (int node = 0, vertex = 0; node <= highest; node++) {
		if (vertex_of[node] == 0) continue;
		nodes[vertex] = node;
		vertex_of[node] = vertex++;
	}
	for (int i = 0; i < 3 * count; i++) own[i] = vertex_of[triangles[i]];
	*skin = (JnSkin){.vertex_count = used, .carriers = 1, .nodes = nodes, .triangle_count = count, .triangles = own};
	return JN_OK;
}

JnStatus jn_skin_from_embedding(const JnEmbedding* embedding, int first_node, JnArena* arena, JnSkin* skin) {
	const JnSurface* surface = &embedding->surface;
	const size_t carried = (size_t)embedding->cell_nodes * (size_t)surface->node_count;
	int *nodes, *triangles;
	double* weights;
	JN_NEW(arena, nodes, carried);
	JN_NEW(arena, weights, carried);
	JN_NEW(arena, triangles, 3 * (size_t)surface->triangle_count);
	for (size_t i = 0; i < carried; i++) {
		nodes[i] = embedding->nodes[i] + first_node;
		weights[i] = embedding->weights[i];
	}
	for (int i = 0; i < 3 * surface->triangle_count; i++) triangles[i] = surface->triangles[i];
	*skin = (JnSkin){.vertex_count = surface->node_count,
					 .carriers = embedding->cell_nodes,
					 .nodes = nodes,
					 .weights = weights,
					 .triangle_count = surface->triangle_count,
					 .triangles = triangles};
	return JN_OK;
}

void jn_skin_position(const JnSkin* skin, int vertex, const double* x, double out[3]) {
	const ptrdiff_t first = (ptrdiff_t)skin->carriers * vertex;
	if (skin->weights == NULL) {
		for (int a = 0; a < 3; a++) out[a] = x[3 * (ptrdiff_t)skin->nodes[vertex] + a];
		return;
	}
	for (int a = 0; a < 3; a++) out[a] = 0;
	for (ptrdiff_t i = first; i < first + skin->carriers; i++)
		for (int a = 0; a < 3; a++) out[a] += skin->weights[i] * x[3 * (ptrdiff_t)skin->nodes[i] + a];
}

void jn_skin_positions(const JnSkin* skin, const double* x, double* out) {
	for (int vertex = 0; vertex < skin->vertex_count; vertex++)
		jn_skin_position(skin, vertex, x, out + 3 * (ptrdiff_t)vertex);
}
