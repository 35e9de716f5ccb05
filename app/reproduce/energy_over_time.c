// HO figure 3: the energy error of the clamped beam over 200 s at two steps, as energy_over_time.csv.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/log.h"
#include "compare_drawing.h"
#include "reproduce/method.h"
#include "reproduce/series.h"
#include "reproduce/study.h"

enum { KEPT_ROWS = 400, STEPS = 2 };

static const char thinned_name[] = "thinned.csv";
static const double steps[STEPS] = {0.033, 0.005}; // [s]

static double duration(const StudyRun* run) {
	return run->options->is_quick ? 20 : 200;
}

static void name_case(int method, double dt, char name[64]) {
	snprintf(name, 64, "%s_dt=%gms", method_list[method].name, 1e3 * dt);
}

// The tolerance is far below the errors shown, which are above 1e-5 J/kg.
static JnStatus plan(StudyRun* run) {
	for (int s = 0; s < STEPS; ++s)
		for (int m = 0; m < PAPER_METHODS; ++m) {
			char name[64], label[64];
			name_case(m, steps[s], name);
			snprintf(label, sizeof label, "%s %g ms", method_list[m].title, 1e3 * steps[s]);
			study_add(run, "beam.yaml", name, label, duration(run) / steps[s]);
			study_set(run, "integrator.method=%s", method_list[m].name);
			study_set(run, "step.dt=%.17g s", steps[s]);
			study_set(run, "duration=%g s", duration(run));
			study_set(run, "newton.tolerance=1e-8");
			study_set(run, "record.interval=1e6 s");
			if (run->options->is_quick) study_set(run, "bodies[0].shape.cells=[2,2,16]");
		}
	return run->status;
}

static JnStatus write_thinned(const Series* series, const char* folder) {
	JnTextFile file;
	int time = 0, error = 0;
	const int every = series->rows / KEPT_ROWS > 1 ? series->rows / KEPT_ROWS : 1;
	JN_TRY(series_column(series, "t", &time));
	JN_TRY(series_column(series, "specific_error", &error));
	JN_TRY(jn_text_open(&file, folder, thinned_name, JN_TEXT_REPLACE));
	jn_text_print(&file, "t,specific_error\n");
	for (int i = 0; i < series->rows; ++i) {
		const double* row = series->values + (size_t)i * (size_t)series->columns;
		if (i % every == 0 || i == series->rows - 1) jn_text_print(&file, "%.17g,%.17g\n", row[time], row[error]);
	}
	return jn_text_close(&file);
}

static void remove_file(const char* folder, const char* name) {
	char path[JN_PATH_SIZE];
	if (jn_path_join(folder, name, path) == JN_OK) unlink(path);
}

// A step's row is of no use once 400 of them are kept: together they take a gigabyte.
static void thin(const CompareJob* job, void* user) {
	(void)user;
	Series series;
	JnStatus status = series_read(job->folder, "series.csv", &series);
	if (status == JN_OK) status = write_thinned(&series, job->folder);
	series_free(&series);
	if (status != JN_OK) return;
	remove_file(job->folder, "series.csv");
	remove_file(job->folder, "run.h5");
	remove_file(job->folder, "run.xdmf");
}

static JnStatus append(JnTextFile* file, const StudyRun* run, int method, double dt) {
	char name[64];
	Series series;
	name_case(method, dt, name);
	const int index = study_find(run, name);
	if (!study_is_done(run, index)) return JN_OK;
	const JnStatus status = series_read(study_folder(run, index), thinned_name, &series);
	for (int i = 0; status == JN_OK && i < series.rows; ++i)
		jn_text_print(file, "%s,%g,%.6g,%.6e\n", method_list[method].name, dt, series.values[2 * i],
					  series.values[2 * i + 1]);
	series_free(&series);
	return status;
}

