/// @file relax.h
/// What relaxation moves: the measures C of springs, of the axes of threads and of tetrahedra, which are to be 0. Kernels of
/// it have the verbs relax() and strain() alone, and groups of it stand beside those of forces.
#ifndef JN_FORCE_RELAX_H
#define JN_FORCE_RELAX_H

#include "force/kernel.h"

/// X(name, nodes, rest_reals, words): numbers at rest; the last is 1, and 0 in padding.
///   spring   C = l - L                                             L, 1
///   axis     C = |sum w_i (x_i+3 - x_i)| - L, nodes as of a link   w_R, w_P, w_Q, L, 1
///   volume   C = V - V_0, V positive if d_0 . (d_1 x d_2) is       V_0, 1
#define JN_RELAX_KERNELS(X)                                                                                            \
	X(spring, 2, 2)                                                                                                    \
	X(axis, 6, 5)                                                                                                      \
	X(volume, 4, 2)

#define JN_NAME_RELAX(name, nodes, reals) JN_RELAX_##name,
typedef enum JnRelaxKernel { JN_RELAX_KERNELS(JN_NAME_RELAX) JN_RELAX_COUNT } JnRelaxKernel;
#undef JN_NAME_RELAX

enum { JN_RELAX_MOST_NODES = 6, JN_RELAX_MOST_REALS = 5 };

typedef JnKernel JnRelaxKernels[JN_RELAX_COUNT];
extern const JnRelaxKernels jn_relax_kernels_2, jn_relax_kernels_4, jn_relax_kernels_8;

/// The kernel for `width` lanes, or for those that this processor likes best when that is 0; NULL where it lacks them.
const JnKernel* jn_relax_kernel(JnRelaxKernel which, int width);

/// An element to be: nodes of the mesh, and numbers at rest as above but for the last.
typedef struct JnRelaxElement {
	int nodes[JN_RELAX_MOST_NODES];
	double rest[JN_RELAX_MOST_REALS];
} JnRelaxElement;

/// A group in batches of elements that share no node, in an order near the given one; what lacks in a batch is padding, and
/// counts. Batches are chosen for 8 lanes, and kept by narrower kernels: elements relax in one order on all processors.
/// `first_node` is added to each node.
JnStatus jn_relax_group_create(const JnKernel* kernel, int count, const JnRelaxElement* elements, int first_node,
							   JnArena* arena, JnGroup* group);

/// JnLaw.relaxed of laws whose springs are all edges of the tetrahedra; and of those whose threads have springs along them and
/// round their sections alone.
JnStatus jn_relax_edges(unsigned kinds, const JnMesh* mesh, int first_node, JnArena* arena, JnGroups* out);
JnStatus jn_relax_lines(unsigned kinds, const JnMesh* mesh, int first_node, JnArena* arena, JnGroups* out);

#endif
