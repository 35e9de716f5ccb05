// The pendulum in the phase plane (EX, "Results"): the pairs that the paper plots, each with a step that shows what it says,
// and all methods with one step.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "reproduce/ex_phase.h"
#include "reproduce/phase.h"
#include "reproduce/series.h"

static const double gravity = 9.81; // and a length of 1 m
const double ex_starts[EX_STARTS] = {0.7, 1.6, 2.6};
static const char curves[] = "curves.csv";

const ExPortrait ex_portraits[EX_PORTRAITS] = {
	{"explicit", "Explicit Euler and midpoint, steps of 20 ms", 0.02, 6, 2, 2, {"explicit_euler", "midpoint"}},
	{"symplectic",
	 "Symplectic Euler and modified midpoint, steps of 150 ms",
	 0.15,
	 60,
	 2,
	 2,
	 {"symplectic_euler", "modified_midpoint"}},
	{"half_steps",
	 "Half step and modified half step, steps of 100 ms",
	 0.1,
	 20,
	 2,
	 2,
	 {"half_step", "modified_half_step"}},
	{"energy_keepers",
	 "Symplectic Euler, Verlet and Forest-Ruth, steps of 250 ms",
	 0.25,
	 100,
	 3,
	 3,
	 {"symplectic_euler", "verlet", "forest_ruth"}},
	{"all",
	 "All with steps of 100 ms",
	 0.1,
	 20,
	 3,
	 12,
	 {"explicit_euler", "midpoint", "modified_midpoint", "half_step", "modified_half_step", "symplectic_euler",
	  "verlet", "forest_ruth", "rk4", "ruth3", "pefrl", "backward_euler"}},
};

void ex_name_case(const ExPortrait* portrait, const char* method, int start, char name[96]) {
	snprintf(name, 96, "%s_%s_%g", portrait->name, method, ex_starts[start]);
}

static void add_case(StudyRun* run, const ExPortrait* portrait, const char* method, int start) {
	char name[96], label[160];
	ex_name_case(portrait, method, start, name);
	snprintf(label, sizeof label, "%s from %g rad, %g ms", method, ex_starts[start], 1e3 * portrait->dt);
	study_add(run, "pendulum.yaml", name, label, portrait->duration / portrait->dt);
	study_set(run, "system={type: pendulum, gravity: %g, length: 1, mass: 1, angle: %g}", gravity, ex_starts[start]);
	study_set(run, "integrator={method: %s}", method);
	study_set(run, "step={dt: %g s}", portrait->dt);
	study_set(run, "duration=%g s", portrait->duration);
}

// The quick form has one start, and the pairs of the paper alone.
static bool is_planned(const StudyRun* run, int portrait, int start) {
	return !run->options->is_quick || (start == 1 && portrait + 1 < EX_PORTRAITS);
}

static JnStatus plan(StudyRun* run) {
	for (int p = 0; p < EX_PORTRAITS; ++p)
		for (int m = 0; m < ex_portraits[p].count; ++m)
			for (int s = 0; s < EX_STARTS; ++s)
				if (is_planned(run, p, s)) add_case(run, &ex_portraits[p], ex_portraits[p].methods[m], s);
	return run->status;
}

// ---- pages ----

static JnStatus add_rows(const StudyRun* run, Table* table) {
	for (int p = 0; p < EX_PORTRAITS; ++p)
		for (int m = 0; m < ex_portraits[p].count; ++m) {
			ExDrift drift;
			if (!is_planned(run, p, 1)) continue;
			JN_TRY(ex_find_drift(run, &ex_portraits[p], ex_portraits[p].methods[m], &drift));
			table_row(table, "%s|%s|%g|%g|%.2g|%+.2g", ex_portraits[p].methods[m], ex_portraits[p].name,
					  1e3 * ex_portraits[p].dt, ex_portraits[p].duration, drift.largest, drift.end);
		}
	return JN_OK;
}

// ---- pictures ----

static void title_panel(const char* method, char title[64]) {
	snprintf(title, 64, "%s", method);
	for (char* at = title; *at != '\0'; ++at)
		if (*at == '_') *at = ' ';
}

