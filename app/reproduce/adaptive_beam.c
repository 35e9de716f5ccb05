// Chosen steps against equal ones on the clamped beam: error of the positions after 1 s over factorisations and over time.
#include <math.h>
#include <stdio.h>

#include "compare_drawing.h"
#include "compare_recording.h"
#include "reproduce/study.h"

enum { BEAM_METHODS = 2, KINDS = 2, VALUES = 4, CURVES = BEAM_METHODS * KINDS };

static const char* const methods[BEAM_METHODS] = {"sdirk2", "tr_bdf2"};
static const struct {
	const char *name, *title, *unit;
	double values[VALUES]; // of dt [s], of the tolerance [m]
} kinds[KINDS] = {
	{"equal", "equal steps", "s", {2e-2, 1e-2, 5e-3, 2.5e-3}},
	{"chosen", "force_error and embedded", "m", {1e-3, 1e-4, 1e-5, 1e-6}},
};

static void name_case(int method, int kind, int value, char name[64]) {
	snprintf(name, 64, "%s_%s_%g", methods[method], kinds[kind].name, kinds[kind].values[value]);
}

static void set_up(StudyRun* run, const char* method) {
	study_set(run, "integrator={method: %s}", method);
	study_set(run, "duration=1 s");
	study_set(run, "newton.tolerance=1e-9"); // far below the errors of the steps
	study_set(run, "record.interval=1 s");
	if (run->options->is_quick) study_set(run, "bodies[0].shape.cells=[2,2,16]");
}

static void add_case(StudyRun* run, int method, int kind, int value) {
	char name[64], label[96];
	const double number = kinds[kind].values[value];
	name_case(method, kind, value, name);
	snprintf(label, sizeof label, "%s, %s, %g %s", methods[method], kinds[kind].title, number, kinds[kind].unit);
	study_add(run, "beam.yaml", name, label, kind == 0 ? 1 / number : 200);
	set_up(run, methods[method]);
	if (kind == 0)
		study_set(run, "step={dt: %g s}", number);
	else
		study_set(run,
				  "step={controller: combined, rules: [{controller: force_error, tolerance: %g m}, "
				  "{controller: embedded, tolerance: %g m}]}",
				  number, number);
}

static JnStatus plan(StudyRun* run) {
	study_add(run, "beam.yaml", "reference", "reference", 5000);
	set_up(run, "esdirk436");
	study_set(run, "step={dt: 1 ms}");
	for (int m = 0; m < BEAM_METHODS; ++m)
		for (int k = 0; k < KINDS; ++k)
			for (int v = 0; v < VALUES; ++v) add_case(run, m, k, v);
	return run->status;
}

// Root mean square, over all nodes, of the distance at the end between two runs.
static JnStatus distance(const StudyRun* run, int first, int second, double* out) {
	CompareRecording a, b;
	double sum = 0;
	JnStatus status = compare_recording_open(study_folder(run, first), &a);
	if (status == JN_OK) {
		status = compare_recording_open(study_folder(run, second), &b);
		for (int k = 0; status == JN_OK && k < 3 * a.node_count; ++k) sum += (a.x[k] - b.x[k]) * (a.x[k] - b.x[k]);
		compare_recording_close(&b);
	}
	*out = status == JN_OK ? sqrt(sum / a.node_count) : (double)NAN;
	compare_recording_close(&a);
	return status;
}

static JnStatus write_row(StudyRun* run, int method, int kind, int value, JnTextFile* file, Table* table) {
	char name[64];
	double error = NAN;
	name_case(method, kind, value, name);
	const int index = study_find(run, name), reference = study_find(run, "reference");
	if (!study_is_done(run, index) || !study_is_done(run, reference)) return JN_OK;
	JN_TRY(distance(run, index, reference, &error));
	const double steps = study_number(run, index, "steps"), rejected = study_number(run, index, "rejected"),
				 factorizations = study_number(run, index, "factorizations"),
				 solves = study_number(run, index, "solves"), seconds = study_number(run, index, "wall_seconds");
	jn_text_print(file, "%g,%.0f,%.6g,%.6g\n", kinds[kind].values[value], factorizations, seconds, error);
	table_row(table, "%s, %s|%g %s|%.0f|%.0f|%.0f|%.0f|%.2f|%.2e", methods[method], kinds[kind].title,
			  kinds[kind].values[value], kinds[kind].unit, steps, rejected, factorizations, solves, seconds, error);
	return JN_OK;
}

// One block a curve, so that gnuplot's `index` finds it.
static JnStatus write_numbers(StudyRun* run, Table* table) {
	JnTextFile file;
	JnStatus status = JN_OK;
	JN_TRY(jn_text_open(&file, run->plan.directory, "work_precision.csv", JN_TEXT_REPLACE));
	for (int c = 0; c < CURVES && status == JN_OK; ++c) {
		jn_text_print(&file, "%s# %s, %s: value,factorizations,wall seconds,rms error [m]\n", c > 0 ? "\n\n" : "",
					  methods[c / KINDS], kinds[c % KINDS].title);
		for (int v = 0; v < VALUES && status == JN_OK; ++v)
			status = write_row(run, c / KINDS, c % KINDS, v, &file, table);
	}
	const JnStatus closed = jn_text_close(&file);
	return status != JN_OK ? status : closed;
}

static JnStatus write_script(const StudyRun* run) {
	static const char* const axes[2] = {"factorisations", "wall time [s]"};
	JnTextFile file;
	JN_TRY(jn_text_open(&file, run->plan.directory, "work_precision.gnuplot", JN_TEXT_REPLACE));
	jn_text_print(&file, "set terminal pngcairo size 1100,480 font 'DejaVu Sans,11'\nset output 'work_precision.png'\n"
						 "set datafile separator ','\nset multiplot layout 1,2\nset logscale xy\nset grid\n"
						 "set format y '10^{%%L}'\nset ylabel 'position error after 1 s, rms [m]'\n");
	for (int axis = 0; axis < 2; ++axis) {
		jn_text_print(&file, "set xlabel '%s'\nplot", axes[axis]);
		for (int c = 0; c < CURVES; ++c)
			jn_text_print(
				&file,
				"%s 'work_precision.csv' index %d using %d:4 with linespoints lw 1.6 pt %d title '%s, %s' noenhanced",
				c > 0 ? "," : "", c, 2 + axis, 4 + c, methods[c / KINDS], kinds[c % KINDS].title);
		jn_text_print(&file, "\n");
	}
	jn_text_print(&file, "unset multiplot\n");
	return jn_text_close(&file);
}

static JnStatus report(StudyRun* run, Page* page) {
	Table table =
		table_begin(&run->plan.arena,
					"method and steps|dt or tolerance|steps|rejected|factorisations|solves|wall [s]|rms error [m]");
	JN_TRY(write_numbers(run, &table));
	JN_TRY(write_script(run));
	JN_TRY(table_write(&table, run->plan.directory, "table.csv"));
	compare_draw(run->plan.directory, "work_precision");
	page_picture(page, "work_precision.png",
				 "Position error over factorisations and over wall time, one run at a time.");
	page_table(page, &table);
	return JN_OK;
}

const Study study_adaptive_beam = {
	.name = "adaptive-beam",
	.doc = "the clamped beam with equal and with chosen steps: error over work",
	.shown = "Nothing: the paper on force errors has no such figure. SDIRK2 and TR-BDF2 step the beam for 1 s, with "
			 "equal steps "
			 "and with steps that the force error and the embedded estimate choose together; the reference is "
			 "ESDIRK436 at 1 ms.",
	.is_timed = true,
	.plan = plan,
	.report = report,
};
