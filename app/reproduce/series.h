/// @file series.h
/// Columns of numbers from a CSV file, such as the series.csv of a run.
#ifndef JN_APP_REPRODUCE_SERIES_H
#define JN_APP_REPRODUCE_SERIES_H

#include "base/arena.h"

typedef struct Series {
	JnArena arena;
	int rows, columns;
	const char** names;
	double* values; ///< [row][column]
} Series;

/// Read "folder/name". JN_IO_FAILED after a message. Free with series_free in either case.
JnStatus series_read(const char* folder, const char* name, Series* series);
void series_free(Series* series);

/// Index of a column. JN_IO_FAILED after a message that names it.
JnStatus series_column(const Series* series, const char* name, int* column);

#endif
