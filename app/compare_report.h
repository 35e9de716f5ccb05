/// @file compare_report.h
/// The page with which a comparison ends.
#ifndef JN_APP_COMPARE_REPORT_H
#define JN_APP_COMPARE_REPORT_H

#include "compare_jobs.h"

/// Write report.html into the plan's folder, about the runs that left a recording, without pictures of bodies: those take
/// longer than many a comparison, and `jounce report` adds them. Without such a run there is no page. JN_IO_FAILED after a
/// message.
JnStatus compare_report_write(const char* title, const CompareJobs* jobs, bool* is_written);

#endif
