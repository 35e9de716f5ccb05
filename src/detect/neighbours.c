// A counting sort of the points by cell, with their coordinates beside each other in that order; then the 27 cells around
// each point, in its own order, so that pairs come out sorted by their first point.
#include "detect/neighbours.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/grow.h"
#include "base/log.h"

static const double ROUNDING = 1e-9; // of the radius: points of a lattice lie at it, whatever their sums round to

typedef struct Point {
	double x[3];
	int number;
} Point;

typedef struct Grid {
	double low[3], width; // [m]
	int counts[3];
	Point* points; // by cell
	int* starts;   // one more than cells
} Grid;

static bool is_finite(const double x[3]) {
	return isfinite(x[0]) && isfinite(x[1]) && isfinite(x[2]);
}

// Cells as wide as the radius, or wider where the points lie so far apart that most cells would be empty.
static size_t lay_out(const double* points, int count, double radius, Grid* grid) {
	double high[3] = {-INFINITY, -INFINITY, -INFINITY};
	for (int a = 0; a < 3; ++a) grid->low[a] = INFINITY;
	for (int i = 0; i < count; ++i) {
		const double* x = points + 3 * (ptrdiff_t)i;
		for (int a = 0; a < 3 && is_finite(x); ++a) {
			grid->low[a] = fmin(grid->low[a], x[a]);
			high[a] = fmax(high[a], x[a]);
		}
	}
	grid->width = radius;
	for (;; grid->width *= 2) {
		double cells = 1, along[3];
		for (int a = 0; a < 3; ++a) {
			along[a] = fmax(1, floor((high[a] - grid->low[a]) / grid->width) + 1); // 1 also where that is no number
			cells *= along[a];
		}
		if (!(cells <= 4.0 * count + 64)) continue;
		for (int a = 0; a < 3; ++a) grid->counts[a] = (int)along[a];
		return (size_t)cells;
	}
}

static int place_along(const Grid* grid, int axis, double x) {
	const double place = (x - grid->low[axis]) / grid->width;
	return (int)fmax(0, fmin(place, grid->counts[axis] - 1)); // fmax: 0 where x is not a number
}

static size_t cell_of(const Grid* grid, const double x[3]) {
	const size_t row =
		(size_t)place_along(grid, 2, x[2]) * (size_t)grid->counts[1] + (size_t)place_along(grid, 1, x[1]);
	return row * (size_t)grid->counts[0] + (size_t)place_along(grid, 0, x[0]);
}

static void sort_points(const double* points, int count, size_t cells, Grid* grid) {
	int* starts = grid->starts + 1; // shifted by one while filling
	memset(grid->starts, 0, (cells + 2) * sizeof *grid->starts);
	for (int i = 0; i < count; ++i) ++starts[cell_of(grid, points + 3 * (ptrdiff_t)i) + 1];
	for (size_t c = 0; c < cells; ++c) starts[c + 1] += starts[c];
	for (int i = 0; i < count; ++i) {
		Point* point = &grid->points[starts[cell_of(grid, points + 3 * (ptrdiff_t)i)]++];
		memcpy(point->x, points + 3 * (ptrdiff_t)i, sizeof point->x);
		point->number = i;
	}
}

static JnStatus make_grid(const double* points, int count, double radius, JnNeighbours* out, Grid* grid) {
	const size_t cells = lay_out(points, count, radius, grid), head = (size_t)count * sizeof(Point);
	JN_TRY(jn_grow(&out->cells, &out->cells_capacity, head + (cells + 2) * sizeof(int), 1));
	grid->points = out->cells;
	grid->starts = (int*)((char*)out->cells + head);
	sort_points(points, count, cells, grid);
	return JN_OK;
}

static void insert_sorted(int* list, int count) {
	for (int i = 1; i < count; ++i) {
		const int number = list[i];
		int k = i;
		for (; k > 0 && list[k - 1] > number; --k) list[k] = list[k - 1];
		list[k] = number;
	}
}

// A row of cells along x, whose points stand behind each other.
static int search_row(const Grid* grid, const int from[3], int to_x, const double x[3], int self, double most,
					  int* list) {
	const size_t row = ((size_t)from[2] * (size_t)grid->counts[1] + (size_t)from[1]) * (size_t)grid->counts[0];
	const int end = grid->starts[row + (size_t)to_x + 1];
	int count = 0;
	for (int k = grid->starts[row + (size_t)from[0]]; k < end; ++k) {
		const Point* other = &grid->points[k];
		const double d[3] = {other->x[0] - x[0], other->x[1] - x[1], other->x[2] - x[2]};
		list[count] = other->number;
		count += other->number > self && d[0] * d[0] + d[1] * d[1] + d[2] * d[2] <= most;
	}
	return count;
}

static int points_between(const Grid* grid, const int low[3], const int high[3]) {
	int count = 0;
	for (int z = low[2]; z <= high[2]; ++z)
		for (int y = low[1]; y <= high[1]; ++y) {
			const size_t row = ((size_t)z * (size_t)grid->counts[1] + (size_t)y) * (size_t)grid->counts[0];
			count += grid->starts[row + (size_t)high[0] + 1] - grid->starts[row + (size_t)low[0]];
		}
	return count;
}

static JnStatus search(const Grid* grid, const double* x, int self, double radius, size_t place, JnNeighbours* out,
					   int* found) {
	int low[3], high[3], count = 0;
	const double most = radius * radius * (1 + 2 * ROUNDING);
	for (int a = 0; a < 3; ++a) {
		low[a] = place_along(grid, a, x[a] - radius * (1 + ROUNDING));
		high[a] = place_along(grid, a, x[a] + radius * (1 + ROUNDING));
	}
	const size_t room = place + (size_t)points_between(grid, low, high) + 1;
	JN_TRY(jn_grow((void**)&out->list, &out->list_capacity, room, sizeof *out->list));
	for (int z = low[2]; z <= high[2]; ++z)
		for (int y = low[1]; y <= high[1]; ++y)
			count += search_row(grid, (int[3]){low[0], y, z}, high[0], x, self, most, out->list + place + count);
	insert_sorted(out->list + place, count);
	*found = count;
	return JN_OK;
}

JnStatus jn_neighbours_find(const double* points, int count, double radius, const char* what, JnNeighbours* out) {
	Grid grid = {0};
	size_t place = 0;
	out->point_count = count;
	JN_TRY(jn_grow((void**)&out->starts, &out->starts_capacity, (size_t)count + 1, sizeof *out->starts));
	JN_TRY(make_grid(points, count, radius, out, &grid));
	for (int i = 0; i < count; ++i) {
		const double* x = points + 3 * (ptrdiff_t)i;
		int found = 0;
		out->starts[i] = (int)place;
		if (is_finite(x)) JN_TRY(search(&grid, x, i, radius, place, out, &found));
		place += (size_t)found;
		if (place <= INT_MAX) continue;
		return jn_error(JN_BAD_INPUT,
						"%s: %d of %d points have more than %d pairs within %g m; use a smaller radius or fewer points",
						what, i + 1, count, INT_MAX, radius);
	}
	out->starts[count] = (int)place;
	return JN_OK;
}

void jn_neighbours_release(JnNeighbours* neighbours) {
	free(neighbours->starts);
	free(neighbours->list);
	free(neighbours->cells);
	*neighbours = (JnNeighbours){0};
}
