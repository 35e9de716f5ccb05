// The surfaces of bodies that threads meet: triangles, and edges with what is on their sides.
#include <stdlib.h>

#include "base/log.h"
#include "mesh/boundary.h"
#include "pass/collision.h"

// A side of an edge, and its triangle.
typedef struct Side {
	int low, high, triangle;
} Side;

static int compare(const void* a, const void* b) {
	const Side *first = a, *second = b;
	if (first->low != second->low) return first->low < second->low ? -1 : 1;
	if (first->high != second->high) return first->high < second->high ? -1 : 1;
	return (first->triangle > second->triangle) - (first->triangle < second->triangle);
}

static void list_edges(JnHide* hide, Side* sides) {
	const int* triangles = hide->skin.triangles;
	const int count = 3 * hide->skin.triangle_count;
	for (int i = 0; i < count; ++i) {
		const int from = triangles[i], to = triangles[i % 3 == 2 ? i - 2 : i + 1];
		sides[i] = (Side){from < to ? from : to, from < to ? to : from, i / 3};
	}
	qsort(sides, (size_t)count, sizeof *sides, compare);
	for (int i = 0; i < count; ++i) {
		int* edge = hide->edges[hide->edge_count++];
		edge[0] = sides[i].low;
		edge[1] = sides[i].high;
		edge[2] = sides[i].triangle;
		edge[3] = -1;
		if (i + 1 == count || sides[i + 1].low != edge[0] || sides[i + 1].high != edge[1]) continue;
		edge[3] = sides[++i].triangle;
	}
}

static JnStatus create_edges(JnHide* hide, JnArena* arena) {
	Side* sides;
	JnArena scratch = {0};
	JN_NEW(arena, hide->edges, 3 * (size_t)hide->skin.triangle_count);
	sides = jn_arena_take(&scratch, 3 * (size_t)hide->skin.triangle_count, sizeof *sides);
	if (sides != NULL) list_edges(hide, sides);
	jn_arena_free(&scratch);
	return sides != NULL ? JN_OK : JN_OUT_OF_MEMORY;
}

/// Impulses need a mass a node; those of corners of tet10 are negative as sums of the rows of a consistent matrix.
static JnStatus check_masses(const JnCollision* pass, const JnHide* hide) {
	for (int v = 0; v < hide->skin.vertex_count; ++v)
		if (!(pass->model->nodal_mass[hide->skin.nodes[v]] > 0))
			return jn_error(
				JN_BAD_INPUT,
				"bodies[%d].mass: its row sums are not positive at all nodes of '%s', which collisions with threads "
				"need; say `mass: lumped`",
				hide->body, pass->model->bodies[hide->body].name);
	return JN_OK;
}

static JnStatus create(JnCollision* pass, int index) {
	const JnBody* body = &pass->model->bodies[index];
	int count, *triangles;
	if (body->mesh.embedding != NULL || body->mesh.shape == JN_TRI3)
		return jn_error(
			JN_BAD_INPUT,
			"collision: bodies[%d] '%s' is %s, which threads cannot meet yet; fill it with tetrahedra, or say "
			"`contact: {active: false}` for it",
			index, body->name, body->mesh.shape == JN_TRI3 ? "a cloth" : "carried along by voxels");
	JN_TRY(jn_mesh_boundary(&body->mesh, &pass->arena, &count, &triangles));
	if (count == 0) return JN_OK;
	JnHide* hide = &pass->hides[pass->hide_count++];
	for (int i = 0; i < 3 * count; ++i) triangles[i] += body->first_node;
	JN_TRY(jn_skin_from_triangles(count, triangles, &pass->arena, &hide->skin));
	hide->body = hide->skin.body = index;
	hide->first_vertex = pass->vertex_count;
	pass->vertex_count += hide->skin.vertex_count;
	JN_TRY(check_masses(pass, hide));
	return create_edges(hide, &pass->arena);
}

JnStatus jn_collision_hides_create(JnCollision* pass) {
	const JnModel* model = pass->model;
	JN_NEW(&pass->arena, pass->hides, model->body_count);
	for (int b = 0; b < model->body_count; ++b)
		if (model->bodies[b].mesh.thread == NULL && model->bodies[b].contact.active) JN_TRY(create(pass, b));
	return JN_OK;
}
