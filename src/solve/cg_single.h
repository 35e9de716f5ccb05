/// @file cg_single.h
/// Preconditioned conjugate gradients in single precision: half the memory to stream and twice the numbers in a vector
/// register. Good to about six digits; whoever needs more refines in double precision.
#ifndef JN_SOLVE_CG_SINGLE_H
#define JN_SOLVE_CG_SINGLE_H

#include "solve/precondition.h"
#include "solve/single_algebra.h"

/// Vectors of 4 numbers a node, padded.
typedef struct JnCgSingle {
	const JnSingleAlgebra* algebra;
	int nodes, threads;
	size_t length;
	float *x, *r, *z, *p, *q; // q = A p
	double* partial;          // two sums a chunk
	int held_count;
	size_t* held_list; // entries of such vectors
} JnCgSingle;

/// Free with jn_cg_single_destroy, also after a failure.
JnStatus jn_cg_single_create(JnCgSingle* cg, const JnPattern* pattern, const bool* held, int threads);
void jn_cg_single_destroy(JnCgSingle* cg);

/// x with |r - A x| <= goal, where cg->r is the right-hand side on entry and what is left of it on exit. Stops after `most`
/// iterations (JN_NOT_CONVERGED) and counts them in *iterations. JN_INDEFINITE: cg->p is a direction of no positive
/// curvature as far as single precision can tell, and cg->x what was found before it. precondition NULL: none.
JnStatus jn_cg_single_solve(JnCgSingle* cg, const JnOperator* matrices, int slot, JnPrecondition* precondition,
							double goal, int most, int* iterations);

#endif
