#include "math/pattern.h"

#include <stdlib.h>

#include "base/parallel.h"

enum { GRAIN = 4096 }; // nodes a thread should have before it is worth waking

// Cells around each node: start[node] .. start[node + 1] into items, each item = list << 32 | cell.
typedef struct Incidence {
	size_t* start;
	uint64_t* items;
} Incidence;

static JnStatus count_incidence(int nodes, int list_count, const JnCellList lists[], JnArena* arena, Incidence* out) {
	JN_NEW(arena, out->start, nodes + 2);
	size_t* start = out->start + 1; // shifted by one while filling
	for (int l = 0; l < list_count; ++l)
		for (long k = 0; k < (long)lists[l].count * lists[l].nodes; ++k)
			++start[lists[l].cells[k] + lists[l].offset + 1];
	for (int i = 0; i < nodes; ++i) start[i + 1] += start[i];
	JN_NEW(arena, out->items, start[nodes] + 1);
	for (int l = 0; l < list_count; ++l)
		for (long k = 0; k < (long)lists[l].count * lists[l].nodes; ++k) {
			const int node = lists[l].cells[k] + lists[l].offset;
			out->items[start[node]++] = (uint64_t)l << 32 | (uint64_t)(k / lists[l].nodes);
		}
	return JN_OK; // filling moved each start to its end, so that out->start is right now
}

static int by_value(const void* a, const void* b) {
	const int left = *(const int*)a, right = *(const int*)b;
	return (left > right) - (left < right);
}

// Neighbours >= node, sorted, the node itself first. `mark` remembers who has been seen from this node.
static int gather_column(int node, const Incidence* incidence, const JnCellList lists[], int* mark, int* out) {
	int count = 0;
	out[count++] = node;
	mark[node] = node + 1;
	for (size_t k = incidence->start[node]; k < incidence->start[node + 1]; ++k) {
		const JnCellList* list = &lists[incidence->items[k] >> 32];
		const int* cell = list->cells + (size_t)(incidence->items[k] & 0xffffffffu) * (size_t)list->nodes;
		for (int i = 0; i < list->nodes; ++i) {
			const int other = cell[i] + list->offset;
			if (other < node || mark[other] == node + 1) continue;
			mark[other] = node + 1;
			out[count++] = other;
		}
	}
	qsort(out, (size_t)count, sizeof *out, by_value);
	return count;
}

static JnStatus fill_rows(JnPattern* pattern, JnArena* arena) {
	const int nodes = pattern->nodes;
	JN_NEW(arena, pattern->full_start, nodes + 2);
	int* start = pattern->full_start + 1;
	for (int j = 0; j < nodes; ++j)
		for (int k = pattern->column_start[j]; k < pattern->column_start[j + 1]; ++k) {
			++start[pattern->row[k] + 1];
			if (pattern->row[k] != j) ++start[j + 1];
		}
	for (int i = 0; i < nodes; ++i) start[i + 1] += start[i];
	JN_NEW(arena, pattern->full_column, start[nodes] + 1);
	JN_NEW(arena, pattern->full_block, start[nodes] + 1);
	for (int j = 0; j < nodes; ++j) { // columns below the diagonal arrive in ascending order
		for (int k = pattern->column_start[j]; k < pattern->column_start[j + 1]; ++k) {
			const int place = start[pattern->row[k]]++;
			pattern->full_column[place] = j;
			pattern->full_block[place] = k;
		}
		for (int k = pattern->column_start[j] + 1; k < pattern->column_start[j + 1]; ++k) {
			const int place = start[j]++;
			pattern->full_column[place] = pattern->row[k];
			pattern->full_block[place] = ~k;
		}
	}
	return JN_OK;
}

static JnStatus fill_columns(JnPattern* pattern, const Incidence* incidence, const JnCellList lists[], int* mark,
							 int* column, JnArena* arena) {
	JN_NEW(arena, pattern->column_start, pattern->nodes + 1);
	for (int j = 0; j < pattern->nodes; ++j)
		pattern->column_start[j + 1] = pattern->column_start[j] + gather_column(j, incidence, lists, mark, column);
	pattern->blocks = pattern->column_start[pattern->nodes];
	JN_NEW(arena, pattern->row, pattern->blocks + 1);
	for (int j = 0; j < pattern->nodes; ++j) mark[j] = 0;
	for (int j = 0; j < pattern->nodes; ++j)
		gather_column(j, incidence, lists, mark, pattern->row + pattern->column_start[j]);
	return fill_rows(pattern, arena);
}

