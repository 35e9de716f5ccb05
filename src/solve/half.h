/// @file half.h
/// Halves of inverse products: with L L' = P A P' a right-hand side b has the half h = L^-1 P b, and b_i' A^-1 b_j = h_i . h_j.
/// A sparse b touches only its path to the root of the elimination tree, so halves are kept in pieces, a piece for each
/// panel of columns of L with the halves that reach it:
///
///   panel 0   [ h_0 h_2 ]              rows of the panel x columns that reach it, column by column
///   panel 3   [ h_1 ]
///   panel 7   [ h_0 h_1 h_2 h_5 ]      the root, which all reach
#ifndef JN_SOLVE_HALF_H
#define JN_SOLVE_HALF_H

#include "base/grow.h"

/// Sparse vectors, one behind the other. Entries are 3 * node + axis; one that comes twice counts twice.
typedef struct JnColumns {
	int count;
	const int* start;    ///< count + 1, into entry and value; start[0] is 0
	const int* entry;    ///< of vectors of 3 * nodes
	const double* value; ///< same length
} JnColumns;

typedef struct JnHalfPiece {
	int panel, rows, count; ///< count of the halves that reach the panel
	int earlier;            ///< piece of the same panel from the last call before that had one, or -1
	size_t column, value;   ///< where its numbers of halves, and its rows * count numbers, begin
} JnHalfPiece;

typedef struct JnHalfLeft JnHalfLeft; // what a solver keeps for a panel on its way

/// All zero is empty. Grows from call to call, and is used again after jn_half_clear.
typedef struct JnHalf {
	int count;       ///< halves
	int piece_count; ///< in the order of calls, then of panels
	JnHalfPiece* pieces;
	int* column; ///< ascending within a piece
	double* value;
	size_t columns, values; ///< in use
	int panels, *latest;    ///< panels of the factor; the last piece of each, or -1
	double *front, *stack;  ///< memory of the solver
	int* marks;             ///< the same
	JnHalfLeft* left;       ///< the same
	size_t piece_capacity, column_capacity, value_capacity, latest_capacity, front_capacity, stack_capacity,
		marks_capacity, left_capacity;
} JnHalf;

/// Forget the halves, keep the memory.
void jn_half_clear(JnHalf* half);
void jn_half_release(JnHalf* half);

/// Before the first pieces of a call by a factor with that many panels.
JnStatus jn_half_begin(JnHalf* half, int panels);

/// A new piece at the end, its columns and values not yet written.
JnStatus jn_half_append(JnHalf* half, int panel, int rows, int count, JnHalfPiece** out);

/// matrix[i + stride * j] += h_i . h_j for all i >= j with i >= first.
JnStatus jn_half_products(JnHalf* half, int first, size_t stride, double* matrix);

#endif
