// HO figure 8: a ball dropped from 3 m, and what energy each bounce and each flight between them takes.
#include <math.h>
#include <stdio.h>

#include "reproduce/picture.h"
#include "reproduce/plot.h"
#include "reproduce/series.h"
#include "reproduce/study.h"

typedef struct BallCase {
	const char *name, *title;
	const char* method;
	double dt; ///< [s]
	const char* prediction;
} BallCase;

static const BallCase cases[] = {
	{"backward_euler_dt=5ms_free", "BE 5 ms", "backward_euler", 5e-3, "free"},
	{"backward_euler_dt=0.5ms_free", "BE 0.5 ms", "backward_euler", 5e-4, "free"},
	{"sdirk2_dt=5ms_free", "SDIRK2 5 ms", "sdirk2", 5e-3, "free"},
	{"sdirk2_dt=0.5ms_free", "SDIRK2 0.5 ms", "sdirk2", 5e-4, "free"},
	{"backward_euler_dt=5ms_carried", "BE 5 ms, carried", "backward_euler", 5e-3, "carried"},
	{"backward_euler_dt=5ms_iterated", "BE 5 ms, iterated", "backward_euler", 5e-3, "iterated"},
	{"sdirk2_dt=5ms_carried", "SDIRK2 5 ms, carried", "sdirk2", 5e-3, "carried"},
	{"sdirk2_dt=5ms_iterated", "SDIRK2 5 ms, iterated", "sdirk2", 5e-3, "iterated"},
};
enum { CASES = sizeof cases / sizeof *cases, EULER = 0, SDIRK2 = 2, MOST_BOUNCES = 32, MOST_TOPS = 4 };

static const double drop = 9.81 * 2.5; // [J/kg]: the ball at the start, above the ball at rest on the floor
static const double pause = 0.1;       // [s]: contacts that are nearer in time than this are one bounce

static double duration(const StudyRun* run) {
	return run->options->is_quick ? 4 : 10;
}

static JnStatus plan(StudyRun* run) {
	for (int i = 0; i < CASES; ++i) {
		study_add(run, "ball.yaml", cases[i].name, cases[i].title, duration(run) / cases[i].dt);
		study_set(run, "integrator.method=%s", cases[i].method);
		study_set(run, "step.dt=%.17g s", cases[i].dt);
		study_set(run, "contact.prediction=%s", cases[i].prediction);
		study_set(run, "duration=%g s", duration(run));
		study_set(run, "newton.tolerance=1e-8"); // what it leaves open is far below what a step loses
		if (run->options->is_quick) study_set(run, "bodies[0].shape.cells=4");
		if (run->options->is_quick) study_set(run, "bodies[0].shape.rings=2");
	}
	return run->status;
}

// ---- what happened to the ball ----

/// A stretch of time in which the ball presses on the floor.
typedef struct Bounce {
	double from, to; ///< [s]
	double left;     ///< energy afterwards
} Bounce;

/// Energies are shares of `drop`.
typedef struct Story {
	int bounces;
	Bounce bounce[MOST_BOUNCES];
	double left;                  ///< at the end
	double in_contact, in_flight; ///< lost in steps with and without contact
	double step_growth;           ///< largest in a step
	double growth;                ///< largest above the least so far
	double predictions;           ///< mean number a step with contact
} Story;

/// The columns that tell it.
typedef struct Columns {
	int t, total, pressing, rounds;
} Columns;

static JnStatus find_columns(const Series* series, Columns* out) {
	JN_TRY(series_column(series, "t", &out->t));
	JN_TRY(series_column(series, "total", &out->total));
	JN_TRY(series_column(series, "contacts_pressing", &out->pressing));
	return series_column(series, "contact_rounds", &out->rounds);
}

static const double* row_of(const Series* series, int row) {
	return series->values + (size_t)row * (size_t)series->columns;
}

// A contact goes on with the last bounce or begins another.
static void note_contact(Story* story, double from, double to, double left) {
	Bounce* last = story->bounces > 0 ? &story->bounce[story->bounces - 1] : NULL;
	if (last == NULL || from - last->to > pause) {
		if (story->bounces == MOST_BOUNCES) return;
		last = &story->bounce[story->bounces++];
		last->from = from;
	}
	last->to = to;
	last->left = left;
}