JnStatus jn_pattern_create(int nodes, int list_count, const JnCellList lists[], JnArena* arena, JnPattern* pattern) {
	*pattern = (JnPattern){.nodes = nodes};
	JnArena scratch = {0};
	Incidence incidence = {0};
	JnStatus status = count_incidence(nodes, list_count, lists, &scratch, &incidence);
	int* mark = status == JN_OK ? jn_arena_take(&scratch, (size_t)nodes + 1, sizeof *mark) : NULL;
	int* column = mark != NULL ? jn_arena_take(&scratch, (size_t)nodes + 1, sizeof *column) : NULL;
	if (column == NULL) status = JN_OUT_OF_MEMORY;
	if (status == JN_OK) status = fill_columns(pattern, &incidence, lists, mark, column, arena);
	jn_arena_free(&scratch);
	return status;
}

int jn_pattern_find(const JnPattern* pattern, int row, int column) {
	int low = pattern->column_start[column], high = pattern->column_start[column + 1];
	while (low < high) {
		const int middle = low + (high - low) / 2;
		if (pattern->row[middle] == row) return middle;
		if (pattern->row[middle] < row)
			low = middle + 1;
		else
			high = middle;
	}
	return -1;
}

// The three sums stay in registers: written out, because compilers keep a small array in memory here.
static void row_blocks(const JnPattern* pattern, const double* blocks, double scale, const double* x, double* y,
					   int i) {
	double s0 = 0, s1 = 0, s2 = 0;
	for (int k = pattern->full_start[i]; k < pattern->full_start[i + 1]; ++k) {
		const double* in = x + 3 * (size_t)pattern->full_column[k];
		const int block = pattern->full_block[k];
		const double* b = blocks + 9 * (size_t)(block >= 0 ? block : ~block);
		if (block >= 0) {
			s0 += b[0] * in[0] + b[1] * in[1] + b[2] * in[2];
			s1 += b[3] * in[0] + b[4] * in[1] + b[5] * in[2];
			s2 += b[6] * in[0] + b[7] * in[1] + b[8] * in[2];
		} else {
			s0 += b[0] * in[0] + b[3] * in[1] + b[6] * in[2];
			s1 += b[1] * in[0] + b[4] * in[1] + b[7] * in[2];
			s2 += b[2] * in[0] + b[5] * in[1] + b[8] * in[2];
		}
	}
	double* out = y + 3 * (size_t)i;
	out[0] += scale * s0;
	out[1] += scale * s1;
	out[2] += scale * s2;
}

void jn_blocks_apply(const JnPattern* pattern, const double* blocks, double scale, const double* x, double* y,
					 int threads) {
	const int team = jn_threads_for((size_t)pattern->nodes, GRAIN, threads);
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1)
	for (int i = 0; i < pattern->nodes; ++i) row_blocks(pattern, blocks, scale, x, y, i);
}

static void row_scalars(const JnPattern* pattern, const double* scalars, double scale, const double* x, double* y,
						int i) {
	double s0 = 0, s1 = 0, s2 = 0;
	for (int k = pattern->full_start[i]; k < pattern->full_start[i + 1]; ++k) {
		const double* in = x + 3 * (size_t)pattern->full_column[k];
		const int block = pattern->full_block[k];
		const double m = scalars[block >= 0 ? block : ~block];
		s0 += m * in[0];
		s1 += m * in[1];
		s2 += m * in[2];
	}
	double* out = y + 3 * (size_t)i;
	out[0] += scale * s0;
	out[1] += scale * s1;
	out[2] += scale * s2;
}

void jn_scalars_apply(const JnPattern* pattern, const double* scalars, double scale, const double* x, double* y,
					  int threads) {
	const int team = jn_threads_for((size_t)pattern->nodes, GRAIN, threads);
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1)
	for (int i = 0; i < pattern->nodes; ++i) row_scalars(pattern, scalars, scale, x, y, i);
}
