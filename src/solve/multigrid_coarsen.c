// What the graph alone decides: where P and the coarser matrix have blocks.
#include <stdlib.h>

#include "solve/multigrid.h"

// Sets that are emptied by counting on: `seen[i] == now` means that i is in.
typedef struct Marks {
	int *nodes, *aggregates;
	int now;
} Marks;

static int by_value(const void* a, const void* b) {
	const int left = *(const int*)a, right = *(const int*)b;
	return (left > right) - (left < right);
}

// Aggregates around a node, ascending.
static int gather_row(const JnGridLevel* level, int node, int* out) {
	int count = 0;
	for (int k = level->start[node]; k < level->start[node + 1]; ++k) {
		const int aggregate = level->aggregate[level->column[k]];
		int place = count;
		if (aggregate < 0) continue;
		while (place > 0 && out[place - 1] > aggregate) --place;
		if (place > 0 && out[place - 1] == aggregate) continue;
		for (int m = count++; m > place; --m) out[m] = out[m - 1];
		out[place] = aggregate;
	}
	return count;
}

static bool is_held(const JnGridLevel* level, int node) {
	return level->held != NULL && level->held[3 * (size_t)node] && level->held[3 * (size_t)node + 1] &&
		   level->held[3 * (size_t)node + 2];
}

static JnStatus pattern_of_p(JnGridLevel* level, JnArena* arena, JnArena* scratch) {
	int most = 0, *row;
	for (int i = 0; i < level->nodes; ++i)
		if (level->start[i + 1] - level->start[i] > most) most = level->start[i + 1] - level->start[i];
	JN_NEW(scratch, row, most + 1);
	JN_NEW(arena, level->p_start, level->nodes + 1);
	for (int i = 0; i < level->nodes; ++i)
		level->p_start[i + 1] = level->p_start[i] + (is_held(level, i) ? 0 : gather_row(level, i, row));
	JN_NEW(arena, level->p_column, level->p_start[level->nodes] + 1);
	for (int i = 0; i < level->nodes; ++i)
		if (!is_held(level, i)) gather_row(level, i, level->p_column + level->p_start[i]);
	return JN_OK;
}

static JnStatus columns_of_p(JnGridLevel* level, int count, JnArena* arena) {
	const int places = level->p_start[level->nodes];
	JN_NEW(arena, level->t_start, count + 2);
	JN_NEW(arena, level->t_node, places + 1);
	JN_NEW(arena, level->t_place, places + 1);
	int* start = level->t_start + 1; // shifted by one while filling
	for (int k = 0; k < places; ++k) ++start[level->p_column[k] + 1];
	for (int j = 0; j < count; ++j) start[j + 1] += start[j];
	for (int i = 0; i < level->nodes; ++i)
		for (int k = level->p_start[i]; k < level->p_start[i + 1]; ++k) {
			const int t = start[level->p_column[k]]++;
			level->t_node[t] = i;
			level->t_place[t] = k;
		}
	return JN_OK;
}

// The nodes that column j of A P reaches, and from them the aggregates that they are in: a row of P' A P, unsorted.
static int gather_coarse(const JnGridLevel* level, int j, Marks* marks, int* support, int* out, int* reached) {
	int nodes = 0, count = 0;
	const int now = ++marks->now;
	for (int t = level->t_start[j]; t < level->t_start[j + 1]; ++t) {
		const int node = level->t_node[t];
		for (int k = level->start[node]; k < level->start[node + 1]; ++k) {
			const int other = level->column[k];
			if (marks->nodes[other] != now) support[nodes++] = other;
			marks->nodes[other] = now;
		}
	}
	for (int s = 0; s < nodes; ++s)
		for (int k = level->p_start[support[s]]; k < level->p_start[support[s] + 1]; ++k) {
			const int other = level->p_column[k];
			if (marks->aggregates[other] != now) out[count++] = other;
			marks->aggregates[other] = now;
		}
	*reached = nodes;
	return count;
}

