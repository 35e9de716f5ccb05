/// @file cg_refine.h
/// Conjugate gradients in mixed precision: iterations in single precision where the operator knows such products, residuals
/// in double precision, and iterations in double precision where the first kind stalls.
#ifndef JN_SOLVE_CG_REFINE_H
#define JN_SOLVE_CG_REFINE_H

#include "solve/cg_double.h"
#include "solve/cg_single.h"

typedef struct JnCgRefine {
	JnCgDouble wide;
	JnCgSingle single; ///< made when it is first wanted
	const JnPattern* pattern;
	const bool* held;
	int threads, most; ///< iterations of a solve
	bool is_double;    ///< all in double precision, whatever the operator knows
} JnCgRefine;

/// Free with jn_cg_refine_destroy, also after a failure.
JnStatus jn_cg_refine_create(JnCgRefine* cg, const JnPattern* pattern, const bool* held, int threads);
void jn_cg_refine_destroy(JnCgRefine* cg);

/// What is to be solved, and how well.
typedef struct JnCgTask {
	const JnOperator* matrices;
	int slot;
	JnPrecondition* precondition; ///< NULL: none
	double tolerance;             ///< of the residual, relative to the right-hand side
	bool is_rough;                ///< the residual of the iteration will do: whoever asks measures it
} JnCgTask;

/// out = A^-1 rhs; held entries of out are 0; out may be rhs, and is left alone unless JN_OK is returned. *iterations is how
/// many it took, *digits by how many powers of ten the residual fell.
JnStatus jn_cg_refine_solve(JnCgRefine* cg, const JnCgTask* task, const double* rhs, double* out, int* iterations,
							double* digits);

#endif
