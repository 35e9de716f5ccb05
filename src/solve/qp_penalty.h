/// @file qp_penalty.h
/// Solves with C + G' R G, R one penalty a contact: the KKT system [C, G'; G, -1/R] of operator splitting, reduced.
/// With the blocks of C by sparse Cholesky (CHOLMOD, AMD), analysed for each problem because contacts change the pattern;
/// with its verbs alone by conjugate gradients preconditioned by C^-1, which sees 1 + eigenvalues of R G C^-1 G'.
#ifndef JN_SOLVE_QP_PENALTY_H
#define JN_SOLVE_QP_PENALTY_H

#include "solve/qp_rows.h"

typedef struct JnPenaltyFactor JnPenaltyFactor; // what CHOLMOD keeps

typedef struct JnPenalty {
	JnPenaltyFactor* factor; ///< NULL before the first use
	const double* rho;       ///< of the last factorisation, one a contact; 0: the contact takes no part
	JnNumbers vectors;       ///< of conjugate gradients
} JnPenalty;

/// A new problem: forget the analysis.
void jn_penalty_begin(JnPenalty* penalty);
/// Factor for rho[contacts], which must live until the next call. JN_INDEFINITE when C is not positive definite.
JnStatus jn_penalty_factor(JnPenalty* penalty, JnQp* qp, const double* rho);
/// change = (C + G' R G)^-1 rhs on the free entries, 0 on held ones.
JnStatus jn_penalty_solve(JnPenalty* penalty, JnQp* qp, const double* rhs, double* change);
void jn_penalty_release(JnPenalty* penalty);

#endif