// Of column j of P' A P: A P from its nodes, and half of the product of that with P', the other half being symmetric.
static double operations(const JnGridLevel* level, int j, const int* support, int reached) {
	const double size = level->size;
	double blocks = 0, products = 0;
	for (int t = level->t_start[j]; t < level->t_start[j + 1]; ++t)
		blocks += level->start[level->t_node[t] + 1] - level->start[level->t_node[t]];
	for (int s = 0; s < reached; ++s) products += level->p_start[support[s] + 1] - level->p_start[support[s]];
	return JN_GRID_MODES * size * (2 * size * blocks + JN_GRID_MODES * products);
}

static JnStatus pattern_of_coarse(JnGridLevel* level, JnGridLevel* coarse, int* start, JnArena* arena,
								  JnArena* scratch) {
	Marks marks = {0};
	int *support, *row, reached, *column;
	JN_NEW(scratch, marks.nodes, level->nodes + 1);
	JN_NEW(scratch, marks.aggregates, coarse->nodes + 1);
	JN_NEW(scratch, support, level->nodes + 1);
	JN_NEW(scratch, row, coarse->nodes + 1);
	for (int j = 0; j < coarse->nodes; ++j) {
		const int count = gather_coarse(level, j, &marks, support, row, &reached);
		const double work = operations(level, j, support, reached);
		start[j + 1] = start[j] + count;
		level->most_support = reached > level->most_support ? reached : level->most_support;
		level->most_row = count > level->most_row ? count : level->most_row;
		level->work += work;
	}
	JN_NEW(arena, column, start[coarse->nodes] + 1);
	for (int j = 0; j < coarse->nodes; ++j) {
		const int count = gather_coarse(level, j, &marks, support, column + start[j], &reached);
		qsort(column + start[j], (size_t)count, sizeof *column, by_value);
	}
	coarse->start = start;
	coarse->column = column;
	return JN_OK;
}

static JnStatus room(JnGridLevel* level, JnGridLevel* coarse, JnArena* arena) {
	const size_t nodes = (size_t)coarse->nodes, reals = JN_GRID_LANES * nodes;
	JN_NEW(arena, level->tentative, (size_t)level->size * JN_GRID_LANES * (size_t)level->nodes + 1);
	JN_NEW(arena, level->p, (size_t)level->size * JN_GRID_LANES * (size_t)level->p_start[level->nodes] + 1);
	JN_NEW(arena, coarse->blocks, JN_GRID_BLOCK * (size_t)coarse->start[nodes] + 1);
	JN_NEW(arena, coarse->inverse, JN_GRID_BLOCK * nodes + 1);
	JN_NEW(arena, coarse->vector, reals + 1);
	JN_NEW(arena, coarse->center, 3 * nodes + 1);
	JN_NEW(arena, coarse->modes, JN_GRID_MODES * JN_GRID_MODES * nodes + 1);
	JN_NEW(arena, coarse->x, reals + 1);
	JN_NEW(arena, coarse->b, reals + 1);
	JN_NEW(arena, coarse->r, reals + 1);
	JN_NEW(arena, coarse->d, reals + 1);
	JN_NEW(arena, coarse->q, reals + 1);
	return JN_OK;
}

JnStatus jn_grid_coarsen(JnGridLevel* level, int count, JnArena* arena, JnArena* scratch, JnGridLevel* coarse) {
	int* start;
	*coarse = (JnGridLevel){.nodes = count, .size = JN_GRID_MODES, .stride = JN_GRID_LANES};
	JN_TRY(pattern_of_p(level, arena, scratch));
	JN_TRY(columns_of_p(level, count, arena));
	JN_NEW(arena, start, count + 1);
	JN_TRY(pattern_of_coarse(level, coarse, start, arena, scratch));
	return room(level, coarse, arena);
}
