/// @file qp_rows.h
/// What contact solvers work on: the rows of G, scaled, one a contact without friction and three with it, and memory that
/// grows and is used again. Scaled rows: G^ = E G, lambda = E lambda^, b = E (G vp - bound).
#ifndef JN_SOLVE_QP_ROWS_H
#define JN_SOLVE_QP_ROWS_H

#include <stdlib.h>

#include "solve/qp.h"

/// Numbers that are allocated once and grow. All zero is empty; free with free(numbers.at).
typedef struct JnNumbers {
	double* at;
	size_t capacity;
} JnNumbers;

/// The same of integers.
typedef struct JnIndices {
	int* at;
	size_t capacity;
} JnIndices;

/// Room for `count`; what was there is lost when it must grow. JN_OUT_OF_MEMORY after a message.
JnStatus jn_numbers_reserve(JnNumbers* numbers, size_t count);
JnStatus jn_indices_reserve(JnIndices* indices, size_t count);

typedef struct JnQpRows {
	int contacts, count;   ///< count: rows
	int* first;            ///< contacts + 1: rows of contact i begin at first[i]; there are 1 or 3, none when G_i is 0
	double* scale;         ///< E, one a contact
	double* mu;            ///< one a contact
	double* before;        ///< b: relative velocity at vp with the bound taken off, scaled, one a row
	double* lambda;        ///< multipliers, scaled, one a row
	double* after;         ///< relative velocity that belongs to lambda, with the bound taken off; solvers' own use
	double velocity_scale; ///< largest of b and of E vp's relative velocity, at least a tiny number
} JnQpRows;

struct JnQp {
	const JnQpType* type;
	JnQpDef options;
	const JnContactProblem* problem; ///< during a solve
	JnQpRows rows;
	JnQpReport report;
	JnNumbers row_numbers, vectors; ///< behind the arrays of rows, and 3 vectors of 3 * nodes
	JnIndices row_indices, marks;   ///< marks: one a body
	double *rhs, *change, *work;    ///< those vectors
};

/// The body of a node; 0 when all nodes are one body.
int jn_qp_body_of(const JnContactProblem* problem, int node);

/// Prepare qp->rows for a problem, lambda from `guess` (3 * count), brought into the cone.
JnStatus jn_qp_rows_prepare(JnQp* qp, const JnContactProblem* problem, const double* guess);

/// Write the multipliers of the rows as 3 a contact.
void jn_qp_rows_unscale(const JnQp* qp, double* lambda);

/// Whether some multiplier is not 0.
bool jn_qp_rows_press(const JnQpRows* rows);

/// out[row] = G^ v.
void jn_qp_rows_apply(const JnQp* qp, const double* v, double* out);

/// f = G^' l; 3 * nodes.
void jn_qp_rows_transpose(const JnQp* qp, const double* l, double* f);

/// f += row `axis` (0 normal, 1 and 2 tangents) of contact i in G^, as a vector of 3 * nodes.
void jn_qp_row_add(const JnQp* qp, int contact, int axis, double* f);

/// Largest entry of the natural map at (after, lambda), relative: velocities by the velocity scale, multipliers by the
/// largest of them. What solvers drive to the tolerance; agrees with JnContactResidual up to rounding.
double jn_qp_rows_residual(const JnQp* qp);

/// Bring the multipliers of a contact into its cone.
void jn_qp_rows_clip(const JnQp* qp, int contact);

#endif
