/// @file multigrid.h
/// The levels of a multigrid of smoothed aggregates (Vanek, Mandel, Brezina 1996: Algebraic multigrid by smoothed aggregation
/// for second and fourth order elliptic problems). The finest level are the nodes of a pattern with 3 unknowns each; nodes of
/// a coarser level are aggregates of those of the finer one, with 6 unknowns: how much of each rigid motion an aggregate makes.
///
///   P0   rigid motions of each aggregate, made orthonormal (modes: what they are in terms of translations and rotations)
///   P    (I - omega D^-1 A) P0, D the diagonal blocks of A
///   Ac   P' A P
///
/// What depends on the graph alone (aggregates, patterns of P and Ac) is made once; numbers are renewed. Single precision.
#ifndef JN_SOLVE_MULTIGRID_H
#define JN_SOLVE_MULTIGRID_H

#include "solve/precondition.h"

enum {
	JN_GRID_MODES = 6,     ///< rigid motions
	JN_GRID_LANES = 8,     ///< numbers in which they are kept, the last two of them 0
	JN_GRID_BLOCK = 6 * 8, ///< numbers of a block of a coarser level: its columns, padded
	JN_GRID_COARSEST = 80, ///< nodes of a level that is solved directly
	JN_GRID_MOST_LEVELS = 12
};

typedef struct JnGridLevel {
	int nodes;
	int size;   ///< unknowns a node: 3 or 6
	int stride; ///< numbers a node in vectors: 4 or 8; the others are 0

	const int *start, *column; ///< full rows of A; the columns of a row ascend
	const int* full_block;     ///< the pattern's, on the finest level; NULL on others
	const double* source;      ///< blocks of A on the finest level, while numbers are renewed
	float* blocks;             ///< of coarser levels: JN_GRID_BLOCK a place of the rows; entry (a, c) at 8 c + a
	const bool* held;          ///< 3 a node on the finest level; NULL on others

	float* inverse;    ///< D^-1: size rows of `stride` a node; rows of held or missing unknowns are 0
	float* vector;     ///< of the largest eigenvalue, as the last estimate left it
	double eigenvalue; ///< of D^-1 A: an upper bound of them, by estimate
	double* center;    ///< 3 a node
	double* modes;     ///< of coarser levels: rigid motions about the node's centre, [6 unknowns][6 motions] a node

	int* aggregate;                  ///< of a node; -1: it has no strong neighbours, smoothing is enough
	int *member_start, *member;      ///< nodes of the aggregates
	int *p_start, *p_column;         ///< rows of P; the columns of a row ascend
	float *tentative, *p;            ///< P0: size rows of 8 a node; P: likewise a place
	int *t_start, *t_node, *t_place; ///< columns of P, as places of its rows
	int most_support, most_row;      ///< largest number of nodes that a column of A P reaches; of blocks of a row of Ac
	double work;                     ///< operations of P' A P

	float *x, *b, *r, *d, *q; ///< vectors of the cycle
} JnGridLevel;

/// Scratch of one thread for the product P' A P.
typedef struct JnGridWork {
	int* slot;    ///< of a node in `support`; -1: not there
	int* support; ///< nodes that a column of A P reaches
	int* where;   ///< of an aggregate in the row of Ac; -1: not there
	float* w;     ///< that column: size rows of 8 a node
	float* sums;  ///< the row of Ac
} JnGridWork;

/// Numbers of one degree of a polynomial smoother.
typedef struct JnGridRelax {
	float keep, c, beta;
} JnGridRelax;

