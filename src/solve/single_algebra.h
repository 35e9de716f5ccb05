/// @file single_algebra.h
/// Loops of conjugate gradients over vectors in single precision of 4 numbers a node, the last of them 0. What belongs
/// together runs in one pass. Sums are of exact products in double precision, in 8 interleaved accumulators; each loop
/// gives the same bits for every vector width.
#ifndef JN_SOLVE_SINGLE_ALGEBRA_H
#define JN_SOLVE_SINGLE_ALGEBRA_H

#include <stdbool.h>
#include <stddef.h>

#include "math/pattern.h"

enum {
	JN_SINGLE_CHUNK = 4096,  ///< entries summed at once; chunks are then summed in order
	JN_SINGLE_INVERSE = 12,  ///< numbers a node of a 3x3 block: its columns, each padded with 0
	JN_SINGLE_MULTIPLE = 16, ///< vectors are padded with zeros to a multiple of so many entries, and aligned to as many
};

/// n is a multiple of JN_SINGLE_MULTIPLE, all pointers are aligned to 64 bytes, and no two vectors overlap.
typedef struct JnSingleAlgebra {
	double (*dot)(size_t n, const float* a, const float* b);
	void (*two_dots)(size_t n, const float* z, const float* r, const float* q, double out[2]); ///< z.r and z.q
	/// x += alpha p, r -= alpha q; returns r.r.
	double (*advance)(size_t n, float alpha, const float* p, const float* q, float* x, float* r);
	void (*extend)(size_t n, float beta, const float* z, float* p); ///< p = z + beta p
	/// z = B r with a block a node.
	void (*apply_blocks)(size_t nodes, const float* blocks, const float* r, float* z);
	/// y = A x in the rows first .. last - 1, with blocks like those of apply_blocks in the places of the pattern.
	void (*multiply)(const JnPattern* pattern, const float* blocks, const float* x, float* y, int first, int last);
	/// x = (L L')^-1 y, y is lost. blocks of L by columns like those of multiply, but of the diagonal the inverse.
	void (*solve_columns)(const JnPattern* pattern, const float* blocks, float* y, float* x);
	/// 4 a node from 3 a node, times scale; held entries give 0.
	void (*pack)(size_t nodes, double scale, const double* in, const bool* held, float* out);
	/// out += scale * in, 3 a node from 4 a node.
	void (*unpack)(size_t nodes, double scale, const float* in, double* out);
} JnSingleAlgebra;

extern const JnSingleAlgebra jn_single_algebra_2, jn_single_algebra_4, jn_single_algebra_8;

/// The one for this processor.
const JnSingleAlgebra* jn_single_algebra(void);

/// Entries of a vector of `nodes` nodes with its padding.
static inline size_t jn_single_length(int nodes) {
	return (4 * (size_t)nodes + JN_SINGLE_MULTIPLE - 1) / JN_SINGLE_MULTIPLE * JN_SINGLE_MULTIPLE;
}

/// Zeroed and aligned; NULL when memory is out. Free with jn_aligned_free().
float* jn_single_vector(size_t length);

#endif
