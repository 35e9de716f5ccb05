/// @file qp_delassus.h
/// The matrix W = G C^-1 G' that tells what velocity at each contact an impulse at another makes (Delassus 1917), dense, in
/// columns that are made when a contact first needs them: most contacts that may touch within a step never do.
///
///   column c of `at` holds W of all rows; working[] names the contacts that have columns, in the order of arrival
#ifndef JN_SOLVE_QP_DELASSUS_H
#define JN_SOLVE_QP_DELASSUS_H

#include "solve/qp_rows.h"

typedef struct JnDelassus {
	JnQp base;
	double* at; ///< rows * columns, column by column
	size_t capacity;
	int columns;
	int working_count;
	int* working;   ///< contacts with columns, room for all
	int* column_of; ///< first column of each contact, or -1
	JnIndices indices;
	JnNumbers batch;          ///< right-hand sides and solutions of one call of solve_many
	JnNumbers numbers, dense; ///< vectors and the dense matrix of the method
	JnIndices marks;          ///< integers of the method
} JnDelassus;

/// Forget all columns and make room for the contacts of the rows.
JnStatus jn_delassus_begin(JnDelassus* d);

/// Give columns to the contacts that lack them and press on, or are below their bound by more than `slack` in `after`;
/// *added counts them.
JnStatus jn_delassus_extend(JnDelassus* d, double slack, int* added);

/// after = before + W lambda, for all rows; contacts without columns must have lambda = 0.
void jn_delassus_velocities(JnDelassus* d);

static inline double jn_delassus_entry(const JnDelassus* d, int row, int column) {
	return d->at[(size_t)column * (size_t)d->base.rows.count + (size_t)row];
}

/// Without friction: a linear complementarity problem, by block principal pivoting.
JnStatus jn_delassus_pivot(JnDelassus* d);

/// With friction: Gauss-Seidel sweeps and semismooth Newton steps.
JnStatus jn_delassus_coulomb(JnDelassus* d);

/// Newton steps on Coulomb's law until the residual is below `tolerance` or grows; lambda and `after` are then the best
/// met. *worked: the residual fell to a tenth.
JnStatus jn_delassus_newton(JnDelassus* d, double tolerance, bool* worked);

#endif
