// HO figure 5: a jello on a nudged plate. Its wobble at time t is measured by the path of the top relative to the
// plate, along the nudge: highest minus lowest of it within (t - 1 s, t].
#include "reproduce/jello.h"

#include <math.h>
#include <stdio.h>

#include "reproduce/measure.h"
#include "reproduce/picture.h"
#include "reproduce/series.h"

const JelloCase jello_cases[JELLO_CASES] = {
	{"jello_backward_euler_dt=5ms", "BE 5 ms", "backward_euler", 5e-3},
	{"jello_backward_euler_dt=0.5ms", "BE 0.5 ms", "backward_euler", 5e-4},
	{"jello_backward_euler_dt=0.05ms", "BE 0.05 ms", "backward_euler", 5e-5},
	{"jello_sdirk2_dt=5ms", "SDIRK2 5 ms", "sdirk2", 5e-3},
	{"jello_tr_bdf2_b_dt=5ms", "TR-BDF2(B) 5 ms", "tr_bdf2_b", 5e-3},
};

static const double nudge_end = 0.2; // [s], in the scene

void jello_add(StudyRun* run, int index, double duration) {
	const JelloCase* jello = &jello_cases[index];
	study_add(run, "jello.yaml", jello->name, jello->title, duration / jello->dt);
	study_set(run, "integrator.method=%s", jello->method);
	study_set(run, "step.dt=%.17g s", jello->dt);
	study_set(run, "duration=%g s", duration);
	study_set(run, "newton.tolerance=1e-6");
	if (!run->options->is_quick) return;
	study_set(run, "bodies[0].shape.flutes=%d", run->study->is_timed ? 4 : 6);
	study_set(run, "bodies[0].shape.cells=%s", run->study->is_timed ? "[16,1,4]" : "[24,1,4]");
}

static double duration_of(const StudyRun* run) {
	return run->options->is_quick ? 3 : 10;
}

static JnStatus plan(StudyRun* run) {
	for (int i = 0; i < JELLO_CASES; ++i) jello_add(run, i, duration_of(run));
	return run->status;
}

// The columns of the two probes along x, and time.
static JnStatus read_wobble(const Series* series, JnArena* arena, double** times, double** wobble) {
	int t = 0, top = 0, plate = 0;
	JN_TRY(series_column(series, "t", &t));
	JN_TRY(series_column(series, "probe.top.x", &top));
	JN_TRY(series_column(series, "probe.plate.x", &plate));
	JN_NEW(arena, *times, series->rows);
	JN_NEW(arena, *wobble, series->rows);
	for (int i = 0; i < series->rows; ++i) {
		const double* row = series->values + (size_t)i * (size_t)series->columns;
		(*times)[i] = row[t];
		(*wobble)[i] = row[top] - row[plate];
	}
	return JN_OK;
}

static JnStatus measure(StudyRun* run, int index, const Plot* plot, const Curve* curve) {
	Series series;
	double *times = NULL, *wobble = NULL;
	JnStatus status = series_read(study_folder(run, index), "series.csv", &series);
	if (status == JN_OK) status = read_wobble(&series, &series.arena, &times, &wobble);
	for (int i = 0; status == JN_OK && i < plot->rows; ++i)
		curve->values[i] = measure_span(series.rows, times, wobble, plot->times[i] - 1, plot->times[i]);
	series_free(&series);
	return status;
}

// The nudge itself is no wobble: the first window begins with its end.
JnStatus jello_amplitudes(StudyRun* run, double duration, Plot* plot) {
	const double first = 1 + nudge_end;
	*plot = (Plot){.name = "wobble_amplitude",
				   .title = "Jello: amplitude of the wobble, peak to peak within the last second",
				   .label = "amplitude [m]"};
	JN_TRY(plot_begin(plot, &run->plan.arena, (int)round((duration - first) / 0.05) + 1, first, duration));
	for (int i = 0; i < JELLO_CASES; ++i) {
		const int index = study_find(run, jello_cases[i].name);
		const Curve* curve = plot_add(plot, &run->plan.arena, jello_cases[i].name, jello_cases[i].title);
		if (curve == NULL) return JN_OUT_OF_MEMORY;
		if (study_is_done(run, index)) JN_TRY(measure(run, index, plot, curve));
	}
	return JN_OK;
}

static JnStatus draw_pictures(StudyRun* run) {
	static const int shown[] = {0, JELLO_SDIRK2};
	Picture picture = {.name = "jello", .camera = {18, 14}, .columns = 4, .width = 340, .height = 250};
	JnStatus status = JN_OK;
	for (int i = 0; i < 8 && status == JN_OK; ++i) {
		const JelloCase* jello = &jello_cases[shown[i / 4]];
		const double end = duration_of(run), times[] = {0.3, end / 4, end / 2, end}, t = times[i % 4];
		const int index = study_find(run, jello->name);
		char title[96];
		snprintf(title, sizeof title, "%s, t = %.3g s", jello->title, t);
		if (study_is_done(run, index)) status = picture_add(&picture, study_folder(run, index), t, title);
	}
	if (status == JN_OK) status = picture_draw(&picture, run->plan.directory);
	picture_free(&picture);
	return status;
}

static Table tabulate(StudyRun* run, const Plot* plot) {
	Table table =
		table_begin(&run->plan.arena, "case|amplitude at the start [m]|at the end [m]|kept|end, over SDIRK2's");
	const double end = duration_of(run), sdirk2 = plot_mean(plot, &plot->curves[JELLO_SDIRK2], end - 0.01, end);
	for (int i = 0; i < JELLO_CASES; ++i) {
		const double first = plot->curves[i].values[0], last = plot_mean(plot, &plot->curves[i], end - 0.01, end);
		table_row(&table, "%s|%.4f|%.4f|%.1f %%|%.3f", jello_cases[i].title, first, last, 100 * last / first,
				  last / sdirk2);
	}
	return table;
}

static JnStatus report(StudyRun* run, Page* page) {
	Plot plot;
	JN_TRY(jello_amplitudes(run, duration_of(run), &plot));
	JN_TRY(plot_draw(&plot, run->plan.directory));
	JN_TRY(draw_pictures(run));
	const Table table = tabulate(run, &plot);
	JN_TRY(table_write(&table, run->plan.directory, "table.csv"));
	page_picture(page, "jello.png", "Backward Euler above, SDIRK2 below, both at 5 ms and at the same times.");
	page_picture(
		page, "wobble_amplitude.png",
		"Path of the jello's top relative to the plate, along the nudge: highest minus lowest within a second.");
	page_table(page, &table);
	page_text(page, "'At the start' is the second after the nudge, 'at the end' the last second of the run.");
	page_link(page, "wobble_amplitude.csv", "the curves");
	return JN_OK;
}

const Study study_ho_fig5 = {
	.name = "ho-fig5",
	.doc = "jello on a nudged plate: pictures, and how long it wobbles",
	.shown =
		"Löschner, Longva, Jeske, Kugelstadt, Bender: Higher-Order Time Integration for Deformable Solids (2020), "
		"figure 5. With backward Euler at 5 ms the jello moves very slowly after 5 s and is at rest to the eye after "
		"10 s; at 0.5 ms it is still damped strongly; only 0.05 ms looks like SDIRK2 at 5 ms, which wobbles vividly "
		"after 10 s with hardly any loss of energy.",
	.plan = plan,
	.report = report,
};
