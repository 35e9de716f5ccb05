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

extern JnScatter jn_scatter_2, jn_scatter_4, jn_scatter_8;

#endif
