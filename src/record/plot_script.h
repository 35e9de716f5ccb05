/// @file plot_script.h
/// The pictures of a run as gnuplot files that read ../series.csv and can be run again by hand.
#ifndef JN_RECORD_PLOT_SCRIPT_H
#define JN_RECORD_PLOT_SCRIPT_H

#include "record/recorder.h"

enum { JN_PLOT_CURVES = 4 };

typedef struct JnCurve {
	const char* column; ///< of the series; a curve without its column is left out
	const char* title;  ///< in the legend
	const char* style;  ///< gnuplot's words behind `with`
} JnCurve;

typedef enum JnPlotAxis {
	JN_AXIS_LINEAR,
	JN_AXIS_LOG,         ///< logarithmic, without the values that are not above 0; linear when none is
	JN_AXIS_LOG_IF_WIDE, ///< the same when the first curve spans more than a factor of 4
	JN_AXIS_COUNT,       ///< linear, from 0
} JnPlotAxis;

typedef struct JnPlot {
	const char* name;  ///< of the files: name.gnuplot, name.svg, name.png
	const char* doc;   ///< one line
	const char* label; ///< of the vertical axis; the unit is that of the first curve's column
	JnPlotAxis axis;
	JnCurve curves[JN_PLOT_CURVES];
} JnPlot;

extern const JnPlot jn_plot_list[]; ///< ended by a row without name

/// What the scripts need to know of the series.
typedef struct JnSeriesRange {
	long rows;
	double low, high; ///< least and largest value above 0 of a plot's first curve; high 0: there is none
} JnSeriesRange;

/// Index of a column, or -1.
int jn_column_find(const JnRecordInfo* info, const char* name);

/// Write plots/<name>.gnuplot into `directory`. JN_IO_FAILED.
JnStatus jn_plot_write(const JnPlot* plot, const JnRecordInfo* info, const char* directory, JnSeriesRange range);

#endif
