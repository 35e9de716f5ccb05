/// @file assembly.h
/// From element numbers to the model's vectors and matrices, the same bits for any number of threads.
///
/// Each thread owns a range of nodes. It runs the kernels of all batches that touch its range and adds only what belongs
/// there, in element order; elements on the border of two ranges are computed twice. Nothing is shared, nothing waits,
/// and every sum has the order of a single thread.
#ifndef JN_MODEL_ASSEMBLY_H
#define JN_MODEL_ASSEMBLY_H

#include "model/model.h"

typedef struct JnAssembly JnAssembly;

typedef enum JnDefinite { JN_EXACT, JN_DEFINITE } JnDefinite; ///< tangent as it is, or with eigenvalues clamped to >= 0

/// Maps and buffers for a model; lives in the model's arena.
JnStatus jn_assembly_create(JnModel* model, JnAssembly** assembly);

/// f += internal forces at x.
void jn_assembly_force(JnAssembly* assembly, const double* x, double* f);

/// blocks[9 * block] = sum over groups of weight[group] * K; weight NULL: 1 for all.
void jn_assembly_tangent(JnAssembly* assembly, const double* x, JnDefinite definite, const double* weight,
						 double* blocks);

/// Where K is taken.
typedef struct JnTangentAt {
	const double* x;
	JnDefinite definite;
	const double* weight; ///< one a group; NULL: 1 for all
} JnTangentAt;

/// blocks[9 * node] = the diagonal blocks of the sum over groups of weight[group] * K.
void jn_assembly_diagonal(JnAssembly* assembly, JnTangentAt tangent, double* blocks);

/// y += scale * sum over groups of weight[group] * K p, K at x, without a matrix. Every kernel has products.
void jn_assembly_product(JnAssembly* assembly, JnTangentAt tangent, double scale, const double* p, double* y);

/// Elastic energy [J], summed in element order.
double jn_assembly_energy(JnAssembly* assembly, const double* x);

/// Rotations and whatever else stays constant over a step. True when some kernel froze something.
bool jn_assembly_freeze(JnAssembly* assembly, const double* x);

#endif
