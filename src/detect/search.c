#include "detect/search.h"

#include <stdlib.h>

#include "base/log.h"
#include "math/vec3.h"

bool jn_search_grow(JnSearchMemory* memory, void** data, int* capacity, int wanted, size_t size) {
	if (wanted <= *capacity) return true;
	if (memory->status != JN_OK) return false;
	int enlarged = *capacity > 0 ? *capacity : 64;
	while (enlarged < wanted) enlarged *= 2;
	void* grown = realloc(*data, (size_t)enlarged * size);
	if (grown == NULL) {
		memory->status =
			jn_error(JN_OUT_OF_MEMORY, "out of memory: %d objects of %zu bytes wanted for contacts", enlarged, size);
		return false;
	}
	*data = grown;
	*capacity = enlarged;
	memory->counts.allocations++;
	return true;
}

void jn_search_memory_free(JnSearchMemory* memory) {
	free(memory->contacts);
	free(memory->triangles);
	free(memory->boxes);
	free(memory->nears);
	*memory = (JnSearchMemory){0};
}

static void keep(JnSearchMemory* memory, int count, const JnContact* found, int skin, int other_skin) {
	if (!jn_search_grow(memory, (void**)&memory->contacts, &memory->contact_capacity, memory->contact_count + count,
						sizeof *found))
		return;
	for (int i = 0; i < count; i++) {
		JnContact* contact = &memory->contacts[memory->contact_count++];
		*contact = found[i];
		contact->vertex_skin = skin;
		contact->other_skin = other_skin;
	}
}

/// All of a box may be left out when its centre is farther from the obstacle than its corners.
static bool is_far_from_obstacle(const JnTreeBox* box, const JnObstacle* obstacle) {
	double center[3], half[3], normal[3];
	for (int a = 0; a < 3; a++) {
		center[a] = 0.5 * box->low[a] + 0.5 * box->high[a];
		half[a] = 0.5 * (box->high[a] - box->low[a]);
	}
	return jn_obstacle_distance(obstacle, center, normal) > vec3_length(half) * (1 + 1e-12);
}

static void leaf_and_obstacle(const JnSearch* search, int mover, int leaf, int number, JnSearchMemory* memory) {
	const JnMover* mine = &search->movers[mover];
	for (int i = mine->tree.vertex_start[leaf]; i < mine->tree.vertex_start[leaf + 1]; i++) {
		JnContact found[JN_CONTACTS_MOST];
		const int count =
			jn_meeting_obstacle(mine, mine->tree.vertices[i], &search->obstacles[number], search->margin, found);
		for (int k = 0; k < count; k++) found[k].other = number;
		keep(memory, count, found, mover, JN_OBSTACLE_SKIN);
	}
}

static void search_obstacle(const JnSearch* search, int mover, int top, int number, JnSearchMemory* memory) {
	const JnTriangleTree* tree = &search->movers[mover].tree.tree;
	int stack[64] = {top};
	for (int depth = 1; depth > 0;) {
		const int box = stack[--depth];
		if (!(tree->boxes[box].low[0] <= tree->boxes[box].high[0])) continue; // no triangles
		if (is_far_from_obstacle(&tree->boxes[box], &search->obstacles[number])) continue;
		if (box >= tree->leaf_count) {
			leaf_and_obstacle(search, mover, box - tree->leaf_count, number, memory);
			continue;
		}
		stack[depth++] = 2 * box + 1;
		stack[depth++] = 2 * box;
	}
}

static void add_triangles(const JnMover* other, int leaf, const JnTreeBox* wanted, JnSearchMemory* memory) {
	const int first = JN_TREE_LEAF * leaf, last = first + JN_TREE_LEAF;
	const int room = memory->triangle_count + JN_TREE_LEAF;
	if (!jn_search_grow(memory, (void**)&memory->triangles, &memory->triangle_capacity, room, sizeof(int))) return;
	if (!jn_search_grow(memory, (void**)&memory->boxes, &memory->box_capacity, room, sizeof(JnTreeBox))) return;
	for (int i = first; i < last && i < other->skin->triangle_count; i++) {
		const int triangle = other->tree.tree.order[i];
		const JnTreeBox box = jn_motion_triangle_box(other->skin, &other->motion, triangle);
		if (!jn_boxes_touch(&box, wanted)) continue;
		memory->boxes[memory->triangle_count] = box;
		memory->triangles[memory->triangle_count++] = triangle;
	}
}

/// Triangles of a skin whose swept boxes touch the box of a leaf's vertices.
static void gather_triangles(const JnMover* other, const JnTreeBox* wanted, JnSearchMemory* memory) {
	const JnTriangleTree* tree = &other->tree.tree;
	int stack[64] = {1};
	memory->triangle_count = 0;
	for (int depth = 1; depth > 0;) {
		const int box = stack[--depth];
		if (!jn_boxes_touch(&tree->boxes[box], wanted)) continue;
		if (box >= tree->leaf_count) {
			add_triangles(other, box - tree->leaf_count, wanted, memory);
			continue;
		}
		stack[depth++] = 2 * box + 1;
		stack[depth++] = 2 * box;
	}
}

