// The scoreboard of EX (table "benchmark"): largest stable step over the time of a step, on the paper's thread, as it is and
// with its axis relaxed; and the paper's conclusions beside the numbers.
#include <math.h>
#include <stdio.h>

#include "base/folder.h"
#include "interrupt.h"
#include "reproduce/ex_claims.h"
#include "reproduce/series.h"
#include "reproduce/study.h"

enum { BOARDS = 3, PLAIN = 0, RELAXED, UNDAMPED, MOST_METHODS = 64 };

static const char scene[] = "thread_paper.yaml";
static const double accuracy_share = 0.25;

/// A scoreboard: the scene with an override, or as it is.
typedef struct Board {
	const char *name, *title, *set;
	double share; // of the time
} Board;

static const Board boards[BOARDS] = {
	{"plain", "The thread as it is", NULL, 1},
	{"relaxed", "With its axis relaxed after every step", "relax={}", 1},
	{"undamped", "Without damping", "bodies[0].material.damping=0", 0.5}, // explicit Euler would take minutes
};

/// What the study finds out: scores of every board, and accuracies without damping.
typedef struct Findings {
	char path[JN_PATH_SIZE];
	const char* sets[BOARDS][2];
	char directories[BOARDS][JN_PATH_SIZE];
	ScoreOptions options[BOARDS];
	Score scores[BOARDS];
	ExAccuracy accuracy[MOST_METHODS];
} Findings;

static double time_of(const StudyRun* run) {
	return run->options->is_quick ? 0.1 : 1;
}

// Two runs that show what relaxation does to the length of the thread; compliance without bounds moves nothing.
static JnStatus plan(StudyRun* run) {
	static const char* const relax[2] = {"relax={sweeps: 1, compliance: 1e15}", "relax={}"};
	for (int i = 0; i < 2; ++i) {
		study_add(run, scene, boards[i].name, boards[i].title, 1);
		study_set(run, "%s", relax[i]);
		study_set(run, "duration=%g s", time_of(run));
	}
	return run->status;
}

// ---- measuring ----

static int measure_board(StudyRun* run, Findings* found, int index) {
	Score* score = &found->scores[index];
	ScoreOptions* options = &found->options[index];
	found->sets[index][0] = run->options->is_quick ? "bodies[0].shape.links=6" : "bodies[0].shape.links=40";
	found->sets[index][1] = boards[index].set;
	*options = (ScoreOptions){.scene = found->path,
							  .directory = found->directories[index],
							  .sets = {boards[index].set != NULL ? 2 : 1, found->sets[index]},
							  .time = boards[index].share * time_of(run),
							  .factor = 100,
							  .threads = run->options->threads,
							  .is_quiet = run->options->is_quiet};
	JN_TRY(jn_path_join(run->plan.directory, boards[index].name, found->directories[index]));
	JN_TRY(jn_folder_make(found->directories[index]));
	const int planned = score_plan(options, score);
	if (planned != 0) return JN_BAD_INPUT;
	score->stop = &app_interrupted;
	score_tell(score, "%s:", boards[index].title);
	JN_TRY(score_measure(score));
	return score->scale > 0 ? score_tables_write(score) : JN_OK;
}

static JnStatus measure(StudyRun* run, Findings* found) {
	JN_TRY(jn_path_join(run->options->scenes, scene, found->path));
	app_catch_interrupts(SA_RESTART);
	for (int i = 0; i < BOARDS && !app_interrupted; ++i) JN_TRY(measure_board(run, found, i));
	if (app_interrupted) run->jobs.was_stopped = true;
	return app_interrupted
			   ? JN_OK
			   : ex_accuracy_find(&found->scores[UNDAMPED], accuracy_share, time_of(run) / 4, found->accuracy);
}

// ---- the page ----

static Table board_table(StudyRun* run, const Score* score) {
	Table table =
		table_begin(&run->plan.arena, "method|order|largest stable step [ms]|time of a step [us]|forces a step|score|"
									  "score by forces|energy error at half that step");
	for (int i = 0; i < score->count; ++i) {
		const ScoreMethod* m = &score->list[i];
		table_row(&table, "%s|%d|%s%.4g|%.3g|%.3g|%.3g|%.3g|%.1e", m->type->row.name, m->type->order,
				  m->is_capped ? ">= " : "", 1e3 * m->limit, 1e6 * m->seconds, m->forces, score_value(score, m),
				  score_by_forces(score, m), m->error_half);
	}
	return table;
}

