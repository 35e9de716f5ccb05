// Adds lane by lane; exports jn_scatters_<width>. The number of nodes is a compile-time constant where elements are small.
#include "model/scatter.h"

#include "math/wide_float.h"

#define JOIN_NAMES(a, b) a##b
#define JOIN(a, b) JOIN_NAMES(a, b)
#define INLINE static inline __attribute__((always_inline))

INLINE int lanes_in(const JnGroup* group, int batch) {
	const int rest = group->count - batch * JN_WIDE;
	return rest < JN_WIDE ? rest : JN_WIDE;
}

INLINE void add(const double* from, double scale, double* to) {
	to[0] += scale * from[0];
	to[1] += scale * from[JN_WIDE];
	to[2] += scale * from[2 * JN_WIDE];
}

INLINE void scatter_any(const JnGroup* group, int first, int last, const double* buffer, double scale,
						JnNodeRange range, double* f, int nodes, bool is_all) {
	const int* batch_nodes = group->nodes + (ptrdiff_t)first * nodes * JN_WIDE;
	for (int batch = first; batch < last; ++batch, buffer += 3 * nodes * JN_WIDE, batch_nodes += nodes * JN_WIDE) {
		const int lanes = lanes_in(group, batch);
		for (int lane = 0; lane < lanes; ++lane)
			for (int i = 0; i < nodes; ++i) {
				const int node = batch_nodes[i * JN_WIDE + lane];
				if (!is_all && (node < range.low || node >= range.high)) continue;
				add(buffer + 3 * i * JN_WIDE + lane, scale, f + 3 * (ptrdiff_t)node);
			}
	}
}

INLINE void put(double a, double b, double c, double* to) {
	to[0] = a;
	to[1] = b;
	to[2] = c;
}

// Elements of two nodes. Bonds stand in runs with the same first node, whose sum stays in registers: in memory, each would
// wait for the one before. No arrays: compilers keep those in memory.
INLINE void scatter_pairs(const JnGroup* group, int batch, const double* element, double scale, JnNodeRange range,
						  double* f, bool is_all) {
	const int lanes = lanes_in(group, batch);
	const int *first = group->nodes + 2 * (ptrdiff_t)batch * JN_WIDE, *second = first + JN_WIDE;
	int open = -1; // node whose sum is s0, s1, s2, to be put to `at`
	double s0 = 0, s1 = 0, s2 = 0, nowhere[3] = {0}, *at = nowhere;
	for (int lane = 0; lane < lanes; ++lane) {
		const int i = first[lane], j = second[lane];
		if (i != open) {
			put(s0, s1, s2, at);
			open = i;
			at = is_all || (i >= range.low && i < range.high) ? f + 3 * (ptrdiff_t)i : nowhere;
			s0 = at[0];
			s1 = at[1];
			s2 = at[2];
		}
		s0 += scale * element[lane];
		s1 += scale * element[JN_WIDE + lane];
		s2 += scale * element[2 * JN_WIDE + lane];
		if (is_all || (j >= range.low && j < range.high))
			add(element + 3 * JN_WIDE + lane, scale, f + 3 * (ptrdiff_t)j);
	}
	put(s0, s1, s2, at);
}

// Elements of two frames of three nodes in a row (force/constraint): nine numbers each, four of them turned from lanes into
// a row at a time, and added in the order of the elements.
INLINE void add_frames(const double* element, const int* nodes, double scale, double* f) {
	int k = 0;
#if JN_WIDE == 4
	for (; k < 8; k += 4) {
		Wide row[2][4];
		for (int frame = 0; frame < 2; ++frame) {
			const double* from = element + 4 * (9 * frame + k);
			const double* const lanes[4] = {from, from + 4, from + 8, from + 12};
			wide_gather_rows(lanes, 4, row[frame]);
		}
		for (int lane = 0; lane < 4; ++lane)
			for (int frame = 0; frame < 2; ++frame) {
				double* to = f + 3 * (ptrdiff_t)nodes[3 * 4 * frame + lane] + k;
				wide_store(to, wide_load(to) + scale * row[frame][lane]);
			}
	}
#endif
	for (; k < 9; ++k)
		for (int lane = 0; lane < JN_WIDE; ++lane)
			for (int frame = 0; frame < 2; ++frame)
				f[3 * (ptrdiff_t)nodes[3 * JN_WIDE * frame + lane] + k] +=
					scale * element[(9 * frame + k) * JN_WIDE + lane];
}

INLINE void scatter_frames(const JnGroup* group, int first, int last, const double* buffer, double scale,
						   JnNodeRange range, double* f, bool is_all) {
	const int* nodes = group->nodes + (ptrdiff_t)first * 6 * JN_WIDE;
	for (int batch = first; batch < last; ++batch, buffer += 18 * JN_WIDE, nodes += 6 * JN_WIDE) {
		if (!is_all || lanes_in(group, batch) < JN_WIDE) {
			scatter_any(group, batch, batch + 1, buffer, scale, range, f, 6, is_all);
			continue;
		}
		add_frames(buffer, nodes, scale, f);
	}
}

