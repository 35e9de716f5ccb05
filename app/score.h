/// @file score.h
/// Which integrator steps a scene best: the largest stable step over the time of a step (EX, "Results").
///
///   plan       the methods, and whether the scene can be stepped by each            score_plan.c
///   measure    the steps below, in their order                                      score_measure.c
///   reference  what energies do with small steps: the bound of the others           score_limit.c
///   limit      the largest stable step of each method, by bisection                 score_limit.c
///   cost       the time of a step of all methods, by turns; errors of energy        score_cost.c
///   tables     text, CSV, Markdown                                                  score_tables.c
#ifndef JN_APP_SCORE_H
#define JN_APP_SCORE_H

#include <signal.h>
#include <stdio.h>

#include "base/arena.h"
#include "jounce/extend.h"
#include "score_options.h"

/// A method, and what was found about it.
typedef struct ScoreMethod {
	const JnIntegratorType* type;
	double limit;       ///< largest stable step [s]; 0: none was found; NAN: not looked for yet
	bool is_capped;     ///< it is stable with the largest step that was tried
	int runs;           ///< that the search took
	double seconds;     ///< median wall time of a step [s]; NAN: not known
	double forces;      ///< evaluations of f, a step
	double error_half;  ///< of the energy at the end with half the largest stable step, in Score.scale; NAN: not known
	double error_scene; ///< the same with the scene's step; NAN: not known, or not stable
	char failure[256];  ///< what the last run that failed said
} ScoreMethod;

typedef struct Score {
	const ScoreOptions* options;
	const volatile sig_atomic_t* stop; ///< not 0: finish, with what there is; NULL: never
	JnArena arena;                     ///< of the methods and texts
	const char* name;                  ///< of the scene
	const char* directory;
	double time;                       ///< of each run [s]
	double dt, cap;                    ///< the scene's step; the largest that is tried [s]
	const JnIntegratorType* reference; ///< method of the reference run
	double reference_dt;               ///< its step [s]
	double start_energy, end_energy;   ///< total, of the reference [J]
	double scale;                      ///< energy in motion: ranges of kinetic and of potential energy together [J]
	int count, first;                  ///< methods; the one that scores are relative to
	ScoreMethod* list;
	bool is_terminal, was_stopped;
	double told; ///< when a line was last written over [s]
} Score;

/// Read the scene and the names of methods, and build the scene for each. EXIT_DONE, or another status after a message.
int score_plan(const ScoreOptions* options, Score* score);
/// Reference, limits and costs. A negative status after a message; JN_OK also when stopped early.
JnStatus score_measure(Score* score);
void score_free(Score* score);

/// Find the reference; then the limit of one method.
JnStatus score_find_reference(Score* score);
JnStatus score_find_limit(Score* score, ScoreMethod* method);
/// Times of a step of all methods whose limit is known, and errors of energy.
JnStatus score_find_costs(Score* score);

/// Largest stable step over the time of a step, relative to that of the first method; NAN: not known.
double score_value(const Score* score, const ScoreMethod* method);
/// The same with evaluations of forces in place of the time.
double score_by_forces(const Score* score, const ScoreMethod* method);
/// The method of that name, or NULL.
const ScoreMethod* score_find(const Score* score, const char* name);

/// The table for people; score.txt, score.csv and score.md in the directory. JN_IO_FAILED after a message.
void score_table_print(const Score* score, FILE* out);
JnStatus score_tables_write(const Score* score);

/// What is being done, on a terminal written over; and a line for good.
void score_show(Score* score, const char* format, ...) __attribute__((format(printf, 2, 3)));
void score_tell(Score* score, const char* format, ...) __attribute__((format(printf, 2, 3)));
bool score_is_stopped(const Score* score);

#endif
