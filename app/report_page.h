/// @file report_page.h
/// The parts of a report; each writes a section, or nothing when there is nothing to tell.
#ifndef JN_APP_REPORT_PAGE_H
#define JN_APP_REPORT_PAGE_H

#include "base/arena.h"
#include "report.h"

typedef struct Report {
	const ReportOptions* options;
	ViewSources* sources;
	JnTextFile file;
	JnArena arena;
	int count;              ///< of runs
	const char** names;     ///< what each is called: its folder, or as much of it as tells it apart
	ViewSeries* series;     ///< of each run
	char no_pictures[1024]; ///< why there are none; "" when there are, or none were asked for
	char* pictures;         ///< HTML of them, made before the page; NULL: none
	size_t pictures_size;
} Report;

/// Text with what HTML needs escaped.
void report_text(Report* report, const char* text);

void report_pictures_make(Report* report);
void report_pictures(Report* report);
void report_curves(Report* report);
void report_statistics(Report* report);
void report_differences(Report* report);
void report_scenes(Report* report);

/// A number of a run's summary.json; NAN when it has none.
double report_number(const Report* report, int run, const char* name);

#endif