// Add a run to a panel, with the columns that its series has.
static JnStatus add_run(StudyRun* run, int index, PhasePanel* panel) {
	char path[160];
	Series series;
	if (!study_is_done(run, index)) return JN_OK;
	JnStatus status = series_read(study_folder(run, index), "series.csv", &series);
	if (status == JN_OK) status = series_column(&series, "theta", &panel->theta);
	if (status == JN_OK) status = series_column(&series, "omega", &panel->omega);
	series_free(&series);
	snprintf(path, sizeof path, "runs/%s/series.csv", run->plan.runs[index].name);
	panel->runs[panel->run_count] = jn_arena_text(&run->plan.arena, path);
	if (panel->runs[panel->run_count] == NULL) return JN_OUT_OF_MEMORY;
	++panel->run_count;
	return status;
}

static JnStatus draw(StudyRun* run, const ExPortrait* portrait) {
	char titles[EX_MOST_METHODS][64];
	PhasePicture picture = {
		.name = portrait->name, .title = portrait->title, .columns = portrait->columns, .omega_high = 8};
	for (int m = 0; m < portrait->count; ++m) {
		PhasePanel* panel = &picture.panels[picture.count];
		title_panel(portrait->methods[m], titles[m]);
		*panel = (PhasePanel){.title = titles[m]};
		for (int s = 0; s < EX_STARTS; ++s) {
			char name[96];
			ex_name_case(portrait, portrait->methods[m], s, name);
			JN_TRY(add_run(run, study_find(run, name), panel));
		}
		picture.count += panel->run_count > 0;
	}
	return phase_draw(&picture, run->plan.directory, curves, EX_STARTS);
}

static JnStatus report(StudyRun* run, Page* page) {
	Table table =
		table_begin(&run->plan.arena, "method|picture|step [ms]|time [s]|largest error of energy|energy at the end");
	Table claims = claims_begin(&run->plan.arena);
	JN_TRY(phase_curves_write(run->plan.directory, curves, gravity, EX_STARTS, ex_starts));
	for (int p = 0; p < EX_PORTRAITS; ++p) {
		char file[64], caption[160];
		if (!is_planned(run, p, 1)) continue;
		JN_TRY(draw(run, &ex_portraits[p]));
		snprintf(file, sizeof file, "%s.png", ex_portraits[p].name);
		snprintf(caption, sizeof caption, "%s, over %g s.", ex_portraits[p].title, ex_portraits[p].duration);
		page_picture(page, file, caption);
	}
	page_text(
		page,
		"Points are the states after each step, from rest at the circles; grey curves are the exact "
		"motions from there, dashed the one that ends at the top, and beyond it the pendulum turns over. Angles are "
		"wrapped to one turn.");
	ex_phase_claims(run, &claims);
	page_heading(page, "What the paper says, and the numbers");
	page_table(page, &claims);
	JN_TRY(table_write(&claims, run->plan.directory, "claims.csv"));
	page_heading(page, "Energies");
	JN_TRY(add_rows(run, &table));
	JN_TRY(table_write(&table, run->plan.directory, "table.csv"));
	page_table(page, &table);
	page_text(
		page,
		"Errors are relative to the energy at the start, the largest of the three starts; the energy at the end is "
		"its mean over the last fifth of the time, minus that at the start, on average over the starts.");
	return JN_OK;
}

const Study study_ex_phase = {
	.name = "ex-phase",
	.doc = "phase portraits of a pendulum, method by method",
	.shown =
		"On the impact of explicit or semi-implicit integration methods over the stability of real-time numerical "
		"simulations: phase portraits of theta'' = -(g/l) sin theta for explicit Euler and midpoint, for symplectic "
		"Euler "
		"and modified midpoint, for the half step and the modified half step, and for symplectic Euler, Verlet and "
		"Forest-Ruth. Explicit Euler introduces ghost energies; symplectic Euler and modified midpoint have a much "
		"higher "
		"stability range; both half steps add energy, the modified one less. Starts, steps and g/l are not given.",
	.plan = plan,
	.report = report,
};
