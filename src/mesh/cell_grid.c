// Each cell goes into all buckets that its box, a little grown, reaches; counted first, then filled.
#include "mesh/cell_grid.h"

#include <limits.h>
#include <math.h>
#include <string.h>

static const double GROWTH = 1e-6; // of a bucket's width: rounding must not lose a cell
enum { BUCKETS_A_CELL = 8 };       // at most, where the mesh leaves much of its bounding box empty

void jn_cell_box(const JnMesh* mesh, int cell, double low[3], double high[3]) {
	const int count = jn_shape_info[mesh->shape].nodes;
	const int* nodes = mesh->cells + (ptrdiff_t)cell * count;
	for (int a = 0; a < 3; ++a) {
		low[a] = INFINITY, high[a] = -INFINITY;
		for (int i = 0; i < count; ++i) {
			const double x = mesh->nodes[3 * (ptrdiff_t)nodes[i] + a];
			if (x < low[a]) low[a] = x;
			if (x > high[a]) high[a] = x;
		}
	}
}

bool jn_cell_grid_is_near(const JnCellGrid* grid, const JnMesh* mesh, int cell, const double point[3]) {
	double low[3], high[3];
	const double slack = GROWTH * grid->width;
	jn_cell_box(mesh, cell, low, high);
	bool is_near = true;
	for (int a = 0; a < 3; ++a) is_near = is_near && point[a] >= low[a] - slack && point[a] <= high[a] + slack;
	return is_near;
}

static double bucket_count(const JnCellGrid* grid, const double top[3]) {
	double count = 1;
	for (int a = 0; a < 3; ++a) count *= floor((top[a] - grid->low[a]) / grid->width) + 1;
	return count;
}

/// As wide as a cell is on average, wider when that were too many. Begun half a bucket before the cells: those of a
/// regular grid then meet two buckets along each axis, and not three.
static void lay_out(const JnMesh* mesh, JnCellGrid* grid) {
	double low[3], high[3], extent = 0, top[3] = {-INFINITY, -INFINITY, -INFINITY};
	for (int a = 0; a < 3; ++a) grid->low[a] = INFINITY;
	for (int cell = 0; cell < mesh->cell_count; ++cell) {
		jn_cell_box(mesh, cell, low, high);
		for (int a = 0; a < 3; ++a) {
			extent += (high[a] - low[a]) / 3 / mesh->cell_count;
			grid->low[a] = fmin(grid->low[a], low[a]), top[a] = fmax(top[a], high[a]);
		}
	}
	const double most = fmin((double)BUCKETS_A_CELL * mesh->cell_count + 64, INT_MAX / 2);
	grid->width = extent > 0 ? extent : 1;
	for (int a = 0; a < 3; ++a) grid->low[a] -= grid->width / 2;
	while (bucket_count(grid, top) > most) grid->width *= 1.25;
	for (int a = 0; a < 3; ++a) grid->counts[a] = 1 + (int)((top[a] - grid->low[a]) / grid->width);
}

static int bucket_along(const JnCellGrid* grid, int axis, double x) {
	const double place = (x - grid->low[axis]) / grid->width;
	return (int)fmin(fmax(place, 0), grid->counts[axis] - 1);
}

/// Count a cell in all its buckets, and enter it there once there is a list.
static void enter_cell(JnCellGrid* grid, const JnMesh* mesh, int cell) {
	double low[3], high[3];
	int from[3], to[3];
	jn_cell_box(mesh, cell, low, high);
	for (int a = 0; a < 3; ++a) {
		from[a] = bucket_along(grid, a, low[a] - GROWTH * grid->width);
		to[a] = bucket_along(grid, a, high[a] + GROWTH * grid->width);
	}
	for (int z = from[2]; z <= to[2]; ++z) {
		for (int y = from[1]; y <= to[1]; ++y) {
			int* start = grid->starts + ((ptrdiff_t)z * grid->counts[1] + y) * grid->counts[0];
			for (int x = from[0]; x <= to[0]; ++x) {
				if (grid->list != NULL) grid->list[start[x]] = cell;
				++start[x];
			}
		}
	}
}

JnStatus jn_cell_grid_create(const JnMesh* mesh, JnArena* arena, JnCellGrid* grid) {
	*grid = (JnCellGrid){0};
	lay_out(mesh, grid);
	const int buckets = grid->counts[0] * grid->counts[1] * grid->counts[2];
	JN_NEW(arena, grid->starts, (size_t)buckets + 1);
	for (int cell = 0; cell < mesh->cell_count; ++cell) enter_cell(grid, mesh, cell);
	int total = 0;
	for (int b = 0; b <= buckets; ++b) {
		const int count = grid->starts[b];
		grid->starts[b] = total;
		total += count;
	}
	JN_NEW(arena, grid->list, (size_t)total + 1);
	for (int cell = 0; cell < mesh->cell_count; ++cell) enter_cell(grid, mesh, cell);
	memmove(grid->starts + 1, grid->starts, (size_t)buckets * sizeof *grid->starts); // each stands at its end now
	grid->starts[0] = 0;
	return JN_OK;
}

int jn_cell_grid_at(const JnCellGrid* grid, const double point[3], const int** cells) {
	for (int a = 0; a < 3; ++a) {
		const double place = (point[a] - grid->low[a]) / grid->width;
		if (!(place >= -GROWTH && place <= grid->counts[a] + GROWTH)) return 0;
	}
	const ptrdiff_t row =
		(ptrdiff_t)bucket_along(grid, 2, point[2]) * grid->counts[1] + bucket_along(grid, 1, point[1]);
	const ptrdiff_t bucket = row * grid->counts[0] + bucket_along(grid, 0, point[0]);
	*cells = grid->list + grid->starts[bucket];
	return grid->starts[bucket + 1] - grid->starts[bucket];
}
