// Adds 3x3 blocks of elements to those of a matrix: nine numbers in the lanes of elements become nine in a row, four lanes at
// a time. Exports jn_scatter_blocks_<width> and jn_scatter_triangles_<width>.
#include "model/scatter.h"

#include <assert.h>

#include "math/wide.h"

#define JOIN_NAMES(a, b) a##b
#define JOIN(a, b) JOIN_NAMES(a, b)
#define INLINE static inline __attribute__((always_inline))

INLINE int lanes_in(const JnGroup* group, int batch) {
	const int rest = group->count - batch * JN_WIDE;
	return rest < JN_WIDE ? rest : JN_WIDE;
}

enum { MOST_PAIRS = 55 };

#if JN_WIDE < 4
enum { LANES = JN_WIDE };
#else
enum { LANES = 4 };

typedef double Four __attribute__((vector_size(32)));
typedef double FourInMemory __attribute__((vector_size(32), aligned(8), may_alias));

INLINE Four load4(const double* from) {
	return *(const FourInMemory*)from;
}

INLINE void store4(double* to, Four a) {
	*(FourInMemory*)to = a;
}

INLINE void transpose4(Four a, Four b, Four c, Four d, Four out[4]) {
	const Four ab = __builtin_shufflevector(a, b, 0, 4, 2, 6), ab_odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
	const Four cd = __builtin_shufflevector(c, d, 0, 4, 2, 6), cd_odd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
	out[0] = __builtin_shufflevector(ab, cd, 0, 1, 4, 5);
	out[1] = __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5);
	out[2] = __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
	out[3] = __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7);
}
#endif

// rows[lane][9 * pair + k] of the lanes from `lane` on.
INLINE void turn_blocks(const double* element, int pairs, int lane, double rows[LANES][9 * MOST_PAIRS]) {
	const double* from = element + lane;
	for (int pair = 0; pair < pairs; ++pair, from += 9 * JN_WIDE) {
		int k = 0;
#if JN_WIDE >= 4
		for (; k < 8; k += 4) {
			Four out[4];
			transpose4(load4(from + k * JN_WIDE), load4(from + (k + 1) * JN_WIDE), load4(from + (k + 2) * JN_WIDE),
					   load4(from + (k + 3) * JN_WIDE), out);
			JN_UNROLL for (int l = 0; l < 4; ++l) store4(rows[l] + 9 * pair + k, out[l]);
		}
#endif
		for (; k < 9; ++k) JN_UNROLL for (int l = 0; l < LANES; ++l) rows[l][9 * pair + k] = from[k * JN_WIDE + l];
	}
}

INLINE void add_block(const double* from, double weight, double* to) {
#if JN_WIDE >= 4
	store4(to, load4(to) + weight * load4(from));
	store4(to + 4, load4(to + 4) + weight * load4(from + 4));
	to[8] += weight * from[8];
#else
	for (int k = 0; k < 9; ++k) to[k] += weight * from[k];
#endif
}

INLINE void add_transposed(const double* from, double weight, double* to) {
#if JN_WIDE >= 4
	const Four a = load4(from), b = load4(from + 4);
	store4(to, load4(to) + weight * __builtin_shufflevector(a, b, 0, 3, 6, 1));
	store4(to + 4, load4(to + 4) + weight * __builtin_shufflevector(a, b, 4, 7, 2, 5));
	to[8] += weight * from[8];
#else
	for (int k = 0; k < 9; ++k) to[k] += weight * from[k % 3 * 3 + k / 3];
#endif
}

static bool is_owned(const int* nodes, int i, int j, JnNodeRange range) {
	const int row = nodes[i * JN_WIDE], column = nodes[j * JN_WIDE], owner = row < column ? row : column;
	return owner >= range.low && owner < range.high;
}

