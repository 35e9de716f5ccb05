#include "reproduce/phase.h"

#include <math.h>

#include "compare_drawing.h"
#include "compare_script.h"

enum { CURVE_POINTS = 400, PANEL_WIDTH = 520, PANEL_HEIGHT = 400 };

static const double PI = 3.14159265358979323846;

// omega^2 = 2 g/l (cos theta - cos theta_0), with theta = theta_0 sin phi: points lie close where the curve turns.
static void print_swing(JnTextFile* file, double stiffness, double angle) {
	for (int i = 0; i <= CURVE_POINTS; ++i) {
		const double phi = 2 * PI * i / CURVE_POINTS, theta = angle * sin(phi);
		const double square = 2 * stiffness * (cos(theta) - cos(angle));
		jn_text_print(file, "%.6g,%.6g\n", theta, copysign(sqrt(fmax(square, 0)), cos(phi)));
	}
}

// The same beyond the top: omega^2 = 2 g/l (1 + cos theta) + over, for both directions.
static void print_turn(JnTextFile* file, double stiffness, double over) {
	for (int side = 1; side >= -1; side -= 2) {
		for (int i = 0; i <= CURVE_POINTS; ++i) {
			const double theta = PI * (2.0 * i / CURVE_POINTS - 1);
			jn_text_print(file, "%.6g,%.6g\n", theta, side * sqrt(2 * stiffness * (1 + cos(theta)) + over));
		}
		jn_text_print(file, "\n");
	}
}

JnStatus phase_curves_write(const char* folder, const char* name, double stiffness, int count, const double* angles) {
	JnTextFile file;
	JN_TRY(jn_text_open(&file, folder, name, JN_TEXT_REPLACE));
	jn_text_print(&file,
				  "# theta [rad], omega [rad/s] of equal energy; the last two blocks: the separatrix, and beyond it\n");
	for (int i = 0; i < count; ++i) {
		print_swing(&file, stiffness, angles[i]);
		jn_text_print(&file, "\n\n");
	}
	print_turn(&file, stiffness, 0);
	jn_text_print(&file, "\n");
	print_turn(&file, stiffness, 2 * stiffness);
	return jn_text_close(&file);
}

// ---- the script ----

static void print_head(JnTextFile* file, const PhasePicture* picture, int rows) {
	compare_print_style(file, picture->name, picture->title);
	jn_text_print(file,
				  "set terminal pngcairo size %d,%d font 'DejaVu Sans,12'\nset output '%s.png'\n"
				  "set datafile separator ','\nset multiplot layout %d,%d title '%s' noenhanced font ',15'\n"
				  "set xrange [-pi:pi]\nset yrange [%g:%g]\n"
				  "set xtics ('-π' -pi, '-π/2' -pi/2, '0' 0, 'π/2' pi/2, 'π' pi)\n"
				  "set xlabel 'angle θ' offset 0,0.3\nset ylabel 'angular speed [rad/s]' offset 1\nunset key\n"
				  "wrap(a) = a - 2 * pi * floor((a + pi) / (2 * pi))\n",
				  PANEL_WIDTH * picture->columns, PANEL_HEIGHT * rows + 40, picture->name, rows, picture->columns,
				  picture->title, -picture->omega_high, picture->omega_high);
}

static void print_curves(JnTextFile* file, const char* curves, int count) {
	for (int i = 0; i < count; ++i)
		jn_text_print(file, "'%s' index %d using 1:2 with lines lw 1.1 lc rgb '#909090', \\\n    ", curves, i);
	jn_text_print(file, "'%s' index %d using 1:2 with lines lw 1.1 dt 2 lc rgb '#606060', \\\n    ", curves, count);
	jn_text_print(file, "'%s' index %d using 1:2 with lines lw 0.8 lc rgb '#c0c0c0'", curves, count + 1);
}

// The path of a run as a thin line that is broken where the angle wraps, and its points.
static void print_run(JnTextFile* file, const PhasePanel* panel, int run) {
	static const char* const colours[PHASE_MOST_RUNS] = {"#0072b2", "#009e73", "#d55e00", "#cc79a7", "#e69f00"};
	jn_text_print(file,
				  ", \\\n    '%s' every ::1 using (wrap($%d)):%d with points pt 7 ps 0.45 lc rgb '%s', "
				  "'%s' every ::1::1 using (wrap($%d)):%d with points pt 6 ps 1.3 lw 1.6 lc rgb '#202020'",
				  panel->runs[run], panel->theta + 1, panel->omega + 1, colours[run % PHASE_MOST_RUNS],
				  panel->runs[run], panel->theta + 1, panel->omega + 1);
}

static void print_panel(JnTextFile* file, const PhasePanel* panel, const char* curves, int curve_count) {
	jn_text_print(file, "set title '%s' noenhanced offset 0,-0.5\nplot ", panel->title);
	print_curves(file, curves, curve_count);
	for (int i = 0; i < panel->run_count; ++i) print_run(file, panel, i);
	jn_text_print(file, "\n");
}

JnStatus phase_draw(const PhasePicture* picture, const char* folder, const char* curves, int curve_count) {
	JnTextFile file;
	char name[128];
	if (picture->count == 0) return JN_OK;
	snprintf(name, sizeof name, "%s.gnuplot", picture->name);
	JN_TRY(jn_text_open(&file, folder, name, JN_TEXT_REPLACE));
	print_head(&file, picture, (picture->count + picture->columns - 1) / picture->columns);
	for (int i = 0; i < picture->count; ++i) print_panel(&file, &picture->panels[i], curves, curve_count);
	jn_text_print(&file, "unset multiplot\n");
	JN_TRY(jn_text_close(&file));
	compare_draw(folder, picture->name);
	return JN_OK;
}
