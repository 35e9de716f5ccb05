/// @file report_chart.h
/// Curves as SVG inside a page.
#ifndef JN_APP_REPORT_CHART_H
#define JN_APP_REPORT_CHART_H

#include <stdbool.h>

#include "record/text_file.h"

typedef struct ReportCurve {
	const char* name;
	long count;
	const double *t, *y; ///< t goes forward
} ReportCurve;

typedef struct ReportChart {
	const char* title;
	const char* unit; ///< of y; "": none
	bool is_log;      ///< what is not above 0 is left out
	int count;
	const ReportCurve* curves;
} ReportChart;

/// A <figure>; nothing when no curve has a point, or all of them are 0.
void report_chart_print(JnTextFile* file, const ReportChart* chart);

#endif
