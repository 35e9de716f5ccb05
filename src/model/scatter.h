/// @file scatter.h
/// From the forces of elements to those of nodes, compiled once a vector width: the numbers of an element stand in the
/// lanes of that many elements.
#ifndef JN_MODEL_SCATTER_H
#define JN_MODEL_SCATTER_H

#include "force/kernel.h"

/// Nodes low <= node < high. Those of other ranges are left to other threads.
typedef struct JnNodeRange {
	int low, high;
	bool is_all; ///< of the model: nothing is left to others
} JnNodeRange;

/// f += scale * the forces of the batches first <= batch < last of a group, which stand in `buffer` as JnKernel.force
/// writes them; in element order, node by node.
typedef void JnScatter(const JnGroup* group, int first, int last, const double* buffer, double scale, JnNodeRange range,
					   double* f);

/// The same in single precision, as JnKernel.product_single writes them, with 4 floats a node; node by node of the elements,
/// for each in their order.
typedef void JnScatterSingle(const JnGroup* group, int first, int last, const float* buffer, float scale,
							 JnNodeRange range, float* f);

/// blocks[9 * place] += weight * the 3x3 blocks of the batches first <= batch < last, which stand in `buffer` as
/// JnKernel.tangent writes them, in element order. place[batch - first][pair][lane]: the block of the pattern, or ~block
/// when transposed; a block belongs to the lower of its nodes.
typedef void JnScatterBlocks(const JnGroup* group, int first, int last, const int* place, const double* buffer,
							 double weight, JnNodeRange range, double* blocks);

/// blocks[9 * node] += weight * the triangles that JnKernel.diagonal writes.
typedef void JnScatterTriangles(const JnGroup* group, int first, int last, const double* buffer, double weight,
								JnNodeRange range, double* blocks);

/// What a vector width has; jn_scatters(width) finds it.
typedef struct JnScatters {
	JnScatter* forces;
	JnScatterSingle* single;
	JnScatterBlocks* blocks;
	JnScatterTriangles* triangles;
} JnScatters;

extern const JnScatters jn_scatters_2, jn_scatters_4, jn_scatters_8;

static inline const JnScatters* jn_scatters(int width) {
#if defined(__x86_64__)
	if (width > 2) return width == 8 ? &jn_scatters_8 : &jn_scatters_4;
#endif
	(void)width;
	return &jn_scatters_2;
}

#endif
