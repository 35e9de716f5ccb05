/// @file block_factor.h
/// Gauss elimination of a sparse matrix of dense blocks whose pattern is symmetric, such as that of contacts grouped by the
/// bodies that they join: a chain of bodies makes it block tridiagonal. Groups are eliminated in the order of least degree,
/// and pivots are sought within the diagonal block alone. Where a group p is eliminated, with the later ones that it meets
/// behind each other,
///
///   [ diagonal   beside ]        LU:        beside = diagonal^-1 beside,      later -= below beside
///   [ below      later  ]        Cholesky:  diagonal = L L', below = below L'^-1,   later -= below below'
#ifndef JN_SOLVE_BLOCK_FACTOR_H
#define JN_SOLVE_BLOCK_FACTOR_H

#include "solve/qp_rows.h"

/// Memory grows and is used again; all zero is empty.
typedef struct JnBlockFactor {
	int count;          ///< groups
	bool is_symmetric;  ///< Cholesky of the lower triangle; nothing is read or written beside
	int *place, *size;  ///< of a group: when it is eliminated; its unknowns
	int *order, *first; ///< by places: the group; where its unknowns begin (count + 1)
	int* start;         ///< by places: where its later groups begin in `later` (count + 1)
	int* offset_of;     ///< by places: work
	JnIndices later;    ///< places that a place meets, ascending, then the rows of their blocks in `below`, then pivots
	int *offset, *pivots;
	int words;                         ///< of a row of `meets`
	unsigned* meets;                   ///< bits: which groups meet
	size_t *diagonal, *below, *beside; ///< by places: where the blocks are in `numbers`
	double work;                       ///< operations of a factorisation
	JnIndices indices, bits;
	JnNumbers numbers, product, vector, offsets;
} JnBlockFactor;

/// A block within its panel: entry (row, column) is at[row + stride * column].
typedef struct JnBlock {
	double* at; ///< NULL: not stored
	int stride;
} JnBlock;

/// Groups of no unknowns yet that do not meet each other.
JnStatus jn_block_begin(JnBlockFactor* f, int count);
static inline void jn_block_meet(JnBlockFactor* f, int a, int b) {
	f->meets[(size_t)a * (size_t)f->words + (size_t)b / 32] |= 1u << b % 32;
	f->meets[(size_t)b * (size_t)f->words + (size_t)a / 32] |= 1u << a % 32;
}
/// Find the order from `size`, the pattern of the factor and its work. `meets` is consumed.
JnStatus jn_block_analyze(JnBlockFactor* f, bool is_symmetric);
/// Room for the numbers, all 0.
JnStatus jn_block_clear(JnBlockFactor* f);
/// The block of a row group and a column group that meet.
JnBlock jn_block_at(JnBlockFactor* f, int row_group, int column_group);
/// JN_OK with *is_regular false when a pivot is 0, or negative in a symmetric matrix.
JnStatus jn_block_factorize(JnBlockFactor* f, bool* is_regular);
/// x = A^-1 x, the unknowns of a group from first[place[group]] on.
void jn_block_solve(JnBlockFactor* f, double* x);
void jn_block_release(JnBlockFactor* f);

#endif
