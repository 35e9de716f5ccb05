/// @file solver.h
/// Linear solvers for symmetric block matrices: analyse a pattern once, factor numbers often, solve more often.
/// Linear algebra alone: no mechanics.
#ifndef JN_SOLVE_SOLVER_H
#define JN_SOLVE_SOLVER_H

#include "jounce/extend.h"
#include "math/pattern.h"
#include "solve/half.h"

typedef struct JnSolver JnSolver;

/// What the first factorisation told about the size of the problem.
typedef struct JnSolverCost {
	double factor_flops;   ///< floating-point operations of a factorisation
	double factor_entries; ///< non-zeros of the factor
	size_t bytes;          ///< memory of one factor
} JnSolverCost;

/// Symmetric matrices, one a slot, as whoever makes them can show them: a solver asks for what it needs, which is made then.
/// What is returned is valid until the next call of the same verb.
typedef struct JnOperator {
	void* user;
	void (*apply)(void* user, int slot, const double* in, double* out); ///< out = A in, held entries included
	/// The same in single precision, with vectors of 4 numbers a node, the last of them 0. NULL: not known.
	void (*apply_single)(void* user, int slot, const float* in, float* out);
	bool is_assembled;                                ///< products come from blocks: those may as well be copied
	const double* (*diagonal)(void* user, int slot);  ///< the diagonal blocks, 9 a node
	const double* (*blocks)(void* user, int slot);    ///< all blocks of the pattern, 9 a block
	const double* (*positions)(void* user, int slot); ///< where the nodes are when the matrix is this [m], 3 a node
	const double* rest;                               ///< and where they are at rest
	/// Whether the matrix is a multiple of that of masses, well conditioned and the same for good. NULL: never.
	bool (*is_mass)(void* user, int slot);
	const double* floor; ///< norm of what rounding leaves in a right-hand side: less than that counts as zero
} JnOperator;

typedef struct JnSolverType {
	JnRow row;
	/// Analyse the pattern without the held entries (held[3 * node + axis]). Sets *out, or a status with a message.
	JnStatus (*create)(const void* options, const JnPattern* pattern, const bool* held, int threads, JnSolver** out);
	void (*destroy)(JnSolver*);
	/// Whether `options` let products stand for the matrix, where the model has them. NULL: never.
	bool (*takes_products)(const void* options);
	/// From now on the matrices are those of `matrices`, and factor() gets no blocks. NULL: factor() gets them.
	void (*attach)(JnSolver*, JnOperator matrices);
	/// Factor the numbers blocks[9 * block] into `slot`. JN_INDEFINITE when the matrix is not positive definite. With
	/// attach: the matrix of `slot` is a new one; blocks is NULL.
	JnStatus (*factor)(JnSolver*, int slot, const double* blocks);
	/// out = A^-1 rhs with the factor of `slot`; held entries of out are 0. Vectors of 3 * nodes; out may be rhs. Solvers
	/// that iterate also return JN_INDEFINITE, JN_NOT_FINITE and JN_NOT_CONVERGED, and leave out as it was.
	JnStatus (*solve)(JnSolver*, int slot, const double* rhs, double* out);
	/// The same for `count` vectors, one behind the other; out may be rhs. NULL: call solve for each.
	JnStatus (*solve_many)(JnSolver*, int slot, int count, const double* rhs, double* out);
	/// Append to `out` the halves of sparse right-hand sides, whose dot products are those of A^-1; held entries of the
	/// columns are dropped. All halves of one `out` are by the same factor. NULL: not known.
	JnStatus (*half)(JnSolver*, int slot, const JnColumns* columns, JnHalf* out);
	/// Like solve, until the residual is below tolerance |rhs|, or better: a factor in single precision gives about six
	/// digits whatever is asked.
	JnStatus (*approximate)(JnSolver*, int slot, double tolerance, const double* rhs, double* out);
	JnSolverCost (*cost)(const JnSolver*); ///< NULL: not known
} JnSolverType;

enum { JN_SOLVER_SLOTS = 4 }; ///< factors that a solver keeps at once

struct JnSolver {
	const JnSolverType* type;
	int iterations;    ///< of the last solve; 0 where there are none
	bool is_iterative; ///< the next solve will iterate, and cost by its tolerance
	JnWay way;         ///< of the last solve
	int changes;       ///< from one way to another, since whoever counts them set it to 0
};

extern const JnRowList jn_solver_list; ///< rows are &JnSolverType.row

/// Keys of `solver: {method: direct}`.
typedef struct JnDirectDef {
	int ordering;  ///< 0 auto: the better of METIS and AMD; 1 metis; 2 amd
	int precision; ///< of directions for iterations that measure their residual: 0 mixed: single; 1 double
} JnDirectDef;

extern const JnSolverType jn_solver_direct;

/// Keys of `solver: {method: cg}`.
typedef struct JnCgDef {
	double tolerance; ///< of a solve: norm of the residual relative to that of the right-hand side
	int max_iterations;
	int precondition; ///< 0 auto: whichever is cheapest; else the JnWay
	int matrix;       ///< 0 auto: products where every law has them; 1 assembled
	int precision;    ///< 0 mixed: iterations in single precision, residuals in double; 1 double
	double memory;    ///< most that a factor may take [bytes]; 0: half of the machine's
} JnCgDef;

extern const JnSolverType jn_solver_cg;

/// Direct or cg, whichever is cheapest, with the keys of cg.
extern const JnSolverType jn_solver_auto;

/// Sparse LU (UMFPACK), for matrices that are not symmetric. Its factor() takes the blocks of all rows, those of
/// pattern->full_column: blocks[9 * k + 3 * r + c] for place k of the full rows. JN_INDEFINITE stands for a singular matrix.
/// No options; no scene names it, as models choose it where they must.
extern const JnSolverType jn_solver_unsymmetric;

#endif
