/// @file report.h
/// A page about runs that needs nothing but itself: pictures, curves, statistics, what differs between their scenes.
#ifndef JN_APP_REPORT_H
#define JN_APP_REPORT_H

#include "view_routes.h"

enum { REPORT_MOST_RUNS = 24 };

typedef struct ReportOptions {
	const char* output; ///< path of the page
	const char* title;  ///< NULL: the names of the scenes
	int pictures;       ///< times that are drawn; 0: none
	const char* field;  ///< that colours them; NULL: none
	const char* note;   ///< a sentence below the title; NULL: none
} ReportOptions;

/// Write the page about open recordings. Without a browser it has no pictures, and says so. JN_IO_FAILED after a message.
JnStatus report_write(const ReportOptions* options, ViewSources* sources);

/// The same about folders, of which those that hold no recording and those behind the first REPORT_MOST_RUNS are left out;
/// without a page, and `*is_written` false, when none is left. For commands that end with a report.
JnStatus report_write_folders(const ReportOptions* options, int count, const char* const folders[], bool* is_written);

#endif
