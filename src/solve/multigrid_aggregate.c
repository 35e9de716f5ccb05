// Aggregates of strongly connected nodes, greedily in the order of the nodes: on a mesh numbered line by line they come out
// as blocks of 3 nodes along each axis.
//   1. a node none of whose strong neighbours is taken makes an aggregate with all of them;
//   2. nodes that are left join the aggregate of their strongest neighbour;
//   3. what touches no aggregate makes further ones.
#include <math.h>

#include "solve/multigrid.h"

// Squares of the Frobenius norms of the blocks, without the held entries.
typedef struct Strength {
	float* norm;     // of a place of the rows
	float* diagonal; // square root of that of a node's diagonal block
	double strong;
} Strength;

static double norm_of(const JnGridLevel* level, int row, int place) {
	double sum = 0;
	if (level->full_block == NULL) {
		const float* block = level->blocks + JN_GRID_BLOCK * (size_t)place;
		for (int e = 0; e < JN_GRID_BLOCK; ++e) sum += (double)block[e] * (double)block[e];
		return sum;
	}
	const int block = level->full_block[place];
	const double* from = level->source + 9 * (size_t)(block >= 0 ? block : ~block);
	const bool *rows = level->held + 3 * (size_t)row, *columns = level->held + 3 * (size_t)level->column[place];
	for (int e = 0; e < 9; ++e) {
		const int r = block >= 0 ? e / 3 : e % 3, c = block >= 0 ? e % 3 : e / 3;
		if (!rows[r] && !columns[c]) sum += from[e] * from[e];
	}
	return sum;
}

static JnStatus measure(const JnGridLevel* level, double strong, JnArena* scratch, Strength* out) {
	out->strong = strong * strong;
	JN_NEW(scratch, out->norm, level->start[level->nodes] + 1);
	JN_NEW(scratch, out->diagonal, level->nodes + 1);
	for (int i = 0; i < level->nodes; ++i)
		for (int k = level->start[i]; k < level->start[i + 1]; ++k) {
			const double norm = norm_of(level, i, k);
			out->norm[k] = (float)norm;
			if (level->column[k] == i) out->diagonal[i] = (float)sqrt(norm);
		}
	return JN_OK;
}

static bool is_strong(const JnGridLevel* level, const Strength* s, int i, int place) {
	const int j = level->column[place];
	return j != i && (double)s->norm[place] > s->strong * (double)s->diagonal[i] * (double)s->diagonal[j];
}

// Take node i and its strong neighbours that are free. The number of neighbours taken.
static int take(const JnGridLevel* level, const Strength* s, int i, int aggregate) {
	int count = 0;
	for (int k = level->start[i]; k < level->start[i + 1]; ++k) {
		if (!is_strong(level, s, i, k) || level->aggregate[level->column[k]] >= 0) continue;
		level->aggregate[level->column[k]] = aggregate;
		++count;
	}
	if (count > 0) level->aggregate[i] = aggregate;
	return count;
}

static bool is_alone(const JnGridLevel* level, const Strength* s, int i) {
	for (int k = level->start[i]; k < level->start[i + 1]; ++k)
		if (is_strong(level, s, i, k) && level->aggregate[level->column[k]] >= 0) return false;
	return true;
}

static int strongest(const JnGridLevel* level, const Strength* s, int i) {
	int best = -1;
	double most = 0;
	for (int k = level->start[i]; k < level->start[i + 1]; ++k) {
		const int j = level->column[k];
		const double weight = (double)s->norm[k] / (double)s->diagonal[j];
		if (!is_strong(level, s, i, k) || level->aggregate[j] < 0 || !(weight > most)) continue;
		most = weight;
		best = level->aggregate[j];
	}
	return best;
}

static int join(const JnGridLevel* level, const Strength* s, int* chosen) {
	int count = 0;
	for (int i = 0; i < level->nodes; ++i)
		if (level->aggregate[i] < 0 && is_alone(level, s, i)) count += take(level, s, i, count) > 0;
	for (int i = 0; i < level->nodes; ++i) chosen[i] = level->aggregate[i] < 0 ? strongest(level, s, i) : -1;
	for (int i = 0; i < level->nodes; ++i)
		if (chosen[i] >= 0) level->aggregate[i] = chosen[i];
	for (int i = 0; i < level->nodes; ++i)
		if (level->aggregate[i] < 0) count += take(level, s, i, count) > 0;
	return count;
}

static void list_members(JnGridLevel* level, int count) {
	int* start = level->member_start + 1; // shifted by one while filling
	for (int i = 0; i < level->nodes; ++i)
		if (level->aggregate[i] >= 0) ++start[level->aggregate[i] + 1];
	for (int j = 0; j < count; ++j) start[j + 1] += start[j];
	for (int i = 0; i < level->nodes; ++i)
		if (level->aggregate[i] >= 0) level->member[start[level->aggregate[i]]++] = i;
}

JnStatus jn_grid_aggregate(JnGridLevel* level, double strong, JnArena* arena, JnArena* scratch, int* count) {
	Strength s;
	int* chosen;
	JN_TRY(measure(level, strong, scratch, &s));
	JN_NEW(scratch, chosen, level->nodes + 1);
	JN_NEW(arena, level->aggregate, level->nodes + 1);
	for (int i = 0; i < level->nodes; ++i) level->aggregate[i] = -1;
	*count = join(level, &s, chosen);
	JN_NEW(arena, level->member_start, *count + 2);
	JN_NEW(arena, level->member, level->nodes + 1);
	list_members(level, *count);
	return JN_OK;
}
