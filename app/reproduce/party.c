// HO figure 1: ducks fall through a maze of trampolines, and beach balls hit an armadillo; what contact costs there.
#include <math.h>
#include <stdio.h>

#include "reproduce/passage.h"
#include "reproduce/picture.h"
#include "reproduce/series.h"
#include "reproduce/study.h"

typedef struct Party {
	const char *name, *scene, *title;
	double duration, quick_duration; ///< [s]

	int panels;
	double shown[6]; ///< times of the pictures, as shares of the duration
} Party;

enum { PARTIES = 2, DUCKS = 0, ARMADILLO = 1, SHEETS = 10, DUCK_COUNT = 30, BALLS = 8 };

static const Party parties[PARTIES] = {
	{.name = "ducks",
	 .scene = "ducks.yaml",
	 .title = "30 ducks, 10 trampolines",
	 .duration = 6,
	 .quick_duration = 1.5,
	 .panels = 6,
	 .shown = {0.08, 0.15, 0.25, 0.4, 0.6, 1}},
	{.name = "armadillo_balls",
	 .scene = "armadillo_balls.yaml",
	 .title = "armadillo, 8 beach balls",
	 .duration = 3.5,
	 .quick_duration = 1.5,
	 .panels = 6,
	 .shown = {0.15, 0.24, 0.33, 0.42, 0.5, 0.76}},
};

static double duration_of(const StudyRun* run, const Party* party) {
	return run->options->is_quick ? party->quick_duration : party->duration;
}

static void make_coarse(StudyRun* run, int party) {
	study_set(run, "record.interval=1/60 s");
	if (party == ARMADILLO) study_set(run, "bodies[0].shape.tetrahedra.size=4 cm");
	for (int b = 0; party == ARMADILLO && b < BALLS; ++b) study_set(run, "bodies[%d].shape.cell=4.5 cm", b + 1);
	for (int b = 0; party == DUCKS && b < SHEETS; ++b) study_set(run, "bodies[%d].shape.cells=[8,8]", b);
	for (int b = 0; party == DUCKS && b < DUCK_COUNT; ++b) study_set(run, "bodies[%d].shape.cell=4 cm", SHEETS + b);
}

static JnStatus plan(StudyRun* run) {
	for (int i = 0; i < PARTIES; ++i) {
		const Party* party = &parties[i];
		study_add(run, party->scene, party->name, party->title, duration_of(run, party) / 5e-3);
		study_set(run, "duration=%g s", duration_of(run, party));
		if (run->options->is_quick) make_coarse(run, i);
	}
	return run->status;
}

// ---- pictures ----

// Trampolines in three colours, and yellow ducks; the balls in all colours.
static void choose_paints(int party, PaintName paints[SHEETS + DUCK_COUNT]) {
	static const PaintName sheets[] = {PAINT_TEAL, PAINT_VIOLET, PAINT_RED},
						   balls[] = {PAINT_RED, PAINT_YELLOW, PAINT_BLUE};
	for (int b = 0; b < SHEETS + DUCK_COUNT; ++b) {
		const PaintName sheet_or_duck = b < SHEETS ? sheets[b / 2 % 3] : PAINT_YELLOW;
		const PaintName armadillo_or_ball = b == 0 ? PAINT_OLIVE : balls[b % 3];
		paints[b] = party == DUCKS ? sheet_or_duck : armadillo_or_ball;
	}
}

static JnStatus draw_picture(StudyRun* run, int party) {
	static const Camera cameras[PARTIES] = {{22, 14}, {205, 6}};
	const Party* p = &parties[party];
	const int index = study_find(run, p->name);
	PaintName paints[SHEETS + DUCK_COUNT];
	Picture picture = {.name = p->name,
					   .camera = cameras[party],
					   .columns = 3,
					   .width = 440,
					   .height = party == DUCKS ? 620 : 460,
					   .focus = party == DUCKS ? SHEETS : 1,
					   .paint_count = SHEETS + DUCK_COUNT,
					   .paints = paints};
	JnStatus status = JN_OK;
	choose_paints(party, paints);
	for (int i = 0; i < p->panels && status == JN_OK && study_is_done(run, index); ++i) {
		const double t = p->shown[i] * duration_of(run, p);
		char title[96];
		snprintf(title, sizeof title, "t = %.2f s", t);
		status = picture_add(&picture, study_folder(run, index), t, title);
	}
	if (status == JN_OK) status = picture_draw(&picture, run->plan.directory);
	picture_free(&picture);
	return status;
}

// ---- numbers ----

static Table tabulate_pace(StudyRun* run) {
	static const char* const parts[] = {"seconds_predict", "seconds_detect", "seconds_factor", "seconds_qp"};
	Table table = table_begin(&run->plan.arena, "scene|bodies|nodes|cells|steps|s a step|s per simulated s|Newton a "
												"step|predict [%]|detect [%]|factor [%]|QP [%]|rest [%]");
	for (int i = 0; i < PARTIES; ++i) {
		const int index = study_find(run, parties[i].name);
		const double wall = study_number(run, index, "wall_seconds"), steps = study_number(run, index, "steps");
		double share[4], rest = 100;
		for (int k = 0; k < 4; ++k) rest -= share[k] = 100 * study_number(run, index, parts[k]) / wall;
		if (study_is_done(run, index))
			table_row(&table, "%s|%.0f|%.0f|%.0f|%.0f|%.3f|%.1f|%.1f|%.1f|%.1f|%.1f|%.1f|%.1f", parties[i].title,
					  study_number(run, index, "bodies"), study_number(run, index, "nodes"),
					  study_number(run, index, "cells"), steps, wall / steps,
					  study_number(run, index, "wall_seconds_per_simulated_second"),
					  study_number(run, index, "newton") / steps, share[0], share[1], share[2], share[3], rest);
	}
	return table;
}

