// AD on cloth: what adaptive steps by force error cost against fixed ones, at the same error. The paper shows a cloth simulator
// without numbers; the scenes are this project's.
#include <math.h>
#include <stdio.h>

#include "compare_drawing.h"
#include "reproduce/frames.h"
#include "reproduce/method.h"
#include "reproduce/study.h"

typedef struct StepScene {
	const char *file, *name, *title;
	double duration; ///< [s]
} StepScene;

static const StepScene scenes[] = {{"tug.yaml", "tug", "tugged once", 3}, {"swing.yaml", "swing", "swinging", 2}};
static const double steps[] = {16e-3, 8e-3, 4e-3, 2e-3, 1.4e-3, 1e-3, 7e-4, 5e-4}; // [s]
static const double reference_step = 8e-3 / 64;
static const double tolerances[] = {1e-3, 1e-4, 3e-5, 1e-5, 1e-6}; // [m]
enum {
	SCENES = sizeof scenes / sizeof *scenes,
	STEPS = sizeof steps / sizeof *steps,
	TOLERANCES = sizeof tolerances / sizeof *tolerances
};

static double duration(const StudyRun* run, int scene) {
	return run->options->is_quick ? 0.8 : scenes[scene].duration;
}

static void add_case(StudyRun* run, int scene, const char* kind, const char* label, double dt) {
	char name[64], words[96];
	snprintf(name, sizeof name, "%s_%s", scenes[scene].name, kind);
	snprintf(words, sizeof words, "%s, %s", scenes[scene].title, label);
	study_add(run, scenes[scene].file, name, words, duration(run, scene) / dt);
	study_set(run, "duration=%g s", duration(run, scene));
	study_set(run, "step.dt=%.17g s", dt);
	study_set(run, "bodies[0].shape.cells=%s", run->options->is_quick ? "[8,8]" : "[16,16]");
}

static void name_fixed(double dt, char name[48]) {
	snprintf(name, 48, "dt=%gms", 1e3 * dt);
}

static void name_adaptive(double tolerance, char name[48]) {
	snprintf(name, 48, "tolerance=%gm", tolerance);
}

static JnStatus plan(StudyRun* run) {
	char name[48], label[64];
	for (int scene = 0; scene < SCENES; ++scene) {
		add_case(run, scene, "reference", "reference", reference_step);
		study_set(run, "step.controller=fixed");
		for (int i = 0; i < STEPS; ++i) {
			name_fixed(steps[i], name);
			snprintf(label, sizeof label, "%g ms", 1e3 * steps[i]);
			add_case(run, scene, name, label, steps[i]);
			study_set(run, "step.controller=fixed");
			study_set(run, "step.cuts=0");
			study_allow_failure(run);
		}
		for (int i = 0; i < TOLERANCES; ++i) {
			name_adaptive(tolerances[i], name);
			snprintf(label, sizeof label, "tolerance %g m", tolerances[i]);
			add_case(run, scene, name, label, 1e-3);
			study_set(run, "step.controller=force_error");
			study_set(run, "step.tolerance=%g m", tolerances[i]);
			study_allow_failure(run);
		}
	}
	return run->status;
}

/// What a case came to; NAN when it has failed.
typedef struct Outcome {
	double error; ///< root mean square of distances to the reference, over nodes and frames [m]
	double factorizations, steps, rejected;
} Outcome;

static JnStatus add_squares(Frames* frames, Frames* reference, double* sum) {
	double *x, *y;
	const size_t count = 3 * (size_t)frames->point_count;
	JN_NEW(&frames->arena, x, count);
	JN_NEW(&frames->arena, y, count);
	for (int i = 0; i < frames->count; ++i) {
		JN_TRY(frames_read(frames, i, x));
		JN_TRY(frames_read(reference, frames_nearest(reference, frames->times[i]), y));
		for (size_t k = 0; k < count; ++k) *sum += (x[k] - y[k]) * (x[k] - y[k]);
	}
	return JN_OK;
}

static JnStatus measure_distance(const char* folder, const char* reference_folder, double* error) {
	Frames frames, reference = {0};
	double sum = 0;
	JnStatus status = frames_open(folder, &frames);
	if (status == JN_OK) status = frames_open(reference_folder, &reference);
	if (status == JN_OK) status = add_squares(&frames, &reference, &sum);
	if (status == JN_OK) *error = sqrt(sum / ((double)frames.count * frames.point_count));
	frames_close(&frames);
	frames_close(&reference);
	return status;
}

static JnStatus measure(const StudyRun* run, int scene, const char* kind, Outcome* out) {
	char name[64];
	*out = (Outcome){NAN, NAN, NAN, NAN};
	snprintf(name, sizeof name, "%s_reference", scenes[scene].name);
	const int reference = study_find(run, name);
	snprintf(name, sizeof name, "%s_%s", scenes[scene].name, kind);
	const int index = study_find(run, name);
	if (!study_is_done(run, index) || !study_is_done(run, reference)) return JN_OK;
	out->factorizations = study_number(run, index, "factorizations");
	out->steps = study_number(run, index, "steps");
	out->rejected = study_number(run, index, "rejected");
	return measure_distance(study_folder(run, index), study_folder(run, reference), &out->error);
}

typedef struct Outcomes {
	Outcome fixed[STEPS], adaptive[TOLERANCES];
} Outcomes;

