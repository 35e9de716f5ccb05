// What a volume mesh from elsewhere must be before anyone simulates it: whole numbers in range, every node in its own
// place and in use, every cell right side out and with a volume.
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/log.h"
#include "math/mat3.h"
#include "mesh/repair.h"

/// Thinner than this, in units of its longest edge cubed, a cell has no volume.
static const double LEAST_VOLUME = 1e-12;

/// The first of those that are wrong, as a text, and how many there are.
typedef struct Offenders {
	int count, length;
	char text[200];
} Offenders;

enum { NAMED_OFFENDERS = 5 };

static void offend(Offenders* offenders, int number) {
	const char* comma = offenders->count > 0 ? ", " : "";
	if (offenders->count < NAMED_OFFENDERS)
		offenders->length += snprintf(offenders->text + offenders->length,
									  sizeof offenders->text - (size_t)offenders->length, "%s%d", comma, number);
	if (offenders->count == NAMED_OFFENDERS)
		snprintf(offenders->text + offenders->length, sizeof offenders->text - (size_t)offenders->length, ", ...");
	++offenders->count;
}

/// "<what>: 3 cells <fault> (counted from 0: 4, 8, 9)".
static JnStatus tell(const Offenders* offenders, const char* what, const char* noun, const char* fault) {
	if (offenders->count == 0) return JN_OK;
	const bool is_one = offenders->count == 1;
	return jn_error(JN_BAD_INPUT, "%s: %d %s%s %s (counted from 0: %s)", what, offenders->count, noun,
					is_one ? "" : "s", fault, offenders->text);
}

static int* cell_nodes(const JnMesh* mesh, int cell) {
	return mesh->cells + (ptrdiff_t)cell * jn_shape_info[mesh->shape].nodes;
}

static bool has_node_out_of_range(const JnMesh* mesh, int cell) {
	const int* nodes = cell_nodes(mesh, cell);
	for (int i = 0; i < jn_shape_info[mesh->shape].nodes; ++i)
		if (nodes[i] < 0 || nodes[i] >= mesh->node_count) return true;
	return false;
}

static bool has_node_twice(const JnMesh* mesh, int cell) {
	const int* nodes = cell_nodes(mesh, cell);
	for (int i = 0; i < jn_shape_info[mesh->shape].nodes; ++i)
		for (int j = 0; j < i; ++j)
			if (nodes[i] == nodes[j]) return true;
	return false;
}

