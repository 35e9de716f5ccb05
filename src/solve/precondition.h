/// @file precondition.h
/// Preconditioners of conjugate gradients: z = B r with B near A^-1, symmetric positive definite. All work in single
/// precision, of which B needs no more, on vectors of 4 numbers a node (the last of them 0; held entries are 0 in r and
/// become 0 in z). Numbers are scaled by whoever calls, so that they lie in the range of single precision.
#ifndef JN_SOLVE_PRECONDITION_H
#define JN_SOLVE_PRECONDITION_H

#include "solve/solver.h"

typedef struct JnPrecondition JnPrecondition;

typedef struct JnPreconditionType {
	const char* name; ///< as written in scene files
	/// For matrices of `pattern` without the held entries (held[3 * node + axis]). `matrices` and what it points to stay
	/// where they are. Sets *out, or a status with a message.
	JnStatus (*create)(const JnPattern* pattern, const bool* held, int threads, const JnOperator* matrices,
					   JnPrecondition** out);
	void (*destroy)(JnPrecondition*); ///< NULL is allowed
	/// The matrix of `slot` is a new one. A preconditioner that is dear to make may keep what it has, made for an earlier
	/// matrix or another slot, until `renew` asks for a new one. JN_INDEFINITE when the matrix is seen not to be positive
	/// definite.
	JnStatus (*update)(JnPrecondition*, int slot, bool renew);
	void (*apply)(JnPrecondition*, int slot, const float* r, float* z); ///< z = B r
	size_t (*bytes)(const JnPrecondition*);                             ///< memory of what is kept of one matrix
} JnPreconditionType;

struct JnPrecondition {
	const JnPreconditionType* type;
	double setup_products; ///< cost of update() with renew, counted in operations and given in products with A
	double apply_products; ///< cost of apply(), likewise
};

/// The inverse diagonal blocks; a sparse Cholesky factor carried along by the rotations of the nodes; an incomplete
/// Cholesky factor without fill; a multigrid of smoothed aggregates.
extern const JnPreconditionType jn_precondition_block, jn_precondition_kept, jn_precondition_incomplete,
	jn_precondition_multigrid;

#endif
