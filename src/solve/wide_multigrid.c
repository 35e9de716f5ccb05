// Compiled once a vector width; see multigrid.h. What belongs to the 6 rigid motions of an aggregate lies in 8 lanes; loops
// over the unknowns of a node are written once for 3 and 6. Each row or column has one owner and one order of sums.
#include <string.h>

#include "base/parallel.h"
#include "math/wide.h"
#include "solve/multigrid.h"

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)

enum { LANES = JN_GRID_LANES, GRAIN = 512 }; // nodes a thread should have before it is worth waking

typedef float Lanes __attribute__((vector_size(LANES * sizeof(float))));
typedef float Four __attribute__((vector_size(4 * sizeof(float))));
typedef float FourInMemory __attribute__((vector_size(4 * sizeof(float)), aligned(4), may_alias));

// ---- blocks ----

// The block of a place of the rows, or its transpose, row by row.
JN_INLINE void load_block(const JnGridLevel* level, int place, bool is_transposed, int size, float at[]) {
	if (size == 3) {
		const int block = level->full_block[place];
		const double* from = level->source + 9 * (size_t)(block >= 0 ? block : ~block);
		const bool by_columns = (block < 0) != is_transposed;
		for (int e = 0; e < 9; ++e) at[e] = (float)from[by_columns ? e % 3 * 3 + e / 3 : e];
	} else {
		const float* from = level->blocks + JN_GRID_BLOCK * (size_t)place;
		for (int a = 0; a < size; ++a)
			for (int c = 0; c < size; ++c) at[size * a + c] = is_transposed ? from[LANES * a + c] : from[LANES * c + a];
	}
}

// w += block b, of `size` rows each.
JN_INLINE void add_product(const float block[], const Lanes* b, int size, Lanes* w) {
	JN_UNROLL for (int a = 0; a < size; ++a) {
		Lanes sum = w[a];
		JN_UNROLL for (int c = 0; c < size; ++c) sum += block[size * a + c] * b[c];
		w[a] = sum;
	}
}

// ---- P = (I - omega D^-1 A) P0 ----

JN_INLINE void smooth_row(const JnGridLevel* level, int node, float omega, int* where, int size) {
	const size_t reals = (size_t)size * LANES;
	const int first = level->p_start[node], last = level->p_start[node + 1];
	Lanes *p = (Lanes*)(level->p + reals * (size_t)first), *tentative = (Lanes*)level->tentative;
	if (first == last) return; // held: its neighbours' aggregates do not move it
	memset(p, 0, (size_t)(last - first) * reals * sizeof(float));
	for (int k = first; k < last; ++k) where[level->p_column[k]] = k - first;
	for (int k = level->start[node]; k < level->start[node + 1]; ++k) {
		const int other = level->column[k];
		if (level->aggregate[other] < 0) continue;
		float block[36];
		load_block(level, k, false, size, block);
		add_product(block, tentative + (size_t)size * (size_t)other, size, p + size * where[level->aggregate[other]]);
	}
	float inverse[36];
	for (int a = 0; a < size; ++a)
		for (int c = 0; c < size; ++c)
			inverse[size * a + c] =
				-omega * level->inverse[(size_t)level->stride * ((size_t)size * (size_t)node + (size_t)a) + (size_t)c];
	for (int k = 0; k < last - first; ++k) {
		Lanes w[6] = {0};
		add_product(inverse, p + size * k, size, w);
		const bool is_own = level->p_column[first + k] == level->aggregate[node];
		for (int a = 0; a < size; ++a) p[size * k + a] = is_own ? w[a] + tentative[size * node + a] : w[a];
	}
	for (int k = first; k < last; ++k) where[level->p_column[k]] = -1;
}

static void smooth(const JnGridLevel* level, float omega, const JnGridWork* work, int threads) {
	const int team = jn_threads_for((size_t)level->nodes, GRAIN, threads);
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1)
	for (int node = 0; node < level->nodes; ++node) {
		int* where = work[jn_thread_number()].where;
		if (level->size == 3)
			smooth_row(level, node, omega, where, 3);
		else
			smooth_row(level, node, omega, where, 6);
	}
}

// ---- P' A P, a column of P at a time ----

// w = A times column j of P. Returns the number of nodes that it reaches.
JN_INLINE int multiply_column(const JnGridLevel* level, int j, const JnGridWork* work, int size) {
	int count = 0;
	Lanes *w = (Lanes*)work->w, *p = (Lanes*)level->p;
	for (int t = level->t_start[j]; t < level->t_start[j + 1]; ++t) {
		const int node = level->t_node[t];
		const Lanes* b = p + (size_t)size * (size_t)level->t_place[t];
		for (int k = level->start[node]; k < level->start[node + 1]; ++k) {
			const int other = level->column[k];
			if (work->slot[other] < 0) {
				work->slot[other] = count;
				work->support[count] = other;
				for (int a = 0; a < size; ++a) w[size * count + a] = (Lanes){0};
				++count;
			}
			float block[36];
			load_block(level, k, true, size, block);
			add_product(block, b, size, w + size * work->slot[other]);
		}
	}
	return count;
}

