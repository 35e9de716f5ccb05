/// @file element_loops.h
/// What loops over solids and over constraints share: positions from the last node, and numbers of the last node from those
/// of the others.
#ifndef JN_FORCE_ELEMENT_LOOPS_H
#define JN_FORCE_ELEMENT_LOOPS_H

#include "force/element.h"
#include "force/kernel.h"
#include "math/wide.h"

/// Positions from the last node.
JN_INLINE void gather_edges(const JnGroup* group, const JnElement* element, int batch, const double* x,
							Wide edges[][3]) {
	const int* nodes = group->nodes + (ptrdiff_t)batch * element->nodes * JN_WIDE;
	Wide origin[3];
	wide_gather_points(x, nodes + (element->nodes - 1) * JN_WIDE, origin);
	JN_UNROLL for (int i = 0; i < element->nodes - 1; i++) {
		wide_gather_points(x, nodes + i * JN_WIDE, edges[i]);
		JN_UNROLL for (int a = 0; a < 3; a++) edges[i][a] -= origin[a];
	}
}

/// Forces of all nodes from those without the last, which is minus their sum: out[3 * nodes][lane].
JN_INLINE void store_forces(const JnElement* element, Wide force[][3], double* out) {
	JN_UNROLL for (int a = 0; a < 3; a++) {
		Wide sum = wide_set(0);
		JN_UNROLL for (int node = 0; node < element->nodes - 1; node++) {
			wide_store(out + (3 * node + a) * JN_WIDE, force[node][a]);
			sum -= force[node][a];
		}
		wide_store(out + (3 * (element->nodes - 1) + a) * JN_WIDE, sum);
	}
}

JN_INLINE int pair_index(int i, int j) {
	return i * (i + 1) / 2 + j;
}

/// The rows of the last node from those of the others: all columns of K sum to 0. Diagonal blocks made symmetric.
JN_INLINE void complete_tangent(const JnElement* element, double* blocks) {
	const int n = element->nodes, last = n - 1;
	for (int node = 0; node < last; node++) {
		double* block = blocks + (ptrdiff_t)pair_index(node, node) * 9 * JN_WIDE;
		JN_UNROLL for (int a = 0; a < 2; a++) {
			JN_UNROLL for (int b = a + 1; b < 3; b++) {
				wide_store(block + (3 * a + b) * JN_WIDE, wide_load(block + (3 * b + a) * JN_WIDE));
			}
		}
	}
	for (int j = 0; j < n; j++) {
		JN_UNROLL for (int ab = 0; ab < 9; ab++) {
			const int ba = ab % 3 * 3 + ab / 3;
			Wide sum = wide_set(0);
			for (int i = 0; i < last; i++) {
				const int pair = i >= j ? pair_index(i, j) : pair_index(j, i);
				sum -= wide_load(blocks + ((ptrdiff_t)pair * 9 + (i >= j ? ab : ba)) * JN_WIDE);
			}
			wide_store(blocks + ((ptrdiff_t)pair_index(last, j) * 9 + ab) * JN_WIDE, sum);
		}
	}
}

#endif
