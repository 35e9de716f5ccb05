// A plate of glass with an edge crack in tension: how fast the crack runs, where, and how much that depends on the points.
// Two refinements: smaller points at the same number of them in the horizon (delta-convergence, towards the local
// theory), and more points in the same horizon (m-convergence, towards the nonlocal theory).
#include <math.h>
#include <stdio.h>

#include "reproduce/frames.h"
#include "reproduce/picture.h"
#include "reproduce/plot.h"
#include "reproduce/series.h"
#include "reproduce/study.h"

typedef struct NotchCase {
	const char *name, *title;
	double stress;   // [MPa]
	double spacing;  // [mm]
	double spacings; // in the horizon: m
	bool is_quick;   // one of the quick form
} NotchCase;

static const NotchCase cases[] = {
	{"s=4MPa_h=1mm_m=3", "4 MPa, h = 1 mm, m = 3", 4, 1, 3, true},
	{"s=4MPa_h=0.5mm_m=3", "4 MPa, h = 0.5 mm, m = 3", 4, 0.5, 3, true},
	{"s=4MPa_h=0.25mm_m=3", "4 MPa, h = 0.25 mm, m = 3", 4, 0.25, 3, false},
	{"s=4MPa_h=0.67mm_m=4.5", "4 MPa, h = 0.67 mm, m = 4.5", 4, 2.0 / 3, 4.5, true},
	{"s=4MPa_h=0.5mm_m=6", "4 MPa, h = 0.5 mm, m = 6", 4, 0.5, 6, false},
	{"s=12MPa_h=1mm_m=3", "12 MPa, h = 1 mm, m = 3", 12, 1, 3, true},
	{"s=12MPa_h=0.5mm_m=3", "12 MPa, h = 0.5 mm, m = 3", 12, 0.5, 3, true},
	{"s=12MPa_h=0.25mm_m=3", "12 MPa, h = 0.25 mm, m = 3", 12, 0.25, 3, false},
};

enum { CASES = sizeof cases / sizeof *cases };

// Of the scene. Under plane stress with Poisson's ratio 1/3 shear waves run at sqrt(3 E / (8 rho)), longitudinal ones
// faster by sqrt(3), as in a body with 1/4, and Rayleigh's equation then has the root 0.9194.
static const double notch_end = 0.05, length = 0.1, thickness = 1e-3, fracture_energy = 135; // [m], [J/m^2]
static const double shear_speed = 3326.5, rayleigh_share = 0.9194;                           // [m/s]
static const double broken = 0.3; // damage beside a straight crack is 0.36 and more with these horizons

static double duration_of(const NotchCase* notch) {
	return notch->stress < 10 ? 60e-6 : 45e-6;
}

static bool is_wanted(const StudyRun* run, const NotchCase* notch) {
	return notch->is_quick || !run->options->is_quick;
}

static JnStatus plan(StudyRun* run) {
	for (int i = 0; i < CASES; ++i) {
		const NotchCase* notch = &cases[i];
		const double duration = duration_of(notch), dt = 1e-7 * notch->spacing;
		if (!is_wanted(run, notch)) continue;
		study_add(run, "notch.yaml", notch->name, notch->title, duration / dt / pow(notch->spacing, 2));
		study_set(run, "bodies[0].shape.spacing=%.17g mm", notch->spacing);
		study_set(run, "bodies[0].material.horizon_spacings=%g", notch->spacings);
		study_set(run, "bodies[0].loads[0].force=[0, %g, 0]", -100 * notch->stress);
		study_set(run, "bodies[0].loads[1].force=[0, %g, 0]", 100 * notch->stress);
		study_set(run, "step.dt=%.17g s", dt);
		study_set(run, "duration=%.17g s", duration);
		study_set(run, "record.plots=no");
	}
	return run->status;
}

// The foremost point that has lost its hold, or the end of the notch [m].
static double find_tip(const Frames* frames, const double* damage) {
	double tip = notch_end;
	for (int i = 0; i < frames->node_count; ++i)
		if (damage[i] > broken) tip = fmax(tip, frames->rest[3 * (size_t)i]);
	return tip;
}