/// det J at the Gauss point next to each corner must have one sign: else the cell is partly inside out.
static bool is_folded(const JnMesh* mesh, int cell) {
	static const int corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
									 {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
	if (mesh->shape != JN_HEX8) return false;
	const double own = 0.5 + 0.5 / sqrt(3.0); // weight of a corner's side at the Gauss point next to it
	int positive = 0;
	for (int point = 0; point < 8; ++point) {
		double J[3][3] = {{0}};
		for (int i = 0; i < 8; ++i) {
			const double* X = mesh->nodes + 3 * (ptrdiff_t)cell_nodes(mesh, cell)[i];
			double weight[3];
			for (int r = 0; r < 3; ++r) weight[r] = corner[i][r] == corner[point][r] ? own : 1 - own;
			for (int k = 0; k < 9; ++k)
				J[k / 3][k % 3] += X[k / 3] * (2 * corner[i][k % 3] - 1) * weight[(k + 1) % 3] * weight[(k + 2) % 3];
		}
		positive += mat3_determinant(J) > 0;
	}
	return positive != 0 && positive != 8;
}

/// The volume below which rounding of coordinates of that size, or LEAST_VOLUME, leaves nothing of a cell.
static double volume_floor(const JnMesh* mesh, int cell) {
	double extent = 0, size = 0;
	for (int a = 0; a < 3; ++a) {
		double low = INFINITY, high = -INFINITY;
		for (int i = 0; i < jn_shape_info[mesh->shape].nodes; ++i) {
			const double x = mesh->nodes[3 * (ptrdiff_t)cell_nodes(mesh, cell)[i] + a];
			low = fmin(low, x);
			high = fmax(high, x);
		}
		extent = fmax(extent, high - low);
		size = fmax(size, fmax(fabs(low), fabs(high)));
	}
	return fmax(LEAST_VOLUME * extent, 8 * DBL_EPSILON * size) * extent * extent;
}

static void turn(const JnMesh* mesh, int cell) {
	static const int mirror[JN_SHAPE_COUNT][10] = {
		[JN_TET4] = {0, 2, 1, 3}, [JN_TET10] = {0, 2, 1, 3, 6, 5, 4, 7, 9, 8}, [JN_HEX8] = {4, 5, 6, 7, 0, 1, 2, 3}};
	const int count = jn_shape_info[mesh->shape].nodes;
	int before[10];
	memcpy(before, cell_nodes(mesh, cell), (size_t)count * sizeof(int));
	for (int i = 0; i < count; ++i) cell_nodes(mesh, cell)[i] = before[mirror[mesh->shape][i]];
}

static JnStatus check_numbers(const JnMesh* mesh, const char* what) {
	Offenders range = {0}, twice = {0}, infinite = {0};
	if (mesh->node_count == 0 || mesh->cell_count == 0) return jn_error(JN_BAD_INPUT, "%s: holds no cells", what);
	for (int cell = 0; cell < mesh->cell_count; ++cell) {
		if (has_node_out_of_range(mesh, cell)) offend(&range, cell);
		if (has_node_twice(mesh, cell)) offend(&twice, cell);
	}
	for (int node = 0; node < mesh->node_count; ++node) {
		const double* X = mesh->nodes + 3 * (ptrdiff_t)node;
		if (!isfinite(X[0]) || !isfinite(X[1]) || !isfinite(X[2])) offend(&infinite, node);
	}
	JN_TRY(tell(&range, what, "cell", "with node numbers that are out of range"));
	JN_TRY(tell(&twice, what, "cell", "with a node twice"));
	return tell(&infinite, what, "node", "with coordinates that are not finite");
}

/// Keep the members that have a new number; a set without any goes.
static void renumber_sets(JnMesh* mesh, const int* number, const char* what) {
	int kept_sets = 0;
	for (int s = 0; s < mesh->set_count; ++s) {
		JnNodeSet set = mesh->sets[s];
		int kept = 0;
		for (int i = 0; i < set.count; ++i)
			if (number[set.nodes[i]] >= 0) set.nodes[kept++] = number[set.nodes[i]];
		set.count = kept;
		if (kept > 0)
			mesh->sets[kept_sets++] = set;
		else
			jn_warn("%s: the node set \"%s\" is left out: no cell uses its nodes", what, set.name);
	}
	mesh->set_count = kept_sets;
}

static JnStatus drop_unused_nodes(JnMesh* mesh, const char* what, JnArena* scratch) {
	int* number;
	JN_NEW(scratch, number, mesh->node_count);
	const ptrdiff_t entries = (ptrdiff_t)mesh->cell_count * jn_shape_info[mesh->shape].nodes;
	for (ptrdiff_t k = 0; k < entries; ++k) number[mesh->cells[k]] = 1;
	int kept = 0;
	for (int node = 0; node < mesh->node_count; ++node) {
		const bool is_used = number[node] == 1;
		number[node] = is_used ? kept : -1;
		if (is_used)
			memmove(mesh->nodes + 3 * (ptrdiff_t)kept++, mesh->nodes + 3 * (ptrdiff_t)node, 3 * sizeof(double));
	}
	if (kept == mesh->node_count) return JN_OK;
	mesh->node_count = kept;
	for (ptrdiff_t k = 0; k < entries; ++k) mesh->cells[k] = number[mesh->cells[k]];
	renumber_sets(mesh, number, what);
	return JN_OK;
}

typedef struct Place {
	double X[3];
	int node;
} Place;

static int by_place(const void* left, const void* right) {
	const Place *a = left, *b = right;
	for (int k = 0; k < 3; ++k)
		if (a->X[k] != b->X[k]) return a->X[k] < b->X[k] ? -1 : 1;
	return 0;
}

static JnStatus check_places(const JnMesh* mesh, const char* what, JnArena* scratch) {
	Place* places;
	JN_NEW(scratch, places, mesh->node_count);
	for (int i = 0; i < mesh->node_count; ++i) {
		memcpy(places[i].X, mesh->nodes + 3 * (ptrdiff_t)i, sizeof places[i].X);
		places[i].node = i;
	}
	qsort(places, (size_t)mesh->node_count, sizeof *places, by_place);
	Offenders same = {0};
	for (int i = 1; i < mesh->node_count; ++i)
		if (by_place(&places[i - 1], &places[i]) == 0) offend(&same, places[i].node);
	return tell(&same, what, "node", "at the place of another; merge them where the mesh was made");
}

static JnStatus turn_cells(const JnMesh* mesh, const char* what) {
	Offenders flat = {0}, folded = {0}, turned = {0};
	for (int cell = 0; cell < mesh->cell_count; ++cell) {
		const double volume = jn_mesh_cell_volume(mesh, cell);
		if (!(fabs(volume) > volume_floor(mesh, cell)))
			offend(&flat, cell);
		else if (is_folded(mesh, cell))
			offend(&folded, cell);
		else if (volume < 0)
			offend(&turned, cell);
		if (volume < 0) turn(mesh, cell);
	}
	JN_TRY(tell(&flat, what, "cell", "without volume"));
	JN_TRY(tell(&folded, what, "hex8 cell", "partly inside out; is the order of nodes that of the format?"));
	if (turned.count > 0)
		jn_warn("%s: %d of %d cells were inside out and have been turned (counted from 0: %s)", what, turned.count,
				mesh->cell_count, turned.text);
	return JN_OK;
}

static JnStatus repair(JnMesh* mesh, const char* what, JnArena* scratch) {
	JN_TRY(check_numbers(mesh, what));
	JN_TRY(drop_unused_nodes(mesh, what, scratch));
	JN_TRY(check_places(mesh, what, scratch));
	return turn_cells(mesh, what);
}

JnStatus jn_mesh_repair(JnMesh* mesh, const char* what, JnArena* arena) {
	(void)arena; // the mesh only shrinks, in place
	JnArena scratch = {0};
	const JnStatus status = repair(mesh, what, &scratch);
	jn_arena_free(&scratch);
	return status;
}
