// HO figure 4: the energy error of the clamped beam at 10 s over the time step, as energy_over_dt.csv.
#include <math.h>
#include <stdio.h>
#include <unistd.h>

#include "base/log.h"
#include "compare_drawing.h"
#include "reproduce/method.h"
#include "reproduce/study.h"

enum { STEPS = 9, QUICK_STEPS = 6, FITTED = 4 };

static const double steps[STEPS] = {1e-1, 5e-2, 2e-2, 1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 1e-4}; // [s]
static const double rounding = 1e-10; // errors below are no longer those of the method [J/kg]

static int step_count(const StudyRun* run) {
	return run->options->is_quick ? QUICK_STEPS : STEPS;
}

static void name_case(int method, double dt, char name[64]) {
	snprintf(name, 64, "%s_dt=%gms", method_list[method].name, 1e3 * dt);
}

// Errors fall to 1e-12 J/kg, and the tolerance stays below them.
static JnStatus plan(StudyRun* run) {
	for (int s = 0; s < step_count(run); ++s)
		for (int m = 0; m < METHODS; ++m) {
			char name[64], label[64];
			name_case(m, steps[s], name);
			snprintf(label, sizeof label, "%s %g ms", method_list[m].title, 1e3 * steps[s]);
			study_add(run, "beam.yaml", name, label, 10 / steps[s]);
			study_set(run, "integrator.method=%s", method_list[m].name);
			study_set(run, "step.dt=%.17g s", steps[s]);
			study_set(run, "duration=10 s");
			study_set(run, "newton.tolerance=1e-11");
			study_set(run, "record.interval=1e6 s");
			if (run->options->is_quick) study_set(run, "bodies[0].shape.cells=[2,2,16]");
		}
	return run->status;
}

// The summary says all that is asked of a run.
static void drop_series(const CompareJob* job, void* user) {
	static const char* const files[] = {"series.csv", "run.h5", "run.xdmf"};
	(void)user;
	for (int i = 0; i < 3; ++i) {
		char path[JN_PATH_SIZE];
		if (jn_path_join(job->folder, files[i], path) == JN_OK) unlink(path);
	}
}

// Least-squares slope of log error over log dt, over the smallest steps whose error is above rounding.
static double slope(const double errors[], int count) {
	double n = 0, x = 0, y = 0, xx = 0, xy = 0;
	for (int i = count - 1; i >= 0 && n < FITTED; --i) {
		if (!(errors[i] > rounding)) continue;
		const double lx = log(steps[i]), ly = log(errors[i]);
		n += 1;
		x += lx;
		y += ly;
		xx += lx * lx;
		xy += lx * ly;
	}
	return n < 2 ? NAN : (n * xy - x * y) / (n * xx - x * x);
}

typedef struct Errors {
	double of[METHODS][STEPS];
	double slopes[METHODS];
} Errors;

static void read_errors(const StudyRun* run, Errors* errors) {
	for (int m = 0; m < METHODS; ++m) {
		for (int s = 0; s < step_count(run); ++s) {
			char name[64];
			name_case(m, steps[s], name);
			errors->of[m][s] = study_number(run, study_find(run, name), "specific_error");
		}
		errors->slopes[m] = slope(errors->of[m], step_count(run));
	}
}

static void print_number(JnTextFile* file, const char* format, double value) {
	if (isnan(value))
		jn_text_print(file, ",nan");
	else if (format[2] == '6')
		jn_text_print(file, ",%.6e", value);
	else
		jn_text_print(file, ",%.2f", value);
}

static JnStatus write_table(const StudyRun* run, const Errors* errors) {
	JnTextFile file;
	JN_TRY(jn_text_open(&file, run->plan.directory, "energy_over_dt.csv", JN_TEXT_REPLACE));
	jn_text_print(&file, "dt");
	for (int m = 0; m < METHODS; ++m) jn_text_print(&file, ",%s", method_list[m].name);
	for (int s = 0; s < step_count(run); ++s) {
		jn_text_print(&file, "\n%g", steps[s]);
		for (int m = 0; m < METHODS; ++m) print_number(&file, "%.6e", errors->of[m][s]);
	}
	jn_text_print(&file, "\nslope");
	for (int m = 0; m < METHODS; ++m) print_number(&file, "%.2f", errors->slopes[m]);
	jn_text_print(&file, "\n");
	return jn_text_close(&file);
}

static JnStatus write_script(const StudyRun* run, const Errors* errors) {
	JnTextFile file;
	JN_TRY(jn_text_open(&file, run->plan.directory, "energy_over_dt.gnuplot", JN_TEXT_REPLACE));
	method_print_head(&file, "energy_over_dt", 1000, 640);
	jn_text_print(&file,
				  "set logscale x\nset format x '10^{%%L}'\nset xlabel 'time step [s]'\n"
				  "set ylabel 'energy error at t = 10 s [J/kg]'\nset xrange [%g:0.14]\nset yrange [1e-11:10]\n"
				  "set title 'Clamped beam, 10 s: energy error against the time step (in brackets: slope)'\nplot ",
				  0.7 * steps[step_count(run) - 1]);
	for (int m = 0; m < METHODS; ++m) {
		const char* name = method_list[m].name;
		jn_text_print(&file,
					  "%s'energy_over_dt.csv' using 1:(column('%s') > 0 ? column('%s') : NaN) every ::0::%d with "
					  "linespoints ",
					  m > 0 ? ", \\\n     " : "", name, name, step_count(run) - 1);
		method_print_pen(&file, m);
		jn_text_print(&file, " pt %d ps 0.8 title '%s (%.2f)'", 4 + m % 10, name, errors->slopes[m]);
	}
	jn_text_print(&file, "\n");
	return jn_text_close(&file);
}

static JnStatus report(StudyRun* run, Page* page) {
	Errors errors;
	read_errors(run, &errors);
	Table table = table_begin(&run->plan.arena, "method|50 ms [J/kg]|10 ms|5 ms|1 ms|slope");
	for (int m = 0; m < METHODS; ++m)
		table_row(&table, "%s|%.2e|%.2e|%.2e|%.2e|%.2f", method_list[m].title, errors.of[m][1], errors.of[m][3],
				  errors.of[m][4], errors.of[m][6], errors.slopes[m]);
	JN_TRY(write_table(run, &errors));
	JN_TRY(write_script(run, &errors));
	JN_TRY(table_write(&table, run->plan.directory, "table.csv"));
	compare_draw(run->plan.directory, "energy_over_dt");
	page_picture(page, "energy_over_dt.png",
				 "Energy error at 10 s. Slopes are fitted to the four smallest steps whose error is "
				 "above 1e-10 J/kg.");
	page_table(page, &table);
	page_link(page, "energy_over_dt.csv", "all errors and slopes");
	return JN_OK;
}

const Study study_ho_fig4 = {
	.name = "ho-fig4",
	.doc = "energy error of the clamped beam at 10 s over the time step",
	.shown =
		"Löschner, Longva, Jeske, Kugelstadt, Bender: Higher-Order Time Integration for Deformable Solids (2020), "
		"figure 4. Energy error at the end of the beam's run over the step, with lines of first, second and third "
		"order. "
		"Orders above two appear only at steps too small for practice; backward Euler stays near its steady state.",
	.plan = plan,
	.ended = drop_series,
	.report = report,
};