// Positions of the tip at the plot's times [mm], until it has reached the far edge.
static JnStatus follow_tip(const char* folder, const Plot* plot, double* tip) {
	Frames frames;
	JnArena arena = {0};
	JnStatus status = frames_open(folder, &frames);
	double* damage = jn_arena_take(&arena, (size_t)frames.node_count + 1, sizeof *damage);
	if (status == JN_OK && damage == NULL) status = JN_OUT_OF_MEMORY;
	for (int i = 0; i < plot->rows && status == JN_OK; ++i) {
		const int frame = frames_nearest(&frames, plot->times[i]);
		if (fabs(frames.times[frame] - plot->times[i]) > 0.3e-6) continue; // the run has ended
		status = frames_read_field(&frames, frame, "damage", damage);
		tip[i] = 1e3 * find_tip(&frames, damage);
	}
	frames_close(&frames);
	jn_arena_free(&arena);
	return status;
}

// Slope of the line through the tips between two places, by least squares [m/s]; NAN for less than three of them.
static double mean_speed(const Plot* plot, const double* tip, double from, double to) {
	double count = 0, t = 0, x = 0, tt = 0, tx = 0;
	for (int i = 0; i < plot->rows; ++i) {
		if (!(tip[i] >= from && tip[i] <= to)) continue;
		count += 1, t += plot->times[i], x += tip[i], tt += plot->times[i] * plot->times[i],
			tx += plot->times[i] * tip[i];
	}
	return count >= 3 ? 1e-3 * (count * tx - t * x) / (count * tt - t * t) : NAN;
}

enum { WINDOW = 6 }; // frames: 6 us, in which the tip passes ten points and more

// Speed at each time, over a window around it [m/s].
static void find_speeds(const Plot* plot, const double* tip, double* speed) {
	for (int i = WINDOW / 2; i + WINDOW / 2 < plot->rows; ++i) {
		const double before = tip[i - WINDOW / 2], after = tip[i + WINDOW / 2];
		const bool is_running = after > 1e3 * notch_end + 0.1 && after < 1e3 * length - 2;
		if (is_running)
			speed[i] = 1e-3 * (after - before) / (plot->times[i + WINDOW / 2] - plot->times[i - WINDOW / 2]);
	}
}

static double largest_of(const Plot* plot, const Curve* curve) {
	double most = NAN;
	for (int i = 0; i < plot->rows; ++i) most = fmax(most, curve->values[i]);
	return most;
}

static JnStatus make_curves(StudyRun* run, Plot* tips, Plot* speeds) {
	*tips = (Plot){.name = "tip", .title = "How far the crack has come", .label = "x of its tip [mm]"};
	*speeds = (Plot){.name = "speed", .title = "Speed of the tip, over 6 us", .label = "[m/s]"};
	JN_TRY(plot_begin(tips, &run->plan.arena, 61, 0, 60e-6));
	JN_TRY(plot_begin(speeds, &run->plan.arena, 61, 0, 60e-6));
	for (int i = 0; i < CASES; ++i) {
		const int index = study_find(run, cases[i].name);
		const Curve* tip = plot_add(tips, &run->plan.arena, cases[i].name, cases[i].title);
		const Curve* speed = plot_add(speeds, &run->plan.arena, cases[i].name, cases[i].title);
		if (tip == NULL || speed == NULL) return JN_OUT_OF_MEMORY;
		if (index < 0 || !study_is_done(run, index)) continue;
		JN_TRY(follow_tip(study_folder(run, index), tips, tip->values));
		find_speeds(speeds, tip->values, speed->values);
	}
	return JN_OK;
}

// Energy of all broken bonds at the end [J].
static double energy_of(StudyRun* run, int index) {
	Series series;
	int column = 0;
	double energy = NAN;
	JnStatus status = series_read(study_folder(run, index), "series.csv", &series);
	if (status == JN_OK) status = series_column(&series, "fracture.energy", &column);
	if (status == JN_OK) energy = series.values[(size_t)(series.rows - 1) * (size_t)series.columns + (size_t)column];
	series_free(&series);
	return energy;
}

static double last_of(const Plot* plot, const Curve* curve) {
	double last = NAN;
	for (int i = 0; i < plot->rows; ++i) last = isnan(curve->values[i]) ? last : curve->values[i];
	return last;
}

