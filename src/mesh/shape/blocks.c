// Nodes of all blocks are placed one by one; a hash of space finds those that exist already.
#include "mesh/shape/blocks.h"

#include <math.h>
#include <string.h>

#include "base/log.h"
#include "mesh/fill/quadratic.h"

static const double MOST_CELLS = 2e7;
static const double SAME_PLACE = 1e-7; // of the size; cells are larger by far, rounding is smaller by far

/// Nodes of blocks as they are placed, before and after those that coincide are one.
typedef struct Weld {
	double* points; // 3 a point, block by block
	int point_count;
	int* node; // of each point
	int node_count;
	double reach; // distance within which points are one
	double edge;  // of the cubes of the hash
	int slots;    // a power of 2
	int* first;   // first point of a slot, -1: none
	int* next;    // the next one in the same slot
} Weld;

static int point_count(const JnBlock* block) {
	return (block->cells[0] + 1) * (block->cells[1] + 1) * (block->cells[2] + 1);
}

static int point_at(const JnBlock* block, const int at[3]) {
	return (at[2] * (block->cells[1] + 1) + at[1]) * (block->cells[0] + 1) + at[0];
}

static void point_place(const JnBlock* block, int point, int at[3]) {
	const int row = block->cells[0] + 1, sheet = row * (block->cells[1] + 1);
	at[0] = point % row;
	at[1] = point % sheet / row;
	at[2] = point / sheet;
}

static void place_points(int count, const JnBlock* blocks, double* points) {
	for (int b = 0; b < count; ++b)
		for (int point = 0; point < point_count(&blocks[b]); ++point, points += 3) {
			int at[3];
			point_place(&blocks[b], point, at);
			blocks[b].place(&blocks[b], at, points);
		}
}

static double size_of(int count, const double* points) {
	double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY}, size = 0;
	for (int k = 0; k < 3 * count; ++k) {
		low[k % 3] = fmin(low[k % 3], points[k]);
		high[k % 3] = fmax(high[k % 3], points[k]);
	}
	for (int axis = 0; axis < 3; ++axis) size = fmax(size, high[axis] - low[axis]);
	return size;
}

/// The slot of the cube in which X + shift lies.
static int slot_of(const Weld* weld, const double X[3], const double shift[3]) {
	uint64_t key = 0;
	for (int axis = 0; axis < 3; ++axis) {
		const int64_t cube = (int64_t)floor((X[axis] + shift[axis]) / weld->edge);
		key = (key ^ (uint64_t)cube) * 0x9e3779b97f4a7c15u;
		key ^= key >> 29;
	}
	return (int)(key & (uint64_t)(weld->slots - 1));
}

static bool is_same(const Weld* weld, int a, int b) {
	const double *p = weld->points + 3 * (size_t)a, *q = weld->points + 3 * (size_t)b;
	return fmax(fabs(p[0] - q[0]), fmax(fabs(p[1] - q[1]), fabs(p[2] - q[2]))) <= weld->reach;
}

/// An earlier point at the place of `point`, or -1. Cubes are wider than twice the reach, so that at most eight meet it.
static int find_earlier(const Weld* weld, int point) {
	for (int corner = 0; corner < 8; ++corner) {
		double shift[3];
		for (int axis = 0; axis < 3; ++axis) shift[axis] = (2 * jn_hex_corner[corner][axis] - 1) * weld->reach;
		int other = weld->first[slot_of(weld, weld->points + 3 * (size_t)point, shift)];
		while (other >= 0 && !is_same(weld, other, point)) other = weld->next[other];
		if (other >= 0) return other;
	}
	return -1;
}

static void number_nodes(Weld* weld) {
	static const double still[3] = {0, 0, 0};
	for (int slot = 0; slot < weld->slots; ++slot) weld->first[slot] = -1;
	for (int point = 0; point < weld->point_count; ++point) {
		const int earlier = find_earlier(weld, point);
		weld->node[point] = earlier >= 0 ? weld->node[earlier] : weld->node_count++;
		if (earlier >= 0) continue;
		const int slot = slot_of(weld, weld->points + 3 * (size_t)point, still);
		weld->next[point] = weld->first[slot];
		weld->first[slot] = point;
	}
}