// One element, whose blocks stand in a row; `place` and `nodes` are those of its lane.
INLINE void add_element(const double* row, const int* place, const int* nodes, int node_count, double weight,
						JnNodeRange range, double* blocks) {
	for (int i = 0; i < node_count; ++i)
		for (int j = 0; j <= i; ++j, place += JN_WIDE, row += 9) {
			if (!range.is_all && !is_owned(nodes, i, j, range)) continue;
			if (*place >= 0)
				add_block(row, weight, blocks + 9 * (size_t)*place);
			else
				add_transposed(row, weight, blocks + 9 * (size_t) ~*place);
		}
}

JnScatterBlocks JOIN(jn_scatter_blocks_, JN_WIDE);

void JOIN(jn_scatter_blocks_, JN_WIDE)(const JnGroup* group, int first, int last, const int* place,
									   const double* buffer, double weight, JnNodeRange range, double* blocks) {
	const int node_count = group->kernel->nodes, pairs = node_count * (node_count + 1) / 2;
	double rows[LANES][9 * MOST_PAIRS];
	assert(pairs > 0 && pairs <= MOST_PAIRS);
	for (int batch = first; batch < last; ++batch, buffer += 9 * pairs * JN_WIDE, place += pairs * JN_WIDE) {
		const int* nodes = group->nodes + (ptrdiff_t)batch * node_count * JN_WIDE;
		const int lanes = lanes_in(group, batch);
		for (int from = 0; from < lanes; from += LANES) {
			turn_blocks(buffer, pairs, from, rows);
			for (int lane = from; lane < lanes && lane < from + LANES; ++lane)
				add_element(rows[lane - from], place + lane, nodes + lane, node_count, weight, range, blocks);
		}
	}
}

// The triangle 0, 1 2, 3 4 5 of a symmetric block stands in its rows as 0 1 3 1, 2 4 3 4, 5.
INLINE void add_triangles(const double* from, const int* nodes, int lanes, double weight, JnNodeRange range,
						  double* blocks) {
	double rows[LANES][9];
#if JN_WIDE >= 4
	Four t[5], out[4];
	JN_UNROLL for (int k = 0; k < 5; ++k) t[k] = load4(from + k * JN_WIDE);
	transpose4(t[0], t[1], t[3], t[1], out);
	JN_UNROLL for (int l = 0; l < 4; ++l) store4(rows[l], out[l]);
	transpose4(t[2], t[4], t[3], t[4], out);
	JN_UNROLL for (int l = 0; l < 4; ++l) store4(rows[l] + 4, out[l]);
	JN_UNROLL for (int l = 0; l < 4; ++l) rows[l][8] = from[5 * JN_WIDE + l];
#else
	static const int entry[9] = {0, 1, 3, 1, 2, 4, 3, 4, 5};
	for (int l = 0; l < LANES; ++l)
		for (int k = 0; k < 9; ++k) rows[l][k] = from[entry[k] * JN_WIDE + l];
#endif
	for (int l = 0; l < lanes && l < LANES; ++l)
		if (range.is_all || (nodes[l] >= range.low && nodes[l] < range.high))
			add_block(rows[l], weight, blocks + 9 * (size_t)nodes[l]);
}

JnScatterTriangles JOIN(jn_scatter_triangles_, JN_WIDE);

// Elements by fours, whatever the width, so that the order of sums does not depend on it.
void JOIN(jn_scatter_triangles_, JN_WIDE)(const JnGroup* group, int first, int last, const double* buffer,
										  double weight, JnNodeRange range, double* blocks) {
	enum { BATCHES = 4 / LANES };
	const ptrdiff_t nodes = group->kernel->nodes;
	for (int batch = first; batch < last; batch += BATCHES)
		for (int from = 0; from < JN_WIDE; from += LANES)
			for (int i = 0; i < nodes; ++i)
				for (int b = batch; b < batch + BATCHES && b < last; ++b) {
					const int* at = group->nodes + (b * nodes + i) * JN_WIDE + from;
					const double* triangles = buffer + ((b - first) * nodes + i) * 6 * JN_WIDE + from;
					add_triangles(triangles, at, lanes_in(group, b) - from, weight, range, blocks);
				}
}
