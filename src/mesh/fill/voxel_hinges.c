// Parts of a mesh of cubes: cells that share a face belong together (union-find). A node whose cells belong to different
// parts is a hinge.
//
// The eight places around a node are numbered by bits, x 1, y 2, z 4; two places that differ in one bit share a face.
#include "base/log.h"
#include "mesh/fill/voxel_grid.h"

/// Place, seen from its corner i, that a cell has; hex8 corners run around z = 0, then around z = 1.
static const int place_of_corner[8] = {7, 6, 4, 5, 3, 2, 0, 1};

static int part_of(int* parents, int cell) {
	while (parents[cell] != cell) {
		parents[cell] = parents[parents[cell]];
		cell = parents[cell];
	}
	return cell;
}

static void join(int* parents, int left, int right) {
	const int a = part_of(parents, left), b = part_of(parents, right);
	if (a < b)
		parents[b] = a;
	else
		parents[a] = b;
}

static void join_over_faces(const int around[8], int* parents) {
	for (int place = 0; place < 8; ++place) {
		for (int bit = 1; bit < 8; bit *= 2) {
			const int left = around[place], right = around[place ^ bit];
			if (left > 0 && right > 0 && left < right) join(parents, left - 1, right - 1);
		}
	}
}

static bool is_hinge(const int around[8], int* parents) {
	int part = -1;
	for (int place = 0; place < 8; ++place) {
		if (around[place] == 0) continue;
		const int other = part_of(parents, around[place] - 1);
		if (part >= 0 && other != part) return true;
		part = other;
	}
	return false;
}

JnStatus jn_voxel_warn_hinges(const JnMesh* mesh, const char* what) {
	JnArena scratch = {0};
	int* around = jn_arena_take(&scratch, 8 * (size_t)mesh->node_count, sizeof *around); // cell + 1; 0: none
	int* parents = jn_arena_take(&scratch, (size_t)mesh->cell_count, sizeof *parents);
	if (around == NULL || parents == NULL) {
		jn_arena_free(&scratch);
		return JN_OUT_OF_MEMORY;
	}
	for (int cell = 0; cell < mesh->cell_count; ++cell) {
		parents[cell] = cell;
		for (int i = 0; i < 8; ++i)
			around[8 * (ptrdiff_t)mesh->cells[8 * (ptrdiff_t)cell + i] + place_of_corner[i]] = cell + 1;
	}
	int parts = 0, hinges = 0;
	for (int node = 0; node < mesh->node_count; ++node) join_over_faces(around + 8 * (ptrdiff_t)node, parents);
	for (int node = 0; node < mesh->node_count; ++node) hinges += is_hinge(around + 8 * (ptrdiff_t)node, parents);
	for (int cell = 0; cell < mesh->cell_count; ++cell) parts += parents[cell] == cell;
	jn_arena_free(&scratch);
	if (hinges > 0)
		jn_warn(
			"%s: the cubes are %d parts, some of which hang together by edges or corners alone (nodes there: %d) and "
			"bend like hinges; another size may help",
			what, parts, hinges);
	return JN_OK;
}