/// Loops that are compiled for each vector width. All are the same, bit for bit, for any number of threads.
typedef struct JnGridKernels {
	/// P = (I - omega D^-1 A) P0.
	void (*smooth)(const JnGridLevel*, float omega, const JnGridWork* work, int threads);
	/// coarse->blocks = P' A P.
	void (*project)(const JnGridLevel*, const JnGridLevel* coarse, const JnGridWork* work, int threads);
	/// y = A x on a coarser level.
	void (*multiply)(const JnGridLevel*, const float* x, float* y, int threads);
	/// y = A x on the finest level with 9 numbers a block of the pattern, and one more number behind them.
	void (*multiply_finest)(const JnPattern*, const float* blocks, const float* x, float* y, int threads);
	/// r = b - q; d = keep d + c D^-1 r; x += beta d. q NULL: x is 0 before; keep 0: d is not read.
	void (*relax)(const JnGridLevel*, JnGridRelax, const float* b, const float* q, float* x, int threads);
	/// coarse = P' (b - q), of `count` aggregates.
	void (*restrict_to)(const JnGridLevel*, const float* b, const float* q, float* coarse, int count, int threads);
	/// x += scale P e.
	void (*prolong)(const JnGridLevel*, const float* e, float scale, float* x, int threads);
} JnGridKernels;

extern const JnGridKernels jn_grid_kernels_2, jn_grid_kernels_4, jn_grid_kernels_8;

/// Join the nodes of a level by strong connections: |A_ij|^2 > strong^2 |A_ii| |A_jj| in Frobenius norms. Fills `aggregate`
/// and the members; the number of aggregates into *count.
JnStatus jn_grid_aggregate(JnGridLevel* level, double strong, JnArena* arena, JnArena* scratch, int* count);

/// From the aggregates: patterns of P and of Ac, and the coarser level with room for its numbers.
JnStatus jn_grid_coarsen(JnGridLevel* level, int count, JnArena* arena, JnArena* scratch, JnGridLevel* coarse);

/// The rigid motions of each aggregate, orthonormal, into `tentative`; centres and modes of the coarser level.
void jn_grid_span(JnGridLevel* level, JnGridLevel* coarse);

/// Invert the diagonal blocks of a coarser level.
void jn_grid_invert(JnGridLevel* level);

/// The place of a node's diagonal block.
static inline size_t jn_grid_diagonal(const JnGridLevel* level, int node) {
	int place = level->start[node];
	while (level->column[place] != node) ++place;
	return (size_t)place;
}

/// What is kept of the matrix of a slot.
typedef struct JnGridSlot {
	float* inverse;    ///< of the diagonal blocks, as on a level; NULL: not yet
	float* blocks;     ///< 9 a block of the pattern, where the operator has no products in single precision
	double eigenvalue; ///< of D^-1 A
	double size;       ///< sum of the diagonal
} JnGridSlot;

typedef struct JnMultigrid {
	JnPrecondition base;
	const JnPattern* pattern;
	const bool* held;
	int threads;
	const JnOperator* matrices;
	const JnGridKernels* kernels;
	JnArena arena;
	int count;        ///< levels; 0: not built yet
	int used;         ///< of them in the cycle: where mass outweighs stiffness, coarser ones have nothing to do
	bool is_direct;   ///< the last level is solved by `inverse`
	double size;      ///< sum of the diagonal of the matrix that the levels were made of
	float* inverse;   ///< of the matrix of the last level, [6 nodes][6 nodes]
	double* dense;    ///< the same, while it is made
	bool is_complete; ///< there is no level to come
	size_t column_room, row_room; ///< of `work`: numbers in w and in sums
	JnGridWork* work;             ///< one a thread
	JnGridLevel levels[JN_GRID_MOST_LEVELS];
	JnGridSlot slots[JN_SOLVER_SLOTS];
} JnMultigrid;

/// Renew all numbers of the levels from the matrix of `slot`, whose diagonal is known; the first time, build the levels.
JnStatus jn_grid_renew(JnMultigrid* grid, int slot);

/// Renew what is kept of the matrix of a slot. JN_INDEFINITE when a diagonal block is not positive definite.
JnStatus jn_grid_renew_slot(JnMultigrid* grid, int slot);

/// Estimate the largest eigenvalue of D^-1 A by the power method, from where the last estimate ended.
void jn_grid_estimate(JnMultigrid* grid, int slot, int level);

/// y = A x on a level.
void jn_grid_multiply(const JnMultigrid* grid, int slot, int level, const float* x, float* y);

/// x = B b on a level and those below.
void jn_grid_cycle(const JnMultigrid* grid, int slot, int level, const float* b, float* x);

#endif
