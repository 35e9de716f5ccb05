// HO table 1: time per simulated second and Newton iterations, with the ratio that is the paper's headline.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "reproduce/cloth.h"
#include "reproduce/jello.h"

/// A row of the paper, on an Intel i9-9900K.
typedef struct PaperRow {
	const char* name; ///< of our case
	double seconds;   ///< per simulated second
	double newton;    ///< iterations a step
} PaperRow;

static const PaperRow paper[] = {
	{"jello_backward_euler_dt=5ms", 21.3, 1.00},
	{"jello_backward_euler_dt=0.5ms", 191.4, 1.00},
	{"jello_backward_euler_dt=0.05ms", 1907.3, 1.00},
	{"jello_sdirk2_dt=5ms", 34.42, 2.00},
	{"jello_tr_bdf2_b_dt=5ms", 40.8, 2.00},
	{"cloth_backward_euler_dt=5ms", 37.92, 2.51},
	{"cloth_backward_euler_dt=0.05ms", 1530.42, 1.01},
	{"cloth_sdirk2_dt=5ms", 100.32, 6.90},
	{"cloth_tr_bdf2_b_dt=5ms", 102.46, 6.59},
	{"cloth_sdirk_4347_dt=5ms", 533.58, 20.78},
};
enum { ROWS = sizeof paper / sizeof *paper };

static const double jello_duration = 1.25; // [s]: the first window of the amplitude ends at 1.2 s

static double cloth_duration(const StudyRun* run) {
	return run->options->is_quick ? 0.2 : 0.5;
}

enum { MOST_PLAIN_STEPS = 50 };

// The same steps as in the paper: plain Newton, a new matrix and factor for each iteration. Few steps tell its pace.
static void add_plain(StudyRun* run, double dt) {
	study_extend(run, "plain", "plain Newton");
	study_set(run, "newton.reuse=never");
	study_set(run, "duration=%.17g s", MOST_PLAIN_STEPS * dt);
}

static JnStatus plan(StudyRun* run) {
	for (int i = 0; i < JELLO_CASES; ++i) {
		jello_add(run, i, jello_duration);
		jello_add(run, i, jello_duration);
		add_plain(run, jello_cases[i].dt);
	}
	for (int i = 0; i < CLOTH_UNDAMPED; ++i) {
		cloth_add(run, i, cloth_duration(run));
		cloth_add(run, i, cloth_duration(run));
		add_plain(run, cloth_cases[i].dt);
	}
	return run->status;
}

static double pace(const StudyRun* run, const char* name) {
	return study_number(run, study_find(run, name), "wall_seconds_per_simulated_second");
}

static double plain_pace(const StudyRun* run, const char* name) {
	char plain[96];
	snprintf(plain, sizeof plain, "%s_plain", name);
	return pace(run, plain);
}

static double newton_a_step(const StudyRun* run, const char* name) {
	const int index = study_find(run, name);
	return study_number(run, index, "newton") / study_number(run, index, "steps");
}

static Table tabulate(StudyRun* run) {
	Table table =
		table_begin(&run->plan.arena, "scene|method|s per simulated s|Newton a step|plain Newton: s per "
									  "simulated s|Newton a step|in the paper: s per simulated s|Newton a step");
	for (int i = 0; i < ROWS; ++i) {
		const char* name = paper[i].name;
		char plain[96];
		snprintf(plain, sizeof plain, "%s_plain", name);
		table_row(&table, "%.5s|%s|%.4g|%.2f|%.4g|%.2f|%.4g|%.2f", name, run->plan.runs[study_find(run, name)].label,
				  pace(run, name), newton_a_step(run, name), plain_pace(run, name), newton_a_step(run, plain),
				  paper[i].seconds, paper[i].newton);
	}
	return table;
}

static double paper_pace(const char* name) {
	for (int i = 0; i < ROWS; ++i)
		if (strcmp(paper[i].name, name) == 0) return paper[i].seconds;
	return NAN;
}

