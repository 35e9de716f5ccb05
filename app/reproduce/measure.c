#include "reproduce/measure.h"

#include <math.h>
#include <string.h>

#include "base/log.h"

double measure_span(int count, const double times[], const double values[], double from, double to) {
	double low = INFINITY, high = -INFINITY;
	for (int i = 0; i < count; ++i) {
		if (!(times[i] >= from && times[i] <= to)) continue;
		low = fmin(low, values[i]);
		high = fmax(high, values[i]);
	}
	return high >= low ? high - low : NAN;
}

// Lowest coordinate along an axis, the next one above it, and the highest.
static void find_spacing(int count, const double* rest, int axis, double out[3]) {
	double low = INFINITY, next = INFINITY, high = -INFINITY;
	for (int i = 0; i < count; ++i) {
		low = fmin(low, rest[3 * i + axis]);
		high = fmax(high, rest[3 * i + axis]);
	}
	for (int i = 0; i < count; ++i)
		if (rest[3 * i + axis] > low + 1e-6 * (high - low)) next = fmin(next, rest[3 * i + axis]);
	out[0] = low;
	out[1] = next;
	out[2] = high;
}

JnStatus sheet_grid_create(int count, const double* rest, JnArena* arena, SheetGrid* grid) {
	double span[2][3];
	*grid = (SheetGrid){0};
	for (int axis = 0; axis < 2; ++axis) {
		find_spacing(count, rest, axis, span[axis]);
		const double cells = (span[axis][2] - span[axis][0]) / (span[axis][1] - span[axis][0]);
		if (!(cells < 1e4)) return jn_error(JN_BAD_INPUT, "the nodes of the cloth are on no grid");
		grid->cells[axis] = (int)round(cells);
	}
	const size_t points = (size_t)(grid->cells[0] + 1) * (size_t)(grid->cells[1] + 1);
	JN_NEW(arena, grid->node, count);
	JN_NEW(arena, grid->members, points);
	JN_NEW(arena, grid->middle, 3 * points);
	JN_NEW(arena, grid->work, 6 * points);
	for (int i = 0; i < count; ++i) {
		int at[2];
		for (int axis = 0; axis < 2; ++axis) {
			const double u = (rest[3 * i + axis] - span[axis][0]) / (span[axis][1] - span[axis][0]);
			at[axis] = (int)round(u);
			if (fabs(u - at[axis]) > 0.01) return jn_error(JN_BAD_INPUT, "the nodes of the cloth are on no even grid");
		}
		grid->node[i] = at[1] * (grid->cells[0] + 1) + at[0];
		++grid->members[grid->node[i]];
	}
	return JN_OK;
}

static void find_middle(SheetGrid* grid, int count, const double* points) {
	const size_t size = 3 * (size_t)(grid->cells[0] + 1) * (size_t)(grid->cells[1] + 1);
	memset(grid->middle, 0, size * sizeof *grid->middle);
	for (int i = 0; i < count; ++i)
		for (int c = 0; c < 3; ++c)
			grid->middle[3 * grid->node[i] + c] += points[3 * i + c] / grid->members[grid->node[i]];
}

// out = (I - S) in, at the points that are at least `margin` grid lines inside.
static void take_off_mean(const SheetGrid* grid, int reach, int margin, const double* in, double* out) {
	const int row = grid->cells[0] + 1, side = 2 * reach + 1;
	for (int j = margin; j <= grid->cells[1] - margin; ++j)
		for (int i = margin; i <= grid->cells[0] - margin; ++i)
			for (int c = 0; c < 3; ++c) {
				double sum = 0;
				for (int k = 0; k < side * side; ++k)
					sum += in[3 * ((j + k / side - reach) * row + i + k % side - reach) + c];
				out[3 * (j * row + i) + c] = in[3 * (j * row + i) + c] - sum / (side * side);
			}
}

double measure_wrinkles(SheetGrid* grid, int count, const double* points) {
	const int shorter = grid->cells[0] < grid->cells[1] ? grid->cells[0] : grid->cells[1];
	const int row = grid->cells[0] + 1, half = (int)round((shorter / 8.0 - 1) / 2), reach = half > 1 ? half : 1;
	const size_t size = 3 * (size_t)row * (size_t)(grid->cells[1] + 1);
	double sum = 0;
	int inside = 0;
	find_middle(grid, count, points);
	take_off_mean(grid, reach, reach, grid->middle, grid->work);
	take_off_mean(grid, reach, 2 * reach, grid->work, grid->work + size);
	for (int j = 2 * reach; j <= grid->cells[1] - 2 * reach; ++j)
		for (int i = 2 * reach; i <= grid->cells[0] - 2 * reach; ++i, ++inside)
			for (int c = 0; c < 3; ++c) sum += pow(grid->work[size + 3 * (size_t)(j * row + i) + (size_t)c], 2);
	return inside > 0 ? sqrt(sum / inside) : NAN;
}
