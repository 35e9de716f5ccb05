// AD figure 1: a mass on a nonlinear spring, stepped in as many steps by each way to choose them.
#include <math.h>
#include <stdio.h>

#include "base/folder.h"
#include "reproduce/plot.h"
#include "reproduce/series.h"
#include "reproduce/spring_tune.h"
#include "reproduce/study.h"

static const SpringWay ways[] = {
	{"fixed", "fixed", "{dt: %.17g s}", false},
	{"speed_limit", "speed limit", "{controller: speed_limit, dt: 1 ms, distance: %.17g m}", false},
	{"stretch_limit", "stretch limit", "{controller: stretch_limit, dt: 1 ms, stretch: %.17g}", false},
	{"step_doubling", "adaptive quadrature", "{controller: step_doubling, dt: 0.1 s, tolerance: %.17g m}", false},
	{"step_doubling_halves", "adaptive quadrature, halves kept",
	 "{controller: step_doubling, keep: halves, dt: 0.1 s, tolerance: %.17g m}", false},
	{"force_error_q=3", "force error, q = 3", "{controller: force_error, dt: 1 ms, exponent: 3, tolerance: %.17g m}",
	 false},
	{"force_error_q=4", "force error, q = 4", "{controller: force_error, dt: 1 ms, tolerance: %.17g m}", false},
	{"force_error_zienkiewicz_xie", "force error and Zienkiewicz, Xie",
	 "{controller: combined, rules: [{controller: force_error, dt: 1 ms, tolerance: %1$.17g m}, "
	 "{controller: zienkiewicz_xie, dt: 1 ms, tolerance: %1$.17g m}]}",
	 true},
	{"zienkiewicz_xie", "Zienkiewicz, Xie", "{controller: zienkiewicz_xie, dt: 1 ms, tolerance: %.17g m}", true},
};
static const struct {
	const char *name, *title;
} methods[] = {{"linearized_euler", "backward Euler"}, {"linearized_newmark", "Newmark"}};
static const struct {
	const char* name;
	SpringGoal goal;
	int target;
	const char* title;
} goals[] = {
	{"30_steps", SPRING_STEPS, 30, "30 steps"},
	{"100_steps", SPRING_STEPS, 100, "100 steps"},
	{"work", SPRING_WORK, 120, "120 factorisations"},
};

enum { WAYS = sizeof ways / sizeof *ways, METHODS_HERE = 2, GOALS = 3, SAMPLES = 2001, FINE = 64 };

static void name_case(int goal, int method, int way, char name[96]) {
	snprintf(name, 96, "%s_%s_%s", methods[method].name, ways[way].name, goals[goal].name);
}

static bool is_served(int method, int way) {
	return !ways[way].is_newmark_only || method == 1;
}

static JnStatus scene_path(const StudyRun* run, char path[JN_PATH_SIZE]) {
	return jn_path_join(run->options->scenes, "spring.yaml", path);
}

static JnStatus add_case(StudyRun* run, int goal, int method, int way) {
	char path[JN_PATH_SIZE], name[96], label[128], step[256];
	SpringTuned tuned;
	JN_TRY(scene_path(run, path));
	JN_TRY(spring_tune(path, methods[method].name, &ways[way], goals[goal].goal, goals[goal].target, &tuned));
	name_case(goal, method, way, name);
	snprintf(label, sizeof label, "%s, %s, %s", methods[method].title, ways[way].title, goals[goal].title);
	spring_step_text(&ways[way], tuned.value, sizeof step, step);
	study_add(run, "spring.yaml", name, label, goals[goal].target);
	study_set(run, "integrator={method: %s}", methods[method].name);
	study_set(run, "%s", step);
	return run->status;
}

static JnStatus plan(StudyRun* run) {
	for (int goal = 0; goal < GOALS; ++goal)
		for (int m = 0; m < METHODS_HERE; ++m)
			for (int w = 0; w < WAYS; ++w)
				if (is_served(m, w)) JN_TRY(add_case(run, goal, m, w));
	return run->status;
}

// ---- what a case came to ----

typedef struct Columns {
	int t, dt, x, v;
} Columns;

static JnStatus find_columns(const Series* series, Columns* at) {
	JN_TRY(series_column(series, "t", &at->t));
	JN_TRY(series_column(series, "dt", &at->dt));
	JN_TRY(series_column(series, "x", &at->x));
	return series_column(series, "v", &at->v);
}

static const double* row_of(const Series* series, int row) {
	return series->values + (size_t)row * (size_t)series->columns;
}

// The cubic between two steps that has their positions and velocities.
static double position_at(const double* before, const double* after, const Columns* at, double t) {
	const double dt = after[at->t] - before[at->t], s = (t - before[at->t]) / dt, r = 1 - s;
	return r * r * (1 + 2 * s) * before[at->x] + s * s * (3 - 2 * s) * after[at->x] +
		   dt * s * r * (r * before[at->v] - s * after[at->v]);
}

static void sample(const Series* series, const Columns* at, const Plot* plot, double* x, double* dt) {
	int row = 1;
	for (int i = 0; i < plot->rows; ++i) {
		while (row + 1 < series->rows && row_of(series, row)[at->t] < plot->times[i]) ++row;
		x[i] = position_at(row_of(series, row - 1), row_of(series, row), at, plot->times[i]);
		dt[i] = row_of(series, row)[at->dt];
	}
}

static JnStatus read_case(StudyRun* run, int index, const Plot* positions, Curve* x, Curve* dt) {
	Series series;
	Columns at = {0};
	JnStatus status = series_read(study_folder(run, index), "series.csv", &series);
	if (status == JN_OK) status = find_columns(&series, &at);
	if (status == JN_OK) sample(&series, &at, positions, x->values, dt->values);
	series_free(&series);
	return status;
}

