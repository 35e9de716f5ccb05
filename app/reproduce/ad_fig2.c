// AD figure 2: a brittle plate is hit by a ball, with equal steps and with steps by the force error, over three sizes.
#include <math.h>
#include <stdio.h>

#include "reproduce/picture.h"
#include "reproduce/series.h"
#include "reproduce/study.h"

typedef struct PlateSize {
	const char* name;
	double spacing; // of the points [mm]
	bool is_quick;  // one of the quick form
} PlateSize;

static const PlateSize sizes[] = {{"small", 5, true}, {"medium", 10.0 / 3, false}, {"large", 2, false}};

enum { SIZES = sizeof sizes / sizeof *sizes };

typedef enum Stepping { FIXED, ADAPTIVE, STEPPINGS } Stepping;

static const char* const stepping_names[STEPPINGS] = {[FIXED] = "fixed", [ADAPTIVE] = "adaptive"};

// Equal steps of 2 us for each mm of spacing are the largest with which no number of the table is farther than a tenth from
// that of the adaptive run. The tolerance stands in the scene and is the same for all sizes.
static const double step_a_mm = 2;                       // [us]
static const double frame = 1.25e-3, shown[] = {30, 35}; // [s], frames
enum { SHOWN = sizeof shown / sizeof *shown };

static void name_case(const PlateSize* size, Stepping stepping, char name[64]) {
	snprintf(name, 64, "%s_%s", stepping_names[stepping], size->name);
}

static int find_case(const StudyRun* run, const PlateSize* size, Stepping stepping) {
	char name[64];
	name_case(size, stepping, name);
	return study_find(run, name);
}

static void add_case(StudyRun* run, const PlateSize* size, Stepping stepping) {
	char name[64], label[96];
	name_case(size, stepping, name);
	snprintf(label, sizeof label, "%s steps, points %.3g mm apart", stepping_names[stepping], size->spacing);
	study_add(run, "shatter.yaml", name, label, (stepping == FIXED ? 4 : 1) * pow(size->spacing, -4));
	study_set(run, "bodies[0].shape.spacing=%g mm", size->spacing);
	if (stepping == FIXED) study_set(run, "step={controller: fixed, dt: %g us}", step_a_mm * size->spacing);
}

static JnStatus plan(StudyRun* run) {
	for (int i = 0; i < SIZES; ++i)
		for (Stepping s = FIXED; s < STEPPINGS && (sizes[i].is_quick || !run->options->is_quick); ++s)
			add_case(run, &sizes[i], s);
	return run->status;
}

// ---- what is left of the plate ----

typedef struct Pieces {
	double broken, damaged, pieces, largest; // bonds; points; pieces, single points among them; points of the largest
} Pieces;

static JnStatus read_pieces(const StudyRun* run, int index, Pieces* out) {
	static const char* const names[] = {"fracture.broken_total", "fracture.damaged_points", "fracture.fragments",
										"fracture.loose_points", "fracture.largest_fragment"};
	enum { NAMES = sizeof names / sizeof *names };
	double last[NAMES];
	Series series;
	JnStatus status = series_read(study_folder(run, index), "series.csv", &series);
	for (int k = 0; k < NAMES && status == JN_OK; ++k) {
		int column = 0;
		status = series_column(&series, names[k], &column);
		if (status == JN_OK)
			last[k] = series.values[(size_t)(series.rows - 1) * (size_t)series.columns + (size_t)column];
	}
	if (status == JN_OK) *out = (Pieces){last[0], last[1], last[2] + last[3], last[4]};
	series_free(&series);
	return status;
}

static JnStatus tabulate_cases(StudyRun* run, Table* table) {
	*table = table_begin(&run->plan.arena, "points|steps|accepted|rejected|iterations of CG|time [s]|broken bonds|"
										   "damaged points|pieces|points of the largest");
	for (int i = 0; i < SIZES; ++i)
		for (Stepping s = FIXED; s < STEPPINGS; ++s) {
			const int index = find_case(run, &sizes[i], s);
			Pieces pieces;
			if (index < 0 || !study_is_done(run, index)) continue;
			JN_TRY(read_pieces(run, index, &pieces));
			table_row(table, "%.0f|%s|%.0f|%.0f|%.0f|%.1f|%.0f|%.0f|%.0f|%.0f", study_number(run, index, "nodes") - 1,
					  stepping_names[s], study_number(run, index, "steps"), study_number(run, index, "rejected"),
					  study_number(run, index, "iterations"), study_number(run, index, "wall_seconds"), pieces.broken,
					  pieces.damaged, pieces.pieces, pieces.largest);
		}
	return JN_OK;
}

