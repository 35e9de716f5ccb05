/// @file assembly_single.h
/// Products in single precision, with vectors of 4 floats a node (the last 0), from what kernels store of a state. Owners
/// compute, as in assembly.h, all terms of a sum in one go: the same bits for any number of threads.
#ifndef JN_MODEL_ASSEMBLY_SINGLE_H
#define JN_MODEL_ASSEMBLY_SINGLE_H

#include "model/assembly.h"

/// What the kernels of a model store of one state. Zero is empty; free with jn_stored_free.
typedef struct JnStored {
	JnDefinite definite;
	const double* weight; ///< one a group, borrowed from JnTangentAt; NULL: 1 for all
	float* numbers;
	size_t capacity; ///< of `numbers`
} JnStored;

/// Whether every kernel of the model, or every one with weight[group] != 0, has products in single precision.
bool jn_assembly_has_single(const JnAssembly* assembly, const double* weight);

/// Keep what products with K need of a state. False where memory is short; it is asked for at the first call alone.
bool jn_assembly_store(JnAssembly* assembly, JnTangentAt at, JnStored* stored);
void jn_stored_free(JnStored* stored);

/// A symmetric matrix with one number a block of the pattern, times the identity of 3x3.
typedef struct JnScalarTerm {
	double scale;         ///< 0: no such term
	const double* blocks; ///< one a block of the pattern
	const float* full;    ///< the same in the order of its full rows; NULL: the diagonal alone
} JnScalarTerm;

typedef struct JnStoredTerm {
	double scale; ///< 0: no such term
	const JnStored* stored;
} JnStoredTerm;

enum { JN_SINGLE_TERMS = 2 };

typedef struct JnSingleSum {
	JnScalarTerm scalars[JN_SINGLE_TERMS];
	JnStoredTerm stored[JN_SINGLE_TERMS];
	/// Of each group, the factor of its elements' integrals of N_i N_j, made along with stored[0], which is there and takes
	/// all groups; NULL: none.
	const double* mass;
} JnSingleSum;

/// y = the sum of all terms, times p.
void jn_assembly_apply_single(JnAssembly* assembly, const JnSingleSum* sum, const float* p, float* y);

#endif