INLINE void scatter_with(const JnGroup* group, int first, int last, const double* buffer, double scale,
						 JnNodeRange range, double* f, bool is_all) {
	switch (group->kernel->nodes) {
	case 2:
		for (int batch = first; batch < last; ++batch, buffer += 6 * JN_WIDE)
			scatter_pairs(group, batch, buffer, scale, range, f, is_all);
		return;
	case 3:
		scatter_any(group, first, last, buffer, scale, range, f, 3, is_all);
		return;
	case 4:
		scatter_any(group, first, last, buffer, scale, range, f, 4, is_all);
		return;
	case 6:
		scatter_frames(group, first, last, buffer, scale, range, f, is_all);
		return;
	default:
		scatter_any(group, first, last, buffer, scale, range, f, group->kernel->nodes, is_all);
		return;
	}
}

static void scatter_forces(const JnGroup* group, int first, int last, const double* buffer, double scale,
						   JnNodeRange range, double* f) {
	if (range.is_all)
		scatter_with(group, first, last, buffer, scale, range, f, true);
	else
		scatter_with(group, first, last, buffer, scale, range, f, false);
}

// Four lanes of node i of a pair of batches: three registers are turned into a row of four a lane. Lanes of padding add zeros.
INLINE void add_rows(const float* element, const int* at, float scale, JnNodeRange range, float* f, bool is_all) {
	const FourFloats x = scale * four_floats_load(element), y = scale * four_floats_load(element + JN_WIDE_FLOATS),
					 z = scale * four_floats_load(element + 2 * JN_WIDE_FLOATS), none = {0};
	const FourFloats xy = __builtin_shufflevector(x, y, 0, 4, 1, 5),
					 xy_high = __builtin_shufflevector(x, y, 2, 6, 3, 7);
	const FourFloats z0 = __builtin_shufflevector(z, none, 0, 4, 1, 5),
					 z0_high = __builtin_shufflevector(z, none, 2, 6, 3, 7);
	const FourFloats row[4] = {__builtin_shufflevector(xy, z0, 0, 1, 4, 5), __builtin_shufflevector(xy, z0, 2, 3, 6, 7),
							   __builtin_shufflevector(xy_high, z0_high, 0, 1, 4, 5),
							   __builtin_shufflevector(xy_high, z0_high, 2, 3, 6, 7)};
	JN_UNROLL for (int lane = 0; lane < 4; ++lane) {
		if (!is_all && (at[lane] < range.low || at[lane] >= range.high)) continue;
		float* to = f + 4 * (ptrdiff_t)at[lane];
		four_floats_store(to, four_floats_load(to) + row[lane]);
	}
}

// Elements by fours, whatever the width: the order of sums, and so the last bits, do not depend on it.
INLINE void add_all_rows(const JnGroup* group, int first, int last, const float* buffer, float scale, JnNodeRange range,
						 float* f, bool is_all) {
	const int nodes = group->kernel->nodes;
	for (int batch = first; batch < last; batch += 2, buffer += 3 * nodes * JN_WIDE_FLOATS) {
		const int* here = group->nodes + (ptrdiff_t)batch * nodes * JN_WIDE;
		const int* second = batch + 1 < group->batches ? here + nodes * JN_WIDE : here;
		for (int lane = 0; lane < JN_WIDE_FLOATS; lane += 4)
			for (int i = 0; i < nodes; ++i) {
				int at[4];
				JN_UNROLL for (int k = 0; k < 4; ++k) {
					const int l = lane + k;
					at[k] = l < JN_WIDE ? here[i * JN_WIDE + l] : second[i * JN_WIDE + l - JN_WIDE];
				}
				add_rows(buffer + 3 * i * JN_WIDE_FLOATS + lane, at, scale, range, f, is_all);
			}
	}
}

static void scatter_single(const JnGroup* group, int first, int last, const float* buffer, float scale,
						   JnNodeRange range, float* f) {
	if (range.is_all)
		add_all_rows(group, first, last, buffer, scale, range, f, true);
	else
		add_all_rows(group, first, last, buffer, scale, range, f, false);
}

JnScatterBlocks JOIN(jn_scatter_blocks_, JN_WIDE);
JnScatterTriangles JOIN(jn_scatter_triangles_, JN_WIDE);

const JnScatters JOIN(jn_scatters_, JN_WIDE) = {scatter_forces, scatter_single, JOIN(jn_scatter_blocks_, JN_WIDE),
												JOIN(jn_scatter_triangles_, JN_WIDE)};