static Table tabulate(StudyRun* run, const Plot* tips, const Plot* speeds) {
	const double rayleigh = rayleigh_share * shear_speed;
	Table table = table_begin(&run->plan.arena, "traction [MPa]|h [mm]|m|horizon [mm]|points|mean speed [m/s]|"
												"largest, over 6 us|largest over Rayleigh's|energy over G0 and length");
	for (int i = 0; i < CASES; ++i) {
		const NotchCase* notch = &cases[i];
		const int index = study_find(run, notch->name);
		if (index < 0 || !study_is_done(run, index)) continue;
		const Curve *tip = &tips->curves[i], *speed = &speeds->curves[i];
		const double most = largest_of(speeds, speed), came = 1e-3 * last_of(tips, tip) - notch_end;
		table_row(&table, "%g|%.3g|%g|%.3g|%.0f|%.0f|%.0f|%.2f|%.2f", notch->stress, notch->spacing, notch->spacings,
				  notch->spacing * notch->spacings, study_number(run, index, "nodes"),
				  mean_speed(tips, tip->values, 53, notch->stress < 10 ? 70 : 90), most, most / rayleigh,
				  energy_of(run, index) / (fracture_energy * thickness * came));
	}
	return table;
}

static JnStatus draw_pictures(StudyRun* run) {
	Picture picture = {.name = "notch", .columns = 2, .width = 520, .height = 230};
	JnStatus status = JN_OK;
	for (int i = 0; i < CASES && status == JN_OK; ++i) {
		const int index = study_find(run, cases[i].name);
		const PointPaint paint = {"damage", 0, 0.6, 0.65e-3 * cases[i].spacing}; // no gaps between points
		if (index >= 0 && study_is_done(run, index))
			status =
				picture_add_points(&picture, study_folder(run, index), duration_of(&cases[i]), cases[i].title, &paint);
	}
	if (status == JN_OK) status = picture_draw(&picture, run->plan.directory);
	picture_free(&picture);
	return status;
}

static JnStatus report(StudyRun* run, Page* page) {
	Plot tips, speeds;
	JN_TRY(make_curves(run, &tips, &speeds));
	JN_TRY(plot_draw(&tips, run->plan.directory));
	JN_TRY(plot_draw(&speeds, run->plan.directory));
	JN_TRY(draw_pictures(run));
	const Table table = tabulate(run, &tips, &speeds);
	JN_TRY(table_write(&table, run->plan.directory, "table.csv"));
	page_picture(page, "notch.png",
				 "Damage at the end of each run: the share of a point's bonds that has broken, from 0 "
				 "(pale) to 0.6 (dark red). The notch itself, from the left edge to the middle, is no "
				 "damage: its bonds were never made.");
	page_table(page, &table);
	page_text(
		page,
		"h is the spacing of the points, m the horizon over it. Mean speeds are slopes of lines through the tip's "
		"path from 53 mm on, to 70 mm at 4 MPa and 90 mm at 12 MPa; the tip is the foremost point with a damage of "
		"more than %g. Rayleigh waves run at %.0f m/s. The last column compares the energy of the broken bonds "
		"with that of one straight crack as long as the tip has come: branches cost more.",
		broken, rayleigh_share * shear_speed);
	page_picture(page, "tip.png", "The tip over time; the notch ends at 50 mm, the plate at 100 mm.");
	page_picture(page, "speed.png", "Its speed.");
	page_link(page, "tip.csv", "tips");
	page_link(page, "speed.csv", "speeds");
	return JN_OK;
}

const Study study_notch = {
	.name = "notch",
	.doc = "edge crack in a plate of glass: its path, and its speed over refinement",
	.shown =
		"Ha, Bobaru: Studies of dynamic crack propagation and crack branching with peridynamics, International "
		"Journal of Fracture 162 (2010). A plate of 10 x 4 cm with a notch to its middle is pulled at its long edges "
		"by a sudden traction. Under a low one the crack runs straight, under a high one (12 MPa there, in another "
		"glass) it branches, and its speed stays below that of Rayleigh waves.",
	.plan = plan,
	.report = report,
};