// sums[i] += P_i' w over the nodes of the column, for aggregates i up to j.
JN_INLINE void project_column(const JnGridLevel* level, int j, int count, const JnGridWork* work, int size) {
	const Lanes *w = (const Lanes*)work->w, *p = (const Lanes*)level->p;
	Lanes* sums = (Lanes*)work->sums;
	for (int s = 0; s < count; ++s) {
		const int node = work->support[s];
		work->slot[node] = -1;
		for (int k = level->p_start[node]; k < level->p_start[node + 1] && level->p_column[k] <= j; ++k) {
			Lanes* sum = sums + JN_GRID_MODES * work->where[level->p_column[k]];
			const float* part = (const float*)(p + (size_t)size * (size_t)k);
			JN_UNROLL for (int m = 0; m < JN_GRID_MODES; ++m) {
				Lanes more = sum[m];
				JN_UNROLL for (int a = 0; a < size; ++a) more += part[LANES * a + m] * w[size * s + a];
				sum[m] = more;
			}
		}
	}
}

static int place_of(const JnGridLevel* level, int row, int column) {
	int low = level->start[row], high = level->start[row + 1] - 1;
	while (low < high) {
		const int middle = (low + high) / 2;
		if (level->column[middle] < column)
			low = middle + 1;
		else
			high = middle;
	}
	return low;
}

// Block (j, i) and its transpose; that of the diagonal is made symmetric.
static void store_blocks(const JnGridLevel* coarse, int j, int place, const float* sums) {
	const int i = coarse->column[place];
	float* mine = coarse->blocks + JN_GRID_BLOCK * (size_t)place;
	float* theirs = coarse->blocks + JN_GRID_BLOCK * (size_t)place_of(coarse, i, j);
	for (int a = 0; a < JN_GRID_MODES; ++a)
		for (int b = 0; b < JN_GRID_MODES; ++b) {
			const float number = i == j && a > b ? sums[LANES * b + a] : sums[LANES * a + b];
			mine[LANES * a + b] = number;
			theirs[LANES * b + a] = number;
		}
}

static void project(const JnGridLevel* level, const JnGridLevel* coarse, const JnGridWork* work, int threads) {
	const int team = jn_threads_for((size_t)level->nodes, GRAIN, threads);
#pragma omp parallel for schedule(dynamic, 16) num_threads(team) if (team > 1)
	for (int j = 0; j < coarse->nodes; ++j) {
		const JnGridWork* mine = &work[jn_thread_number()];
		const int first = coarse->start[j];
		int last = first;
		for (; last < coarse->start[j + 1] && coarse->column[last] <= j; ++last)
			mine->where[coarse->column[last]] = last - first;
		memset(mine->sums, 0, (size_t)(last - first) * JN_GRID_BLOCK * sizeof(float));
		if (level->size == 3)
			project_column(level, j, multiply_column(level, j, mine, 3), mine, 3);
		else
			project_column(level, j, multiply_column(level, j, mine, 6), mine, 6);
		for (int k = first; k < last; ++k) {
			store_blocks(coarse, j, k, mine->sums + JN_GRID_BLOCK * (k - first));
			mine->where[coarse->column[k]] = -1;
		}
	}
}

// ---- products ----

static void multiply(const JnGridLevel* level, const float* x, float* y, int threads) {
	const int team = jn_threads_for((size_t)level->nodes, GRAIN, threads);
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1)
	for (int node = 0; node < level->nodes; ++node) {
		Lanes sum[2] = {{0}};
		for (int k = level->start[node]; k < level->start[node + 1]; ++k) {
			const Lanes* block = (const Lanes*)(level->blocks + JN_GRID_BLOCK * (size_t)k);
			const float* in = x + LANES * (size_t)level->column[k];
			JN_UNROLL for (int c = 0; c < JN_GRID_MODES; ++c) sum[c % 2] += in[c] * block[c];
		}
		((Lanes*)y)[node] = sum[0] + sum[1];
	}
}

// Blocks below the diagonal are read by rows, of which the sums lie in lanes, those above it as columns. The lane beside a
// row holds what comes next in memory: the fourth number of a node, 0, takes it out of the sums.
JN_INLINE Four multiply_row(const JnPattern* pattern, const float* blocks, const float* x, int node) {
	Four rows[3] = {{0}}, columns = {0};
	for (int k = pattern->full_start[node]; k < pattern->full_start[node + 1]; ++k) {
		const int block = pattern->full_block[k];
		const FourInMemory* b = (const FourInMemory*)(blocks + 9 * (size_t)(block >= 0 ? block : ~block));
		const Four in = ((const Four*)x)[pattern->full_column[k]];
		const Four b0 = b[0], b1 = *(const FourInMemory*)((const float*)b + 3),
				   b2 = *(const FourInMemory*)((const float*)b + 6);
		if (block >= 0) {
			rows[0] += b0 * in;
			rows[1] += b1 * in;
			rows[2] += b2 * in;
		} else {
			columns += b0 * in[0] + b1 * in[1] + b2 * in[2];
		}
	}
	Four out = {0};
	JN_UNROLL for (int a = 0; a < 3; ++a) out[a] = columns[a] + (rows[a][0] + rows[a][1] + rows[a][2]);
	return out;
}

