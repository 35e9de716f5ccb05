/// @file cg_double.h
/// Preconditioned conjugate gradients in double precision, the preconditioner alone in single precision.
#ifndef JN_SOLVE_CG_DOUBLE_H
#define JN_SOLVE_CG_DOUBLE_H

#include "base/space.h"
#include "solve/precondition.h"
#include "solve/single_algebra.h"

typedef struct JnCgDouble {
	const JnSingleAlgebra* algebra;
	JnSpace* space;
	const bool* held;
	int nodes, held_count;
	size_t* held_list;          // entries
	JnVec x, r, z, p, q;        // q = A p
	float *single_r, *single_z; // for the preconditioner
} JnCgDouble;

/// Free with jn_cg_double_destroy, also after a failure.
JnStatus jn_cg_double_create(JnCgDouble* cg, const JnPattern* pattern, const bool* held, int threads);
void jn_cg_double_destroy(JnCgDouble* cg);

/// out = A in, held entries 0.
void jn_cg_double_multiply(const JnCgDouble* cg, const JnOperator* matrices, int slot, const double* in, JnVec out);

/// cg->x += d with |r - A d| <= goal, where cg->r is the right-hand side on entry and what is left of it on exit. Stops
/// when *iterations, which counts them, has reached `most`: JN_NOT_CONVERGED. JN_INDEFINITE: cg->p is a direction of no
/// positive curvature. precondition NULL: none.
JnStatus jn_cg_double_solve(JnCgDouble* cg, const JnOperator* matrices, int slot, JnPrecondition* precondition,
							double goal, int most, int* iterations);

#endif