static JnStatus measure_all(const StudyRun* run, int scene, Outcomes* out) {
	char name[48];
	for (int i = 0; i < STEPS; ++i) {
		name_fixed(steps[i], name);
		JN_TRY(measure(run, scene, name, &out->fixed[i]));
	}
	for (int i = 0; i < TOLERANCES; ++i) {
		name_adaptive(tolerances[i], name);
		JN_TRY(measure(run, scene, name, &out->adaptive[i]));
	}
	return JN_OK;
}

// Factorisations that fixed steps need for an error: on the line, in logarithms, between the two cases around it; those
// of the coarsest steps that work where these are more exact; NAN where none is as exact.
static double fixed_cost(const Outcomes* outcomes, double error) {
	const Outcome* coarser = NULL;
	for (int i = 0; i < STEPS; ++i) {
		const Outcome* at = &outcomes->fixed[i];
		if (isnan(at->error)) continue;
		if (at->error <= error) {
			if (coarser == NULL) return at->factorizations;
			const double share = log(error / coarser->error) / log(at->error / coarser->error);
			return exp(log(coarser->factorizations) + share * log(at->factorizations / coarser->factorizations));
		}
		coarser = at;
	}
	return NAN;
}

static void add_rows(const Outcomes* outcomes, int scene, Table* table) {
	for (int i = 0; i < STEPS; ++i) {
		const Outcome* at = &outcomes->fixed[i];
		if (isnan(at->error))
			table_row(table, "%s|%g ms|fails||||", scenes[scene].name, 1e3 * steps[i]);
		else
			table_row(table, "%s|%g ms|%.3g|%.0f|%.0f||", scenes[scene].name, 1e3 * steps[i], 1e3 * at->error,
					  at->factorizations, at->rejected);
	}
	for (int i = 0; i < TOLERANCES; ++i) {
		const Outcome* at = &outcomes->adaptive[i];
		const double cost = fixed_cost(outcomes, at->error);
		table_row(table, "%s|tolerance %g mm|%.3g|%.0f|%.0f|%.0f|%.2f", scenes[scene].name, 1e3 * tolerances[i],
				  1e3 * at->error, at->factorizations, at->rejected, cost, cost / at->factorizations);
	}
}

static void print_points(JnTextFile* file, int count, const Outcome* outcomes) {
	for (int i = 0; i < count; ++i)
		if (!isnan(outcomes[i].error))
			jn_text_print(file, "%g %.6e\n", outcomes[i].factorizations, 1e3 * outcomes[i].error);
	jn_text_print(file, "e\n");
}

// Four curves of few points, which stand in the script itself.
static JnStatus draw(const StudyRun* run, const Outcomes outcomes[SCENES]) {
	static const char* const colours[SCENES] = {"#1f77b4", "#ff7f0e"};
	JnTextFile file;
	JN_TRY(jn_text_open(&file, run->plan.directory, "cloth_steps.gnuplot", JN_TEXT_REPLACE));
	method_print_head(&file, "cloth_steps", 900, 520);
	jn_text_print(&file, "set datafile separator whitespace\nset logscale x\nset xlabel 'factorisations'\n"
						 "set ylabel 'rms distance to the reference [mm]'\n"
						 "set title 'Cloth, linearised Newmark: error against work'\nplot ");
	for (int i = 0; i < SCENES; ++i)
		jn_text_print(
			&file,
			"%s'-' with linespoints lw 1.6 dt 2 pt 6 lc rgb '%s' title '%s, fixed', \\\n     '-' with linespoints "
			"lw 2 pt 7 lc rgb '%s' title '%s, adaptive'",
			i > 0 ? ", \\\n     " : "", colours[i], scenes[i].title, colours[i], scenes[i].title);
	jn_text_print(&file, "\n");
	for (int i = 0; i < SCENES; ++i) {
		print_points(&file, STEPS, outcomes[i].fixed);
		print_points(&file, TOLERANCES, outcomes[i].adaptive);
	}
	JN_TRY(jn_text_close(&file));
	compare_draw(run->plan.directory, "cloth_steps");
	return JN_OK;
}

static JnStatus report(StudyRun* run, Page* page) {
	Outcomes outcomes[SCENES];
	Table table = table_begin(
		&run->plan.arena, "scene|steps|error [mm]|factorisations|rejected|fixed steps of that error|fixed / adaptive");
	for (int scene = 0; scene < SCENES; ++scene) {
		JN_TRY(measure_all(run, scene, &outcomes[scene]));
		add_rows(&outcomes[scene], scene, &table);
	}
	JN_TRY(draw(run, outcomes));
	JN_TRY(table_write(&table, run->plan.directory, "table.csv"));
	page_picture(page, "cloth_steps.png",
				 "Distance to a run with steps of 8 ms / 64, root mean square over nodes and frames, against the "
				 "number of factorisations: one a step, rejected ones included.");
	page_table(page, &table);
	page_text(
		page,
		"The last column is what fixed steps of the same error cost, interpolated between the cases around it (or "
		"the coarsest ones that do not fail, where those are more exact already), over what adaptive steps cost.");
	return JN_OK;
}

const Study study_ad_cloth = {
	.name = "ad-cloth",
	.doc = "adaptive steps by force error against fixed ones on cloth, at equal error",
	.shown =
		"Adaptive Time-Stepping with Linearized Force Error Estimation, section 4, names a cloth simulator among its "
		"tests and gives no numbers for it. For brittle fracture it tells of three to six times less work.",
	.plan = plan,
	.report = report,
};