static void multiply_finest(const JnPattern* pattern, const float* blocks, const float* x, float* y, int threads) {
	const int team = jn_threads_for((size_t)pattern->nodes, GRAIN, threads);
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1)
	for (int node = 0; node < pattern->nodes; ++node) ((Four*)y)[node] = multiply_row(pattern, blocks, x, node);
}

// ---- smoother ----

#define RELAX(name, Vector, size)                                                                                      \
	JN_INLINE void name(const JnGridLevel* level, JnGridRelax with, int node, const float* b, const float* q,          \
						float* x) {                                                                                    \
		const Vector* inverse = (const Vector*)level->inverse + (size_t)(size) * (size_t)node;                         \
		const Vector rest =                                                                                            \
			q != NULL ? ((const Vector*)b)[node] - ((const Vector*)q)[node] : ((const Vector*)b)[node];                \
		Vector step = rest[0] * inverse[0];                                                                            \
		JN_UNROLL for (int a = 1; a < (size); ++a) step += rest[a] * inverse[a];                                       \
		step = with.keep != 0 ? with.keep * ((Vector*)level->d)[node] + with.c * step : with.c * step;                 \
		((Vector*)level->r)[node] = rest;                                                                              \
		((Vector*)level->d)[node] = step;                                                                              \
		((Vector*)x)[node] = q != NULL ? ((Vector*)x)[node] + with.beta * step : with.beta * step;                     \
	}

RELAX(relax_3, Four, 3)
RELAX(relax_6, Lanes, 6)

static void relax(const JnGridLevel* level, JnGridRelax with, const float* b, const float* q, float* x, int threads) {
	const int team = jn_threads_for((size_t)level->nodes, 4 * GRAIN, threads);
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1)
	for (int node = 0; node < level->nodes; ++node) {
		if (level->size == 3)
			relax_3(level, with, node, b, q, x);
		else
			relax_6(level, with, node, b, q, x);
	}
}

// ---- transfer ----

JN_INLINE Lanes restrict_one(const JnGridLevel* level, int j, const float* b, const float* q, int size) {
	Lanes sum = {0};
	for (int t = level->t_start[j]; t < level->t_start[j + 1]; ++t) {
		const size_t at = (size_t)level->stride * (size_t)level->t_node[t];
		const Lanes* p = (const Lanes*)level->p + (size_t)size * (size_t)level->t_place[t];
		JN_UNROLL for (int a = 0; a < size; ++a) sum += (b[at + (size_t)a] - q[at + (size_t)a]) * p[a];
	}
	return sum;
}

static void restrict_to(const JnGridLevel* level, const float* b, const float* q, float* coarse, int count,
						int threads) {
	const int team = jn_threads_for((size_t)level->nodes, GRAIN, threads);
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1)
	for (int j = 0; j < count; ++j)
		((Lanes*)coarse)[j] = level->size == 3 ? restrict_one(level, j, b, q, 3) : restrict_one(level, j, b, q, 6);
}

JN_INLINE float sum_lanes(Lanes a) {
	return ((a[0] + a[4]) + (a[2] + a[6])) + ((a[1] + a[5]) + (a[3] + a[7]));
}

JN_INLINE void prolong_one(const JnGridLevel* level, int node, const float* e, float scale, float* x, int size) {
	Lanes sum[6] = {{0}};
	for (int k = level->p_start[node]; k < level->p_start[node + 1]; ++k) {
		const Lanes in = ((const Lanes*)e)[level->p_column[k]];
		const Lanes* p = (const Lanes*)level->p + (size_t)size * (size_t)k;
		JN_UNROLL for (int a = 0; a < size; ++a) sum[a] += p[a] * in;
	}
	float* out = x + (size_t)level->stride * (size_t)node;
	JN_UNROLL for (int a = 0; a < size; ++a) out[a] += scale * sum_lanes(sum[a]);
}

static void prolong(const JnGridLevel* level, const float* e, float scale, float* x, int threads) {
	const int team = jn_threads_for((size_t)level->nodes, GRAIN, threads);
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1)
	for (int node = 0; node < level->nodes; ++node) {
		if (level->size == 3)
			prolong_one(level, node, e, scale, x, 3);
		else
			prolong_one(level, node, e, scale, x, 6);
	}
}

const JnGridKernels JOIN(jn_grid_kernels_, JN_WIDE) = {
	.smooth = smooth,
	.project = project,
	.multiply = multiply,
	.multiply_finest = multiply_finest,
	.relax = relax,
	.restrict_to = restrict_to,
	.prolong = prolong,
};