// Numbers of the fixed run over those of the adaptive one.
static JnStatus tabulate_gain(StudyRun* run, Table* table) {
	*table = table_begin(&run->plan.arena, "points|fewer attempts|fewer iterations|faster|broken bonds|damaged "
										   "points|pieces");
	for (int i = 0; i < SIZES; ++i) {
		const int fixed = find_case(run, &sizes[i], FIXED), adaptive = find_case(run, &sizes[i], ADAPTIVE);
		Pieces a, b;
		if (fixed < 0 || !study_is_done(run, fixed) || !study_is_done(run, adaptive)) continue;
		JN_TRY(read_pieces(run, fixed, &a));
		JN_TRY(read_pieces(run, adaptive, &b));
		const double attempts = study_number(run, adaptive, "steps") + study_number(run, adaptive, "rejected");
		table_row(table, "%.0f|%.2f|%.2f|%.2f|%.2f|%.2f|%.2f", study_number(run, fixed, "nodes") - 1,
				  study_number(run, fixed, "steps") / attempts,
				  study_number(run, fixed, "iterations") / study_number(run, adaptive, "iterations"),
				  study_number(run, fixed, "wall_seconds") / study_number(run, adaptive, "wall_seconds"),
				  a.broken / b.broken, a.damaged / b.damaged, a.pieces / b.pieces);
	}
	return JN_OK;
}

// Of the largest size that is there: equal steps left, chosen ones right, as in the paper.
static JnStatus draw_pictures(StudyRun* run) {
	Picture picture = {.name = "frames", .camera = {25, 12}, .columns = STEPPINGS, .width = 400, .height = 320};
	JnStatus status = JN_OK;
	int size = SIZES - 1;
	while (size > 0 && find_case(run, &sizes[size], FIXED) < 0) --size;
	const PointPaint paint = {"damage", 0, 1, 0.6e-3 * sizes[size].spacing};
	for (int k = 0; k < SHOWN * STEPPINGS && status == JN_OK; ++k) {
		const Stepping stepping = k % STEPPINGS;
		const int index = find_case(run, &sizes[size], stepping);
		char title[96];
		snprintf(title, sizeof title, "%s steps, frame %g", stepping_names[stepping], shown[k / STEPPINGS]);
		if (study_is_done(run, index))
			status =
				picture_add_points(&picture, study_folder(run, index), frame * shown[k / STEPPINGS], title, &paint);
	}
	if (status == JN_OK) status = picture_draw(&picture, run->plan.directory);
	picture_free(&picture);
	return status;
}

static JnStatus report(StudyRun* run, Page* page) {
	Table cases, gain;
	JN_TRY(tabulate_cases(run, &cases));
	JN_TRY(tabulate_gain(run, &gain));
	JN_TRY(draw_pictures(run));
	JN_TRY(table_write(&cases, run->plan.directory, "cases.csv"));
	JN_TRY(table_write(&gain, run->plan.directory, "gain.csv"));
	page_picture(page, "frames.png",
				 "Damage, the share of a point's bonds that has broken, from 0 (pale) to 1 (dark red). The ball is "
				 "blue.");
	page_table(page, &cases);
	page_text(
		page,
		"The ball arrives at frame 28 of 36. Equal steps are %g us for each mm between points; the tolerance of the "
		"force error is the same for all sizes.",
		step_a_mm);
	page_heading(page, "Equal over chosen steps");
	page_table(page, &gain);
	return JN_OK;
}

const Study study_ad_fig2 = {
	.name = "ad-fig2",
	.doc = "a brittle plate hit by a ball, fixed against adaptive steps: pictures, steps, iterations, time",
	.shown =
		"Adaptive Time-Stepping with Linearized Force Error Estimation, figure 2: brittle fracture by peridynamics "
		"with "
		"Newmark's method, fixed steps left and adaptive ones right, at frames 30 and 35. The patterns are similar, "
		"and "
		"adaptive steps are 3 to 6 times faster in all, more for larger models; conjugate gradients take up to ten "
		"times the iterations in large steps. The scene, the steps and the tolerance are not given.",
	.is_timed = true,
	.plan = plan,
	.report = report,
};
