/// @file choice.h
/// Which way to solve linear systems is cheapest, judged by work that is counted, never by the clock: a run that is
/// repeated makes the same choices, with any number of threads.
#ifndef JN_SOLVE_CHOICE_H
#define JN_SOLVE_CHOICE_H

#include <stdbool.h>

#include "jounce/base.h"

/// What is known of a way. Work is in nanoseconds of one core, by the rates in choice.c.
typedef struct JnWayWork {
	bool is_allowed;
	bool is_known;    ///< what it costs
	double renew;     ///< of a new factor or hierarchy
	double update;    ///< for each new matrix
	double iteration; ///< product, preconditioner and vectors; of a direct solve: the solve
	double digit;     ///< iterations a power of ten of the residual, as observed of late; 0: not yet
} JnWayWork;

typedef struct JnChoice {
	int nodes, blocks;
	bool has_single; ///< products are in single precision
	JnWay way;       ///< the present one
	JnWayWork work[JN_WAY_COUNT];
	double regret[JN_WAY_COUNT]; ///< what each way would have saved since the last change
	double spent;                ///< in all
	double fresh;                ///< iterations a digit just after the last renewal; 0: not yet known
	double excess;               ///< work above that since then
	double best;                 ///< fewest iterations a digit since the last change, or since they doubled
	double refresh;              ///< matrices a direct solve, as observed of late
	int matrices;                ///< since the last solve
	int changes;
} JnChoice;

/// Of a matrix of `nodes` nodes and `blocks` stored blocks; has_single: products are in single precision. allowed[way]; the first
/// way is an incomplete factor where it is allowed: nearly always near the best, and cheap to make.
void jn_choice_begin(JnChoice* choice, int nodes, int blocks, bool has_single, const bool allowed[JN_WAY_COUNT]);

/// What the sparse Cholesky factor costs.
void jn_choice_learn_factor(JnChoice* choice, double flops, double entries);

/// What a preconditioner costs, in products with the matrix.
void jn_choice_learn(JnChoice* choice, JnWay way, double setup_products, double apply_products);

/// Would it be worth an analysis to know what `way` costs?
bool jn_choice_wants_to_know(const JnChoice* choice, JnWay way);

/// The way for the next matrix.
JnWay jn_choice_next(JnChoice* choice);

/// It is time for a new factor or hierarchy.
bool jn_choice_renews(const JnChoice* choice);

/// A matrix has been prepared for the present way.
void jn_choice_count_matrix(JnChoice* choice, bool is_renewed);

/// A solve took so many iterations for so many powers of ten.
void jn_choice_count_solve(JnChoice* choice, int iterations, double digits);

/// The present way has failed, or cannot be had: use others from now on. False: there are none.
bool jn_choice_forbid(JnChoice* choice, JnWay way);

#endif
