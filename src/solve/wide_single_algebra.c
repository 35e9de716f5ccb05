// Compiled once a vector width; see single_algebra.h. Exports the table jn_single_algebra_<width>.
#include <string.h>

#include "solve/single_algebra.h"

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)

enum { LANES = 8, PARTS = LANES / JN_WIDE };

typedef float Single __attribute__((vector_size(JN_WIDE * sizeof(float)), may_alias));
typedef double Double __attribute__((vector_size(JN_WIDE * sizeof(double))));
typedef float Node __attribute__((vector_size(4 * sizeof(float)), may_alias));

// The lanes, in registers.
typedef struct Sums {
	Double part[PARTS];
} Sums;

static inline Double wide_at(const float* a) {
	return __builtin_convertvector(*(const Single*)a, Double);
}

static inline double total(const Sums* sums) {
	double lane[LANES];
	memcpy(lane, sums->part, sizeof lane);
	return ((lane[0] + lane[4]) + (lane[2] + lane[6])) + ((lane[1] + lane[5]) + (lane[3] + lane[7]));
}

static double dot(size_t n, const float* a, const float* b) {
	Sums sums = {{{0}}};
	for (size_t k = 0; k < n; k += LANES)
		for (size_t p = 0; p < PARTS; ++p) sums.part[p] += wide_at(a + k + p * JN_WIDE) * wide_at(b + k + p * JN_WIDE);
	return total(&sums);
}

static void two_dots(size_t n, const float* z, const float* r, const float* q, double out[2]) {
	Sums with_r = {{{0}}}, with_q = {{{0}}};
	for (size_t k = 0; k < n; k += LANES)
		for (size_t p = 0; p < PARTS; ++p) {
			const size_t at = k + p * JN_WIDE;
			const Double wide = wide_at(z + at);
			with_r.part[p] += wide * wide_at(r + at);
			with_q.part[p] += wide * wide_at(q + at);
		}
	out[0] = total(&with_r);
	out[1] = total(&with_q);
}

static double advance(size_t n, float alpha, const float* p, const float* q, float* x, float* r) {
	Sums sums = {{{0}}};
	for (size_t k = 0; k < n; k += LANES)
		for (size_t part = 0; part < PARTS; ++part) {
			const size_t at = k + part * JN_WIDE;
			*(Single*)(x + at) += alpha * *(const Single*)(p + at);
			const Single left = *(const Single*)(r + at) - alpha * *(const Single*)(q + at);
			*(Single*)(r + at) = left;
			const Double wide = __builtin_convertvector(left, Double);
			sums.part[part] += wide * wide;
		}
	return total(&sums);
}

static void extend(size_t n, float beta, const float* z, float* p) {
	for (size_t k = 0; k < n; k += JN_WIDE)
		*(Single*)(p + k) = *(const Single*)(z + k) + beta * *(const Single*)(p + k);
}

static inline const Node* block_at(const float* blocks, int k) {
	return (const Node*)(blocks + JN_SINGLE_INVERSE * (size_t)k);
}

static inline Node times(const Node* block, Node x) {
	return block[0] * x[0] + block[1] * x[1] + block[2] * x[2];
}

// Sums of transposed blocks times vectors, before each is summed over its entries.
typedef struct Across {
	Node entry[3];
} Across;

static inline void add_across(Across* sum, const Node* block, Node x) {
	for (int c = 0; c < 3; ++c) sum->entry[c] += block[c] * x;
}

static inline Node total_across(const Across* sum) {
	const Node a = sum->entry[0], b = sum->entry[1], c = sum->entry[2];
	return (Node){a[0] + a[1] + a[2], b[0] + b[1] + b[2], c[0] + c[1] + c[2], 0};
}

static void apply_blocks(size_t nodes, const float* blocks, const float* r, float* z) {
	for (size_t node = 0; node < nodes; ++node)
		*(Node*)(z + 4 * node) = times((const Node*)(blocks + JN_SINGLE_INVERSE * node), *(const Node*)(r + 4 * node));
}

static void multiply(const JnPattern* pattern, const float* blocks, const float* x, float* y, int first, int last) {
	for (int row = first; row < last; ++row) {
		Node sum = {0};
		Across across = {{{0}}};
		for (int k = pattern->full_start[row]; k < pattern->full_start[row + 1]; ++k) {
			const int place = pattern->full_block[k];
			const Node in = *(const Node*)(x + 4 * (size_t)pattern->full_column[k]);
			if (place >= 0)
				sum += times(block_at(blocks, place), in);
			else
				add_across(&across, block_at(blocks, ~place), in);
		}
		*(Node*)(y + 4 * (size_t)row) = sum + total_across(&across);
	}
}

static void solve_columns(const JnPattern* pattern, const float* blocks, float* from, float* to) {
	const int *start = pattern->column_start, *row = pattern->row;
	Node *y = (Node*)from, *x = (Node*)to;
	for (int node = 0; node < pattern->nodes; ++node) {
		const Node here = times(block_at(blocks, start[node]), y[node]);
		y[node] = here;
		for (int k = start[node] + 1; k < start[node + 1]; ++k) y[row[k]] -= times(block_at(blocks, k), here);
	}
	for (int node = pattern->nodes - 1; node >= 0; --node) {
		Across below = {{{0}}}, here = {{{0}}};
		for (int k = start[node] + 1; k < start[node + 1]; ++k) add_across(&below, block_at(blocks, k), x[row[k]]);
		add_across(&here, block_at(blocks, start[node]), y[node] - total_across(&below));
		x[node] = total_across(&here);
	}
}

static void pack(size_t nodes, double scale, const double* in, const bool* held, float* out) {
	for (size_t node = 0; node < nodes; ++node) {
		for (size_t axis = 0; axis < 3; ++axis) {
			const size_t k = 3 * node + axis;
			out[4 * node + axis] = held[k] ? 0 : (float)(scale * in[k]);
		}
		out[4 * node + 3] = 0;
	}
}

static void unpack(size_t nodes, double scale, const float* in, double* out) {
	for (size_t node = 0; node < nodes; ++node)
		for (size_t axis = 0; axis < 3; ++axis) out[3 * node + axis] += scale * (double)in[4 * node + axis];
}

const JnSingleAlgebra JOIN(jn_single_algebra_, JN_WIDE) = {.dot = dot,
														   .two_dots = two_dots,
														   .advance = advance,
														   .extend = extend,
														   .apply_blocks = apply_blocks,
														   .multiply = multiply,
														   .solve_columns = solve_columns,
														   .pack = pack,
														   .unpack = unpack};