static void tell(const Series* series, const Columns* at, double mass, Story* story) {
	double last = 1, least = 1, rounds = 0;
	int contacts = 0;
	*story = (Story){0};
	for (int i = 1; i < series->rows; ++i) {
		const double *before = row_of(series, i - 1), *row = row_of(series, i);
		const double left = 1 + (row[at->total] - row_of(series, 0)[at->total]) / (mass * drop);
		const bool is_contact = row[at->pressing] > 0;
		if (is_contact) note_contact(story, before[at->t], row[at->t], left);
		if (is_contact) rounds += row[at->rounds], ++contacts;
		*(is_contact ? &story->in_contact : &story->in_flight) += last - left;
		story->step_growth = fmax(story->step_growth, left - last);
		story->growth = fmax(story->growth, left - least);
		least = fmin(least, left);
		last = left;
	}
	story->left = last;
	story->predictions = rounds / contacts;
}

static void draw_curve(const Series* series, const Columns* at, double mass, const Plot* plot, const Curve* curve) {
	int row = 0;
	for (int i = 0; i < plot->rows; ++i) {
		while (row + 1 < series->rows && row_of(series, row)[at->t] < plot->times[i] - 1e-9) ++row;
		curve->values[i] = (row_of(series, 0)[at->total] - row_of(series, row)[at->total]) / mass;
	}
}

static JnStatus read_case(StudyRun* run, int index, const Plot* plot, const Curve* curve, Story* story) {
	Series series;
	Columns at = {0};
	const double mass = study_number(run, index, "total_mass");
	JnStatus status = series_read(study_folder(run, index), "series.csv", &series);
	if (status == JN_OK) status = find_columns(&series, &at);
	if (status == JN_OK) tell(&series, &at, mass, story);
	if (status == JN_OK) draw_curve(&series, &at, mass, plot, curve);
	series_free(&series);
	return status;
}

static JnStatus read_cases(StudyRun* run, Plot* plot, Story stories[CASES]) {
	*plot = (Plot){
		.name = "energy_loss", .title = "Bouncing ball: loss of total specific energy", .label = "energy lost [J/kg]"};
	JN_TRY(plot_begin(plot, &run->plan.arena, (int)round(duration(run) / 0.01) + 1, 0, duration(run)));
	for (int i = 0; i < CASES; ++i) {
		const int index = study_find(run, cases[i].name);
		const Curve* curve = plot_add(plot, &run->plan.arena, cases[i].name, cases[i].title);
		if (curve == NULL) return JN_OUT_OF_MEMORY;
		if (study_is_done(run, index)) JN_TRY(read_case(run, index, plot, curve, &stories[i]));
	}
	return JN_OK;
}

// ---- the page ----

static JnStatus add_panel(Picture* picture, const char* folder, int index, double t, const char* when) {
	char title[96];
	snprintf(title, sizeof title, "%s, %s, %.2f s", index == EULER ? "BE" : "SDIRK2", when, t);
	return picture_add(picture, folder, t, title);
}

// The start, the first bounce, and the top of each flight: the middle of the time between two bounces.
static JnStatus add_row(StudyRun* run, int index, const Story* story, int tops, Picture* picture) {
	const int found = study_find(run, cases[index].name);
	if (!study_is_done(run, found) || story->bounces == 0) return JN_OK;
	const char* folder = study_folder(run, found);
	JN_TRY(add_panel(picture, folder, index, 0, "start"));
	JN_TRY(add_panel(picture, folder, index, (story->bounce[0].from + story->bounce[0].to) / 2, "bounce"));
	for (int k = 0; k < tops; ++k)
		JN_TRY(add_panel(picture, folder, index, (story->bounce[k].to + story->bounce[k + 1].from) / 2, "top"));
	return JN_OK;
}

static JnStatus draw_pictures(StudyRun* run, const Story stories[CASES]) {
	const int flights = (int)fmin(stories[EULER].bounces, stories[SDIRK2].bounces) - 1;
	const int tops = (int)fmax(0, fmin(flights, MOST_TOPS));
	Picture picture = {.name = "ball", .camera = {0, 6}, .columns = 2 + tops, .width = 210, .height = 430};
	JnStatus status = add_row(run, EULER, &stories[EULER], tops, &picture);
	if (status == JN_OK) status = add_row(run, SDIRK2, &stories[SDIRK2], tops, &picture);
	if (status == JN_OK) status = picture_draw(&picture, run->plan.directory);
	picture_free(&picture);
	return status;
}

