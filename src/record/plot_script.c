// One row a picture; the script is the same for all but for the row's words.
#include "record/plot_script.h"

#include <math.h>
#include <string.h>

#include "record/text_file.h"

enum { PLOTTED_ROWS = 4000 }; // about two a pixel

static const double VISIBLE_RATIO = 1e-12; // of the largest value, at the foot of a logarithmic axis

// Colours of Okabe and Ito, which stay apart for the colour-blind.
#define BLUE "'#0072b2'"
#define ORANGE "'#d55e00'"
#define GREEN "'#009e73'"
#define BLACK "'#303030'"

const JnPlot jn_plot_list[] = {
	{"energy",
	 "Energies over time",
	 "energy",
	 JN_AXIS_LINEAR,
	 {{"kinetic", "kinetic", "lines lw 1.6 lc rgb " BLUE},
	  {"elastic", "elastic", "lines lw 1.6 lc rgb " ORANGE},
	  {"gravity", "gravity", "lines lw 1.6 lc rgb " GREEN},
	  {"total", "total", "lines lw 2.2 lc rgb " BLACK}}},
	{"energy_error",
	 "Distance of the specific total energy from its start",
	 "energy error",
	 JN_AXIS_LOG,
	 {{"specific_error", "", "lines lw 1.6 lc rgb " ORANGE}}},
	{"step_size",
	 "Time steps as the controller chose them",
	 "time step",
	 JN_AXIS_LOG_IF_WIDE,
	 {{"dt", "", "lines lw 1.6 lc rgb " BLUE}}},
	{"newton",
	 "Cost of each step",
	 "count in a step",
	 JN_AXIS_COUNT,
	 {{"newton", "Newton iterations", "points pt 7 ps 0.6 lc rgb " BLUE},
	  {"factorizations", "factorisations", "points pt 7 ps 0.6 lc rgb " ORANGE}}},
	{0},
};

int jn_column_find(const JnRecordInfo* info, const char* name) {
	for (int i = 0; i < info->column_count; i++) {
		if (strcmp(info->columns[i].name, name) == 0) return i;
	}
	return -1;
}

// A single-quoted string knows no escapes but '' for '.
static void print_quoted(JnTextFile* file, const char* text) {
	for (const char* at = text; *at != '\0'; at++) {
		if (*at == '\'')
			jn_text_print(file, "''");
		else
			jn_text_print(file, "%c", (unsigned char)*at < 0x20 ? ' ' : *at);
	}
}

static void print_label(JnTextFile* file, const char* axis, const char* words, const char* unit) {
	jn_text_print(file, "set %slabel '%s", axis, words);
	if (unit[0] != '\0') jn_text_print(file, " [%s]", unit);
	jn_text_print(file, "' noenhanced\n");
}

static bool is_logarithmic(JnPlotAxis axis, JnSeriesRange range) {
	if (axis == JN_AXIS_LOG_IF_WIDE) return range.high > 4 * range.low;
	return axis == JN_AXIS_LOG && range.high > 0;
}

// Errors far below the largest are rounding: they would squeeze the rest.
static void print_axis(JnTextFile* file, JnPlotAxis axis, JnSeriesRange range) {
	const bool is_log = is_logarithmic(axis, range);
	if (is_log) {
		jn_text_print(file, "set logscale y\nset format y '10^{%%T}'\n");
		if (range.low < VISIBLE_RATIO * range.high)
			jn_text_print(file, "set yrange [%g:*]\n", VISIBLE_RATIO * range.high);
	} else if (axis == JN_AXIS_COUNT) {
		jn_text_print(file, "set yrange [0:*]\nset offsets 0, 0, graph 0.05, graph 0.03\n");
		jn_text_print(file, "set ytics %g\n", fmax(1, ceil(range.high / 8)));
	} else if (axis == JN_AXIS_LINEAR) {
		jn_text_print(file, "set offsets 0, 0, graph 0.04, graph 0.04\n");
	} else {
		jn_text_print(file, "set yrange [0:*]\nset offsets 0, 0, graph 0.1, 0\n");
	}
	jn_text_print(file, "shown(value) = %s\n", is_log ? "value > 0 ? value : NaN # zeros have no logarithm" : "value");
}

static void print_frame(JnTextFile* file, const JnPlot* plot, const JnRecordInfo* info, JnSeriesRange range) {
	const JnColumn* time = &info->columns[jn_column_find(info, "t")];
	const JnColumn* first = &info->columns[jn_column_find(info, plot->curves[0].column)];
	const bool has_legend = plot->curves[0].title[0] != '\0'; // between title and picture
	jn_text_print(file, "# %s, from ../series.csv. To draw it again: gnuplot %s.gnuplot\n", plot->doc, plot->name);
	jn_text_print(file, "set datafile separator comma\nset encoding utf8\nset title '");
	print_quoted(file, info->scene_name);
	jn_text_print(file, " — ");
	print_quoted(file, info->method);
	jn_text_print(file, "' noenhanced font ',16'%s\n", has_legend ? " offset 0,1.5" : "");
	print_label(file, "x", "time", time->unit);
	print_label(file, "y", plot->label, first->unit);
	jn_text_print(file, "set border 3 lw 0.8 lc rgb '#606060'\n"
						"set tics nomirror out scale 0.6 textcolor rgb '#303030'\n"
						"set grid lw 0.6 lt 1 lc rgb '#e2e2e2'\n"
						"set autoscale xfix\nset format '%%g'\n");
	if (has_legend) {
		jn_text_print(file,
					  "set tmargin 5\n"
					  "set key at graph 0.5, graph 1.03 center bottom horizontal reverse Left samplen 2 width 2\n");
	}
	print_axis(file, plot->axis, range);
}

static void print_curves(JnTextFile* file, const JnPlot* plot, const JnRecordInfo* info, JnSeriesRange range) {
	const long stride = range.rows > PLOTTED_ROWS ? (range.rows + PLOTTED_ROWS - 1) / PLOTTED_ROWS : 1;
	const char* lead = "plot";
	for (int i = 0; i < JN_PLOT_CURVES && plot->curves[i].column != NULL; i++) {
		const JnCurve* curve = &plot->curves[i];
		if (jn_column_find(info, curve->column) < 0) continue;
		jn_text_print(file, "%s '../series.csv' every %ld using (column('t')):(shown(column('%s'))) with %s %stitle",
					  lead, stride, curve->column, curve->style, curve->title[0] != '\0' ? "" : "no");
		if (curve->title[0] != '\0') jn_text_print(file, " '%s'", curve->title);
		lead = ", \\\n    ";
	}
	jn_text_print(file, "\n");
}

JnStatus jn_plot_write(const JnPlot* plot, const JnRecordInfo* info, const char* directory, JnSeriesRange range) {
	char name[64];
	snprintf(name, sizeof name, "plots/%s.gnuplot", plot->name);
	JnTextFile file;
	JN_TRY(jn_text_open(&file, directory, name, JN_TEXT_DIRECT));
	print_frame(&file, plot, info, range);
	jn_text_print(&file,
				  "\nset terminal svg size 900,500 dynamic font 'sans-serif,14' background '#ffffff'\n"
				  "set output '%s.svg'\n",
				  plot->name);
	print_curves(&file, plot, info, range);
	jn_text_print(&file,
				  "\nset terminal pngcairo size 1350,750 font 'sans-serif,14' fontscale 1.2 linewidth 1.5\n"
				  "set output '%s.png'\nreplot\n",
				  plot->name);
	return jn_text_close(&file);
}
