/// @file columns.h
/// What constraint elements share: small vectors in wide numbers, and the matrix K from its products with unit vectors.
#ifndef JN_FORCE_CONSTRAINT_COLUMNS_H
#define JN_FORCE_CONSTRAINT_COLUMNS_H

#include "force/constraint/constraint.h"
#include "force/constraint/strain.h"

JN_INLINE void wide_cross(const Wide a[3], const Wide b[3], Wide out[3]) {
	JN_UNROLL for (int i = 0; i < 3; i++) {
		const int j = (i + 1) % 3, k = (i + 2) % 3;
		out[i] = wide_minor(a[j], b[k], a[k], b[j]);
	}
}

/// out = a + factor b.
JN_INLINE void wide_axpy(Wide factor, const Wide b[3], const Wide a[3], Wide out[3]) {
	JN_UNROLL for (int i = 0; i < 3; i++) out[i] = wide_fma(factor, b[i], a[i]);
}

/// K p of an element whose state is known: what its load() left in `state`.
typedef void ConstraintMultiply(const void* state, bool definite, Wide p[][3], Wide out[][3]);

/// Blocks of all node pairs but those of the last node, column by column.
JN_INLINE void columns_of(const void* state, bool definite, int edges, ConstraintMultiply* multiply, double* blocks) {
	for (int column = 0; column < 3 * edges; column++) {
		Wide p[JN_CONSTRAINT_MOST_NODES - 1][3], out[JN_CONSTRAINT_MOST_NODES - 1][3];
		JN_UNROLL for (int k = 0; k < 3 * edges; k++) p[k / 3][k % 3] = wide_set(k == column);
		multiply(state, definite, p, out);
		const int j = column / 3, b = column % 3;
		for (int i = j; i < edges; i++) {
			double* block = blocks + (ptrdiff_t)(9 * (i * (i + 1) / 2 + j) + b) * JN_WIDE;
			JN_UNROLL for (int a = 0; a < 3; a++) wide_store(block + (ptrdiff_t)3 * a * JN_WIDE, out[i][a]);
		}
	}
}

#endif