// How the fine backward Euler and SDIRK2 look alike: the amplitude of the jello, the wrinkles of the cloth.
static JnStatus compare_looks(StudyRun* run, double likeness[2]) {
	Plot jello, cloth;
	const double end = jello_duration, cloth_end = cloth_duration(run);
	JN_TRY(jello_amplitudes(run, end, &jello));
	JN_TRY(cloth_wrinkles(run, CLOTH_UNDAMPED, cloth_end, &cloth));
	likeness[0] = plot_mean(&jello, &jello.curves[JELLO_SDIRK2], end - 0.01, end) /
				  plot_mean(&jello, &jello.curves[JELLO_FINE], end - 0.01, end);
	likeness[1] = plot_mean(&cloth, &cloth.curves[CLOTH_SDIRK2], cloth_end / 2, cloth_end) /
				  plot_mean(&cloth, &cloth.curves[CLOTH_FINE], cloth_end / 2, cloth_end);
	JN_TRY(plot_draw(&jello, run->plan.directory));
	return plot_draw(&cloth, run->plan.directory);
}

static JnStatus report(StudyRun* run, Page* page) {
	static const char* const names[2][3] = {
		{"jello, amplitude of the wobble", "jello_backward_euler_dt=0.05ms", "jello_sdirk2_dt=5ms"},
		{"cloth, height of the wrinkles", "cloth_backward_euler_dt=0.05ms", "cloth_sdirk2_dt=5ms"}};
	double likeness[2] = {NAN, NAN};
	const Table table = tabulate(run);
	JN_TRY(compare_looks(run, likeness));
	Table ratios = table_begin(
		&run->plan.arena,
		"scene and measure|SDIRK2 5 ms over BE 0.05 ms, measure|BE 0.05 ms over SDIRK2 5 ms, time|with plain Newton|in "
		"the paper");
	for (int i = 0; i < 2; ++i)
		table_row(&ratios, "%s|%.3f|%.1f|%.1f|%.1f", names[i][0], likeness[i],
				  pace(run, names[i][1]) / pace(run, names[i][2]),
				  plain_pace(run, names[i][1]) / plain_pace(run, names[i][2]),
				  paper_pace(names[i][1]) / paper_pace(names[i][2]));
	JN_TRY(table_write(&table, run->plan.directory, "table.csv"));
	JN_TRY(table_write(&ratios, run->plan.directory, "ratios.csv"));
	page_table(page, &table);
	page_text(page,
			  "Paces are means over %g s (jello) and %g s (cloth) from the start, stages being solved to a relative "
			  "residual of "
			  "1e-6 (jello) and 1e-5 (cloth); the paper does not say where it stops, nor how large its jello and its "
			  "mesh are. "
			  "By default a tangent and its factor are kept over many iterations and steps, so that there are more "
			  "iterations "
			  "and each is cheaper; 'plain Newton' is newton.reuse=never over the first %d steps, with a new matrix "
			  "and factor "
			  "for each iteration, as in the paper.",
			  jello_duration, cloth_duration(run), MOST_PLAIN_STEPS);
	page_heading(page, "The same look at a lower price");
	page_table(page, &ratios);
	page_text(page, "A measure of 1 means that SDIRK2 at 5 ms moves as much as backward Euler at 0.05 ms.");
	page_picture(page, "wobble_amplitude.png", "Jello: amplitude over time.");
	page_picture(page, "wrinkles.png", "Cloth: height of the wrinkles over time.");
	return JN_OK;
}

const Study study_ho_table1 = {
	.name = "ho-table1",
	.doc = "time per simulated second and Newton iterations, jello and cloth",
	.shown = "Löschner, Longva, Jeske, Kugelstadt, Bender: Higher-Order Time Integration for Deformable Solids (2020), "
			 "table "
			 "1, measured on an Intel i9-9900K with Intel MKL. SDIRK2 at 5 ms looks like backward Euler at 0.05 ms and "
			 "is more "
			 "than 55 times (jello) and almost 17 times (cloth) faster.",
	.is_timed = true,
	.plan = plan,
	.report = report,
};