static JnTreeBox box_of_vertices(const JnMover* mine, int leaf) {
	const int first = mine->tree.vertex_start[leaf], end = mine->tree.vertex_start[leaf + 1];
	JnTreeBox whole = jn_motion_vertex_box(&mine->motion, mine->tree.vertices[first]);
	for (int i = first + 1; i < end; i++) {
		const JnTreeBox own = jn_motion_vertex_box(&mine->motion, mine->tree.vertices[i]);
		for (int a = 0; a < 3; a++) {
			whole.low[a] = fmin(whole.low[a], own.low[a]);
			whole.high[a] = fmax(whole.high[a], own.high[a]);
		}
	}
	return whole;
}

/// Whether vertex and triangle of the same skin never touch.
static bool is_neighbor(const JnSearch* search, const JnMover* mover, int vertex, int triangle) {
	if (jn_adjacency_is_near(&mover->adjacency, mover->skin, vertex, triangle)) return true;
	const int* t = mover->skin->triangles + 3 * (ptrdiff_t)triangle;
	const double *a = mover->rest + 3 * (ptrdiff_t)t[0], *b = mover->rest + 3 * (ptrdiff_t)t[1],
				 *c = mover->rest + 3 * (ptrdiff_t)t[2], *p = mover->rest + 3 * (ptrdiff_t)vertex;
	double w[3], at[3];
	jn_triangle_nearest(a, b, c, p, w);
	for (int k = 0; k < 3; k++) at[k] = w[0] * a[k] + w[1] * b[k] + w[2] * c[k];
	return vec3_distance(at, p) <= search->neighborhood;
}

/// The candidates of one vertex among the triangles gathered for its leaf.
static int select_candidates(const JnSearch* search, int mover, int other, int vertex, JnSearchMemory* memory) {
	const JnMover* mine = &search->movers[mover];
	const JnTreeBox box = jn_motion_vertex_box(&mine->motion, vertex);
	int count = 0;
	for (int i = 0; i < memory->triangle_count; i++) {
		const int triangle = memory->triangles[i];
		if (!jn_boxes_touch(&memory->boxes[i], &box)) continue;
		if (mover == other && is_neighbor(search, mine, vertex, triangle)) continue;
		memory->nears[count++] = (JnNear){.triangle = triangle};
	}
	memory->counts.tested += memory->triangle_count;
	memory->counts.candidates += count;
	return count;
}

static void leaf_and_skin(const JnSearch* search, int mover, int leaf, int other, JnSearchMemory* memory) {
	const JnMover* mine = &search->movers[mover];
	const int first = mine->tree.vertex_start[leaf], end = mine->tree.vertex_start[leaf + 1];
	if (first == end) return;
	const JnTreeBox wanted = box_of_vertices(mine, leaf);
	if (!jn_boxes_touch(&search->movers[other].tree.tree.boxes[1], &wanted)) return;
	gather_triangles(&search->movers[other], &wanted, memory);
	if (!jn_search_grow(memory, (void**)&memory->nears, &memory->near_capacity, memory->triangle_count, sizeof(JnNear)))
		return;
	for (int i = first; i < end; i++) {
		JnMeeting meeting = {.mine = mine,
							 .other = &search->movers[other],
							 .vertex = mine->tree.vertices[i],
							 .margin = search->margin,
							 .nears = memory->nears};
		JnContact found[JN_CONTACTS_MOST];
		meeting.count = select_candidates(search, mover, other, meeting.vertex, memory);
		keep(memory, jn_meeting_contacts(&meeting, found), found, mover, other);
	}
}

static void search_skin(const JnSearch* search, int mover, int top, int other, JnSearchMemory* memory) {
	const JnTriangleTree* tree = &search->movers[mover].tree.tree;
	const JnTreeBox* whole = &search->movers[other].tree.tree.boxes[1];
	int stack[64] = {top};
	for (int depth = 1; depth > 0;) {
		const int box = stack[--depth];
		if (!jn_boxes_touch(&tree->boxes[box], whole)) continue;
		if (box >= tree->leaf_count) {
			leaf_and_skin(search, mover, box - tree->leaf_count, other, memory);
			continue;
		}
		stack[depth++] = 2 * box + 1;
		stack[depth++] = 2 * box;
	}
}

void jn_search_part(const JnSearch* search, int mover, int box, JnSearchMemory* memory) {
	for (int i = 0; i < search->obstacle_count; i++) search_obstacle(search, mover, box, i, memory);
	for (int i = 0; i < search->mover_count; i++)
		if (i != mover || (search->self != NULL && search->self[mover])) search_skin(search, mover, box, i, memory);
}