static JnStatus weld_points(int count, const JnBlock* blocks, JnArena* scratch, Weld* weld) {
	for (int b = 0; b < count; ++b) weld->point_count += point_count(&blocks[b]);
	for (weld->slots = 64; weld->slots < weld->point_count; weld->slots *= 2) continue;
	JN_NEW(scratch, weld->points, 3 * (size_t)weld->point_count);
	JN_NEW(scratch, weld->node, weld->point_count);
	JN_NEW(scratch, weld->next, weld->point_count);
	JN_NEW(scratch, weld->first, weld->slots);
	place_points(count, blocks, weld->points);
	weld->reach = SAME_PLACE * size_of(weld->point_count, weld->points);
	weld->edge = 4 * weld->reach;
	number_nodes(weld);
	return JN_OK;
}

/// Exchange the lower and the upper face.
static void mirror(int* cell) {
	for (int i = 0; i < 4; ++i) {
		const int keep = cell[i];
		cell[i] = cell[i + 4];
		cell[i + 4] = keep;
	}
}

static int put_block(const JnBlock* block, const int* node, JnMesh* mesh, int cell) {
	const int first = cell, count = block->cells[0] * block->cells[1] * block->cells[2];
	for (int k = 0; k < count; ++k, ++cell) {
		const int low[3] = {k % block->cells[0], k / block->cells[0] % block->cells[1],
							k / block->cells[0] / block->cells[1]};
		for (int i = 0; i < 8; ++i) {
			const int at[3] = {low[0] + jn_hex_corner[i][0], low[1] + jn_hex_corner[i][1],
							   low[2] + jn_hex_corner[i][2]};
			mesh->cells[8 * (size_t)cell + (size_t)i] = node[point_at(block, at)];
		}
	}
	const bool is_inside_out = jn_mesh_cell_volume(mesh, first) < 0;
	for (int k = first; is_inside_out && k < cell; ++k) mirror(mesh->cells + 8 * (size_t)k);
	return cell;
}

static JnStatus put_cells(int count, const JnBlock* blocks, const Weld* weld, JnArena* arena, JnMesh* mesh) {
	mesh->shape = JN_HEX8;
	mesh->node_count = weld->node_count;
	JN_NEW(arena, mesh->nodes, 3 * (size_t)mesh->node_count);
	JN_NEW(arena, mesh->cells, 8 * (size_t)mesh->cell_count);
	for (int point = weld->point_count - 1; point >= 0; --point) // the first of those that are one has the last word
		memcpy(mesh->nodes + 3 * (size_t)weld->node[point], weld->points + 3 * (size_t)point, 3 * sizeof(double));
	const int* node = weld->node;
	for (int b = 0, cell = 0; b < count; ++b) {
		cell = put_block(&blocks[b], node, mesh, cell);
		node += point_count(&blocks[b]);
	}
	return JN_OK;
}

static bool is_at(const JnBlock* block, int place, int point) {
	int at[3];
	if (place == JN_BLOCK_WHOLE) return true;
	point_place(block, point, at);
	return at[place / 2] == (place % 2 == 0 ? 0 : block->cells[place / 2]);
}

static void mark_set(int count, const JnBlock* blocks, const int* node, const char* name, bool* chosen) {
	for (int b = 0; b < count; node += point_count(&blocks[b++]))
		for (int place = 0; place < JN_BLOCK_PLACES; ++place) {
			if (blocks[b].sets[place] == NULL || strcmp(blocks[b].sets[place], name) != 0) continue;
			for (int point = 0; point < point_count(&blocks[b]); ++point)
				if (is_at(&blocks[b], place, point)) chosen[node[point]] = true;
		}
}

