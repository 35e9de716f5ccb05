// What relaxation moves in a mesh: springs on edges, the axis of a thread, volumes of cells.
#include <stdlib.h>

#include "base/log.h"
#include "force/constraint/rest.h"
#include "force/relax.h"
#include "math/vec3.h"

/// Elements of one kernel while they are listed.
typedef struct List {
	int count;
	JnRelaxElement* elements;
} List;

static const double* at(const JnMesh* mesh, int node) {
	return mesh->nodes + 3 * (ptrdiff_t)node;
}

static void add_spring(const JnMesh* mesh, int a, int b, List* list) {
	list->elements[list->count++] =
		(JnRelaxElement){.nodes = {a < b ? a : b, a < b ? b : a}, .rest = {vec3_distance(at(mesh, a), at(mesh, b))}};
}

static int compare(const void* a, const void* b) {
	const int *e = ((const JnRelaxElement*)a)->nodes, *f = ((const JnRelaxElement*)b)->nodes;
	return e[0] != f[0] ? (e[0] > f[0]) - (e[0] < f[0]) : (e[1] > f[1]) - (e[1] < f[1]);
}

// Each once, in the order of their nodes: a sweep goes along the body.
static void drop_doubles(List* list) {
	int kept = 0;
	qsort(list->elements, (size_t)list->count, sizeof *list->elements, compare);
	for (int k = 0; k < list->count; ++k)
		if (kept == 0 || compare(&list->elements[k], &list->elements[kept - 1]) != 0)
			list->elements[kept++] = list->elements[k];
	list->count = kept;
}

static JnStatus list_edges(const JnMesh* mesh, JnArena* scratch, List* list) {
	JN_NEW(scratch, list->elements, 6 * (size_t)mesh->cell_count);
	for (int c = 0; c < mesh->cell_count; ++c)
		for (int i = 0; i < 4; ++i)
			for (int j = 0; j < i; ++j)
				add_spring(mesh, mesh->cells[4 * (ptrdiff_t)c + i], mesh->cells[4 * (ptrdiff_t)c + j], list);
	drop_doubles(list);
	return JN_OK;
}

static JnStatus list_lines(const JnMesh* mesh, JnArena* scratch, List* list) {
	const JnThread* thread = mesh->thread;
	JN_NEW(scratch, list->elements, (ROD_STRUTS + LINK_SIDES) * (size_t)jn_thread_links(thread));
	for (int link = 0; link < jn_thread_links(thread); ++link) {
		int nodes[LINK_NODES];
		jn_link_nodes(thread, link, nodes);
		for (int k = 0; k < ROD_STRUTS; ++k) add_spring(mesh, nodes[link_struts[k][0]], nodes[link_struts[k][1]], list);
		for (int k = 0; k < LINK_SIDES; ++k)
			add_spring(mesh, nodes[JN_FRAME_NODES + link_struts[k][0]], nodes[JN_FRAME_NODES + link_struts[k][1]],
					   list);
	}
	drop_doubles(list);
	return JN_OK;
}

static JnStatus list_axis(const JnMesh* mesh, JnArena* scratch, List* list) {
	const JnThread* thread = mesh->thread;
	JN_NEW(scratch, list->elements, jn_thread_links(thread));
	for (int link = 0; link < jn_thread_links(thread); ++link) {
		JnRelaxElement* element = &list->elements[list->count++];
		double d[3] = {0};
		jn_link_nodes(thread, link, element->nodes);
		for (int i = 0; i < JN_FRAME_NODES; ++i) {
			element->rest[i] = thread->axis[i];
			for (int a = 0; a < 3; ++a)
				d[a] += thread->axis[i] * (at(mesh, element->nodes[3 + i])[a] - at(mesh, element->nodes[i])[a]);
		}
		element->rest[JN_FRAME_NODES] = vec3_length(d);
	}
	return JN_OK;
}

// d_0 . (d_1 x d_2) / 6 with the edges d from node 3.
static double signed_volume(const JnMesh* mesh, const int nodes[4]) {
	double d[3][3], n[3];
	for (int i = 0; i < 3; ++i)
		for (int a = 0; a < 3; ++a) d[i][a] = at(mesh, nodes[i])[a] - at(mesh, nodes[3])[a];
	vec3_cross(d[1], d[2], n);
	return vec3_dot(d[0], n) / 6;
}

static JnStatus list_volumes(const JnMesh* mesh, JnArena* scratch, List* list) {
	JN_NEW(scratch, list->elements, mesh->cell_count);
	for (int c = 0; c < mesh->cell_count; ++c) {
		JnRelaxElement* element = &list->elements[list->count++];
		for (int i = 0; i < 4; ++i) element->nodes[i] = mesh->cells[4 * (ptrdiff_t)c + i];
		element->rest[0] = signed_volume(mesh, element->nodes);
	}
	return JN_OK;
}

typedef JnStatus Lister(const JnMesh* mesh, JnArena* scratch, List* list);

static JnStatus add_group(JnRelaxKernel which, Lister* lister, const JnMesh* mesh, int first_node, JnArena* arena,
						  JnGroups* out) {
	JnArena scratch = {0};
	List list = {0};
	JnStatus status = lister(mesh, &scratch, &list);
	if (status == JN_OK)
		status = jn_relax_group_create(jn_relax_kernel(which, 0), list.count, list.elements, first_node, arena,
									   &out->list[out->count++]);
	jn_arena_free(&scratch);
	return status;
}

static JnStatus build(unsigned kinds, Lister* springs, const JnMesh* mesh, int first_node, JnArena* arena,
					  JnGroups* out) {
	*out = (JnGroups){0};
	JN_NEW(arena, out->list, JN_RELAX_COUNT);
	if (kinds & JN_RELAXED_SPRINGS) JN_TRY(add_group(JN_RELAX_spring, springs, mesh, first_node, arena, out));
	if ((kinds & JN_RELAXED_AXIS) && mesh->thread != NULL)
		JN_TRY(add_group(JN_RELAX_axis, list_axis, mesh, first_node, arena, out));
	if (kinds & JN_RELAXED_VOLUMES) JN_TRY(add_group(JN_RELAX_volume, list_volumes, mesh, first_node, arena, out));
	return JN_OK;
}

JnStatus jn_relax_edges(unsigned kinds, const JnMesh* mesh, int first_node, JnArena* arena, JnGroups* out) {
	return build(kinds, list_edges, mesh, first_node, arena, out);
}

JnStatus jn_relax_lines(unsigned kinds, const JnMesh* mesh, int first_node, JnArena* arena, JnGroups* out) {
	return build(kinds, list_lines, mesh, first_node, arena, out);
}