static JnStatus add_board(StudyRun* run, Page* page, const Findings* found, int index) {
	const Score* score = &found->scores[index];
	char file[64];
	page_heading(page, boards[index].title);
	if (!(score->scale > 0)) {
		page_text(page, "Not measured: stopped before.");
		return JN_OK;
	}
	Table table = board_table(run, score);
	page_table(page, &table);
	snprintf(file, sizeof file, "%s.csv", boards[index].name);
	JN_TRY(table_write(&table, run->plan.directory, file));
	const char* set = boards[index].set;
	page_text(page, "jounce score %s --time %gs --set '%s'%s%s%s", found->path, score->time, found->sets[index][0],
			  set != NULL ? " --set '" : "", set != NULL ? set : "", set != NULL ? "'" : "");
	if (index == UNDAMPED) return JN_OK;
	Table claims = claims_begin(&run->plan.arena);
	ex_claims_add(score, &claims);
	if (index == PLAIN) ex_claims_add_accuracy(&found->scores[UNDAMPED], found->accuracy, &claims);
	page_table(page, &claims);
	snprintf(file, sizeof file, "claims_%s.csv", boards[index].name);
	return table_write(&claims, run->plan.directory, file);
}

static JnStatus add_accuracy(StudyRun* run, Page* page, const Findings* found) {
	const Score* score = &found->scores[UNDAMPED];
	Table table = table_begin(&run->plan.arena, "method|step [ms]|error, rms [m]|measured order");
	page_heading(page, "Accuracy at equal cost, without damping");
	for (int i = 0; i < score->count; ++i)
		table_row(&table, "%s|%.3g|%.2e|%.2f", score->list[i].type->row.name, 1e3 * found->accuracy[i].dt,
				  found->accuracy[i].error, found->accuracy[i].order);
	page_table(page, &table);
	page_text(
		page,
		"Steps with which a simulated second takes as long as with symplectic Euler at %g of its largest stable step; "
		"errors of all positions after %g s against RK4 with far smaller steps, empty where that step is not stable; "
		"orders from steps of a quarter and an eighth of a method's own largest.",
		accuracy_share, time_of(run) / 4);
	return table_write(&table, run->plan.directory, "accuracy.csv");
}

static double largest(const StudyRun* run, int index, const char* column) {
	Series series;
	int at = 0;
	double most = NAN;
	if (!study_is_done(run, index)) return NAN;
	if (series_read(study_folder(run, index), "series.csv", &series) == JN_OK &&
		series_column(&series, column, &at) == JN_OK)
		for (int row = 0; row < series.rows; ++row) most = fmax(most, series.values[row * series.columns + at]);
	series_free(&series);
	return most;
}

static void add_stretch(StudyRun* run, Page* page, const Findings* found) {
	const double plain = ex_method(&found->scores[PLAIN], "symplectic_euler")->limit,
				 relaxed = ex_method(&found->scores[RELAXED], "symplectic_euler")->limit;
	page_heading(page, "What relaxation does");
	page_text(
		page,
		"Largest stretch of the axis while the thread swings for %g s with steps of the scene: %.2g %% with springs "
		"alone, %.2g %% relaxed. Largest stable step of symplectic Euler: %.3g ms and %.3g ms.",
		time_of(run), 100 * largest(run, PLAIN, "relax.stretch_after"),
		100 * largest(run, RELAXED, "relax.stretch_after"), 1e3 * plain, 1e3 * relaxed);
}

static JnStatus report(StudyRun* run, Page* page) {
	Findings found = {0};
	JnStatus status = run->jobs.was_stopped ? JN_OK : measure(run, &found);
	for (int i = 0; i < BOARDS && status == JN_OK; ++i) status = add_board(run, page, &found, i);
	if (status == JN_OK && found.scores[UNDAMPED].scale > 0) status = add_accuracy(run, page, &found);
	if (status == JN_OK) add_stretch(run, page, &found);
	if (status == JN_OK)
		page_text(
			page,
			"Stable, score and errors are those of `jounce score`, told in docs/score.md. Scores within %g %% of each "
			"other count as the same: times of a step repeat no better.",
			100 * EX_TIE);
	for (int i = 0; i < BOARDS; ++i) score_free(&found.scores[i]);
	return status;
}

const Study study_ex_table = {
	.name = "ex-table",
	.doc = "largest stable step over the time of a step, on the thread of the paper",
	.shown =
		"On the impact of explicit or semi-implicit integration methods over the stability of real-time numerical "
		"simulations: a score sheet of nine methods on a thread, the ratio between the largest step and the time that "
		"a "
		"step needs, relative to explicit Euler. Its numbers are lost. The text says: symplectic Euler has the highest "
		"score and modified midpoint the second highest; Verlet benefits from its relatively high stability; "
		"Forest-Ruth is "
		"the best alternative where accuracy counts; RK4 supports high steps but is the most time consuming; the "
		"modification significantly increases the stability of the half step.",
	.is_timed = true,
	.plan = plan,
	.report = report,
};
