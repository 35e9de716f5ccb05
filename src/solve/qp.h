/// @file qp.h
/// Solvers of the contact problem behind one interface. They reuse their memory from call to call.
#ifndef JN_SOLVE_QP_H
#define JN_SOLVE_QP_H

#include "jounce/extend.h"
#include "solve/contact_problem.h"

typedef struct JnQp JnQp;

/// What a solve has cost and reached.
typedef struct JnQpReport {
	int iterations;     ///< of the outermost iteration of the method
	int sweeps;         ///< Gauss-Seidel sweeps over the contacts
	int factorizations; ///< dense or sparse, C itself not counted
	int solves;         ///< solves with C, or with C and the penalty of the splitting
	int rows;           ///< rows of G that the method worked on
	JnContactResidual residual;
} JnQpReport;

typedef struct JnQpType {
	JnRow row;
	size_t size; ///< bytes of the struct that begins with JnQp
	/// Find the multipliers of the rows prepared in qp_rows.h: read and write qp->rows.lambda, add to qp->report.
	JnStatus (*solve)(JnQp*);
	void (*release)(JnQp*); ///< free what the method allocated
} JnQpType;

/// Keys of every solver.
typedef struct JnQpDef {
	double tolerance;   ///< largest relative residual, see JnContactResidual
	int max_iterations; ///< of the method
} JnQpDef;

extern const JnRowList jn_qp_list; ///< rows are &JnQpType.row
extern const JnKey jn_qp_keys[];   ///< of every row
extern const JnQpType jn_qp_auto, jn_qp_admm, jn_qp_delassus;

/// A solver by the row and the options that a scene chose (copied). JN_OUT_OF_MEMORY after a message. Free with jn_qp_destroy.
JnStatus jn_qp_create(const JnQpType* type, const JnQpDef* options, JnQp** out);
void jn_qp_destroy(JnQp* qp);

/// Solve. `v` (3 * nodes) receives the velocities: bodies whose multipliers are all 0, and all held entries, are those of
/// vp bit for bit. `lambda` (3 * count, in contact frames [N s]) holds a guess and receives the multipliers; zeros are a
/// fair guess. JN_NOT_CONVERGED when a residual exceeds the tolerance, as with bounds that contradict each other: v and
/// lambda are then the best known, finite. JN_NOT_FINITE, with v = vp and lambda = 0, when the input is not finite.
/// JN_BAD_INPUT after a message when a contact names a node that does not exist.
JnStatus jn_qp_solve(JnQp* qp, const JnContactProblem* problem, double* v, double* lambda, JnQpReport* report);

#endif