/// Mean and most of a column of the series.
typedef struct Spread {
	double mean, most;
} Spread;

static JnStatus spread_of(const Series* series, const char* name, Spread* out) {
	int column = 0;
	JN_TRY(series_column(series, name, &column));
	*out = (Spread){0, -INFINITY};
	for (int i = 1; i < series->rows; ++i) {
		const double value = series->values[(size_t)i * (size_t)series->columns + (size_t)column];
		out->mean += value / (series->rows - 1);
		out->most = fmax(out->most, value);
	}
	return JN_OK;
}

static JnStatus count_contacts(StudyRun* run, int index, const Party* party, Table* table) {
	static const char* const names[] = {"contacts",    "contacts_pressing", "qp_iterations",
										"qp_residual", "penetration",       "rejected"};
	Series series;
	Spread s[6] = {0};
	JnStatus status = series_read(study_folder(run, index), "series.csv", &series);
	for (int k = 0; k < 6 && status == JN_OK; ++k) status = spread_of(&series, names[k], &s[k]);
	if (status == JN_OK)
		table_row(table, "%s|%.0f|%.0f|%.0f|%.0f|%.1f|%.0f|%.1e|%.2f|%.2f|%.0f", party->title, s[0].mean, s[0].most,
				  s[1].mean, s[1].most, s[2].mean, s[2].most, s[3].most, 1e3 * s[4].mean, 1e3 * s[4].most,
				  s[5].mean * (series.rows - 1));
	series_free(&series);
	return status;
}

static JnStatus tabulate_contacts(StudyRun* run, Table* table) {
	*table =
		table_begin(&run->plan.arena, "scene|contacts, mean|most|pressing, mean|most|QP iterations a "
									  "step|most|largest residual|deepest overlap, mean [mm]|most [mm]|rejected steps");
	for (int i = 0; i < PARTIES; ++i) {
		const int index = study_find(run, parties[i].name);
		if (study_is_done(run, index)) JN_TRY(count_contacts(run, index, &parties[i], table));
	}
	return JN_OK;
}

static JnStatus count_passages(StudyRun* run, int* passages) {
	const int index = study_find(run, parties[DUCKS].name);
	Frames frames;
	*passages = 0;
	if (!study_is_done(run, index)) return JN_OK;
	JnStatus status = frames_open(study_folder(run, index), &frames);
	if (status == JN_OK) status = passages_count(&frames, SHEETS, passages);
	frames_close(&frames);
	return status;
}

static JnStatus report(StudyRun* run, Page* page) {
	Table contacts;
	int passages = 0;
	const Table pace = tabulate_pace(run);
	JN_TRY(tabulate_contacts(run, &contacts));
	JN_TRY(count_passages(run, &passages));
	for (int i = 0; i < PARTIES; ++i) JN_TRY(draw_picture(run, i));
	JN_TRY(table_write(&pace, run->plan.directory, "pace.csv"));
	JN_TRY(table_write(&contacts, run->plan.directory, "contacts.csv"));
	page_picture(page, "ducks.png", "Ducks fall through a maze of ten trampolines, each held at its four corners.");
	page_picture(page, "armadillo_balls.png", "Beach balls hit an armadillo that hangs by its hands.");
	page_heading(page, "Where the time goes");
	page_table(page, &pace);
	page_text(page,
			  "Shares of the wall time: the integrator's prediction, finding contacts, filling and factoring the "
			  "matrices of bodies in contact, and solving the quadratic programs; the rest is energies and files.");
	page_heading(page, "Contacts");
	page_table(page, &contacts);
	page_text(
		page,
		"Between frames the middle of a duck changed %d times from one side of a trampoline to the other without "
		"going around its rim. An overlap is that of the deepest vertex; contacts are of vertices with faces, so that "
		"edges may enter each other until a vertex finds a face.",
		passages);
	return JN_OK;
}

const Study study_ho_fig1 = {
	.name = "ho-fig1",
	.doc = "duck trampoline party and suspended armadillo: pictures, and what contact costs",
	.shown =
		"Löschner, Longva, Jeske, Kugelstadt, Bender: Higher-Order Time Integration for Deformable Solids (2020), "
		"figure 1, section 5.5. Left: 30 rubber ducks fall into a maze of 10 thin trampolines held at their corners, "
		"slide and bounce across them and collide with each other. Right: beach balls are thrown in sequence at a "
		"suspended armadillo, which takes their kinetic energy and keeps it well. Both with SDIRK2; the armadillo "
		"takes "
		"242.4 s per simulated second at 5 ms, with 5.48 Newton iterations a step (table 1, Intel i9-9900K).",
	.is_timed = true,
	.plan = plan,
	.report = report,
};