static JnStatus write_table(const StudyRun* run) {
	JnTextFile file;
	JN_TRY(jn_text_open(&file, run->plan.directory, "energy_over_time.csv", JN_TEXT_REPLACE));
	jn_text_print(&file, "method,dt,t,specific_error\n");
	JnStatus status = JN_OK;
	for (int i = 0; i < STEPS * PAPER_METHODS && status == JN_OK; ++i)
		status = append(&file, run, i % PAPER_METHODS, steps[i / PAPER_METHODS]);
	const JnStatus closed = jn_text_close(&file);
	return status != JN_OK ? status : closed;
}

static JnStatus write_script(const StudyRun* run) {
	static const char* const lows[STEPS] = {"1e-3", "1e-5"};
	JnTextFile file;
	JN_TRY(jn_text_open(&file, run->plan.directory, "energy_over_time.gnuplot", JN_TEXT_REPLACE));
	method_print_head(&file, "energy_over_time", 1000, 820);
	jn_text_print(
		&file, "set xlabel 'time [s]'\nset ylabel 'energy error [J/kg]'\nset xrange [0:%g]\nset multiplot layout 2,1\n",
		duration(run));
	for (int s = 0; s < STEPS; ++s) {
		jn_text_print(&file, "set title 'Clamped beam, steps of %g ms'\nset yrange [%s:5]\nplot ", 1e3 * steps[s],
					  lows[s]);
		for (int m = 0; m < PAPER_METHODS; ++m) {
			jn_text_print(&file,
						  "%s'< grep -E \"^%s,%g,\" energy_over_time.csv' using 3:($4 > 0 ? $4 : NaN) with lines ",
						  m > 0 ? ", \\\n     " : "", method_list[m].name, steps[s]);
			method_print_pen(&file, m);
			jn_text_print(&file, " title '%s'", method_list[m].name);
		}
		jn_text_print(&file, "\n");
	}
	jn_text_print(&file, "unset multiplot\n");
	return jn_text_close(&file);
}

static JnStatus report(StudyRun* run, Page* page) {
	char header[64];
	snprintf(header, sizeof header, "method|energy error at %g s, 33 ms [J/kg]|5 ms [J/kg]", duration(run));
	Table table = table_begin(&run->plan.arena, header);
	for (int m = 0; m < PAPER_METHODS; ++m) {
		double errors[STEPS];
		for (int s = 0; s < STEPS; ++s) {
			char name[64];
			name_case(m, steps[s], name);
			errors[s] = study_number(run, study_find(run, name), "specific_error");
		}
		table_row(&table, "%s|%.3e|%.3e", method_list[m].title, errors[0], errors[1]);
	}
	JN_TRY(write_table(run));
	JN_TRY(write_script(run));
	JN_TRY(table_write(&table, run->plan.directory, "table.csv"));
	compare_draw(run->plan.directory, "energy_over_time");
	page_picture(page, "energy_over_time.png",
				 "Distance of kinetic, elastic and gravitational energy per unit mass from its start.");
	page_table(page, &table);
	page_link(page, "energy_over_time.csv", "the curves");
	return JN_OK;
}

const Study study_ho_fig3 = {
	.name = "ho-fig3",
	.doc = "energy error of the clamped beam over 200 s, at 33 ms and 5 ms",
	.shown =
		"Löschner, Longva, Jeske, Kugelstadt, Bender: Higher-Order Time Integration for Deformable Solids (2020), "
		"figure 3. The double-clamped beam of 512 hexahedra swings for 200 s. The energy loss of backward Euler is "
		"nearly two orders of magnitude larger than that of all other methods. At 33 ms SDIRK2 and TR-BDF2(B) have the "
		"smallest errors; at 5 ms SDIRK(3,3,4,5) and SDIRK(4,3,4,7) are below them, and SDIRK(4,3,4,7) begins to gain "
		"energy at about 100 s.",
	.plan = plan,
	.ended = thin,
	.report = report,
};