static double rms(const double* a, const double* b, int count) {
	double sum = 0;
	for (int i = 0; i < count; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
	return sqrt(sum / count);
}

// ---- the page ----

/// The motion by tiny steps of the method, and the true one.
typedef struct References {
	double *fine, *exact;
} References;

static JnStatus find_references(StudyRun* run, int method, References* out) {
	char path[JN_PATH_SIZE];
	JN_NEW(&run->plan.arena, out->fine, SAMPLES);
	JN_NEW(&run->plan.arena, out->exact, SAMPLES);
	JN_TRY(scene_path(run, path));
	JN_TRY(spring_sample(path, methods[method].name, FINE, SAMPLES, out->fine));
	return spring_sample(path, "rk4", FINE, SAMPLES, out->exact);
}

static void add_row(StudyRun* run, Table* table, int index, int way, const References* reference, const double* x) {
	table_row(table, "%s|%.0f|%.0f|%.0f|%.0f|%.2e|%.2e", ways[way].title, study_number(run, index, "steps"),
			  study_number(run, index, "rejected"), study_number(run, index, "factorizations"),
			  study_number(run, index, "forces"), rms(x, reference->fine, SAMPLES), rms(x, reference->exact, SAMPLES));
}

static JnStatus begin_plots(StudyRun* run, int goal, int method, double duration, Plot plots[2], char texts[4][96]) {
	snprintf(texts[0], 96, "x_%s_%s", methods[method].name, goals[goal].name);
	snprintf(texts[1], 96, "dt_%s_%s", methods[method].name, goals[goal].name);
	snprintf(texts[2], 96, "Spring, linearised %s, %s", methods[method].title, goals[goal].title);
	plots[0] = (Plot){.name = texts[0], .title = texts[2], .label = "x [m]"};
	plots[1] = (Plot){.name = texts[1], .title = texts[2], .label = "step [s]", .is_logarithmic = true};
	JN_TRY(plot_begin(&plots[0], &run->plan.arena, SAMPLES, 0, duration));
	return plot_begin(&plots[1], &run->plan.arena, SAMPLES, 0, duration);
}

static JnStatus report_cases(StudyRun* run, Page* page, int goal, int method, const References* reference) {
	char texts[4][96], picture[128];
	Plot plots[2];
	const double duration = 2;
	Table table = table_begin(
		&run->plan.arena, "way|steps|rejected|factorisations|forces|rms error, fine steps [m]|rms error, truth [m]");
	JN_TRY(begin_plots(run, goal, method, duration, plots, texts));
	for (int w = 0; w < WAYS; ++w) {
		char name[96];
		name_case(goal, method, w, name);
		const int index = study_find(run, name);
		if (!study_is_done(run, index)) continue;
		Curve* x = plot_add(&plots[0], &run->plan.arena, ways[w].name, ways[w].title);
		Curve* dt = plot_add(&plots[1], &run->plan.arena, ways[w].name, ways[w].title);
		if (x == NULL || dt == NULL) return JN_OUT_OF_MEMORY;
		JN_TRY(read_case(run, index, &plots[0], x, dt));
		add_row(run, &table, index, w, reference, x->values);
	}
	Curve* truth = plot_add(&plots[0], &run->plan.arena, "reference", "fine steps");
	if (truth == NULL) return JN_OUT_OF_MEMORY;
	truth->values = reference->fine;
	snprintf(texts[3], 96, "table_%s_%s.csv", methods[method].name, goals[goal].name);
	JN_TRY(table_write(&table, run->plan.directory, texts[3]));
	for (int i = 0; i < 2; ++i) {
		JN_TRY(plot_draw(&plots[i], run->plan.directory));
		snprintf(picture, sizeof picture, "%s.png", plots[i].name);
		page_picture(page, picture, plots[i].label);
	}
	page_table(page, &table);
	return JN_OK;
}

static JnStatus report(StudyRun* run, Page* page) {
	References references[METHODS_HERE];
	for (int m = 0; m < METHODS_HERE; ++m) {
		JN_TRY(find_references(run, m, &references[m]));
		page_text(page, "Linearised %s: steps of 1/%d ms differ from the truth by %.1e m (rms over 2 s).",
				  methods[m].title, FINE, rms(references[m].fine, references[m].exact, SAMPLES));
	}
	for (int goal = 0; goal < GOALS; ++goal)
		for (int m = 0; m < METHODS_HERE; ++m) {
			char heading[128];
			snprintf(heading, sizeof heading, "Linearised %s, %s", methods[m].title, goals[goal].title);
			page_heading(page, heading);
			JN_TRY(report_cases(run, page, goal, m, &references[m]));
		}
	page_text(
		page,
		"Errors are root mean squares over 2001 times, with a cubic between steps. The tuned number of each way is in "
		"the command of its run. Neither method has an embedded estimate, so that the controller 'embedded' cannot "
		"serve them; the estimate of Zienkiewicz and Xie serves Newmark's.");
	return JN_OK;
}

const Study study_ad_fig1 = {
	.name = "ad-fig1",
	.doc = "a mass on a nonlinear spring, by each way to choose steps",
	.shown = "Adaptive Time-Stepping with Linearized Force Error Estimation, figure 1: position of the mass and step "
			 "sizes over "
			 "time, for linearised backward Euler and Newmark, with the parameters of all ways adjusted to about the "
			 "same number "
			 "of steps. The paper finds its own way, the error of linearised forces, clearly closest to a reference of "
			 "small "
			 "steps; speed limiting furthest from it.",
	.plan = plan,
	.report = report,
};