static JnStatus put_set(JnMesh* mesh, const char* name, const bool* chosen, JnArena* arena) {
	JnNodeSet* set = &mesh->sets[mesh->set_count++];
	set->name = name;
	for (int i = 0; i < mesh->node_count; ++i) set->count += chosen[i];
	JN_NEW(arena, set->nodes, set->count);
	for (int i = 0, k = 0; i < mesh->node_count; ++i)
		if (chosen[i]) set->nodes[k++] = i;
	return JN_OK;
}

static bool has_set(const JnMesh* mesh, const char* name) {
	for (int i = 0; i < mesh->set_count; ++i)
		if (strcmp(mesh->sets[i].name, name) == 0) return true;
	return false;
}

static JnStatus put_sets(int count, const JnBlock* blocks, const Weld* weld, JnArena* scratch, JnArena* arena,
						 JnMesh* mesh) {
	bool* chosen;
	JN_NEW(scratch, chosen, mesh->node_count);
	JN_NEW(arena, mesh->sets, count * JN_BLOCK_PLACES);
	for (int k = 0; k < count * JN_BLOCK_PLACES; ++k) {
		const char* name = blocks[k / JN_BLOCK_PLACES].sets[k % JN_BLOCK_PLACES];
		if (name == NULL || has_set(mesh, name)) continue;
		memset(chosen, 0, (size_t)mesh->node_count * sizeof *chosen);
		mark_set(count, blocks, weld->node, name, chosen);
		JN_TRY(put_set(mesh, name, chosen, arena));
	}
	return JN_OK;
}

static JnStatus join_hexahedra(int count, const JnBlock* blocks, JnArena* arena, JnMesh* mesh) {
	JnArena scratch = {0};
	Weld weld = {0};
	JnStatus status = weld_points(count, blocks, &scratch, &weld);
	if (status == JN_OK) status = put_cells(count, blocks, &weld, arena, mesh);
	if (status == JN_OK) status = put_sets(count, blocks, &weld, &scratch, arena, mesh);
	jn_arena_free(&scratch);
	return status;
}

static JnStatus check_volumes(const JnMesh* mesh, const char* what) {
	int flat = 0, first = 0;
	for (int cell = mesh->cell_count - 1; cell >= 0; --cell) {
		if (jn_mesh_cell_volume(mesh, cell) > 0) continue;
		first = cell;
		++flat;
	}
	if (flat == 0) return JN_OK;
	const double* X = mesh->nodes + 3 * (size_t)mesh->cells[(size_t)first * (size_t)jn_shape_info[mesh->shape].nodes];
	return jn_error(
		JN_BAD_INPUT,
		"%s: %d of %d cells come out flat or inside out, the first near [%g, %g, %g] m; choose a shape that "
		"is less extreme, or other numbers of cells",
		what, flat, mesh->cell_count, X[0], X[1], X[2]);
}

JnStatus jn_blocks_join(int count, const JnBlock* blocks, JnShape element, const char* what, JnArena* arena,
						JnMesh* mesh) {
	double cells = 0;
	for (int b = 0; b < count; ++b) cells += (double)blocks[b].cells[0] * blocks[b].cells[1] * blocks[b].cells[2];
	const double share = element == JN_HEX8 ? 1 : 6;
	if (cells * share > MOST_CELLS)
		return jn_error(JN_BAD_INPUT, "%s.cells: they make %.3g cells of %s, more than %.0g; use fewer", what,
						cells * share, jn_shape_info[element].name, MOST_CELLS);
	JnMesh hexahedra = {.cell_count = (int)cells}, tetrahedra;
	JN_TRY(join_hexahedra(count, blocks, arena, &hexahedra));
	*mesh = hexahedra;
	if (element == JN_HEX8) return check_volumes(mesh, what);
	JN_TRY(jn_blocks_cut(&hexahedra, arena, &tetrahedra));
	JN_TRY(check_volumes(&tetrahedra, what));
	*mesh = tetrahedra;
	return element == JN_TET10 ? jn_mesh_add_middles(&tetrahedra, arena, mesh) : JN_OK;
}
