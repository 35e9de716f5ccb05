/// @file pattern.h
/// Symmetric sparse matrices over the node graph: 3x3 blocks (stiffness, damping) or one number a block (mass).
///
///   lower triangle by columns: column j holds blocks (row >= j), the diagonal first, rows ascending;
///   full rows list the same blocks once more, so that products run row by row, in the same order for any thread count.
#ifndef JN_MATH_PATTERN_H
#define JN_MATH_PATTERN_H

#include "base/arena.h"

typedef struct JnPattern {
	int nodes;
	int blocks;        ///< stored blocks: the lower triangle with the diagonal
	int* column_start; ///< nodes + 1
	int* row;          ///< blocks
	int* full_start;   ///< nodes + 1, into the two arrays below
	int* full_column;  ///< columns of a row, ascending
	int* full_block;   ///< >= 0: block as stored; < 0: ~block, transposed
} JnPattern;

/// Cells whose nodes are all coupled: cells[i * nodes + k] + offset is a node.
typedef struct JnCellList {
	int count, nodes, offset;
	const int* cells;
} JnCellList;

/// The pattern in which all nodes of each cell are neighbours.
JnStatus jn_pattern_create(int nodes, int list_count, const JnCellList lists[], JnArena* arena, JnPattern* pattern);

/// Stored block of (row, column), row >= column; -1 when the nodes are no neighbours.
int jn_pattern_find(const JnPattern* pattern, int row, int column);

/// y += scale * A x with blocks[9 * block] row-major; x and y have 3 * nodes entries and do not overlap.
void jn_blocks_apply(const JnPattern* pattern, const double* blocks, double scale, const double* x, double* y,
					 int threads);

/// y += scale * (A (x) I_3) x with one number a block.
void jn_scalars_apply(const JnPattern* pattern, const double* scalars, double scale, const double* x, double* y,
					  int threads);

#endif