static double left_after(const Story* story, int bounce) {
	return bounce < story->bounces ? 100 * story->bounce[bounce].left : NAN;
}

static Table tabulate_energy(StudyRun* run, const Story stories[CASES]) {
	char header[160];
	snprintf(header, sizeof header,
			 "case|after bounce 1 [%%]|2 [%%]|3 [%%]|4 [%%]|after %g s [%%]|lost in contact [%%]|in flight [%%]",
			 duration(run));
	Table table = table_begin(&run->plan.arena, header);
	for (int i = 0; i < CASES; ++i) {
		const Story* s = &stories[i];
		if (study_is_done(run, study_find(run, cases[i].name)))
			table_row(&table, "%s|%.1f|%.1f|%.1f|%.1f|%.1f|%.1f|%.1f", cases[i].title, left_after(s, 0),
					  left_after(s, 1), left_after(s, 2), left_after(s, 3), 100 * s->left, 100 * s->in_contact,
					  100 * s->in_flight);
	}
	return table;
}

static Table tabulate_cost(StudyRun* run, const Story stories[CASES]) {
	Table table = table_begin(
		&run->plan.arena,
		"case|largest growth in a step [%]|above the least so far [%]|steps a second|predictions a step in contact");
	for (int i = 0; i < CASES; ++i) {
		const int index = study_find(run, cases[i].name);
		const double pace = study_number(run, index, "steps") / study_number(run, index, "wall_seconds");
		if (study_is_done(run, index))
			table_row(&table, "%s|%.4f|%.4f|%.0f|%.2f", cases[i].title, 100 * stories[i].step_growth,
					  100 * stories[i].growth, pace, stories[i].predictions);
	}
	return table;
}

static JnStatus report(StudyRun* run, Page* page) {
	Plot plot;
	Story stories[CASES] = {0};
	JN_TRY(read_cases(run, &plot, stories));
	JN_TRY(plot_draw(&plot, run->plan.directory));
	JN_TRY(draw_pictures(run, stories));
	const Table energy = tabulate_energy(run, stories), cost = tabulate_cost(run, stories);
	JN_TRY(table_write(&energy, run->plan.directory, "table.csv"));
	JN_TRY(table_write(&cost, run->plan.directory, "cost.csv"));
	page_picture(page, "energy_loss.png",
				 "Energy lost since the start, per unit mass. An undeformed ball on the floor has lost 24.5 J/kg.");
	page_table(page, &energy);
	page_text(
		page,
		"Shares of the energy at the start above that of an undeformed ball on the floor, %g J/kg; a ball at rest "
		"sags, and has a little less than none. Cases without "
		"another word predict freely, as in the paper (contact.prediction=free); 'carried' lets the contact "
		"forces of the last step act while the integrator predicts, 'iterated' those of the step itself.",
		drop);
	page_picture(page, "ball.png",
				 "Start, first bounce, and the top after each bounce, predicted freely with steps of 5 ms: backward "
				 "Euler above, SDIRK2 below.");
	page_heading(page, "Does energy grow, and what does it cost?");
	page_table(page, &cost);
	page_text(page, "Growth is a share of the same energy; nothing in the scene adds any.");
	page_link(page, "energy_loss.csv", "the curves");
	return JN_OK;
}

const Study study_ho_fig8 = {
	.name = "ho-fig8",
	.doc = "bouncing ball: energy lost in each bounce and between them",
	.shown =
		"Löschner, Longva, Jeske, Kugelstadt, Bender: Higher-Order Time Integration for Deformable Solids (2020), "
		"figure 8. Each collision with the floor takes energy, and backward Euler loses much between collisions, too. "
		"With 5 ms and with 0.5 ms SDIRK2 loses visibly less than backward Euler, in each collision and between them, "
		"so that its ball jumps higher. Smaller steps lose much less in contact. SDIRK2's advantage is smaller than "
		"without contact; the paper names iterated prediction and correction as a way out.",
	.is_timed = true,
	.plan = plan,
	.report = report,
};
