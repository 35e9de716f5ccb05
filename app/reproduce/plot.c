#include "reproduce/plot.h"

#include <math.h>
#include <stdio.h>

#include "compare_drawing.h"
#include "compare_script.h"

JnStatus plot_begin(Plot* plot, JnArena* arena, int rows, double first, double last) {
	plot->rows = rows;
	JN_NEW(arena, plot->times, rows);
	for (int i = 0; i < rows; ++i) plot->times[i] = first + (last - first) * i / (rows > 1 ? rows - 1 : 1);
	return JN_OK;
}

Curve* plot_add(Plot* plot, JnArena* arena, const char* name, const char* title) {
	if (plot->count == PLOT_MOST_CURVES) return NULL;
	Curve* curve = &plot->curves[plot->count];
	*curve = (Curve){.name = name, .title = title};
	curve->values = jn_arena_take(arena, (size_t)plot->rows, sizeof *curve->values);
	if (curve->values == NULL) return NULL;
	for (int i = 0; i < plot->rows; ++i) curve->values[i] = NAN;
	++plot->count;
	return curve;
}

double plot_mean(const Plot* plot, const Curve* curve, double from, double to) {
	double sum = 0;
	int count = 0;
	for (int i = 0; i < plot->rows; ++i) {
		if (!(plot->times[i] >= from && plot->times[i] <= to) || isnan(curve->values[i])) continue;
		sum += curve->values[i];
		++count;
	}
	return count > 0 ? sum / count : NAN;
}

static JnStatus write_table(const Plot* plot, const char* folder) {
	JnTextFile file;
	char name[128];
	snprintf(name, sizeof name, "%s.csv", plot->name);
	JN_TRY(jn_text_open(&file, folder, name, JN_TEXT_REPLACE));
	jn_text_print(&file, "t");
	for (int c = 0; c < plot->count; ++c) jn_text_print(&file, ",%s", plot->curves[c].name);
	for (int i = 0; i < plot->rows; ++i) {
		jn_text_print(&file, "\n%.6g", plot->times[i]);
		for (int c = 0; c < plot->count; ++c)
			if (isnan(plot->curves[c].values[i]))
				jn_text_print(&file, ",nan");
			else
				jn_text_print(&file, ",%.9g", plot->curves[c].values[i]);
	}
	jn_text_print(&file, "\n");
	return jn_text_close(&file);
}

static bool is_shown(const Plot* plot, const Curve* curve) {
	return !isnan(plot_mean(plot, curve, -INFINITY, INFINITY));
}

JnStatus plot_draw(const Plot* plot, const char* folder) {
	JnTextFile file;
	char name[128];
	const char* lead = "plot";
	snprintf(name, sizeof name, "%s.gnuplot", plot->name);
	JN_TRY(write_table(plot, folder));
	JN_TRY(jn_text_open(&file, folder, name, JN_TEXT_REPLACE));
	compare_print_style(&file, plot->name, plot->title);
	jn_text_print(&file,
				  "set terminal pngcairo size 1000,480 font 'DejaVu Sans,12'\nset output '%s.png'\n"
				  "set datafile separator ','\nset datafile missing 'nan'\nset title '%s' noenhanced\n"
				  "set xlabel 'time [s]'\nset ylabel '%s' noenhanced\nset key outside right noenhanced samplen 2\n",
				  plot->name, plot->title, plot->label);
	if (plot->is_logarithmic) jn_text_print(&file, "set logscale y\nset format y '10^{%%L}'\n");
	for (int i = 0; i < plot->count; ++i) {
		if (!is_shown(plot, &plot->curves[i])) continue;
		jn_text_print(&file, "%s '%s.csv' every ::1 using 1:%d with lines ", lead, plot->name, i + 2);
		compare_print_pen(&file, i, i / COMPARE_COLOURS);
		jn_text_print(&file, " title '%s'", plot->curves[i].title);
		lead = ", \\\n    ";
	}
	jn_text_print(&file, "\n");
	JN_TRY(jn_text_close(&file));
	if (*lead == ',') compare_draw(folder, plot->name);
	return JN_OK;
}
