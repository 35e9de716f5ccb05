/// @file plot.h
/// Curves over common times, as a CSV file and a picture.
#ifndef JN_APP_REPRODUCE_PLOT_H
#define JN_APP_REPRODUCE_PLOT_H

#include "base/arena.h"

enum { PLOT_MOST_CURVES = 16 };

typedef struct Curve {
	const char* name;  ///< column of the CSV
	const char* title; ///< in the legend
	double* values;    ///< one a time; NAN: nothing to show
} Curve;

typedef struct Plot {
	const char* name; ///< of the files: name.csv, name.gnuplot, name.png
	const char* title;
	const char* label; ///< of the vertical axis
	bool is_logarithmic;
	int rows;
	double* times; ///< rows [s]
	int count;
	Curve curves[PLOT_MOST_CURVES];
} Plot;

/// Make room for `rows` times of equal distance, from `first` to `last`.
JnStatus plot_begin(Plot* plot, JnArena* arena, int rows, double first, double last);
/// Add a curve whose values are NAN; NULL when there is no room.
Curve* plot_add(Plot* plot, JnArena* arena, const char* name, const char* title);
/// Mean of a curve's values at times in [from, to]; NAN when there is none.
double plot_mean(const Plot* plot, const Curve* curve, double from, double to);
/// Write the files into `folder` and draw. JN_IO_FAILED.
JnStatus plot_draw(const Plot* plot, const char* folder);

#endif
